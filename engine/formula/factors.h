// SPDX-License-Identifier: Apache-2.0
// Formulas as products: x^2 sin y + x is x (x sin y + 1). What several formulas have in common can then be
// taken out of all of them, and divided out without a quotient that is 0/0 where it is 0.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "formula/expression.h"

namespace luxo {

/// number * node^exponent * ...
struct Product {
  double number = 1;
  std::map<std::uint32_t, int> factors = {};  ///< nodes of the graph, none of them a constant
};

/// The formulas as they are written, in factors: sums show those that all their terms have. Cost: linear in
/// the nodes that the formulas need, of each at most 24 factors; what has more counts as one.
[[nodiscard]] std::vector<Product> factored(Graph& graph, std::span<const Expr> formulas);
[[nodiscard]] Expr expressionOf(Graph& graph, const Product& product);

/// Factors that all of the products have, which are not 0, with the least of their exponents; poles are none.
[[nodiscard]] std::map<std::uint32_t, int> commonFactors(std::span<const Product> products);
/// Required: `by` are factors of it.
[[nodiscard]] Product quotient(Product product, const std::map<std::uint32_t, int>& by);

}  // namespace luxo
