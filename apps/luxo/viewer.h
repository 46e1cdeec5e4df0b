// SPDX-License-Identifier: Apache-2.0
// A scene in a window: what `luxo view` and `luxo_grandpa` open.
#pragma once

#include <string>

#include "draw/options.h"
#include "scene/scene.h"

namespace luxo {

struct ViewerOptions {
  std::string title = "luxo";
  RenderSettings settings = {};  ///< size, first moment, shading, samples, tolerance, frames per second
  CameraId camera = {};          ///< none: the scene's first
  bool playing = true;           ///< false: starts paused
  Skips skips = {};
  std::string device = "auto";
  bool validate = false;  ///< Vulkan validation layers on; any message fails the run
};

/// Shows the scene until its user closes the window, and gives the exit code. Nothing is drawn while nothing
/// changes. Throws Error(Device) where there is no screen, Error(Usage) where this build has no window.
[[nodiscard]] int runViewer(const Scene& scene, const ViewerOptions& options);

}  // namespace luxo
