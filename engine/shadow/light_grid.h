// SPDX-License-Identifier: Apache-2.0
// A light's small map of a caster: for every direction of light the cells that a ray in it may meet.
//
// Unlike a depth map it holds no samples: every texel lists all cells that may reach into it (by the boxes
// around them, and the outlines of their tangents' parallelograms, grown by what they bend), nearest first,
// so that no caster is too thin for it, whatever its size. How many texels there are decides how long the
// lists are, never what is in shadow.
//
// Directions from a point light are on the six faces of a cube around it, turned so that the caster's middle
// is straight ahead in the first; of a directional light there is one face, across its rays. A face has
// texels only where the caster is.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "math/vec.h"
#include "shadow/caster_cells.h"

namespace luxo {

struct LightGrid {
  struct Face {
    Vec2 low{0};              ///< the corner of the first texel
    Vec2 texels{0};           ///< per unit; 0: the face is empty
    std::uint32_t first = 0;  ///< its texel (0, 0) among `starts`
  };
  struct Entry {
    std::uint32_t cell = 0;  ///< index into CasterCells::cells
    /// Lower bound of its distance from the light along the face's axis, less the margin; of parallel rays of
    /// where it is along them, from the object's origin on.
    float nearest = 0;
  };

  /// Of the cube: x, y, z from object space. Face 2 k (2 k + 1) looks along the positive (negative) k-th
  /// axis; its own x and y are the next two in turn, divided, for a point light, by the distance along its
  /// axis. The face of a directional light looks along +z, away from the light, with x and y as they are.
  Mat3 axes{1};
  /// What a point light looks at along +z, and how far away that is: of points beside it nothing cancels,
  /// however far away the light is. 0 for a directional light.
  Vec3 middle{0};
  double distance = 0;
  int size = 0;  ///< texels along a side
  std::array<Face, 6> faces;
  /// Of each face that is not empty, row by row: where the entries of a texel start; then where the last
  /// end.
  std::vector<std::uint32_t> starts;
  std::vector<Entry> entries;

  static constexpr std::uint32_t kFirstFace = 4;  ///< the one that looks along +z

  /// From object space to the cube's axes, from a point light on.
  [[nodiscard]] Vec3 fromLight(const Vec3& p) const { return axes * (p - middle) + Vec3(0, 0, distance); }
};

/// Texels along a side; and so many entries at most: where there would be more there are fewer texels.
inline constexpr int kLightGridSize = 64;
inline constexpr std::size_t kMaxGridEntries = std::size_t{1} << 22;

/// Of cells that are finite. `light`: object space; w = 0: the direction toward it, of any length above 0.
/// `margin`: how far from where it should be a ray may be, metres. Cost: some 10 ns an entry.
[[nodiscard]] LightGrid makeLightGrid(const CasterCells& caster, const Vec4& light, double margin,
                                      int size = kLightGridSize);

}  // namespace luxo
