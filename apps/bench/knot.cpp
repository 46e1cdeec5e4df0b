// SPDX-License-Identifier: Apache-2.0
#include "knot.h"

#include <cmath>

namespace luxo::bench {
namespace {

constexpr std::uint32_t kAlong = 2000, kAround = kKnotTriangles / 2 / kAlong;
constexpr double kTubeRadius = 0.4;

// The trefoil on a torus, and how it moves on.
Vec3 curve(double t) {
  const double r = 2 + std::cos(3 * t);
  return {r * std::cos(2 * t), r * std::sin(2 * t), std::sin(3 * t)};
}
Vec3 tangent(double t) {
  const double r = 2 + std::cos(3 * t), dr = -3 * std::sin(3 * t);
  return {dr * std::cos(2 * t) - 2 * r * std::sin(2 * t), dr * std::sin(2 * t) + 2 * r * std::cos(2 * t),
          3 * std::cos(3 * t)};
}

}  // namespace

MeshArrays knot() {
  MeshArrays arrays;
  for (std::uint32_t i = 0; i < kAlong; ++i) {
    const double t = kTau * i / kAlong;
    const Vec3 along = unit(tangent(t)), side = unit(glm::cross(Vec3(0, 0, 1), along)),
               up = glm::cross(along, side);
    for (std::uint32_t j = 0; j < kAround; ++j) {
      const double angle = kTau * j / kAround;
      const Vec3 normal = std::cos(angle) * side + std::sin(angle) * up;
      arrays.positions.push_back(curve(t) + kTubeRadius * normal);
      arrays.normals.emplace_back(normal);
    }
  }
  const auto vertex = [](std::uint32_t i, std::uint32_t j) { return i % kAlong * kAround + j % kAround; };
  for (std::uint32_t i = 0; i < kAlong; ++i)
    for (std::uint32_t j = 0; j < kAround; ++j) {
      const std::uint32_t a = vertex(i, j), b = vertex(i + 1, j), c = vertex(i + 1, j + 1),
                          d = vertex(i, j + 1);
      arrays.indices.insert(arrays.indices.end(), {a, b, c, a, c, d});
    }
  return arrays;
}

}  // namespace luxo::bench
