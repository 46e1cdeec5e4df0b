// SPDX-License-Identifier: Apache-2.0
#include "surface/cloth_simulation.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "base/error.h"

namespace luxo {
namespace {

/// States in memory: one for each cloth of a picture, of the moment a camera is fitted to, and some for going
/// back.
constexpr std::size_t kHeldStates = 8;

}  // namespace

ClothSimulation::~ClothSimulation() = default;

Surface ClothSimulation::surfaceAfter(const Cloth& cloth, std::uint32_t steps) {
  const std::lock_guard lock(mutex_);
  return held(cloth, steps).surface;
}

ClothState ClothSimulation::stateAfter(const Cloth& cloth, std::uint32_t steps) {
  const std::lock_guard lock(mutex_);
  return held(cloth, steps).state;
}

void ClothSimulation::advance(const Cloth&, ClothState&, std::uint32_t) {
  throw Error(
      ErrorKind::Scene, "cloth moves on a device, and its scene was given none",
      "scene.set(std::make_shared<DeviceClothSimulation>()), or render it with Renderer::render(scene)");
}

const ClothSimulation::Held& ClothSimulation::held(const Cloth& cloth, std::uint32_t steps) {
  auto latest = held_.end();
  for (auto i = held_.begin(); i != held_.end(); ++i)
    if (i->steps <= steps && i->cloth == cloth && (latest == held_.end() || i->steps > latest->steps))
      latest = i;
  if (latest != held_.end() && latest->steps == steps) {
    held_.splice(held_.begin(), held_, latest);
    return held_.front();
  }
  Held next{.cloth = cloth, .steps = steps};
  const std::uint32_t from = latest == held_.end() ? 0 : latest->steps;
  next.state = latest == held_.end() ? clothAtRest(cloth) : latest->state;
  if (from < steps) advance(cloth, next.state, steps - from);
  next.surface = clothSurface(cloth, next.state.positions);
  held_.push_front(std::move(next));
  if (held_.size() > kHeldStates) held_.pop_back();
  return held_.front();
}

}  // namespace luxo
