// SPDX-License-Identifier: Apache-2.0
#include "tessellate/mesh_cache.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "mesh/inscribed_balls.h"
#include "surface/equation.h"
#include "surface/surface_triangles.h"

namespace luxo {

double toleranceLevel(double tolerance) {
  if (!(tolerance > 0 && std::isfinite(tolerance))) return tolerance;
  int exponent = 0;
  std::frexp(tolerance, &exponent);
  // Scaling by a power of two is exact, so a level is its own level.
  const double power = std::ldexp(1.0, exponent - 1), between = std::ldexp(std::numbers::sqrt2, exponent - 1);
  return between <= tolerance ? between : power;
}

std::shared_ptr<const Mesh> MeshCache::get(const Surface& surface, std::span<const double> parameters,
                                           const MeshDesc& desc) {
  Key key{.shape = {surface, parameters}};
  if (surface.isPolygonal()) {
    // All levels are one.
  } else if (desc.uniform) {
    key.uniform = *desc.uniform;
  } else {
    key.tolerance = toleranceLevel(desc.tolerance);
    key.longestEdge = toleranceLevel(desc.longestEdge);
  }
  if (auto mesh = meshes_.find(key)) return mesh;
  const auto mapOfSurface = [&]() -> const CurvatureMap& {
    return maps_.get(surface, parameters, [&] { return CurvatureMap(surface, parameters); });
  };
  const bool plain = desc.uniform || surface.isPolygonal();
  Mesh mesh = plain ? tessellate(surface, parameters, desc)
                    : tessellate(surface, parameters, mapOfSurface(),
                                 {.tolerance = key.tolerance, .longestEdge = key.longestEdge});
  const std::size_t bytes = bytesIn(mesh.positions, mesh.normals, mesh.parameters, mesh.indices);
  return meshes_.insert(std::move(key), surface, std::move(mesh), bytes);
}

bool MeshCache::boundsSolid(const Surface& surface, std::span<const double> parameters) {
  return solids_.get(surface, parameters, [&] { return luxo::boundsSolid(surface, parameters); });
}

std::span<const Sphere> MeshCache::inscribedBalls(const Surface& triangles) {
  bool isFirst = false;
  std::optional<std::vector<Sphere>>& balls = balls_.get(triangles, {}, [&] {
    isFirst = true;
    return std::optional<std::vector<Sphere>>();
  });
  if (isFirst) return {};
  if (!balls) balls = luxo::inscribedBalls(triangles.triangles()->mesh);
  return *balls;
}

}  // namespace luxo
