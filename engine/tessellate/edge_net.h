// SPDX-License-Identifier: Apache-2.0
// The vertices on the edges of blocks. A line that blocks share is cut at every corner on it, from both sides
// and through joints, and every piece as finely as the finest block beside it: the vertices on a line are
// decided by the line alone, so all blocks beside it have the same ones and no crack is possible.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "surface/surface.h"
#include "tessellate/block_plan.h"

namespace luxo {

/// A vertex's place: its patch and the parts of the patch's sides. Places in a patch differ.
struct EdgeVertex {
  std::uint32_t patch = 0;
  double partU = 0, partV = 0;
};

/// Two vertices of different (u,v) that are one point of the surface.
struct Twin {
  std::uint32_t a = 0, b = 0;
  bool sameNormal = false, flipped = false;
};

class EdgeNet {
 public:
  /// Raises the segments of blocks that could not be joined with the finer lines around them: two are needed
  /// between two such lines.
  EdgeNet(const Topology& topology, std::vector<Block>& blocks);

  [[nodiscard]] const std::vector<EdgeVertex>& vertices() const { return vertices_; }
  /// Vertices along a side of a block, its corners included, with ascending parameter.
  [[nodiscard]] std::span<const std::uint32_t> side(std::size_t block, Side side) const {
    const Range& range = sides_[block][static_cast<std::size_t>(side)];
    return std::span(sideVertices_).subspan(range.first, range.count);
  }
  /// Whether the vertices along a side are those of the block's own cells.
  [[nodiscard]] bool plain(std::size_t block, Side side) const {
    return sides_[block][static_cast<std::size_t>(side)].plain;
  }
  /// What joints and collapsed edges identify.
  [[nodiscard]] const std::vector<Twin>& twins() const { return twins_; }

 private:
  struct Range {
    std::size_t first = 0, count = 0;
    bool plain = true;
  };

  std::vector<EdgeVertex> vertices_;
  std::vector<std::array<Range, 4>> sides_;
  std::vector<std::uint32_t> sideVertices_;
  std::vector<Twin> twins_;
};

}  // namespace luxo
