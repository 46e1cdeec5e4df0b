// SPDX-License-Identifier: Apache-2.0
#include "formula/pythagoras.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "formula/factors.h"

namespace luxo {
namespace {

constexpr std::size_t kMaxSumTerms = 32;
constexpr double kRounding = 0x1p-50;  // of a number: some products of constants

std::vector<Product> termsOf(Graph& graph, Expr sum) {
  std::vector<Product> terms;
  std::vector<std::pair<std::uint32_t, double>> open{{graph.nodeOf(sum), 1}};
  while (!open.empty() && terms.size() <= kMaxSumTerms) {
    const auto [index, sign] = open.back();
    open.pop_back();
    const ExprNode node = graph.nodes()[index];
    if (node.op == Op::Add || node.op == Op::Subtract) {
      open.emplace_back(node.b, node.op == Op::Add ? sign : -sign);
      open.emplace_back(node.a, sign);
    } else if (node.op == Op::Negate) {
      open.emplace_back(node.a, -sign);
    } else {
      const Expr term = graph.at(index);
      terms.push_back(factored(graph, {&term, 1})[0]);
      terms.back().number *= sign;
    }
  }
  return terms;
}

/// k, where one is k sin^2 x and the other k cos^2 x.
std::optional<Product> joined(const Graph& graph, const Product& a, const Product& b) {
  for (const auto& [sine, exponent] : a.factors) {
    if (exponent < 2 || graph.nodes()[sine].op != Op::Sin) continue;
    for (const auto& [cosine, other] : b.factors) {
      const ExprNode& node = graph.nodes()[cosine];
      if (other < 2 || node.op != Op::Cos || node.a != graph.nodes()[sine].a) continue;
      const Product restA = quotient(a, {{sine, 2}}), restB = quotient(b, {{cosine, 2}});
      if (restA.factors == restB.factors &&
          std::abs(restA.number - restB.number) <= kRounding * std::abs(restA.number))
        return restA;
    }
  }
  return std::nullopt;
}

bool joinSome(const Graph& graph, std::vector<Product>& terms) {
  for (std::size_t i = 0; i < terms.size(); ++i)
    for (std::size_t j = 0; j < terms.size(); ++j)
      if (i != j)
        if (std::optional<Product> one = joined(graph, terms[i], terms[j])) {
          terms[i] = std::move(*one);
          terms.erase(terms.begin() + static_cast<std::ptrdiff_t>(j));
          return true;
        }
  return false;
}

}  // namespace

Expr withoutSquaresOfTurns(Graph& graph, Expr sum) {
  if (sum.isConstant()) return sum;
  std::vector<Product> terms = termsOf(graph, sum);
  if (terms.size() > kMaxSumTerms || !joinSome(graph, terms)) return sum;
  while (joinSome(graph, terms)) {
  }
  Expr result = 0;
  for (const Product& term : terms) result = result + expressionOf(graph, term);
  return result;
}

}  // namespace luxo
