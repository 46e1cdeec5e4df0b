// SPDX-License-Identifier: Apache-2.0
// Indices of 16 bits for meshes of any size: a draw adds its vertex offset to them.
#pragma once

#include <compare>
#include <cstdint>
#include <span>
#include <vector>

namespace luxo {

/// Vertices that 16 bits number.
constexpr std::uint32_t kWindowVertices = 65536;

/// Consecutive indices of whole triangles whose vertices are in [firstVertex, firstVertex + kWindowVertices).
struct IndexWindow {
  std::uint32_t end = 0;  ///< the index after its last; it begins where the one before it ends
  std::uint32_t firstVertex = 0;

  friend auto operator<=>(const IndexWindow&, const IndexWindow&) = default;
};

/// As few windows as hold all indices, in their order; never more than twice as many as their vertices would
/// need in the best order, as each is a draw: of triangles in a wilder order there are none. Required: three
/// indices a triangle. Cost: one pass.
[[nodiscard]] std::vector<IndexWindow> indexWindows(std::span<const std::uint32_t> indices);

}  // namespace luxo
