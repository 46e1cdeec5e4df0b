// SPDX-License-Identifier: Apache-2.0
// What is hidden: how deep a picture can be seen into, sample by sample, past triangles that nothing is seen
// through. A depth buffer on the host, for devices that find out too late (after Newton's method) that a
// fragment is behind another.
#pragma once

#include <array>
#include <cstddef>
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
};

class OcclusionBuffer {
 public:
  /// Nothing is hidden. Samples lie `sample` from the upper left corners of their pixels.
  void clear(const PixelSize& size, const Vec2& sample) { clear(size.width, {0, size.height}, sample); }
  /// The same, of some rows only: what is in others is not looked at.
  void clear(int width, const Rows& rows, const Vec2& sample);

  /// What is covered from now on is covered by another slab, which nothing has entered.
  void beginSlab();

  /// Behind this triangle the slab covers nothing, in the samples of the triangle and a little around it.
  void enter(const PixelTriangle& triangle);

  /// Nothing is seen behind this triangle, in samples on or inside its edges, unless the slab was entered
  /// before. Cost: a fraction of a nanosecond per sample.
  void cover(const PixelTriangle& triangle);

  /// How many samples are on or inside the edges of a triangle; and how many something covers.
  [[nodiscard]] std::size_t samplesIn(const PixelTriangle& triangle) const;
  [[nodiscard]] std::size_t covered() const;

  /// Whether the triangle is hidden in all samples that it covers, and a little around it. So is what covers
  /// no sample at all. Ends with the first row that is not.
  [[nodiscard]] bool hides(const PixelTriangle& triangle) const;

 private:
  [[nodiscard]] std::size_t startOf(int row) const {
    return static_cast<std::size_t>(row - rows_.first) * static_cast<std::size_t>(width_);
  }

  int width_ = 0;
  Rows rows_;
  Vec2 sample_{0};
  std::vector<float> farthest_;                        ///< that can be seen, by row
  std::vector<float> entered_;                         ///< where, by row
  Rows enteredRows_;                                   ///< in which something may be,
  int firstEnteredColumn_ = 0, enteredColumnEnd_ = 0;  ///< and columns
};

}  // namespace luxo
