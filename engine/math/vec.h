// SPDX-License-Identifier: Apache-2.0
// Vectors and matrices: GLM's, in double on the CPU and in float only for what the GPU reads.
// Column vectors, column-major matrices, as in GLSL: destination = matrix * source.
#pragma once

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "math/numbers.h"

namespace luxo {

using Vec2 = glm::dvec2;
using Vec3 = glm::dvec3;
using Vec4 = glm::dvec4;
using Mat3 = glm::dmat3;
using Mat4 = glm::dmat4;

using Vec2f = glm::vec2;
using Vec3f = glm::vec3;
using Vec4f = glm::vec4;
using Mat3f = glm::mat3;
using Mat4f = glm::mat4;

[[nodiscard]] constexpr double radians(double degrees) { return degrees * (kPi / 180); }

/// Unit vector along v, right for any finite length from 1e-300 to 1e300; the zero vector stays zero.
[[nodiscard]] inline Vec3 unit(const Vec3& v) {
  const double scale = glm::max(glm::max(glm::abs(v.x), glm::abs(v.y)), glm::abs(v.z));
  if (!(scale > 0)) return Vec3(0);
  const Vec3 scaled = v / scale;
  return scaled / glm::length(scaled);
}

}  // namespace luxo
