// SPDX-License-Identifier: Apache-2.0
#include "formula/expression.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <initializer_list>
#include <tuple>
#include <utility>

#include "base/assert.h"
#include "base/error.h"
#include "math/bits.h"

namespace luxo {

Expr operator-(Expr x) { return Graph::apply(Op::Negate, x); }
Expr operator+(Expr x, Expr y) { return Graph::apply(Op::Add, x, y); }
Expr operator-(Expr x, Expr y) { return Graph::apply(Op::Subtract, x, y); }
Expr operator*(Expr x, Expr y) { return Graph::apply(Op::Multiply, x, y); }
Expr operator/(Expr x, Expr y) { return Graph::apply(Op::Divide, x, y); }
Expr pow(Expr x, int exponent) { return Graph::apply(Op::Power, x, {}, {}, exponent); }
Expr pow(Expr x, Expr y) { return Graph::apply(Op::Raise, x, y); }
Expr sqrt(Expr x) { return Graph::apply(Op::Sqrt, x); }
Expr exp(Expr x) { return Graph::apply(Op::Exp, x); }
Expr log(Expr x) { return Graph::apply(Op::Log, x); }
Expr cardinal(Expr w, int order) { return Graph::apply(Op::Cardinal, w, {}, {}, order); }
Expr sin(Expr x) { return Graph::apply(Op::Sin, x); }
Expr cos(Expr x) { return Graph::apply(Op::Cos, x); }
Expr tan(Expr x) { return Graph::apply(Op::Tan, x); }
Expr asin(Expr x) { return Graph::apply(Op::Asin, x); }
Expr acos(Expr x) { return Graph::apply(Op::Acos, x); }
Expr atan(Expr x) { return Graph::apply(Op::Atan, x); }
Expr atan2(Expr y, Expr x) { return Graph::apply(Op::Atan2, y, x); }
Expr sinh(Expr x) { return Graph::apply(Op::Sinh, x); }
Expr cosh(Expr x) { return Graph::apply(Op::Cosh, x); }
Expr tanh(Expr x) { return Graph::apply(Op::Tanh, x); }
Expr abs(Expr x) { return Graph::apply(Op::Abs, x); }
Expr min(Expr x, Expr y) { return Graph::apply(Op::Min, x, y); }
Expr max(Expr x, Expr y) { return Graph::apply(Op::Max, x, y); }
Expr floor(Expr x) { return Graph::apply(Op::Floor, x); }
Expr sign(Expr x) { return Graph::apply(Op::Sign, x); }
Expr less(Expr x, Expr y) { return Graph::apply(Op::Less, x, y); }
Expr lessEqual(Expr x, Expr y) { return Graph::apply(Op::LessEqual, x, y); }
Expr equal(Expr x, Expr y) { return Graph::apply(Op::Equal, x, y); }
Expr notEqual(Expr x, Expr y) { return 1 - equal(x, y); }
Expr select(Expr condition, Expr a, Expr b) { return Graph::apply(Op::Select, condition, a, b); }

Expr mod(Expr x, Expr y) { return x - y * floor(x / y); }
Expr clamp(Expr x, Expr lowest, Expr highest) { return min(max(x, lowest), highest); }
Expr mix(Expr a, Expr b, Expr t) { return a * (1 - t) + b * t; }
Expr smoothstep(Expr edge0, Expr edge1, Expr x) {
  const Expr t = clamp((x - edge0) / (edge1 - edge0), 0, 1);
  return t * t * (3 - 2 * t);
}

namespace {

std::uint64_t mixed(Op op, std::initializer_list<std::uint64_t> parts) {
  constexpr std::uint64_t kOdd = 0x9e3779b97f4a7c15u;
  std::uint64_t h = static_cast<std::uint64_t>(op) + 1;
  for (const std::uint64_t part : parts) h = std::rotl((h ^ part) * kOdd, 29);
  return h * kOdd;
}

std::uint32_t hash(const ExprNode& node) {
  return static_cast<std::uint32_t>(
      mixed(node.op, {std::uint64_t{node.a} << 32 | node.b, std::uint64_t{node.c},
                      std::bit_cast<std::uint64_t>(node.value)}) >>
      32);
}

/// By bits, so that NaN is one constant and -0 is not 0.
bool same(const ExprNode& x, const ExprNode& y) {
  return x.op == y.op && x.a == y.a && x.b == y.b && x.c == y.c && sameBits(x.value, y.value);
}

}  // namespace

Expr Graph::intern(const ExprNode& node) {
  if (2 * (nodes_.size() + 1) > table_.size()) growTable();
  const std::size_t mask = table_.size() - 1;
  const std::uint32_t key = hash(node);
  std::size_t place = key & mask;
  for (; table_[place].next != 0; place = (place + 1) & mask) {
    const std::uint32_t known = table_[place].next - 1;
    if (table_[place].hash == key && same(nodes_[known], node)) return {this, known};
  }
  if (nodes_.size() == kMaxNodes)
    throw Error(ErrorKind::Scene,
                fmt::format("the formula and its derivatives need more than {} operations", kMaxNodes),
                "split the surface, or simplify the formula");
  ranks_.push_back(rankOf(node));
  nodes_.push_back(node);
  table_[place] = {key, static_cast<std::uint32_t>(nodes_.size())};
  return {this, table_[place].next - 1};
}

Graph::Rank Graph::rankOf(const ExprNode& node) const {
  if (node.op == Op::Variable) return {.content = node.a};
  const int operands = operandCount(node.op);
  const Rank a = operands > 0 ? ranks_[node.a] : Rank{}, b = operands > 1 ? ranks_[node.b] : Rank{},
             c = operands > 2 ? ranks_[node.c] : Rank{};
  return {
      .height = operands > 0 ? 1 + std::max({a.height, b.height, c.height}) : 0,
      .content = mixed(node.op, {a.content, b.content, c.content, std::bit_cast<std::uint64_t>(node.value)})};
}

bool Graph::precedes(std::uint32_t node, std::uint32_t other) const {
  const Rank &x = ranks_[node], &y = ranks_[other];
  return std::tie(x.height, x.content) < std::tie(y.height, y.content);
}

void Graph::growTable() {
  std::vector<Entry> larger(std::max<std::size_t>(64, 2 * table_.size()));
  const std::size_t mask = larger.size() - 1;
  for (const Entry& entry : table_) {
    if (entry.next == 0) continue;
    std::size_t place = entry.hash & mask;
    while (larger[place].next != 0) place = (place + 1) & mask;
    larger[place] = entry;
  }
  table_ = std::move(larger);
}

Expr Graph::variable(std::uint32_t index) { return intern({.op = Op::Variable, .a = index}); }

std::uint32_t Graph::nodeOf(Expr f) {
  if (!f.isConstant()) {
    LUXO_REQUIRE(f.graph_ == this);
    return f.node_;
  }
  return intern({.op = Op::Constant, .value = f.constant_}).node_;
}

Expr Graph::at(std::uint32_t node) {
  LUXO_REQUIRE_COMPARE(node, <, nodes_.size());
  return nodes_[node].op == Op::Constant ? Expr(nodes_[node].value) : Expr(this, node);
}

std::vector<std::uint32_t> reachable(const Graph& graph, const std::vector<std::uint32_t>& roots) {
  const auto& nodes = graph.nodes();
  std::vector<bool> needed(nodes.size(), false);
  for (const std::uint32_t root : roots) needed[root] = true;
  for (std::size_t i = nodes.size(); i-- > 0;) {
    if (!needed[i]) continue;
    const int operands = operandCount(nodes[i].op);
    if (operands > 0) needed[nodes[i].a] = true;
    if (operands > 1) needed[nodes[i].b] = true;
    if (operands > 2) needed[nodes[i].c] = true;
  }
  std::vector<std::uint32_t> order;
  for (std::uint32_t i = 0; i < nodes.size(); ++i)
    if (needed[i]) order.push_back(i);
  return order;
}

std::vector<std::uint32_t> inOrderOfNeed(const Graph& graph, const std::vector<std::uint32_t>& roots) {
  const auto& nodes = graph.nodes();
  std::vector<bool> visited(nodes.size()), listed(nodes.size());
  std::vector<std::uint32_t> order, open(roots.rbegin(), roots.rend());
  while (!open.empty()) {
    const std::uint32_t i = open.back();
    if (visited[i]) {  // so have been its operands
      open.pop_back();
      if (!listed[i]) order.push_back(i);
      listed[i] = true;
      continue;
    }
    visited[i] = true;
    const int operands = operandCount(nodes[i].op);
    if (operands > 2) open.push_back(nodes[i].c);
    if (operands > 1) open.push_back(nodes[i].b);
    if (operands > 0) open.push_back(nodes[i].a);
  }
  return order;
}

}  // namespace luxo
