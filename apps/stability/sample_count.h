// SPDX-License-Identifier: Apache-2.0
// How often the triangles of a mesh cover each sample of a picture: what additive blending would show, in
// integers, and faces apart.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gpu/buffer.h"
#include "gpu/context.h"
#include "gpu/descriptor.h"
#include "gpu/pipeline.h"
#include "math/vec.h"

namespace luxo {

/// Triangles seen from their front (counter-clockwise) and from their back that cover a pixel's centre.
struct SampleCount {
  std::uint32_t front = 0, back = 0;
};

class SampleCounter {
 public:
  /// Pictures of side x side pixels. Error(Device) where shaders cannot count.
  SampleCounter(gpu::Context& context, int side);

  /// What follows counts these triangles; positions are rounded to float.
  void setMesh(std::span<const Vec3> positions, std::span<const std::uint32_t> indices);

  /// Row by row, from the top, one picture after the other.
  [[nodiscard]] std::vector<SampleCount> count(std::span<const Mat4> clipFromObject);

 private:
  gpu::Context* context_;
  int side_;
  gpu::DescriptorLayout layout_;
  gpu::GraphicsPipeline pipeline_;
  gpu::Buffer positions_, indices_;
  std::uint32_t indexCount_ = 0;
};

}  // namespace luxo
