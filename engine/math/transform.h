// SPDX-License-Identifier: Apache-2.0
// Affine transforms in double. Named destinationFromSource; applied right to left.
#pragma once

#include "math/vec.h"

namespace luxo {

/// x -> linear * x + translation.
struct Transform {
  Mat3 linear{1};
  Vec3 translation{0};

  /// Exact comparison: used to find what changed between two moments.
  friend bool operator==(const Transform&, const Transform&) = default;
};

/// aFromB * bFromC = aFromC. Rounding: at most gamma(4) of the products per entry.
[[nodiscard]] Transform operator*(const Transform& aFromB, const Transform& bFromC);

[[nodiscard]] Vec3 transformPoint(const Transform& t, const Vec3& point);  ///< w = 1: translated
[[nodiscard]] Vec3 transformDirection(const Transform& t,
                                      const Vec3& direction);  ///< w = 0: not translated, not normalised

/// sign(det A) * cof(A): takes normals of A's source to normals of its destination, (A a) x (A b) = cof(A) (a
/// x b). No division: right for singular and mirrored A. The result is not normalised; its sign keeps outward
/// outward.
[[nodiscard]] Mat3 normalMatrix(const Mat3& linear);

/// Largest singular value: no vector grows by more. Relative error below 1e-12; never under the true value by
/// more.
[[nodiscard]] double largestStretch(const Mat3& linear);

/// Whether the transform turns a right hand into a left hand (det < 0).
[[nodiscard]] bool mirrors(const Transform& t);

/// Right-handed rotation about an axis of any non-zero length (Rodrigues' formula). An exactly zero axis is
/// accepted only with angle 0; otherwise throws Error(Scene).
[[nodiscard]] Mat3 rotation(const Vec3& axis, double angleRadians);

/// T * R * S, the local matrix of a scene node.
[[nodiscard]] Transform compose(const Vec3& translation, const Mat3& rotation, const Vec3& scale);

/// rate * time reduced to [-pi, pi], with the exact product: a clock of any age turns as smoothly as a new
/// one. Error below 1e-15 rad for any finite product. Angles are never accumulated: time is absolute.
[[nodiscard]] double angleAt(double radiansPerSecond, double timeSeconds);

}  // namespace luxo
