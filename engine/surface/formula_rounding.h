// SPDX-License-Identifier: Apache-2.0
// What a formula loses where shaders compute it in single precision.
#pragma once

#include <cstddef>
#include <span>

#include "surface/patch.h"

namespace luxo {

/// Places that tell it: of a surface, and of each patch at least. Measured: of a mirror with a radius of 30 m
/// the four corners tell less than half, and more places no more.
inline constexpr std::size_t kRoundingProbes = 512, kLeastRoundingProbes = 32;

/// How far that moves a point of the patch, the most of `probes` places where the formula exists; object
/// units. u is counted as shaders do (SurfaceFunction::originOfU). A formula with large phases, or that takes
/// the difference of large numbers, loses far more than 2^-24 of its result. Cost: two evaluations a place.
[[nodiscard]] double formulaRounding(const Patch& patch, std::span<const double> parameters,
                                     std::size_t probes);

}  // namespace luxo
