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

/// x and y: pixels right of and below the picture's upper left corner; z: depth, metres in front of the eye's
/// plane.
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

  /// From the nearest corner of this triangle on, the slab covers nothing in the samples of the triangle and
  /// a little around it.
  void enter(const PixelTriangle& triangle);

  /// Nothing is seen behind the farthest corner of this triangle, in samples on or inside its edges, unless
  /// the slab was entered before. Cost: a fraction of a nanosecond per sample.
  void cover(const PixelTriangle& triangle);

  /// How many samples are on or inside the edges of a triangle; and how many something covers.
  [[nodiscard]] std::size_t samplesIn(const PixelTriangle& triangle) const;
  [[nodiscard]] std::size_t covered() const;

  /// Whether all that the triangle covers, and a little around it, is hidden where its nearest corner is. So
  /// is what covers no sample at all. Ends at the first sample that is not.
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
