// SPDX-License-Identifier: Apache-2.0
// A camera at one moment for one picture size: the matrices, in double.
//
// Eye space: origin at the eye, +X right, +Y up, looking along -Z. Depth = -z. Clip space: y up (the draw
// stage flips it once, with a negative viewport), reversed depth: 1 at the near plane, 0 far away, compared
// with GREATER.
#pragma once

#include <limits>

#include "math/frustum.h"
#include "math/transform.h"
#include "scene/camera.h"

namespace luxo {

struct View {
  PixelSize size;
  Projection projection = Projection::Perspective;
  Vec3 eye{0};  ///< world
  Mat3 eyeFromWorld{
      1};  ///< rotation: pointEye = eyeFromWorld * (pointWorld - eye); error below 1e-15 per entry
  /// Perspective: clip.z = near, clip.w = depth. Orthographic: clip.z = (far - depth) / (far - near), clip.w
  /// = 1.
  Mat4 clipFromEye{1};
  double near = 0.1;
  double far =
      std::numeric_limits<double>::infinity();  ///< infinite for perspective, fitted for orthographic
  /// Perspective: pixels per metre at depth 1, f = H / (2 tan(fovY / 2)). Orthographic: pixels per metre.
  double pixelsPerUnit = 1;
  Vec2 halfExtent{
      1};  ///< half the picture's width and height in metres: at depth 1, or (orthographic) everywhere
  /// From the centre of every pixel to where it is sampled: x right, y down. Only clipFromEye has it in: what
  /// is drawn at gl_FragCoord.xy lies at gl_FragCoord.xy + sampleOffsetPx of the picture, which all else here
  /// is about.
  Vec2 sampleOffsetPx{0};

  [[nodiscard]] bool perspective() const { return projection == Projection::Perspective; }
  [[nodiscard]] Vec3 right() const { return {eyeFromWorld[0].x, eyeFromWorld[1].x, eyeFromWorld[2].x}; }
  [[nodiscard]] Vec3 up() const { return {eyeFromWorld[0].y, eyeFromWorld[1].y, eyeFromWorld[2].y}; }
  [[nodiscard]] Vec3 forward() const { return {-eyeFromWorld[0].z, -eyeFromWorld[1].z, -eyeFromWorld[2].z}; }
  friend bool operator==(const View&, const View&) = default;
};

/// Evaluates a camera. `sceneBounds` (world) only fits the depth range of an orthographic view: from the near
/// plane, or the nearest point if that is farther, to the farthest point, with a sixteenth to spare. Throws
/// Error(Scene) saying which value is out of range: eye equal to look_at, anything not finite, fov_y outside
/// 0..180 degrees, near or height not above 0, a size below 1x1, infinite bounds for an orthographic camera.
[[nodiscard]] View viewAt(const Camera& camera, const Moment& moment, PixelSize size,
                          const Box& sceneBounds = {});

/// The same view sampled that far from the pixels' centres: a pass of a picture with many samples per pixel.
[[nodiscard]] View sampledAt(View view, const Vec2& offsetPx);

/// Subtracts the eye in double before anything is rounded: the error is relative to the distance from the
/// eye.
[[nodiscard]] Transform eyeFromObject(const View& view, const Transform& worldFromObject);

[[nodiscard]] inline Vec3 eyeFromWorldPoint(const View& view, const Vec3& pointWorld) {
  return view.eyeFromWorld * (pointWorld - view.eye);
}

/// Pixel coordinates (x right, y down, pixel centres at .5) of a point of eye space; perspective: in front of
/// the eye.
[[nodiscard]] Vec2 pixelFromEye(const View& view, const Vec3& pointEye);

/// The planes of what the picture shows, grown by `marginPx` pixels on each side.
[[nodiscard]] Frustum frustumOf(const View& view, double marginPx = 0);

}  // namespace luxo
