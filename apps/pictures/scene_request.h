// SPDX-License-Identifier: Apache-2.0
// What a request means for a scene: the command line over the scene over the default.
#pragma once

#include <optional>
#include <string>

#include "options.h"
#include "scene/scene.h"
#include "viewer.h"

namespace luxo {

[[nodiscard]] RenderSettings settingsOf(const Scene& scene, const RenderRequest& request);

/// Where --sample is, pixels from the centre of its pixel; none: it was not given. Error(Usage): there are
/// not so many samples.
[[nodiscard]] std::optional<Vec2> sampleOffsetOf(const RenderSettings& settings,
                                                 const RenderRequest& request);

/// None: the scene's first. Error(Usage): it has none of that name.
[[nodiscard]] CameraId cameraOf(const Scene& scene, const RenderRequest& request);

/// The light that --aov light-depth:NODE is of, none if it names none. Error(Usage): no light of that name,
/// or of a node without a name at that place, has a shadow.
[[nodiscard]] NodeId lightOf(const Scene& scene, const RenderRequest& request);

/// Error(Usage) for any -P: what is built in C++ has no parameters.
void refuseParameters(const RenderRequest& request);

/// The parameter that is swept. Error(Usage): the scene has none of that name, or its range does not allow
/// all the values.
[[nodiscard]] ParameterId sweptParameter(const Scene& scene, const Sweep& sweep);

/// The scene as the request wants it shown. Error(Usage): it has no such camera.
[[nodiscard]] ViewedScene viewedScene(Scene scene, const RenderRequest& request);

/// A window for it. It starts paused where the request names a moment.
[[nodiscard]] ViewerOptions viewerOptions(const std::string& title, const RenderRequest& request);

/// Has a device move the scene's cloth, if it has any, until a signal interrupts it (interruption.h), and run
/// its vertex programs. It is opened once there is a step to do, or a mesh that may move.
void moveByDevice(Scene& scene, const std::string& device);

}  // namespace luxo
