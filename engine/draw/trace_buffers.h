// SPDX-License-Identifier: Apache-2.0
// On the device: what the pixels of a view ask of the scene, and the answers (draw/secondary_rays.h).
#pragma once

#include <cstdint>
#include <vector>

#include "draw/mirrored_buffer.h"
#include "gpu/buffer.h"
#include "gpu/context.h"
#include "gpu/vk.h"
#include "shared/scene_data.h"

namespace luxo {

class TraceBuffers {
 public:
  explicit TraceBuffers(gpu::Context& context) : context_(&context) {}

  /// A picture of that size begins, to which nothing is answered yet. Waits for the device where there has
  /// to be more room.
  void prepare(VkExtent2D extent);
  /// Of SecondaryRays. Throws Error(Device) for more than the device binds at once.
  void answer(const std::vector<std::uint32_t>& starts, const std::vector<shared::TraceAnswer>& answers);
  /// What no pixel asks.
  void clear(VkCommandBuffer commands);

  [[nodiscard]] gpu::Buffer& questions() { return questions_; }
  [[nodiscard]] const gpu::Buffer& starts() { return starts_.use(*context_); }
  [[nodiscard]] const gpu::Buffer& answers() { return answers_.use(*context_); }

  /// Of a recording that is complete: of all pixels, row by row. Cost: a copy of 28 bytes a pixel.
  [[nodiscard]] std::vector<shared::TraceQuestion> asked();

 private:
  void requireRoom(VkDeviceSize bytes) const;

  gpu::Context* context_;
  gpu::Buffer questions_;
  MirroredBuffer starts_, answers_;
  std::size_t pixels_ = 0;
};

}  // namespace luxo
