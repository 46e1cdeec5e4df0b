// SPDX-License-Identifier: Apache-2.0
// How strongly a surface bends, and where: proven bounds of its second derivatives over every dyadic
// rectangle.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "surface/surface.h"
#include "tessellate/tile.h"

namespace luxo {

/// From so many patches on it is worth waking all cores for them.
inline constexpr std::size_t kPatchesForAllCores = 8;

/// Upper bounds of the lengths of Suu, Suv and Svv, with u and v measured in parts of the patch's sides, so
/// that they are lengths of the object. Infinite where none could be proven.
struct Curvature {
  double uu = 0, uv = 0, vv = 0;
  double mixed = 0;  ///< that of Suv also where `uv` leaves it out: see CurvatureMap

  [[nodiscard]] bool proven() const;
  /// How far a triangle may be from the surface if its corners lie within `du` x `dv` of each other: see
  /// tessellator.h.
  [[nodiscard]] double deviation(double du, double dv) const {
    return (uu * (du * du) + 2 * uv * (du * dv) + vv * (dv * dv)) / 8;
  }
  /// How much the derivatives may change over `du` x `dv`, along any direction in it.
  [[nodiscard]] double change(double du, double dv) const {
    return uu * (du * du) + 2 * mixed * (du * dv) + vv * (dv * dv);
  }
  /// Triangles that a unit square of parts takes, times twice the tolerance: accuracy of Filip's bound,
  /// minimised over the shape of the cells.
  [[nodiscard]] double density() const;

  friend bool operator==(const Curvature&, const Curvature&) = default;
};

/// What holds where either does.
[[nodiscard]] Curvature larger(const Curvature& a, const Curvature& b);

/// Where it is proven, the mixed term is left out on surfaces on which it moves nothing that is seen (see
/// tessellator.h). Immutable; the same surface and parameters give the same map.
class CurvatureMap {
 public:
  /// Cost: up to about 8,000 interval evaluations, 1,000 for a surface with free parameters, spent where they
  /// lower the number of triangles most.
  CurvatureMap(const Surface& surface, std::span<const double> parameters);

  /// Levels up to which tiles can be asked for.
  [[nodiscard]] std::uint32_t levelU() const { return levelU_; }
  [[nodiscard]] std::uint32_t levelV() const { return levelV_; }

  [[nodiscard]] const Curvature& over(std::uint32_t patch, const Tile& tile) const {
    return tiles_[patch][numberOf(tile)];
  }
  /// A dense numbering of all tiles of a patch.
  [[nodiscard]] std::size_t numberOf(const Tile& tile) const {
    // Before the tiles of these levels come those of all smaller ones, level by level.
    const std::size_t rowsOfTiles = (std::size_t{2} << levelV_) - 1;
    return ((std::size_t{1} << tile.levelU) - 1 + tile.column) * rowsOfTiles +
           ((std::size_t{1} << tile.levelV) - 1 + tile.row);
  }
  [[nodiscard]] std::size_t tileCount() const {
    return ((std::size_t{2} << levelU_) - 1) * ((std::size_t{2} << levelV_) - 1);
  }

 private:
  std::uint32_t levelU_ = 0, levelV_ = 0;
  std::vector<std::vector<Curvature>> tiles_;  ///< of each patch, by number
};

/// What a single tile's interval evaluation proves. `kinked` tiles are never proven.
[[nodiscard]] Curvature curvatureOf(const Surface& surface, std::uint32_t patch, const Domain& domain,
                                    const Domain& cell, std::span<const double> parameters);

}  // namespace luxo
