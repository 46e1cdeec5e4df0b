// SPDX-License-Identifier: Apache-2.0
// Linear maps as the rotations and scales that model files say them by.
#pragma once

#include <optional>

#include "math/vec.h"

namespace luxo {

struct Turn {
  Vec4 rotation;  ///< unit quaternion x, y, z, w
  Vec3 scale;     ///< first: the map is rotation * scale
};

[[nodiscard]] Mat3 rotationOf(const Vec4& unitQuaternion);

/// rotation * scale, where the map is that but for the roundings of floats (1e-6); nothing where it is
/// sheared or flat.
[[nodiscard]] std::optional<Turn> decomposed(Mat3 linear);

/// Any linear map: turn.rotation * turn.scale * first, its singular value decomposition, but for
/// 1e-14 of its largest entry. By one-sided Jacobi rotations: M. R. Hestenes, Inversion of matrices by
/// biorthogonalization and related results, 1958.
struct SingularValues {
  Turn turn;   ///< a scale is 0 where the map is flat, and one is below 0 where it mirrors
  Vec4 first;  ///< unit quaternion x, y, z, w
};
[[nodiscard]] SingularValues singularValues(Mat3 linear);

}  // namespace luxo
