// SPDX-License-Identifier: Apache-2.0
// The mouse as shaders of whole pictures read it: Shadertoy's iMouse. In pixels, y upward, of the pixel's
// corner at the lower left, as fragCoord counts them:
//
//     xy   where it was last while its left button was down
//     zw   where that was pressed; z negative once it is up again, w in all pictures but the press's first
//
#pragma once

#include <array>
#include <span>
#include <string>

#include "math/vec.h"
#include "scene/scene.h"
#include "scene/view.h"
#include "window/window.h"

namespace luxo {

class PictureMouse {
 public:
  /// Of the grab area that is the whole picture, behind all others.
  static constexpr int kKey = 1 << 21;

  /// Another scene, whose parameters of these names are the four numbers; none: nothing reads the mouse. What
  /// they were stays.
  void adopt(Scene& scene, std::span<const std::string> parameters);
  [[nodiscard]] bool isRead() const { return !parameters_.empty(); }

  /// True when that changed the scene.
  bool obey(const window::Grab& grab, PixelSize size, Scene& scene);
  /// A picture shows what there is. True when the next one shows something else.
  bool wasDrawn(Scene& scene);
  [[nodiscard]] const std::array<double, 4>& numbers() const { return numbers_; }

 private:
  void give(Scene& scene) const;

  std::span<const std::string> parameters_;
  std::array<double, 4> numbers_{};
  bool used_ = false;  ///< the button was pressed at some time
};

}  // namespace luxo
