// SPDX-License-Identifier: Apache-2.0
#include "formula/expression.h"

#include <bit>
#include <utility>

#include "base/assert.h"
#include "formula/operation.h"

namespace luxo {

Expr operator-(Expr x) { return Graph::apply(Op::Negate, x); }
Expr operator+(Expr x, Expr y) { return Graph::apply(Op::Add, x, y); }
Expr operator-(Expr x, Expr y) { return Graph::apply(Op::Subtract, x, y); }
Expr operator*(Expr x, Expr y) { return Graph::apply(Op::Multiply, x, y); }
Expr operator/(Expr x, Expr y) { return Graph::apply(Op::Divide, x, y); }
Expr pow(Expr x, int exponent) { return Graph::apply(Op::Power, x, {}, exponent); }
Expr sqrt(Expr x) { return Graph::apply(Op::Sqrt, x); }
Expr exp(Expr x) { return Graph::apply(Op::Exp, x); }
Expr log(Expr x) { return Graph::apply(Op::Log, x); }
Expr sin(Expr x) { return Graph::apply(Op::Sin, x); }
Expr cos(Expr x) { return Graph::apply(Op::Cos, x); }
Expr tan(Expr x) { return Graph::apply(Op::Tan, x); }
Expr sinh(Expr x) { return Graph::apply(Op::Sinh, x); }
Expr cosh(Expr x) { return Graph::apply(Op::Cosh, x); }
Expr tanh(Expr x) { return Graph::apply(Op::Tanh, x); }

std::size_t Graph::NodeHash::operator()(const ExprNode& node) const noexcept {
  std::uint64_t h = static_cast<std::uint64_t>(node.op) * 0x9e3779b97f4a7c15u;
  h ^= (static_cast<std::uint64_t>(node.a) << 32 | node.b) + 0x9e3779b97f4a7c15u + (h << 6) + (h >> 2);
  h ^= std::bit_cast<std::uint64_t>(node.value) * 0xff51afd7ed558ccdu + (h << 6) + (h >> 2);
  return static_cast<std::size_t>(h ^ (h >> 31));
}

Expr Graph::intern(const ExprNode& node) {
  const auto [entry, isNew] = index_.try_emplace(node, static_cast<std::uint32_t>(nodes_.size()));
  if (isNew) nodes_.push_back(node);
  return {this, entry->second};
}

Expr Graph::variable(std::uint32_t index) { return intern({.op = Op::Variable, .a = index}); }

std::uint32_t Graph::nodeOf(Expr f) {
  if (!f.isConstant()) {
    LUXO_REQUIRE(f.graph_ == this);
    return f.node_;
  }
  return intern({.op = Op::Constant, .value = f.constant_}).node_;
}

Expr Graph::apply(Op op, Expr x, Expr y, int exponent) {
  const bool binary = operandCount(op) == 2;
  if (x.isConstant() && (!binary || y.isConstant())) return operate(op, x.constant_, y.constant_, exponent);

  const auto is = [](const Expr& e, double value) { return e.isConstant() && e.constant_ == value; };
  switch (op) {
    case Op::Add:
      if (is(x, 0)) return y;
      if (is(y, 0)) return x;
      break;
    case Op::Subtract:
      if (is(y, 0)) return x;
      if (is(x, 0)) return -y;
      break;
    case Op::Multiply:
      if (is(x, 0) || is(y, 0)) return 0;
      if (is(x, 1)) return y;
      if (is(y, 1)) return x;
      if (is(x, -1)) return -y;
      if (is(y, -1)) return -x;
      break;
    case Op::Divide:
      if (is(x, 0)) return 0;
      if (is(y, 1)) return x;
      break;
    case Op::Power:
      if (exponent == 0) return 1;
      if (exponent == 1) return x;
      break;
    default:
      break;
  }

  Graph* graph = x.isConstant() ? y.graph_ : x.graph_;
  ExprNode node{.op = op, .a = graph->nodeOf(x)};
  if (binary) node.b = graph->nodeOf(y);
  if (op == Op::Power) node.value = exponent;
  if (op == Op::Negate && graph->nodes_[node.a].op == Op::Negate) return {graph, graph->nodes_[node.a].a};
  // Addition and multiplication commute exactly in floating point: one order of operands finds more equal
  // nodes.
  if ((op == Op::Add || op == Op::Multiply) && node.a > node.b) std::swap(node.a, node.b);
  return graph->intern(node);
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
  }
  std::vector<std::uint32_t> order;
  for (std::uint32_t i = 0; i < nodes.size(); ++i)
    if (needed[i]) order.push_back(i);
  return order;
}

Expr Graph::derivative(Expr f, std::uint32_t index) {
  if (f.isConstant()) return 0;
  LUXO_REQUIRE(f.graph_ == this);
  std::vector<Expr> d(nodes_.size());  // of the nodes that exist now; the derivatives themselves add more
  for (const std::uint32_t i : reachable(*this, {f.node_})) {
    const ExprNode node = nodes_[i];
    const auto operand = [&](std::uint32_t n) {
      return nodes_[n].op == Op::Constant ? Expr(nodes_[n].value) : Expr(this, n);
    };
    const int operands = operandCount(node.op);
    const Expr self(this, i);
    const Expr x = operands > 0 ? operand(node.a) : Expr(), dx = operands > 0 ? d[node.a] : Expr();
    const Expr y = operands > 1 ? operand(node.b) : Expr(), dy = operands > 1 ? d[node.b] : Expr();
    switch (node.op) {
      case Op::Constant:
        d[i] = 0;
        break;
      case Op::Variable:
        d[i] = node.a == index ? 1 : 0;
        break;
      case Op::Negate:
        d[i] = -dx;
        break;
      case Op::Add:
        d[i] = dx + dy;
        break;
      case Op::Subtract:
        d[i] = dx - dy;
        break;
      case Op::Multiply:
        d[i] = dx * y + x * dy;
        break;
      case Op::Divide:
        d[i] = (dx - self * dy) / y;
        break;
      case Op::Power:
        d[i] = node.value * pow(x, static_cast<int>(node.value) - 1) * dx;
        break;
      case Op::Sqrt:
        d[i] = dx / (2 * self);
        break;
      case Op::Exp:
        d[i] = self * dx;
        break;
      case Op::Log:
        d[i] = dx / x;
        break;
      case Op::Sin:
        d[i] = cos(x) * dx;
        break;
      case Op::Cos:
        d[i] = -(sin(x) * dx);
        break;
      case Op::Tan:
        d[i] = (1 + pow(self, 2)) * dx;
        break;
      case Op::Sinh:
        d[i] = cosh(x) * dx;
        break;
      case Op::Cosh:
        d[i] = sinh(x) * dx;
        break;
      case Op::Tanh:
        d[i] = (1 - pow(self, 2)) * dx;
        break;
    }
  }
  return d[f.node_];
}

}  // namespace luxo
