// SPDX-License-Identifier: Apache-2.0
// A triangle mesh on plain Vulkan: one pipeline, one draw of all its triangles, in the order in which luxo
// has them. What surrounds that (device, memory, frames) is the engine's own.
#pragma once

#include "gpu/buffer.h"
#include "gpu/context.h"
#include "gpu/frame.h"
#include "gpu/pipeline.h"
#include "image/image.h"
#include "mesh/triangle_mesh.h"
#include "plain_targets.h"
#include "scene/view.h"

namespace luxo::bench {

/// Where the light of the knot's pictures is, unit.
inline const Vec3 kKnotLight = unit(Vec3(1, 2, 3));

class PlainKnot {
 public:
  PlainKnot(gpu::Context& context, PixelSize size, const TriangleMesh& mesh);

  /// Records the mesh as the view has it. Scene-linear RGBA in target() once the recording is complete.
  void record(VkCommandBuffer commands, const View& view);
  [[nodiscard]] gpu::Texture& target() { return targets_.color(); }

 private:
  std::uint32_t indexCount_;
  gpu::Buffer vertices_, indices_;
  gpu::GraphicsPipeline pipeline_;
  PlainTargets targets_;
};

}  // namespace luxo::bench
