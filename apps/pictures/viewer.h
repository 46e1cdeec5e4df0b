// SPDX-License-Identifier: Apache-2.0
// A scene in a window: what `luxo view` and `luxo_grandpa` open.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "draw/options.h"
#include "math/interval.h"
#include "scene/scene.h"

namespace luxo {

/// How people turn some parameters of a scene that belong together: the components of a colour, of a vector.
struct ParameterControl {
  enum class Kind { Slider, Color, Choice, Switch };
  std::string label = {};
  Kind kind = Kind::Slider;
  std::vector<std::string> parameters = {};  ///< by name, one for each component
  Interval range = {0, 1};  ///< of the sliders; a parameter without its own takes other values, too
  std::vector<std::string> choices = {};  ///< of Choice: names of the values 0, 1, ...
  bool encoded = false;                   ///< of Color: codes of sRGB, not linear

  friend bool operator==(const ParameterControl&, const ParameterControl&) = default;
};

/// What is shown, and how as long as its user does not say otherwise.
struct ViewedScene {
  Scene scene;
  RenderSettings settings = {};  ///< size, first moment, shading, samples, tolerance, frames per second
  CameraId camera = {};          ///< none: the scene's first
  std::vector<ParameterControl> controls = {};  ///< other parameters with a range have a slider each
  /// Parameters that follow the mouse (viewer/picture_mouse.h): four, or none.
  std::vector<std::string> mouse = {};
  double loop = 0;  ///< seconds after which it plays from 0 on again; 0: never
};

struct ViewerOptions {
  std::string title = "luxo";
  bool playing = true;  ///< false: starts paused
  Skips skips = {};
  std::string device = "auto";
  bool validate = false;    ///< Vulkan validation layers on; any message fails the run
  std::string shader = {};  ///< whose presets (shader_presets.h) can be taken and saved; empty: none
  /// Reads the scene: the viewer asks for it whenever one of its files is saved. What it throws is shown over
  /// the last good scene, until the next time. `files` gets those that it is made of, there or not, also
  /// where it throws.
  using Files = std::vector<std::filesystem::path>;
  std::function<ViewedScene(Files& files)> readAgain = {};
  Files files = {};  ///< of the first time: all are watched
  std::chrono::system_clock::time_point begun = std::chrono::system_clock::now();  ///< before that
  std::optional<Error> problem = {};  ///< why the first scene is not the one that was asked for
};

/// Shows the scene until its user closes the window, and gives the exit code. Nothing is drawn while nothing
/// changes. Parameters with a range get sliders; moving one reads, compiles and uploads nothing but what it
/// changes. Throws Error(Device) where there is no screen, Error(Usage) where this build has no window.
[[nodiscard]] int runViewer(ViewedScene viewed, const ViewerOptions& options);

}  // namespace luxo
