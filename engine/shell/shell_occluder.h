// SPDX-License-Identifier: Apache-2.0
// Slabs around a surface that it spans from wall to wall, so that no ray passes through them beside it: what
// is behind them is hidden.
//
// Theorem: a ray that leaves such a slab by one face, and has not come in by the same face before, nor by a
// wall or a turned prism, has met the surface. Proof: over each triangle of the mesh stands a prism, the
// places (1 - s) bottom + s top, 0 <= s <= 1. Where the Jacobians of all prisms are positive, the map from
// the patch times [0, 1] into space has an inverse near each place (but at single lines, which rays miss),
// also where the slab passes through itself. So the ray can be followed back from where it leaves, always
// within the slab as the patch has it, until it comes to its boundary: by the other face, with the surface in
// between, which parts the two faces there; by the same face; or by a wall. Where a Jacobian may vanish (the
// prism is turned) it may come from anywhere.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "math/vec.h"

namespace luxo {

struct Shell;
class ShellFrame;
struct Distances;

struct ShellOccluder {
  /// Of the shell's vertices, as its `indices` number them: those at walls lie as far inside of the surface's
  /// borders as those of the shell lie outside of the patch's edges. Where patches go on in each other there
  /// are no walls.
  std::vector<Vec3> positions;
  std::vector<std::uint32_t> slabOf;  ///< of each patch: which of the slabs it is in
  /// Where the triangles of a slab are in the shell's `indices`, but for walls between patches.
  struct Slab {
    std::vector<std::uint32_t> tops, walls, bottoms;
  };
  std::vector<Slab> slabs;
  enum class Triangle : char { Upright, Turned, Joint };
  /// As in the shell's `indices`. Where the surface bends more sharply than the slab is thick, or is narrower
  /// than that, a prism may turn over (that is said of its top and of its bottom), or nearly vanish; and a
  /// wall between patches is not there.
  std::vector<Triangle> triangles;
  bool proven = true;  ///< false where no direction leads out, and nothing said here has to hold
};

/// Of a shell that has all but its occluder. `distances`: of each point of the frame. `sources`: what each
/// triangle of the shell is made of: a triangle of the frame's mesh, or one of its walls.
[[nodiscard]] ShellOccluder occluderOf(const Shell& shell, const ShellFrame& frame,
                                       std::span<const Distances> distances,
                                       std::span<const std::size_t> sources);

}  // namespace luxo
