// SPDX-License-Identifier: Apache-2.0
// What a request means for a scene: the command line over the scene over the default.
#pragma once

#include "options.h"
#include "scene/scene.h"
#include "viewer.h"

namespace luxo {

[[nodiscard]] RenderSettings settingsOf(const Scene& scene, const RenderRequest& request);

/// None: the scene's first. Error(Usage): it has none of that name.
[[nodiscard]] CameraId cameraOf(const Scene& scene, const RenderRequest& request);

/// Error(Usage) for any -P or --sweep: built-in scenes are C++ and have no parameters.
void refuseParameters(const RenderRequest& request);

/// A window on the scene. It starts paused where the request names a moment. Error(Usage) as above.
[[nodiscard]] ViewerOptions viewerOptions(const Scene& scene, const std::string& title,
                                          const RenderRequest& request);

}  // namespace luxo
