// SPDX-License-Identifier: Apache-2.0
// Presets of a shader (shader_presets.h) in the hands of the viewer's user: two buttons.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "scene/scene.h"
#include "viewer.h"
#include "viewer/sliders.h"
#include "window/overlay.h"
#include "window/window.h"

namespace luxo {

class Presets {
 public:
  /// `shader`: whose they are; empty: there are none.
  explicit Presets(std::string shader) : shader_(std::move(shader)) {}

  /// What was done, as people read it; nothing where the grab is of something else. Error: the file cannot be
  /// read or written, or a value is none.
  [[nodiscard]] std::optional<std::string> obey(const window::Grab& grab, Sliders& sliders, Scene& scene,
                                                std::span<const ParameterControl> controls);
  /// Adds its rows to the panel of sliders.
  void addRows(window::Panel& panel) const;

 private:
  std::string save(const Scene& scene, std::span<const ParameterControl> controls);
  std::string takeNext(Sliders& sliders, Scene& scene, std::span<const ParameterControl> controls);

  std::string shader_, current_;
};

}  // namespace luxo
