// SPDX-License-Identifier: Apache-2.0
// How far a surface is from the planes of the triangles that stand for it, and on which side.
//
// The deviation of a mesh says how far points are from their own points of the triangles. Much of that is
// along the triangles, where it does not matter to a shell, and most of the rest is on one side: a slab that
// keeps it on both is several times as thick as it has to be. So the surface is looked at on a finer mesh, in
// a few points of each triangle; around them a small part of the deviation is left.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "surface/surface.h"

namespace luxo {

class ShellFrame;
struct ShellPatch;

/// Proven upper bounds, object units; infinite where the deviation is.
struct ShellHeights {
  /// Of each triangle: how far over and under its plane the surface is, where its slab may hold it.
  std::vector<double> above, below;
  /// Of each wall: how far outside of it, and inside, the edge of the patch is.
  std::vector<double> beyond, within;
  /// Of each triangle, seen but not proven: the least cosine between its normal and the surface's.
  std::vector<double> alike;
  /// Triangles whose surface may stand over more others than it was followed to, ascending.
  std::vector<std::size_t> unfollowed;
};

/// How far a point has to be moved from what stands around it: out of the planes of triangles, or in; and out
/// of the patch from walls, or in.
struct Distances {
  double out = 0, in = 0, beyond = 0, within = 0;
};

/// Largest distances on both sides.
struct HeightRange {
  double above = 0, below = 0;

  void add(double height, double around);
};

/// What is seen of the surface from one triangle.
struct TriangleLook {
  /// A point that may be over, or under, other triangles, too.
  struct Stray {
    Vec3 point;
    double around;  ///< how far the surface is from the finer mesh
    double reach;   ///< how far it is from the triangle's plane
  };

  HeightRange plane;
  std::array<HeightRange, 3> edges;  ///< outside of them, and inside; by the corner opposite
  double alike = 1;                  ///< as in ShellHeights
  std::vector<Stray> strays;
};

/// Looks at a surface from frames that are refined step by step: at triangles that an earlier one had, once.
class ShellLook {
 public:
  /// All must outlive it.
  ShellLook(const Surface& surface, std::span<const double> parameters,
            const std::vector<ShellPatch>& patches)
      : surface_(surface), parameters_(parameters), patches_(patches) {}

  /// Cost: twelve evaluations for each new triangle, eighteen at poles. Equal input gives equal bits.
  [[nodiscard]] ShellHeights heightsOf(const ShellFrame& frame);

 private:
  /// All that a look at a triangle depends on.
  struct Triangle {
    std::uint32_t patch;
    std::array<double, 7> numbers;  ///< (u, v) of the corners; the bound

    friend bool operator==(const Triangle&, const Triangle&) = default;
  };
  struct HashOf {
    std::size_t operator()(const Triangle& triangle) const;
  };

  static Triangle triangleOf(const ShellFrame& frame, std::size_t triangle);
  void lookAt(const ShellFrame& frame, std::span<const std::size_t> triangles,
              std::span<TriangleLook* const> looks) const;
  void lookAt(const ShellFrame& frame, std::uint32_t patch, std::span<const std::size_t> triangles,
              std::span<TriangleLook* const> looks) const;

  const Surface& surface_;
  std::span<const double> parameters_;
  const std::vector<ShellPatch>& patches_;
  /// By their hashes, in parts, so that all cores may look for triangles in them at once.
  std::array<std::unordered_map<Triangle, TriangleLook, HashOf>, 16> looks_;
};

}  // namespace luxo
