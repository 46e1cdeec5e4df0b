// SPDX-License-Identifier: Apache-2.0
// What is hidden: how deep a picture can be seen into, sample by sample, past triangles that nothing is seen
// through. A depth buffer on the host, for devices that find out too late (after Newton's method) that a
// fragment is behind another.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "math/vec.h"
#include "scene/camera.h"

namespace luxo {

/// x and y: pixels right of and below the picture's upper left corner; z: grows with the depth and is linear
/// on the screen: the depth itself of parallel rays, -1 / depth of those through an eye.
using PixelTriangle = std::array<Vec3, 3>;

/// Rows of a picture, from the top.
struct Rows {
  int first = 0, end = 0;

  friend bool operator==(const Rows&, const Rows&) = default;
};

class OcclusionBuffer {
 public:
  /// Nothing is hidden. Samples lie `sample` from the upper left corners of their pixels.
  void clear(const PixelSize& size, const Vec2& sample) { clear(size.width, {0, size.height}, sample); }
  /// The same, of some rows only: what is in others is not looked at.
  void clear(int width, const Rows& rows, const Vec2& sample);

  /// Of a slab: nothing is seen behind what rays leave it by, in samples on or inside the edges of those
  /// triangles, unless a ray has entered it before by one of the others, in their samples or a little around
  /// them. Cost: a fraction of a nanosecond per sample, and some fifty per triangle; what is hidden, or
  /// enters behind all that it could undo, costs ten.
  void cover(std::span<const PixelTriangle> leaving, std::span<const PixelTriangle> entering = {});

  /// How many samples are on or inside the edges of a triangle; and how many something covers.
  [[nodiscard]] std::size_t samplesIn(const PixelTriangle& triangle) const;
  [[nodiscard]] std::size_t covered() const;

  /// Whether the triangle is hidden in all samples that it covers, and a little around it. So is what covers
  /// no sample at all. Ends with the first row that is not.
  [[nodiscard]] bool hides(const PixelTriangle& triangle) const;

 private:
  static constexpr float kInfinity = std::numeric_limits<float>::infinity();

  /// A square of samples.
  struct Tile {
    float farthest = kInfinity;  ///< that can be seen
    float cover = -kInfinity;    ///< the farthest that the slab may cover
    bool entered = false;        ///< whether the slab may be
    bool covered = false;        ///< something in it may be behind a slab
  };
  /// The tiles that a triangle may hold samples of, and its depths.
  struct Reach {
    int left = 0, right = 0, top = 0, bottom = 0;
    float near = 0, far = 0;

    [[nodiscard]] bool empty() const { return left == right; }
  };

  [[nodiscard]] std::size_t startOf(int row) const {
    return static_cast<std::size_t>(row - rows_.first) * static_cast<std::size_t>(stride_);
  }
  [[nodiscard]] Reach reachOf(const PixelTriangle& triangle) const;
  template <typename Action>
  void forEachTile(const Reach& reach, const Action& action);
  /// Whether in all tiles that depth is nearer than all of the triangle.
  [[nodiscard]] bool allNearer(float Tile::*depth, const Reach& reach) const;
  void enter(const PixelTriangle& triangle);
  void coverUnlessEntered(const PixelTriangle& triangle);
  void settle(Tile& tile, int column, int row);
  /// With the column and row in which each begins.
  template <typename Action>
  void forEachTilePlace(const Action& action);
  /// Of the tile that begins there: all as if nothing had been there.
  void fill(std::vector<float>& samples, int column, int row) const;

  int width_ = 0, stride_ = 0, tilesAcross_ = 0;
  Rows rows_;
  Vec2 sample_{0};
  std::vector<float> farthest_;          ///< that can be seen, by row
  std::vector<float> entered_;           ///< where the slab was, by row
  std::vector<Tile> tiles_;              ///< by row
  std::vector<std::uint32_t> covering_;  ///< which of what the slab is left by may cover something
};

}  // namespace luxo
