// SPDX-License-Identifier: Apache-2.0
// How a surface bends at a point, from the exact second derivatives of its formula.
//
// A curve of the surface through the point bends by k, which depends on its direction alone (Meusnier, 1776):
// k = -II / I with the outward normal, positive where the surface falls off behind it as that of a ball does
// (1 / r), negative where it rises. K = k1 k2 and |H| do not depend on the normal, the signs of k1, k2 and H
// do (M. do Carmo, "Differential Geometry of Curves and Surfaces", 3-2 and 3-3).
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "math/transform.h"
#include "math/vec.h"
#include "surface/surface.h"

namespace luxo {

/// Of the world: 1 / metres, 1 / metres^2 of `gaussian`.
struct PrincipalCurvatures {
  double k1 = 0, k2 = 0;  ///< the largest and the least of all directions: k1 >= k2
  double gaussian = 0;    ///< K = k1 k2
  double mean = 0;        ///< H = (k1 + k2) / 2
  /// Unit, in which the surface bends by k1 and k2; perpendicular. Where these are equal any two are.
  Vec3 direction1{0}, direction2{0};
};

/// At (u, v) of a patch of a formula, placed in the world by any regular linear map. Nothing where Su x Sv
/// vanishes but for a millionth (poles, apexes, cusps) or the formula has no second derivatives. Error:
/// rounding, some 1e-15 of the derivatives' lengths over those of Su and Sv.
[[nodiscard]] std::optional<PrincipalCurvatures> curvatureAt(const Surface& surface, std::uint32_t patch,
                                                             double u, double v,
                                                             std::span<const double> parameters,
                                                             const Mat3& worldFromObject = Mat3(1));

}  // namespace luxo
