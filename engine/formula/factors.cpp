// SPDX-License-Identifier: Apache-2.0
#include "formula/factors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <unordered_map>
#include <utility>

namespace luxo {
namespace {

constexpr std::size_t kMaxProductFactors = 24;

using Factors = std::map<std::uint32_t, int>;

/// x * y^times.
Product product(Product x, const Product& y, int times) {
  x.number *= std::pow(y.number, times);
  for (const auto& [node, exponent] : y.factors)
    if ((x.factors[node] += times * exponent) == 0) x.factors.erase(node);
  return x;
}

class Factorization {
 public:
  explicit Factorization(Graph& graph) : graph_(graph) {}

  /// Its operands have been visited.
  void visit(std::uint32_t index) { products_.emplace(index, productOf(index)); }
  [[nodiscard]] const Product& at(std::uint32_t index) const { return products_.at(index); }

 private:
  [[nodiscard]] Product productOf(std::uint32_t index) {
    const ExprNode node = graph_.nodes()[index];
    std::optional<Product> found;
    switch (node.op) {
      case Op::Constant:
        return {node.value, {}};
      case Op::Negate:
        found = at(node.a);
        found->number = -found->number;
        break;
      case Op::Multiply:
        found = product(at(node.a), at(node.b), 1);
        break;
      case Op::Divide:
        found = product(at(node.a), at(node.b), -1);
        break;
      case Op::Power:
        found = product({}, at(node.a), static_cast<int>(node.value));
        break;
      case Op::Add:
        found = sum(at(node.a), at(node.b), 1);
        break;
      case Op::Subtract:
        found = sum(at(node.a), at(node.b), -1);
        break;
      default:
        break;
    }
    return found && found->factors.size() <= kMaxProductFactors ? *found : Product{1, {{index, 1}}};
  }

  /// Of terms that have something in common.
  [[nodiscard]] std::optional<Product> sum(const Product& a, const Product& b, double sign) {
    const Factors common = commonFactors(std::array{a, b});
    if (common.empty()) return std::nullopt;
    const Expr rest =
        expressionOf(graph_, quotient(a, common)) + sign * expressionOf(graph_, quotient(b, common));
    if (rest.isConstant()) return Product{rest.constant(), common};
    return product({1, common}, {1, {{graph_.nodeOf(rest), 1}}}, 1);
  }

  Graph& graph_;
  std::unordered_map<std::uint32_t, Product> products_;
};

}  // namespace

std::vector<Product> factored(Graph& graph, std::span<const Expr> formulas) {
  std::vector<std::uint32_t> indices;
  for (const Expr& formula : formulas) indices.push_back(graph.nodeOf(formula));
  Factorization factorization(graph);
  for (const std::uint32_t index : reachable(graph, indices)) factorization.visit(index);
  std::vector<Product> products;
  for (const std::uint32_t index : indices) products.push_back(factorization.at(index));
  return products;
}

Expr expressionOf(Graph& graph, const Product& product) {
  Expr above = product.number, below = 1;
  for (const auto& [node, exponent] : product.factors)
    if (exponent > 0)
      above = above * pow(graph.at(node), exponent);
    else
      below = below * pow(graph.at(node), -exponent);
  return above / below;
}

std::map<std::uint32_t, int> commonFactors(std::span<const Product> products) {
  std::optional<Factors> common;
  for (const Product& one : products) {
    if (one.number == 0) continue;
    Factors shared;
    for (const auto& [node, exponent] : one.factors) {
      const int others = !common ? exponent : common->contains(node) ? common->at(node) : 0;
      if (const int least = std::min(exponent, others); least > 0) shared.emplace(node, least);
    }
    common = std::move(shared);
  }
  return common.value_or(Factors{});
}

Product quotient(Product product, const std::map<std::uint32_t, int>& by) {
  if (product.number == 0) return product;
  for (const auto& [node, exponent] : by)
    if ((product.factors[node] -= exponent) == 0) product.factors.erase(node);
  return product;
}

}  // namespace luxo
