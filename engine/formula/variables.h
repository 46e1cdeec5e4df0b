// SPDX-License-Identifier: Apache-2.0
// What formulas depend on.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "formula/expression.h"

namespace luxo {

/// The variables that expressions read, ascending.
[[nodiscard]] std::vector<std::uint32_t> variablesOf(Graph& graph, std::span<const Expr> expressions);

}  // namespace luxo
