// SPDX-License-Identifier: Apache-2.0
#include "scene_request.h"

#include <fmt/format.h>

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/suggestion.h"
#include "draw/accumulation.h"
#include "draw/device_cloth_simulation.h"
#include "draw/device_vertex_movement.h"
#include "interruption.h"

namespace luxo {

RenderSettings settingsOf(const Scene& scene, const RenderRequest& request) {
  RenderSettings settings = scene.settings();
  settings.size = request.size.value_or(settings.size);
  settings.time = request.time.value_or(settings.time);
  settings.fps = request.fps.value_or(settings.fps);
  settings.samples = request.samples.value_or(settings.samples);
  settings.tolerance = request.tolerancePx.value_or(settings.tolerance);
  settings.shading = request.shading.value_or(settings.shading);
  settings.hiddenLines |= request.hiddenLines;
  return settings;
}

std::optional<Vec2> sampleOffsetOf(const RenderSettings& settings, const RenderRequest& request) {
  if (!request.sample) return std::nullopt;
  if (*request.sample >= settings.samples)
    throw Error(ErrorKind::Usage,
                fmt::format("there is no sample {} of {}", *request.sample, settings.samples),
                fmt::format("samples count from 0; give --samples {} or more", *request.sample + 1));
  return samplePattern(settings.samples)[static_cast<std::size_t>(*request.sample)];
}

CameraId cameraOf(const Scene& scene, const RenderRequest& request) {
  if (!request.camera) return {};
  if (const auto id = scene.findCamera(*request.camera)) return *id;
  std::vector<std::string> names;
  for (const Camera& camera : scene.cameras()) names.push_back(camera.name);
  throw Error(ErrorKind::Usage, fmt::format("--camera: the scene has no camera '{}'", *request.camera),
              names.empty()
                  ? "it has no camera at all; leave the option out"
                  : didYouMean(*request.camera, names, fmt::format("its cameras: {}", listed(names))));
}

NodeId lightOf(const Scene& scene, const RenderRequest& request) {
  if (!request.light) return {};
  std::vector<std::string> names;
  for (std::uint32_t i = 0; i < scene.nodes().size(); ++i) {
    const Scene::Entry& entry = scene.nodes()[i];
    if (entry.removed || !entry.node.light || entry.node.light->shadow == Light::Shadow::None) continue;
    names.push_back(entry.node.name.empty() ? scene.shownName({i}) : entry.node.name);
    if (names.back() == *request.light) return {i};
  }
  throw Error(ErrorKind::Usage,
              fmt::format("--aov light-depth: the scene has no light '{}' with a shadow", *request.light),
              names.empty() ? "no light of it has one"
                            : didYouMean(*request.light, names,
                                         fmt::format("its lights with a shadow: {}", listed(names))));
}

void refuseParameters(const RenderRequest& request) {
  if (!request.parameters.empty())
    throw Error(ErrorKind::Usage,
                fmt::format("the scene has no parameter '{}'", request.parameters.front().name),
                "it has no parameters");
}

ParameterId sweptParameter(const Scene& scene, const Sweep& sweep) {
  const auto id = scene.findParameter(sweep.name);
  if (!id) {
    std::vector<std::string> names;
    for (const Parameter& parameter : scene.parameters()) names.push_back(parameter.name);
    throw Error(ErrorKind::Usage, fmt::format("--sweep: the scene has no parameter '{}'", sweep.name),
                names.empty() ? "it has no parameters"
                              : didYouMean(sweep.name, names, fmt::format("it has {}", listed(names))));
  }
  try {
    for (const double value : sweep.values) requireAllowed(scene[*id], value);
  } catch (const Error& error) {
    throw Error(ErrorKind::Usage, fmt::format("--sweep: {}", error.what()));
  }
  return *id;
}

ViewedScene viewedScene(Scene scene, const RenderRequest& request) {
  const RenderSettings settings = settingsOf(scene, request);
  const CameraId camera = cameraOf(scene, request);
  moveByDevice(scene, request.device);
  return {std::move(scene), settings, camera};
}

ViewerOptions viewerOptions(const std::string& title, const RenderRequest& request) {
  return {.title = title,
          .playing = !request.time,
          .skips = request.skips,
          .device = request.device,
          .validate = request.validate};
}

void moveByDevice(Scene& scene, const std::string& device) {
  scene.set(std::make_shared<DeviceVertexMovement>(gpu::ContextDesc{.device = device}));
  if (!scene.hasCloth()) return;
  const auto simulation = std::make_shared<DeviceClothSimulation>(gpu::ContextDesc{.device = device});
  simulation->setInterruption([] { return interruptingSignal() != 0; });
  scene.set(simulation);
}

}  // namespace luxo
