// SPDX-License-Identifier: Apache-2.0
// What the cases that look at pictures share. Pixel coordinates: x right, y down, centres at .5.
#pragma once

#include <cmath>
#include <cstdint>

#include "image/image.h"
#include "scene/snapshot.h"
#include "stability/pixels.h"
#include "stability/stability.h"

namespace luxo {

/// The ray of a place in the picture; its parameter is the depth. World space.
struct PixelRay {
  Vec3 origin{0}, direction{0};

  [[nodiscard]] Vec3 at(double depth) const { return origin + depth * direction; }
};

[[nodiscard]] PixelRay rayThrough(const View& view, const Vec2& pixel);
[[nodiscard]] inline Vec2 centerOf(int x, int y) { return {x + 0.5, y + 0.5}; }
/// The place in the picture of a point in front of the eye.
[[nodiscard]] Vec2 pixelOf(const View& view, const Vec3& pointWorld);

/// Whether `inside(pixel)` is `value` at some of 32 places within `radius` pixels of a pixel's centre: then
/// the picture may show it.
template <class Inside>
[[nodiscard]] bool couldBe(bool value, const Inside& inside, const Vec2& pixel, double radius) {
  if (inside(pixel) == value) return true;
  for (int k = 0; k < 32; ++k) {
    const double angle = kTau * k / 32;
    if (inside(pixel + radius * Vec2(std::cos(angle), std::sin(angle))) == value) return true;
  }
  return false;
}

/// Pixels that show something (id not 0) where nothing can be seen within `radius`, or the reverse.
template <class Inside>
[[nodiscard]] double misclassified(const Image& id, const Inside& inside, double radius) {
  double count = 0;
  for (int y = 0; y < id.height(); ++y)
    for (int x = 0; x < id.width(); ++x)
      if (!couldBe(id.pixel(x, y)[0] != 0, inside, centerOf(x, y), radius)) ++count;
  return count;
}

/// Samples that are NaN.
[[nodiscard]] double nanCount(const Image& image);
/// Pixels that show nothing in an image of ids.
[[nodiscard]] double emptyCount(const Image& id);
/// Between two directions of any length, right down to the last bit, where an arc cosine is not; 180 where
/// one has no direction.
[[nodiscard]] double degreesBetween(const Vec3& a, const Vec3& b);

/// Vulkan rounds vertices to a grid of at least 1/256 pixel in each direction; with the rounding of single
/// precision before it, an edge is drawn within this many pixels of its place.
inline constexpr double kSnapPx = 1.0 / 128;

/// Shows `color` under ambient light 1, whatever the lights do.
[[nodiscard]] Material glowing(const Vec3& color);
/// Ambient light 1 and a black background: glowing materials show their colour.
[[nodiscard]] RenderSettings plainSettings();
/// A scene of one surface, glowing white over black.
[[nodiscard]] Scene sceneOf(const Surface& surface);
/// The angle of view for which a picture of that height has `pixelsPerUnit` pixels per metre at depth 1.
[[nodiscard]] inline double fovOf(int height, double pixelsPerUnit) {
  return 2 * std::atan(height / (2 * pixelsPerUnit));
}

/// On the screen, from a pixel's centre to the surface's point at the (u, v) that the pixel shows: the
/// largest of the pixels of an output pair that show the snapshot's only node.
[[nodiscard]] double positionErrorPx(const Snapshot& snapshot, const Image& id, const Image& uv);

}  // namespace luxo
