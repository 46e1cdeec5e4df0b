// SPDX-License-Identifier: Apache-2.0
// Leaves out the triangles of shells in which nothing is seen. A CPU device compares a fragment's depth only
// when its search is over, so what is behind costs as much as what is seen.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cull/occlusion_buffer.h"
#include "scene/snapshot.h"
#include "shell/shell.h"

namespace luxo {

struct DrawBatch;
struct DrawList;

class OcclusionCulling {
 public:
  /// Drops triangles that are seen from inside their slabs, or behind the surface of a shell in every sample
  /// of the picture (1 or 4 of a pixel, where Vulkan has them), and instances of shared shells that are
  /// behind one; gives how many triangles. No pixel changes but in its last bits, where it would have been
  /// found from a hidden triangle, too. Cost: about a nanosecond per pixel and layer, where there is more
  /// than one layer to see, on all cores.
  std::uint64_t drop(DrawList& list, const Snapshot& snapshot, int samples);

 private:
  /// What rays come into a slab by, and what they leave it by having met the surface.
  struct Passage {
    std::vector<PixelTriangle> entering, leaving;
    double top, bottom;  ///< of what rays leave by
  };

  /// A shell in the picture.
  struct Body {
    const Shell* shell;
    std::vector<Vec3> points;    ///< its vertices, as PixelTriangle has them
    std::vector<Vec3> occluder;  ///< the same of its occluder; empty: it hides nothing
    bool mirrored, bothSides;
    bool inFront;  ///< of the near plane, all of it

    [[nodiscard]] int facing(const PixelTriangle& triangle) const;
  };

  void addBodies(const DrawList& list, const Snapshot& snapshot);
  [[nodiscard]] bool layered(const DrawList& list, const PixelSize& size);
  void cover(const PixelSize& size, int samples);
  [[nodiscard]] std::vector<char> findUnseen(const DrawList& list, bool hiding) const;
  /// Of shells that several nodes share, whole instances; gives how many triangles.
  std::uint64_t dropInstances(DrawList& list, const Snapshot& snapshot) const;
  [[nodiscard]] bool hides(const PixelTriangle& triangle) const;
  [[nodiscard]] const Body& bodyOf(const DrawList& list, const DrawBatch& batch) const;
  [[nodiscard]] static Passage passageOf(const Body& body, const ShellOccluder::Slab& slab, bool tops);

  // Of one picture; only their memory is kept.
  std::vector<Body> bodies_;
  std::vector<std::size_t> bodyOf_;       // by index into Snapshot::nodes
  std::vector<OcclusionBuffer> buffers_;  ///< of bands of rows, for every sample of a pixel
  OcclusionBuffer coarse_;
};

}  // namespace luxo
