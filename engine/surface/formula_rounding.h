// SPDX-License-Identifier: Apache-2.0
// What a formula loses where shaders compute it in single precision.
#pragma once

#include <cstdint>
#include <span>

#include "surface/surface.h"

namespace luxo {

/// How far that moves a point of the patch, the most of some hundred places where the formula exists; object
/// units. u is counted as shaders do (SurfaceFunction::originOfU). A formula with large phases, or that takes
/// the difference of large numbers, loses far more than 2^-24 of its result. Cost: two evaluations a place.
[[nodiscard]] double formulaRounding(const Surface& surface, std::uint32_t patch,
                                     std::span<const double> parameters);

/// The most of all patches.
[[nodiscard]] double formulaRounding(const Surface& surface, std::span<const double> parameters);

}  // namespace luxo
