// SPDX-License-Identifier: Apache-2.0
// How deep a picture can be seen into past solids, by squares of pixels.
//
// Whoever looks at a solid from outside sees nothing behind a ball that is inside of it: a ray that meets the
// ball's middle section, the disk parallel to the picture, has come into the solid by a front face before. So
// has it where single precision moves the faces, as long as none of them reaches the disk: a closed surface
// that moves goes around a point as often as before unless it meets the point. What a ray sees first is
// behind no disk, so that no front face that is seen is ever hidden, whichever solids hide it.
#pragma once

#include <vector>

#include "math/bounds.h"
#include "scene/view.h"

namespace luxo {

class OccluderGrid {
 public:
  /// Nothing is hidden.
  explicit OccluderGrid(const View& view);

  /// Nothing is seen behind the middle of a ball, in the world, that is inside of an opaque solid that is
  /// seen from outside, at least `slack` from its surface when that is smaller by so much. Cost: a nanosecond
  /// a square.
  void cover(const Sphere& ball, double slack);
  [[nodiscard]] bool empty() const { return farthest_.empty(); }

  /// Whether all of what the picture shows of a ball is hidden.
  [[nodiscard]] bool hides(const Sphere& ball) const;

 private:
  /// In the picture, in pixels.
  struct Circle {
    Vec2 middle{0};
    double radius = 0;
  };
  /// Rows or columns of squares.
  struct Run {
    int first = 0, end = 0;
  };

  /// A circle around all of what is seen of a ball in the eye's space, whose points are before the eye.
  [[nodiscard]] Circle around(const Sphere& ball) const;
  [[nodiscard]] Run rowsOf(const Circle& circle) const;
  /// Of a row, the squares that are in the circle, or that it reaches.
  [[nodiscard]] Run within(const Circle& circle, int row) const;
  [[nodiscard]] Run reached(const Circle& circle, int row) const;

  View view_;
  int square_;  ///< pixels along one
  int columns_, rows_;
  std::vector<float> farthest_;  ///< depth that can be seen, by row; none where nothing is hidden
};

}  // namespace luxo
