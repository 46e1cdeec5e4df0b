// SPDX-License-Identifier: Apache-2.0
// Rays against triangles: a hierarchy of boxes, and the nearest triangle that a ray meets, certified.
//
// The corners of a triangle have, with the ray's own directions as coordinates, offsets (f1, f2) from the ray
// (RayFunctions). Seen along the ray its three edges are signs of cross products of these, and an edge that
// two triangles share has the same bits for both, turned round: no ray slips through between them (S. Woop,
// C. Benthin, I. Wald, "Watertight Ray/Triangle Intersection", 2013; here for any transform, in double). What
// rounding leaves of each sign is bounded. A ray within that of an edge is decided where triangles lie on
// both of its sides; at a border or an outline it is not.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "math/bounds.h"
#include "reference/roots.h"
#include "surface/surface_triangles.h"

namespace luxo::reference {

/// Immutable; safe from any thread. Keeps the mesh.
class TriangleTree {
 public:
  /// In parallel; the tree does not depend on the number of threads. Cost: 4 bytes a triangle and 32 a node.
  explicit TriangleTree(const SurfaceTriangles& triangles);

  /// A box and what is in it: two children, the first of which follows the node, or some triangles.
  struct Node {
    Vec3f low{0}, high{0};    ///< of offsets from origin()
    std::uint32_t first = 0;  ///< of order(); of a node with children the index of the second
    std::uint32_t count = 0;  ///< triangles; 0: it has children
  };

  [[nodiscard]] const SurfaceTriangles& triangles() const { return triangles_; }
  [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }  ///< the first is the root
  [[nodiscard]] const std::vector<std::uint32_t>& order() const { return order_; }
  /// The largest magnitude of any point's coordinate, along each axis.
  [[nodiscard]] const Vec3& reach() const { return reach_; }

 private:
  SurfaceTriangles triangles_;
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> order_;
  Vec3 reach_{0};
};

/// Root::patch is the triangle, and (u, v) are the weights of its second and third corner. Cost: some dozen
/// boxes and triangles.
[[nodiscard]] Roots nearestRoot(const TriangleTree& tree, const RayFunctions& ray, const RootQuery& query);

}  // namespace luxo::reference
