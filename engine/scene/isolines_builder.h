// SPDX-License-Identifier: Apache-2.0
// The isolines of a scene file as formulas.
#pragma once

#include <span>
#include <vector>

#include "scene/isolines.h"
#include "scene/moment_formulas.h"
#include "scene/scene_file.h"
#include "surface/patch.h"

namespace luxo {

/// Appends what is written of them.
void appendQuantities(std::span<const IsolinesDesc> isolines, std::vector<Quantity>& quantities);

/// Whether they ask for the range of the surface that they are on.
[[nodiscard]] bool needDomain(std::span<const IsolinesDesc> isolines);

/// `values`: of what appendQuantities() appended, in variables 0 and 1, u and v, of `domain`. Constants are
/// held against what they may be (MomentFormulas::accept()).
[[nodiscard]] std::vector<Isolines> isolinesOf(std::span<const IsolinesDesc> isolines,
                                               std::span<const Expr> values, Expr u, Expr v,
                                               const Domain& domain, MomentFormulas& formulas);

}  // namespace luxo
