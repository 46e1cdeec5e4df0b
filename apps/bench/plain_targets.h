// SPDX-License-Identifier: Apache-2.0
// What a textbook draws into: a colour and a depth, both cleared.
#pragma once

#include <string_view>

#include "gpu/context.h"
#include "gpu/texture.h"

namespace luxo::bench {

class PlainTargets {
 public:
  PlainTargets() = default;
  PlainTargets(gpu::Context& context, VkExtent2D extent, VkFormat color, std::string_view name);

  /// Begins to draw, with the whole as viewport; `farthest` is in the depth buffer where nothing is.
  void begin(VkCommandBuffer commands, float farthest);
  [[nodiscard]] gpu::Texture& color() { return color_; }

  static constexpr VkFormat kDepth = VK_FORMAT_D32_SFLOAT;

 private:
  gpu::Texture color_, depth_;
};

}  // namespace luxo::bench
