// SPDX-License-Identifier: Apache-2.0
// The triangles of a surface that has no formula (Surface::triangles()).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "mesh/triangle_mesh.h"

namespace luxo {

struct Cloth;

/// Triangles that are a surface: all of a mesh, or those of one of its materials.
struct SurfaceTriangles {
  TriangleMesh mesh;
  std::uint32_t first = 0, count = 0;
  std::shared_ptr<const Cloth> cloth = {};  ///< what moves them, as it was built; none of all else

  /// The vertices of one of them, 0 to count - 1.
  [[nodiscard]] std::array<std::uint32_t, 3> corners(std::uint32_t triangle) const {
    const std::uint32_t* at = mesh.indices().data() + std::size_t{3} * (first + triangle);
    return {at[0], at[1], at[2]};
  }
  [[nodiscard]] std::array<Vec3, 3> points(std::uint32_t triangle) const {
    const auto [a, b, c] = corners(triangle);
    return {mesh.point(a), mesh.point(b), mesh.point(c)};
  }
};

}  // namespace luxo
