// SPDX-License-Identifier: Apache-2.0
// The slope of a formula from a fixed place: (f(x) - f(at)) / (x - at), written without that quotient, so
// that it is f'(at) at the place itself and the factor x - at is gone. By the rules of divided differences,
// e.g. sin a - sin b = 2 cos((a + b) / 2) sin((a - b) / 2).
#pragma once

#include <cstdint>
#include <optional>

#include "formula/expression.h"

namespace luxo {

/// In one variable, the others as they are. Nothing where an operation on the way has no rule: kinks,
/// logarithms, inverse functions. Cost: linear in the nodes of f, and in their exponents.
[[nodiscard]] std::optional<Expr> slope(Graph& graph, Expr f, std::uint32_t variable, double at);

}  // namespace luxo
