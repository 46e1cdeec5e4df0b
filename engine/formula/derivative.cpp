// SPDX-License-Identifier: Apache-2.0
#include "base/assert.h"
#include "formula/expression.h"

namespace luxo {
namespace {

/// A node with its operands (x, y, z) and their derivatives.
struct Differential {
  Expr self, x, y, z, dx, dy, dz;
};

/// d(x^y). The logarithm belongs to the change of the exponent alone; where x is 0 and the power exists, it
/// is 0 however y changes, though log x is not defined.
Expr differentiateRaise(const Differential& d) {
  const Expr byBase = d.y * pow(d.x, d.y - 1) * d.dx;
  if (d.dy.isConstant() && d.dy.constant() == 0) return byBase;
  return byBase + select(equal(d.x, 0), 0, d.self * log(d.x)) * d.dy;
}

Expr differentiate(const ExprNode& node, const Differential& d) {
  const auto& [self, x, y, z, dx, dy, dz] = d;
  switch (node.op) {
    case Op::Negate:
      return -dx;
    case Op::Add:
      return dx + dy;
    case Op::Subtract:
      return dx - dy;
    case Op::Multiply:
      return dx * y + x * dy;
    case Op::Divide:
      return (dx - self * dy) / y;
    case Op::Power:
      return node.value * pow(x, static_cast<int>(node.value) - 1) * dx;
    case Op::Raise:
      return differentiateRaise(d);
    case Op::Sqrt:
      return dx / (2 * self);
    case Op::Cardinal:
      return -0.5 * cardinal(x, static_cast<int>(node.value) + 1) * dx;
    case Op::Exp:
      return self * dx;
    case Op::Log:
      return dx / x;
    case Op::Sin:
      return cos(x) * dx;
    case Op::Cos:
      return -(sin(x) * dx);
    case Op::Tan:
      return (1 + pow(self, 2)) * dx;
    case Op::Asin:
      return dx / sqrt(1 - pow(x, 2));
    case Op::Acos:
      return -(dx / sqrt(1 - pow(x, 2)));
    case Op::Atan:
      return dx / (1 + pow(x, 2));
    case Op::Atan2:
      return (y * dx - x * dy) / (pow(x, 2) + pow(y, 2));
    case Op::Sinh:
      return cosh(x) * dx;
    case Op::Cosh:
      return sinh(x) * dx;
    case Op::Tanh:
      return (1 - pow(self, 2)) * dx;
    case Op::Abs:
      return sign(x) * dx;
    case Op::Min:
      return select(less(x, y), dx, dy);
    case Op::Max:
      return select(less(y, x), dx, dy);
    case Op::Select:
      return select(x, dy, dz);
    case Op::Constant:
    case Op::Variable:
    case Op::Floor:
    case Op::Sign:
    case Op::Less:
    case Op::LessEqual:
    case Op::Equal:
      break;
  }
  return 0;
}

bool vanishes(const Expr& e) { return e.isConstant() && e.constant() == 0; }

}  // namespace

Expr Graph::derivative(Expr f, std::uint32_t index) {
  if (f.isConstant()) return 0;
  LUXO_REQUIRE(f.graph_ == this);
  const std::vector<std::uint32_t> order = reachable(*this, {f.node_});
  std::vector<Expr> derivatives(f.node_ + 1);  // by node; they add nodes of their own behind these
  for (const std::uint32_t i : order) {
    const ExprNode node = nodes_[i];
    const int operands = operandCount(node.op);
    Differential d{.self = Expr(this, i)};
    if (operands > 0) d.x = at(node.a), d.dx = derivatives[node.a];
    if (operands > 1) d.y = at(node.b), d.dy = derivatives[node.b];
    if (operands > 2) d.z = at(node.c), d.dz = derivatives[node.c];
    if (node.op == Op::Variable)
      derivatives[i] = node.a == index ? 1 : 0;
    else if (!(vanishes(d.dx) && vanishes(d.dy) && vanishes(d.dz)))
      derivatives[i] = differentiate(node, d);
  }
  return derivatives[f.node_];
}

}  // namespace luxo
