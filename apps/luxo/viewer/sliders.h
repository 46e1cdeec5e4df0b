// SPDX-License-Identifier: Apache-2.0
// The scene's parameters in the hands of the viewer's user: a slider for each that has a range.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scene/scene.h"
#include "window/overlay.h"
#include "window/window.h"

namespace luxo {

class Sliders {
 public:
  /// Another scene: values that the user chose stay where it has a parameter of that name that takes them.
  void adopt(Scene& scene);

  /// True when that changed the scene.
  bool obey(const window::Grab& grab, Scene& scene);
  /// Gives every parameter the value that its scene gave it.
  void reset(Scene& scene);

  /// `values` are the parameters' now. Nothing for a scene without sliders.
  [[nodiscard]] std::optional<window::Panel> panel(const Scene& scene, std::span<const double> values) const;

 private:
  std::vector<Animated<double>> given_;  // by the scene; index = ParameterId
  std::map<std::string, double> chosen_;
};

}  // namespace luxo
