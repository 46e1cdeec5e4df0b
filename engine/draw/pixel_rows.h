// SPDX-License-Identifier: Apache-2.0
// A picture's pixels as linear functions of an object's points, and back, and how near these can be.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "math/vec.h"
#include "scene/snapshot.h"

namespace luxo {

/// Of a point p of object space, as dot(row, (p, 1)): depth in metres along the view axis, x and y in pixels
/// right of and below the picture's middle, times the depth (perspective).
struct PixelRows {
  Vec4 x, y, depth;
};

[[nodiscard]] PixelRows pixelRows(const View& view, const Transform& worldFromObject);

/// What a picture shows of a polygon whose corners are such (x, y, depth), of parallel rays (x, y, 1).
[[nodiscard]] std::vector<Vec3> clipped(std::vector<Vec3> polygon, const PixelSize& size);

/// Of a pixel right of and below the middle, as dot(row, (pixel, 1)): the place it shows of the object's
/// plane y = 0 has x / w and z / w. A ratio of linear functions finds it without a search (P. Heckbert,
/// Fundamentals of Texture Mapping and Image Warping, 1989).
struct PlaneRows {
  Vec3 x, z, w;
};

/// Nothing where the plane is seen edge-on, or so nearly that double does not tell where pixels are on it.
[[nodiscard]] std::optional<PlaneRows> planeRows(const View& view, const Transform& worldFromObject);

/// Metres along the view axis.
struct DepthRange {
  double nearest = 0, farthest = 0;
};

/// The depths of what the picture shows of the node's bounds, not below that of the near plane: they may
/// reach past the eye outside of the picture. Nothing where it shows none of them. Cost: a microsecond.
[[nodiscard]] std::optional<DepthRange> depthsSeen(const View& view, const SnapshotNode& node);
/// The least of them, or infinity.
[[nodiscard]] double nearestSeen(const View& view, const SnapshotNode& node);

/// A pixel of the picture, from the top left.
struct PixelPlace {
  std::int32_t x = 0, y = 0;

  friend bool operator==(const PixelPlace&, const PixelPlace&) = default;
};

/// Pixels from `low` to before `high`.
struct PixelRect {
  PixelPlace low, high;

  friend bool operator==(const PixelRect&, const PixelRect&) = default;

  [[nodiscard]] std::uint64_t count() const {
    return static_cast<std::uint64_t>(high.x - low.x) * static_cast<std::uint64_t>(high.y - low.y);
  }
};

[[nodiscard]] PixelRect overlap(const PixelRect& a, const PixelRect& b);

/// The pixels that show any of a box, and a pixel around them; all of the picture where it reaches past the
/// eye.
[[nodiscard]] PixelRect pixelsOf(const View& view, const Box& world);

}  // namespace luxo
