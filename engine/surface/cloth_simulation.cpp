// SPDX-License-Identifier: Apache-2.0
#include "surface/cloth_simulation.h"

#include <fmt/format.h>

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

void ClothSimulation::setInterruption(std::function<bool()> asked) {
  const std::lock_guard lock(mutex_);
  interruption_ = std::move(asked);
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
  const std::uint32_t from = latest == held_.end() ? 0 : latest->steps;
  Held next{.cloth = cloth, .steps = from};
  next.state = latest == held_.end() ? clothAtRest(cloth) : latest->state;
  while (next.steps < steps) {
    if (interruption_ && interruption_()) {
      const std::uint32_t reached = next.steps;
      if (reached > from) remembered(std::move(next));
      throw Error(ErrorKind::Retry,
                  fmt::format("interrupted after {} of the {} steps that a cloth takes", reached, steps));
    }
    const std::uint32_t more = std::min(steps - next.steps, kMaxStepsAtOnce);
    advance(cloth, next.state, more);
    next.steps += more;
  }
  return remembered(std::move(next));
}

const ClothSimulation::Held& ClothSimulation::remembered(Held held) {
  held.surface = clothSurface(held.cloth, held.state.positions);
  held_.push_front(std::move(held));
  if (held_.size() > kHeldStates) held_.pop_back();
  return held_.front();
}

}  // namespace luxo
