// SPDX-License-Identifier: Apache-2.0
#include "scene_request.h"

#include <fmt/format.h>

#include "base/error.h"

namespace luxo {

RenderSettings settingsOf(const Scene& scene, const RenderRequest& request) {
  RenderSettings settings = scene.settings();
  settings.size = request.size.value_or(settings.size);
  settings.time = request.time.value_or(settings.time);
  settings.fps = request.fps.value_or(settings.fps);
  settings.samples = request.samples.value_or(settings.samples);
  settings.tolerance = request.tolerancePx.value_or(settings.tolerance);
  settings.shading = request.shading.value_or(settings.shading);
  return settings;
}

CameraId cameraOf(const Scene& scene, const RenderRequest& request) {
  if (!request.camera) return {};
  if (const auto id = scene.findCamera(*request.camera)) return *id;
  std::string names;
  for (const Camera& camera : scene.cameras()) names += (names.empty() ? "" : ", ") + camera.name;
  throw Error(ErrorKind::Usage, fmt::format("--camera: the scene has no camera '{}'", *request.camera),
              names.empty() ? "it has no camera at all; leave the option out"
                            : fmt::format("its cameras: {}", names));
}

void refuseParameters(const RenderRequest& request) {
  const std::string name = !request.parameters.empty() ? request.parameters.front().name
                           : request.sweep             ? request.sweep->name
                                                       : "";
  if (!name.empty())
    throw Error(ErrorKind::Usage, fmt::format("the scene has no parameter '{}'", name),
                "built-in scenes have no parameters");
}

ViewerOptions viewerOptions(const Scene& scene, const std::string& title, const RenderRequest& request) {
  refuseParameters(request);
  return {.title = title,
          .settings = settingsOf(scene, request),
          .camera = cameraOf(scene, request),
          .playing = !request.time,
          .skips = request.skips,
          .device = request.device,
          .validate = request.validate};
}

}  // namespace luxo
