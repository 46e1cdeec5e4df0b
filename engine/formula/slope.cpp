// SPDX-License-Identifier: Apache-2.0
#include "formula/slope.h"

#include <cmath>
#include <unordered_map>

namespace luxo {
namespace {

/// An operand: anywhere, at the place, and the slope from there.
struct Sloped {
  Expr value, at, slope;
};

/// Of x^n, n >= 1.
Expr ofPower(const Sloped& x, int n) {
  Expr sum = 0;
  for (int k = 0; k < n; ++k) sum = sum + pow(x.value, k) * pow(x.at, n - 1 - k);
  return x.slope * sum;
}

std::optional<Expr> slopeOf(const ExprNode& node, const Sloped& a, const Sloped& b) {
  const Expr middle = 0.5 * (a.value + a.at), half = 0.5 * (a.value - a.at);
  switch (node.op) {
    case Op::Negate:
      return -a.slope;
    case Op::Add:
      return a.slope + b.slope;
    case Op::Subtract:
      return a.slope - b.slope;
    case Op::Multiply:
      return a.slope * b.value + a.at * b.slope;
    case Op::Divide:
      return (a.slope - a.at / b.at * b.slope) / b.value;
    case Op::Power: {
      const int n = static_cast<int>(node.value);
      if (n > 0) return ofPower(a, n);
      return -ofPower(a, -n) / (pow(a.value, -n) * pow(a.at, -n));
    }
    case Op::Sqrt:
      return a.slope / (sqrt(a.value) + sqrt(a.at));
    case Op::Sin:
      return a.slope * cos(middle) * cardinal(pow(half, 2), 0);
    case Op::Cos:
      return -(a.slope * sin(middle) * cardinal(pow(half, 2), 0));
    case Op::Tan:
      return a.slope * cardinal(pow(2 * half, 2), 0) / (cos(a.value) * cos(a.at));
    case Op::Sinh:
      return a.slope * cosh(middle) * cardinal(-pow(half, 2), 0);
    case Op::Cosh:
      return a.slope * sinh(middle) * cardinal(-pow(half, 2), 0);
    case Op::Tanh:
      return a.slope * cardinal(-pow(2 * half, 2), 0) / (cosh(a.value) * cosh(a.at));
    case Op::Exp:
      return a.slope * exp(middle) * cardinal(-pow(half, 2), 0);
    default:
      return std::nullopt;
  }
}

}  // namespace

std::optional<Expr> slope(Graph& graph, Expr f, std::uint32_t variable, double at) {
  const std::uint32_t root = graph.nodeOf(f);
  std::unordered_map<std::uint32_t, Sloped> known;
  for (const std::uint32_t index : reachable(graph, {root})) {
    const ExprNode node = graph.nodes()[index];
    const Expr value = graph.at(index);
    const int operands = operandCount(node.op);
    if (node.op == Op::Variable && node.a == variable) {
      known[index] = {value, at, 1};
      continue;
    }
    const Sloped a = operands > 0 ? known[node.a] : Sloped(), b = operands > 1 ? known[node.b] : Sloped(),
                 c = operands > 2 ? known[node.c] : Sloped();
    const auto stands = [](const Sloped& x) { return x.slope.isConstant() && x.slope.constant() == 0; };
    if (stands(a) && stands(b) && stands(c)) {
      known[index] = {value, value, 0};
      continue;
    }
    const std::optional<Expr> found = slopeOf(node, a, b);
    if (!found) return std::nullopt;
    known[index] = {value, Graph::apply(node.op, a.at, b.at, c.at, static_cast<int>(node.value)), *found};
  }
  return known[root].slope;
}

}  // namespace luxo
