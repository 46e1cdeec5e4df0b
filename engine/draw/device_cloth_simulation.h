// SPDX-License-Identifier: Apache-2.0
// Cloth that a compute shader moves (shaders/cloth.comp).
//
//     scene.set(std::make_shared<DeviceClothSimulation>());
//
// Its steps are the same bytes each time on a device; another device rounds square roots and quotients
// otherwise. Nothing is made, no device, pipeline or buffer, before a cloth has to move. States are read
// back, once for each time that is asked for: their triangles are a mesh like any other (triangleMesh() says
// what it costs), for rays in double as for what is drawn. Processor time of a step without a GPU, measured
// with the gallery's cloth: 0.2 ms of 16 x 16 cells, 0.5 ms of 24 x 24, 1 ms of 32 x 32, 3 ms of 48 x 48,
// whose steps take more iterations.
#pragma once

#include <memory>

#include "gpu/context_on_demand.h"
#include "surface/cloth_simulation.h"

namespace luxo {

class DeviceClothSimulation : public ClothSimulation {
 public:
  /// On a device of its own, opened once a cloth moves; then Error(Device) where there is none.
  explicit DeviceClothSimulation(gpu::ContextDesc desc = {});
  /// On a device of the caller's, which must outlive it.
  explicit DeviceClothSimulation(gpu::Context& context);
  ~DeviceClothSimulation() override;

 private:
  class Stepper;

  /// Error(Scene) where numbers leave float's range, Error(Retry) when the device runs out of memory or is
  /// lost.
  void advance(const Cloth& cloth, ClothState& state, std::uint32_t steps) override;

  gpu::ContextOnDemand context_;
  std::unique_ptr<Stepper> stepper_;
};

}  // namespace luxo
