// SPDX-License-Identifier: Apache-2.0
// Meshes by (surface, parameter values, level of detail): what was tessellated once is not tessellated again.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <tuple>
#include <vector>

#include "math/bounds.h"
#include "surface/surface.h"
#include "tessellate/curvature_map.h"
#include "tessellate/mesh.h"
#include "tessellate/shape_cache.h"
#include "tessellate/tessellator.h"

namespace luxo {

/// The tolerance actually used for a wanted one: the next power of sqrt(2) at or below it. A level depends on
/// the tolerance alone, so a moving camera asks for few distinct meshes and equal frames give equal meshes.
/// What is not positive and finite is its own level.
[[nodiscard]] double toleranceLevel(double tolerance);

/// Not thread-safe.
class MeshCache {
 public:
  explicit MeshCache(std::size_t mostBytes = kUsualCacheBytes) : meshes_(mostBytes) {}

  /// The mesh for the levels of the tolerance and of the longest edge.
  [[nodiscard]] std::shared_ptr<const Mesh> get(const Surface& surface, std::span<const double> parameters,
                                                const MeshDesc& desc);

  /// boundsSolid(), found once.
  [[nodiscard]] bool boundsSolid(const Surface& surface, std::span<const double> parameters);

  /// inscribedBalls() of triangles that bound a solid; valid until the next call. None when they are asked
  /// for first: of what is drawn once, as of what moves, they would cost more than they spare. So it is of
  /// more meshes in a picture than the table holds.
  [[nodiscard]] std::span<const Sphere> inscribedBalls(const Surface& triangles);

  [[nodiscard]] std::size_t bytes() const { return meshes_.bytes(); }
  /// Meshes made so far (not found in the cache).
  [[nodiscard]] std::uint64_t tessellated() const { return meshes_.made(); }
  /// Meshes looked at so far for what may be forgotten.
  [[nodiscard]] std::uint64_t lookedAt() const { return meshes_.lookedAt(); }

 private:
  struct Key {
    Shape shape;
    Segments uniform;  ///< 0 x 0: none
    double tolerance = 0, longestEdge = 0;

    friend bool operator<(const Key& a, const Key& b) {
      const auto order = [](const Key& k) {
        return std::tie(k.shape, k.uniform.u, k.uniform.v, k.tolerance, k.longestEdge);
      };
      return order(a) < order(b);
    }
  };

  ShapeCache<Key, Mesh> meshes_;
  ShapeTable<CurvatureMap> maps_{64};
  ShapeTable<bool> solids_{256};
  ShapeTable<std::optional<std::vector<Sphere>>> balls_{256};
};

}  // namespace luxo
