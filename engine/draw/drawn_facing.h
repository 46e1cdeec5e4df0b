// SPDX-License-Identifier: Apache-2.0
// Which way a shell's triangles face where a device draws them: not always the way they do.
//
// A device moves the corners of triangles to the raster's grid, and a triangle that is narrower in the
// picture than they move may turn over. The faces of a slab around a point of the surface go around it all
// the same (marginOf() in shell_list.cpp), but only all of them do: what turned over covers what its
// neighbours no longer do.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/snapshot.h"
#include "shell/shell.h"

namespace luxo {

class DrawnFacing {
 public:
  enum class Side { Either, Front, Back };

  /// The shell is kept by reference. Cost: some 10 ns per vertex.
  DrawnFacing(const View& view, const SnapshotNode& node, const Shell& shell);

  /// Which side of the triangle that begins at that index is drawn in front: certainly so, wherever corners
  /// move. Either: it, or what is seen of it, is so narrow that it may turn over. (What the near plane cuts
  /// may be narrower: the eye is inside the shell then, and rays look there.)
  [[nodiscard]] Side side(std::uint32_t firstIndex) const;

  /// Whether triangles may be clipped, as some of them are not in the picture. Devices may then decide which
  /// way triangles face before they move corners to the grid.
  [[nodiscard]] bool clips() const { return clips_; }

 private:
  const Shell& shell_;
  PixelSize size_;
  bool mirrored_;
  std::vector<Vec3> corners_;  // as PixelRows has them; of parallel rays with 1 for the depth
  std::vector<char> shows_;    // in the picture
  bool clips_ = false;
};

}  // namespace luxo
