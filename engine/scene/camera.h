// SPDX-License-Identifier: Apache-2.0
// A camera: where it stands, what it looks at, how it projects. scene/view.h evaluates it at a moment.
#pragma once

#include <string>

#include "math/animated.h"
#include "math/vec.h"

namespace luxo {

enum class Projection { Perspective, Orthographic };

/// Size of a picture in pixels; pixels are square.
struct PixelSize {
  int width = 1280, height = 720;

  friend bool operator==(const PixelSize&, const PixelSize&) = default;
};

/// World space, metres. Checked when it is evaluated, since it may move.
struct Camera {
  std::string name = "camera";
  Animated<Vec3> eye = Vec3(0, 0, 5);
  Animated<Vec3> lookAt = Vec3(0);
  /// Need not be unit or perpendicular. Zero or parallel to the view direction: +Y is used, or -Z when
  /// looking along Y.
  Animated<Vec3> up = Vec3(0, 1, 0);
  Animated<double> fovY =
      radians(40);              ///< full vertical angle, radians, above 0 and below pi; perspective only
  Animated<double> near = 0.1;  ///< nothing closer is seen; metres along the view axis, above 0
  Projection projection = Projection::Perspective;
  Animated<double> height = 10.0;  ///< of the picture in metres, above 0; orthographic only

  [[nodiscard]] bool movesWithTime() const;
};

}  // namespace luxo
