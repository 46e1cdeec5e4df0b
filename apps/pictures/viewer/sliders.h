// SPDX-License-Identifier: Apache-2.0
// The scene's parameters in the hands of the viewer's user: a slider for each that has a range, and what the
// scene's controls (viewer.h) make of others.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scene/scene.h"
#include "viewer.h"
#include "window/overlay.h"
#include "window/window.h"

namespace luxo {

class Sliders {
 public:
  /// Another scene: values that the user chose stay where it has a parameter of that name that takes them.
  /// `controls` outlive their use.
  void adopt(Scene& scene, std::span<const ParameterControl> controls = {});

  /// True when that changed the scene.
  bool obey(const window::Grab& grab, Scene& scene);

  /// Whether a value is being typed: keys and characters belong to it then.
  [[nodiscard]] bool typing() const { return typing_.has_value(); }
  void obey(const window::Typed& typed);
  /// Enter takes the value, a number such as 0.5 or 1/3, or of a colour #ff8000, and Escape leaves it. True
  /// when that changed the scene. Throws Error(Usage) for what is no value of it, which goes on being typed.
  bool obey(const window::KeyPress& key, Scene& scene);
  /// Gives a parameter that value. Error(Scene): it does not take it.
  void choose(ParameterId id, double value, Scene& scene);
  /// Gives every parameter the value that its scene gave it.
  void reset(Scene& scene);

  /// `values` are the parameters' now. Nothing for a scene without sliders.
  [[nodiscard]] std::optional<window::Panel> panel(const Scene& scene, std::span<const double> values) const;

 private:
  struct Typing {
    ParameterId parameter;  ///< of a colour its first one
    std::string text;
    bool isColor = false;
  };

  /// Of its slider. None: it has none.
  [[nodiscard]] std::optional<Interval> rangeOf(const Parameter& parameter) const;
  [[nodiscard]] const ParameterControl* controlOf(const std::string& parameter) const;
  [[nodiscard]] window::Panel::Row swatchRow(const ParameterControl& control, ParameterId first,
                                             const Scene& scene, std::span<const double> values) const;
  void take(const Typing& typing, Scene& scene);
  [[nodiscard]] static double typedValue(const Typing& typing, const Scene& scene);

  std::span<const ParameterControl> controls_;
  std::vector<Animated<double>> given_;  // by the scene; index = ParameterId
  std::map<std::string, double> chosen_;
  std::optional<Typing> typing_;
};

}  // namespace luxo
