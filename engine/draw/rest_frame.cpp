// SPDX-License-Identifier: Apache-2.0
#include "draw/rest_frame.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>

#include "math/transform.h"
#include "shared/scene_data.h"
#include "surface/surface_triangles.h"

namespace luxo {
namespace {

/// From 0 to 2 kRestSteps.
std::uint32_t stepOf(double p) {
  return static_cast<std::uint32_t>(std::lround(shared::kRestSteps * (p + 1)));
}

double signOf(double x) { return x < 0 ? -1 : 1; }

}  // namespace

Vec4f restFrame(const Vec3f& point, const Vec3& normal) {
  const Vec3 n = normal / (std::abs(normal.x) + std::abs(normal.y) + std::abs(normal.z));
  const Vec2 p =
      n.z < 0 ? Vec2((1 - std::abs(n.y)) * signOf(n.x), (1 - std::abs(n.x)) * signOf(n.y)) : Vec2(n);
  const std::uint32_t packed = stepOf(p.x) << 15 | stepOf(p.y);
  // The uppermost bit is the sign; the exponent begins with 10, so that it is neither small nor infinite.
  const std::uint32_t bits = 0x40000000u | (packed & 0x1fffffffu) | (packed >> 29) << 31;
  return {point, std::bit_cast<float>(bits)};
}

Vec4f frameOf(const SnapshotNode& node, const reference::Hit& hit) {
  const SurfaceTriangles* triangles = node.surface.triangles();
  if (!triangles || triangles->mesh.rest().empty()) return Vec4f(hit.frame);
  const TriangleMesh& mesh = triangles->mesh;
  const std::array<std::uint32_t, 3> corners = triangles->corners(hit.patch);
  std::array<Vec3, 3> at;
  for (std::size_t i = 0; i < 3; ++i) at[i] = transformPoint(node.worldFromObject, mesh.point(corners[i]));
  const Vec3 across = glm::cross(at[1] - at[0], at[2] - at[0]);
  const auto part = [&](std::size_t i, std::size_t k) {
    return glm::dot(glm::cross(at[i] - hit.position, at[k] - hit.position), across) /
           glm::dot(across, across);
  };
  const double second = part(2, 0), third = part(0, 1);
  const auto between = [&](std::span<const Vec3f> values) {
    return (1 - second - third) * Vec3(values[corners[0]]) + second * Vec3(values[corners[1]]) +
           third * Vec3(values[corners[2]]);
  };
  const bool turned =
      glm::dot(normalMatrix(node.worldFromObject.linear) * between(mesh.normals()), hit.normal) < 0;
  const Vec3 normal = between(mesh.restNormals());
  return restFrame(Vec3f(between(mesh.rest())), turned ? -normal : normal);
}

}  // namespace luxo
