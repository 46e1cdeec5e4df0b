// SPDX-License-Identifier: Apache-2.0
// The mesh under a shell, and what stands around each of its points.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "shell/shell.h"
#include "shell/shell_heights.h"
#include "surface/surface.h"
#include "tessellate/block_plan.h"
#include "tessellate/curvature_map.h"
#include "tessellate/mesh.h"

namespace luxo {

/// Where a patch goes on beyond its edges, and where they are points. `size` of the surface: two points that
/// differ by 1e-9 of it are one.
[[nodiscard]] ShellPatch readPatch(const Surface& surface, std::uint32_t patch,
                                   std::span<const double> parameters, double size);

/// The curvature over the tiles, about as large as the rectangle, that hold it. Corners in parts of the
/// patch's sides.
[[nodiscard]] Curvature curvatureAround(const CurvatureMap& map, std::uint32_t patch, const Vec2& low,
                                        const Vec2& high);

/// A way out of the triangles around a point.
struct Move {
  Vec3 way{0};
  bool leadsOut = false;
};

/// How far a way has to lead from the planes of facets, and of walls.
struct Clearance {
  double facets = 0, walls = 0;
};

/// The shortest vector that goes as far as it has to along all facets' normals (times `side`) and all walls'
/// normals: dual coordinate ascent (Hildreth 1957). `leadsOut` is false where there is none, or none short
/// enough.
[[nodiscard]] Move shortestMove(std::span<const Vec3> facets, std::span<const Vec3> walls, double side,
                                const Clearance& clearance);

/// A point is what vertices of a patch share that are one place of it: at a wrapped seam, at a collapsed
/// edge.
class ShellFrame {
 public:
  struct WallEdge {
    std::uint32_t from = 0, to = 0;  ///< vertices, along the border with the patch at the left
    std::size_t triangle = 0;        ///< there
  };

  /// Blocks of one patch are consecutive.
  ShellFrame(const Surface& surface, std::span<const double> parameters, const CurvatureMap& map,
             const std::vector<Block>& blocks, const std::vector<ShellPatch>& patches, ShellLook& look);

  [[nodiscard]] const Mesh& mesh() const { return mesh_; }
  [[nodiscard]] double size() const { return size_; }  ///< diagonal of the box around it
  [[nodiscard]] std::size_t pointCount() const { return pointCount_; }
  [[nodiscard]] std::uint32_t pointOf(std::uint32_t vertex) const { return points_[vertex]; }
  [[nodiscard]] std::uint32_t patchOf(std::uint32_t vertex) const { return patches_[vertex]; }
  /// Edges of triangles that no other triangle of the patch continues.
  [[nodiscard]] const std::vector<WallEdge>& walls() const { return walls_; }
  [[nodiscard]] const Vec3& wallNormal(std::size_t wall) const { return wallNormals_[wall]; }
  [[nodiscard]] std::array<std::uint32_t, 3> corners(std::size_t triangle) const {
    return {mesh_.indices[3 * triangle], mesh_.indices[3 * triangle + 1], mesh_.indices[3 * triangle + 2]};
  }
  /// Triangles of a block are firstTriangle(b) .. firstTriangle(b + 1) - 1.
  [[nodiscard]] std::size_t firstTriangle(std::size_t block) const { return firstIndices_[block] / 3; }
  /// Unit normal of a triangle; 0 for slivers.
  [[nodiscard]] const Vec3& facet(std::size_t triangle) const { return facets_[triangle]; }
  /// Proven deviation of a triangle: often less than that of its block, which is that of the worst place.
  [[nodiscard]] double bound(std::size_t triangle) const { return bounds_[triangle]; }
  /// That of each part of the triangle falls with the square of its size.
  [[nodiscard]] bool smooth(std::size_t triangle) const { return smooth_[triangle] != 0; }
  [[nodiscard]] const ShellHeights& heights() const { return heights_; }

  /// Normals of the triangles around a point, and of the walls, which lead out of the patch along it.
  [[nodiscard]] std::span<const Vec3> facetsAround(std::size_t point) const {
    return std::span(around_).subspan(first_[2 * point], first_[2 * point + 1] - first_[2 * point]);
  }
  [[nodiscard]] std::span<const Vec3> wallsAround(std::size_t point) const {
    return std::span(around_).subspan(first_[2 * point + 1], first_[2 * point + 2] - first_[2 * point + 1]);
  }

 private:
  void numberPoints(const std::vector<Block>& blocks, const std::vector<ShellPatch>& patches);
  void findFacets();
  void findWalls(const std::vector<ShellPatch>& patches);
  void fileByPoint();
  void findBounds(const CurvatureMap& map, const std::vector<Block>& blocks,
                  const std::vector<ShellPatch>& patches);

  std::vector<std::size_t> firstIndices_;  // of blocks; filled while mesh_ is made
  Mesh mesh_;
  double size_ = 0;
  std::vector<std::uint32_t> points_, patches_;  // of vertices
  std::size_t pointCount_ = 0;
  std::vector<Vec3> facets_;
  std::vector<double> bounds_;
  std::vector<char> smooth_;
  ShellHeights heights_;
  std::vector<WallEdge> walls_;
  std::vector<Vec3> wallNormals_;
  std::vector<std::size_t> first_;  // in around_, of facets and of walls, by point
  std::vector<Vec3> around_;
};

}  // namespace luxo
