// SPDX-License-Identifier: Apache-2.0
#include "viewer/viewed_moment.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "base/error.h"
#include "scene/fitted_camera.h"

namespace luxo {
namespace {

constexpr std::uint32_t kSofter = 4;  // so many times the samples from picture to picture

}  // namespace

void ViewedMoment::look() {
  const Scene& scene = viewed_->scene;
  fitted_.reset();
  if (scene.cameras().empty())
    fitted_ = {takeSnapshot(scene, scene.settings().time, viewed_->settings.size, Camera{}), {0, 0}, {}};
  mostShadowSamples_ = 1;
  for (const Scene::Entry& entry : scene.nodes())
    if (const std::optional<Light>& light = entry.node.light; light && light->shadow != Light::Shadow::None)
      mostShadowSamples_ = std::max(mostShadowSamples_, light->shadowSamples);
}

Camera ViewedMoment::sceneCamera(PixelSize size) {
  if (viewed_->camera.valid()) return viewed_->scene[viewed_->camera];
  if (!fitted_) return viewed_->scene.cameras().front();
  if (fitted_->size != size) {
    fitted_->size = size;
    fitted_->camera = fitCamera(fitted_->scene, fitted_->size);
  }
  return fitted_->camera;
}

Snapshot ViewedMoment::next(PixelSize size, const Snapshot* last) {
  Snapshot quick = snapshot(size, last, kQuickShadowSamples);
  if (mostShadowSamples_ <= kQuickShadowSamples) return quick;
  if (quick != quick_) shadowSamples_ = kQuickShadowSamples;
  quick_ = quick;
  return shadowSamples_ > kQuickShadowSamples ? snapshot(size, last, shadowSamples_) : std::move(quick);
}

Snapshot ViewedMoment::whole(PixelSize size, const Snapshot* last) {
  return snapshot(size, last, kMaxShadowSamples);
}

bool ViewedMoment::soften() {
  if (shadowSamples_ >= mostShadowSamples_) return false;
  shadowSamples_ = std::min(shadowSamples_ * kSofter, mostShadowSamples_);
  return true;
}

Snapshot ViewedMoment::snapshot(PixelSize size, const Snapshot* last, std::uint32_t mostShadowSamples) {
  try {
    seconds_ = controls_->playback().seconds(std::chrono::steady_clock::now());
    parameters_ = viewed_->scene.parametersAt(seconds_);
    Snapshot now = takeSnapshot(viewed_->scene, seconds_, size,
                                controls_->ownCamera().value_or(sceneCamera(size)), mostShadowSamples);
    impossible_.clear();
    return now;
  } catch (const Error& error) {
    if (last == nullptr || error.kind() != ErrorKind::Scene) throw;
    impossible_ = error.what();
    return resized(*last, size);
  }
}

Snapshot resized(Snapshot snapshot, PixelSize size) {
  View& view = snapshot.view;
  if (view.size == size) return snapshot;
  view.size = size;
  view.pixelsPerUnit = size.height / (2 * view.halfExtent.y);
  const double halfWidth = size.width / (2 * view.pixelsPerUnit);
  view.clipFromEye[0].x *= view.halfExtent.x / halfWidth;
  view.halfExtent.x = halfWidth;
  return snapshot;
}

}  // namespace luxo
