// SPDX-License-Identifier: Apache-2.0
#include "viewer/picture_mouse.h"

#include <cmath>
#include <cstddef>

namespace luxo {

void PictureMouse::adopt(Scene& scene, std::span<const std::string> parameters) {
  parameters_ = parameters;
  if (used_) give(scene);
}

bool PictureMouse::obey(const window::Grab& grab, PixelSize size, Scene& scene) {
  if (!isRead() || grab.key != kKey || grab.types) return false;
  auto& [x, y, pressedX, pressedY] = numbers_;
  used_ = true;
  x = std::floor(grab.cursorPx.x);
  y = size.height - 1 - std::floor(grab.cursorPx.y);
  if (grab.pressed) {
    pressedX = x;
    pressedY = y;
  }
  if (grab.released) pressedX = -std::abs(pressedX);
  give(scene);
  return true;
}

bool PictureMouse::wasDrawn(Scene& scene) {
  double& pressedY = numbers_[3];
  if (!isRead() || !used_ || pressedY <= 0) return false;
  pressedY = -pressedY;
  give(scene);
  return true;
}

void PictureMouse::give(Scene& scene) const {
  for (std::size_t i = 0; i < parameters_.size(); ++i)
    if (const auto id = scene.findParameter(parameters_[i])) scene.setParameter(*id, numbers_[i]);
}

}  // namespace luxo
