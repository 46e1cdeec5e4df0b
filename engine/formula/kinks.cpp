// SPDX-License-Identifier: Apache-2.0
#include <optional>
#include <set>
#include <utility>

#include "formula/expression.h"

namespace luxo {
namespace {

bool isStep(Op op) {
  return op == Op::Floor || op == Op::Sign || op == Op::Less || op == Op::LessEqual || op == Op::Equal;
}

/// The guard of an operation on operands that vary smoothly.
std::optional<Kink> kinkOf(Op op, const Expr& x, const Expr& y) {
  switch (op) {
    case Op::Abs:
    case Op::Sign:
    case Op::Select:
      return Kink{x};
    case Op::Floor:
      return Kink{x, true};
    case Op::Min:
    case Op::Max:
    case Op::Less:
    case Op::LessEqual:
    case Op::Equal:
      return Kink{x - y};
    case Op::Atan2:
      return Kink{
          select(less(y, 0), x, 1)};  // jumps where its first operand passes 0 and the second is negative
    default:
      return {};
  }
}

}  // namespace

std::vector<Kink> Graph::kinks(std::span<const Expr> roots) {
  std::vector<std::uint32_t> indices;
  for (const Expr& root : roots)
    if (!root.isConstant()) indices.push_back(nodeOf(root));
  const std::vector<std::uint32_t> order = reachable(*this, indices);

  // What is constant but for jumps has no kinks beside the jumps, which are guarded where they arise.
  std::vector<bool> constantBetweenJumps(nodes_.size());
  std::vector<Kink> found;
  std::set<std::pair<std::uint32_t, bool>> known;
  for (const std::uint32_t i : order) {
    const ExprNode node = nodes_[i];
    const int operands = operandCount(node.op);
    const bool first = operands < 1 || constantBetweenJumps[node.a];
    const bool second = operands < 2 || constantBetweenJumps[node.b];
    const bool third = operands < 3 || constantBetweenJumps[node.c];
    const bool variesHere = node.op == Op::Variable && node.a < 2;
    constantBetweenJumps[i] = !variesHere && (isStep(node.op) || (first && second && third));
    // A choice jumps with its condition only: the alternatives have kinks of their own.
    if (operands == 0 || (first && (second || node.op == Op::Select))) continue;
    const auto kink = kinkOf(node.op, at(node.a), operands > 1 ? at(node.b) : Expr());
    if (!kink || kink->guard.isConstant()) continue;
    if (known.emplace(kink->guard.node_, kink->atIntegers).second) found.push_back(*kink);
  }
  return found;
}

}  // namespace luxo
