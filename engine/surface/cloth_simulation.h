// SPDX-License-Identifier: Apache-2.0
// Moves cloth on, and remembers where it was.
#pragma once

#include <cstdint>
#include <functional>
#include <list>
#include <mutex>

#include "surface/cloth.h"

namespace luxo {

/// What a cloth is like is a function of it and of the number of steps, whatever was asked before. Safe from
/// any thread, one at a time.
class ClothSimulation {
 public:
  ClothSimulation() = default;
  virtual ~ClothSimulation();
  ClothSimulation(const ClothSimulation&) = delete;
  ClothSimulation& operator=(const ClothSimulation&) = delete;

  /// Asked for the same cloth and steps again soon it is the same surface, not only an equal one. Cost: the
  /// steps since the latest state before that is remembered, or since rest.
  [[nodiscard]] Surface surfaceAfter(const Cloth& cloth, std::uint32_t steps);
  [[nodiscard]] ClothState stateAfter(const Cloth& cloth, std::uint32_t steps);

  /// Asked before every kMaxStepsAtOnce steps, by whoever asks for a state: once it says yes that is
  /// refused, Error(Retry). What was reached is remembered: asked again it goes on from there.
  void setInterruption(std::function<bool()> asked);

 protected:
  /// Of one advance(): a step of the largest cloth takes some 10 ms, and systems end what takes a device
  /// seconds.
  static constexpr std::uint32_t kMaxStepsAtOnce = 64;

 private:
  struct Held {
    Cloth cloth;
    std::uint32_t steps = 0;
    ClothState state;
    Surface surface;
  };

  /// So many steps on, at most kMaxStepsAtOnce. This one throws Error(Scene): it takes a device
  /// (draw/device_cloth_simulation.h).
  virtual void advance(const Cloth& cloth, ClothState& state, std::uint32_t steps);
  const Held& held(const Cloth& cloth, std::uint32_t steps);
  const Held& remembered(Held held);

  std::mutex mutex_;
  std::function<bool()> interruption_;
  std::list<Held> held_;  ///< the last asked for first
};

}  // namespace luxo
