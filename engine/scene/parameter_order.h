// SPDX-License-Identifier: Apache-2.0
// Parameters may use each other in any order; a scene wants each after those it needs.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "formula/parse.h"
#include "scene/scene_problems.h"

namespace luxo {

/// Gets the parameters of a circle, what is wrong and what to do.
using RejectCircle =
    std::function<void(std::span<const std::size_t>, const std::string& message, const std::string& hint)>;

/// Indices of the parameters, each after those that its value uses, else in the order given. Left out are
/// those whose name cannot be one, which is a problem; circles are opened, and `rejectCircle` gets each.
/// `reject` gets every value that is not a formula, with its index. Cost: linear in the formulas; no
/// recursion.
[[nodiscard]] std::vector<std::size_t> parameterOrder(
    std::span<const ParameterDesc> parameters, SceneProblems& problems,
    const std::function<void(std::size_t, const Formula&)>& reject, const RejectCircle& rejectCircle);

}  // namespace luxo
