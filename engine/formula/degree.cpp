// SPDX-License-Identifier: Apache-2.0
#include "formula/degree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "math/numbers.h"

namespace luxo {
namespace {

constexpr Vec2 kNoDegree(std::numeric_limits<double>::infinity());
constexpr double kBesideTurn = 1e-3;  // a domain's end may be typed with few digits

struct Term {
  Vec2 degree = kNoDegree;
  Vec2 slope{std::numeric_limits<double>::quiet_NaN()};  ///< of a linear function of u and v, else NaN
  bool isConstant = false;
  double value = 0;  ///< of a constant
};

Term turning(const Term& angle, const Vec2& width) {
  const Vec2 turns = glm::abs(angle.slope) * width / kTau;
  return {.degree = std::isfinite(turns.x + turns.y) ? turns : kNoDegree};
}

/// A node, from its operands.
Term termOf(const ExprNode& node, const Term& a, const Term& b, const Vec2& width) {
  switch (node.op) {
    case Op::Constant:
      return {.degree = Vec2(0), .slope = Vec2(0), .isConstant = true, .value = node.value};
    case Op::Variable: {
      const Vec2 one(node.a == 0, node.a == 1);
      return node.a > 1 ? Term() : Term{.degree = one, .slope = one};
    }
    case Op::Negate:
      return {.degree = a.degree, .slope = -a.slope};
    case Op::Add:
      return {.degree = glm::max(a.degree, b.degree), .slope = a.slope + b.slope};
    case Op::Subtract:
      return {.degree = glm::max(a.degree, b.degree), .slope = a.slope - b.slope};
    case Op::Multiply: {
      Term product{.degree = a.degree + b.degree};
      if (a.isConstant) product.slope = a.value * b.slope;
      if (b.isConstant) product.slope = b.value * a.slope;
      return product;
    }
    case Op::Divide:
      return b.isConstant ? Term{.degree = a.degree, .slope = a.slope / b.value} : Term();
    case Op::Power:
      return node.value < 0 ? Term() : Term{.degree = node.value * a.degree};
    case Op::Sqrt:
      return {.degree = a.degree};
    case Op::Sin:
    case Op::Cos:
      return turning(a, width);
    default:
      return {};
  }
}

/// Of all nodes that the roots need: `visit` takes the number of each, its node, and the terms of its
/// operands.
void forTerms(Graph& graph, std::span<const Expr> roots, const Vec2& width, const auto& visit) {
  std::vector<std::uint32_t> ends;
  for (const Expr& root : roots) ends.push_back(graph.nodeOf(root));
  std::unordered_map<std::uint32_t, Term> terms;
  for (const std::uint32_t i : reachable(graph, ends)) {
    const ExprNode& node = graph.nodes()[i];
    const int operands = operandCount(node.op);
    const Term a = operands > 0 ? terms.at(node.a) : Term(), b = operands > 1 ? terms.at(node.b) : Term();
    visit(i, node, terms[i] = termOf(node, a, b, width), a);
  }
}

}  // namespace

std::vector<Vec2> degreesOf(Graph& graph, std::span<const Expr> roots, const Vec2& width) {
  std::unordered_map<std::uint32_t, Vec2> degrees;
  forTerms(graph, roots, width, [&](std::uint32_t i, const ExprNode&, const Term& term, const Term&) {
    degrees[i] = term.degree;
  });
  std::vector<Vec2> ofRoots;
  for (const Expr& root : roots) ofRoots.push_back(degrees.at(graph.nodeOf(root)));
  return ofRoots;
}

bool isPeriodic(Graph& graph, std::span<const Expr> roots, int variable, double width) {
  std::unordered_map<std::uint32_t, bool> periodic;
  const auto turnsWhole = [&](const Term& angle) {
    const double turns = angle.slope[variable] * width / kTau;
    return std::abs(turns - std::round(turns)) <= kBesideTurn;  // not of NaN
  };
  forTerms(graph, roots, Vec2(1), [&](std::uint32_t i, const ExprNode& node, const Term&, const Term& angle) {
    const std::uint32_t operands[] = {node.a, node.b, node.c};
    bool all = node.op != Op::Variable || node.a != static_cast<std::uint32_t>(variable);
    for (int k = 0; k < operandCount(node.op); ++k) all = all && periodic.at(operands[k]);
    const bool isTurn = node.op == Op::Sin || node.op == Op::Cos || node.op == Op::Tan;
    periodic[i] = all || (isTurn && turnsWhole(angle));
  });
  return std::ranges::all_of(roots, [&](const Expr& root) { return periodic.at(graph.nodeOf(root)); });
}

}  // namespace luxo
