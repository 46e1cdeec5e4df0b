// SPDX-License-Identifier: Apache-2.0
#include "scene/camera.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace luxo {

bool Camera::movesWithTime() const {
  return eye.movesWithTime() || lookAt.movesWithTime() || up.movesWithTime() || fovY.movesWithTime() ||
         near.movesWithTime() || height.movesWithTime();
}

Camera fitCamera(const Box& bounds, PixelSize size) {
  const Box box = bounds.empty() ? Box{Vec3(-0.5), Vec3(0.5)} : bounds;
  const Sphere sphere = sphereAround(box);
  if (!std::isfinite(glm::dot(sphere.center, Vec3(1))) || !std::isfinite(sphere.radius))
    throw Error(ErrorKind::Scene, "cannot fit a camera around the scene: its bounds are infinite",
                "give the scene a camera");
  const double radius = std::max(sphere.radius, 1e-6 * glm::length(sphere.center) + 1e-12);

  Camera camera{.name = "fitted"};
  const double tanY = std::tan(0.5 * camera.fovY.at(0));
  const double tanNarrow = tanY * std::min(1.0, double(size.width) / std::max(size.height, 1));
  const double distance = radius / std::sin(std::atan(tanNarrow));
  camera.eye = sphere.center + distance * unit(Vec3(1, 0.8, 1.5));
  camera.lookAt = sphere.center;
  camera.near = std::min(camera.near.at(0), 0.01 * distance);
  return camera;
}

}  // namespace luxo
