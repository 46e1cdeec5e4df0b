// SPDX-License-Identifier: Apache-2.0
// How triangles hang together at their points and edges.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/triangle_mesh.h"

namespace luxo {

/// The corners beside a corner in its triangle: three consecutive numbers, in turn.
[[nodiscard]] constexpr std::uint32_t nextCorner(std::uint32_t corner) {
  return corner % 3 == 2 ? corner - 2 : corner + 1;
}
[[nodiscard]] constexpr std::uint32_t previousCorner(std::uint32_t corner) {
  return corner % 3 == 0 ? corner + 2 : corner - 1;
}

/// For each position the number of the first with the same bits.
[[nodiscard]] std::vector<std::uint32_t> pointNumbers(std::span<const Vec3f> positions);

/// An edge of a triangle: from corner `corner` to the next one of its triangle.
struct EdgeUse {
  std::uint32_t other = 0;  ///< the edge's point of the larger number
  std::uint32_t corner : 31 = 0;
  std::uint32_t forward : 1 = 1;  ///< from the point of the smaller number to the other
};

/// All edges of triangles whose corners are points; edges from a point to itself are left out. Cost: 8 bytes
/// an edge, linear in time but for the sorting at each point.
class EdgeList {
 public:
  EdgeList() = default;
  explicit EdgeList(std::span<const std::uint32_t> corners, std::size_t points);

  /// Calls action(uses) for every edge with all that use it, in a fixed order.
  template <class Action>
  void forEach(Action action) const {
    for (std::size_t point = 0; point + 1 < begins_.size(); ++point) {
      std::uint32_t at = begins_[point];
      while (at < begins_[point + 1]) {
        std::uint32_t end = at + 1;
        while (end < begins_[point + 1] && uses_[end].other == uses_[at].other) ++end;
        action(std::span(uses_).subspan(at, end - at));
        at = end;
      }
    }
  }

  [[nodiscard]] MeshEdges count() const;

 private:
  std::vector<std::uint32_t> begins_;  ///< of the uses at each point of a smaller number, and the end
  std::vector<EdgeUse> uses_;
};

}  // namespace luxo
