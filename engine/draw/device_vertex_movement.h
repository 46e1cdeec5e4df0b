// SPDX-License-Identifier: Apache-2.0
// Vertex programs that move meshes, run by a compute shader (shaders/lib/vertex_movement.glsl).
//
//     scene.set(std::make_shared<DeviceVertexMovement>());
//
// Positions are the same bytes each time on a device; another device rounds sines and quotients otherwise.
// Nothing is made, no device, pipeline or buffer, before a mesh may have to move. Each program has a pipeline
// of its own. Endless loops end as in pixels (shaders/MATERIALS.md), in the first thousand vertices where
// they are in all.
#pragma once

#include <memory>
#include <vector>

#include "gpu/context_on_demand.h"
#include "scene/vertex_movement.h"

namespace luxo {

class DeviceVertexMovement : public VertexMovement {
 public:
  /// On a device of its own, opened once a mesh may have to move; then Error(Device) where there is none.
  explicit DeviceVertexMovement(gpu::ContextDesc desc = {});
  /// On a device of the caller's, which must outlive it.
  explicit DeviceVertexMovement(gpu::Context& context);
  ~DeviceVertexMovement() override;

 private:
  class Mover;

  /// Error(Scene) as VertexMovement::moved(), Error(Retry) when the device runs out of memory or is lost.
  std::vector<Vec4f> run(const VerticesAtRest& vertices, const Material& material) override;

  gpu::ContextOnDemand context_;
  std::unique_ptr<Mover> mover_;
};

}  // namespace luxo
