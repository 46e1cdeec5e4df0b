// SPDX-License-Identifier: Apache-2.0
#include "draw/texel_store.h"

#include <fmt/format.h>

#include <cstddef>
#include <span>

#include "base/error.h"

namespace luxo {

VkBufferView TexelStore::get(const TextureList& textures) {
  if (textures == textures_ && view_) return view_;
  std::size_t texels = 0;
  for (const auto& texture : textures) texels += texelsOf(*texture);
  if (const std::size_t most = context_->limits().maxTexelBufferElements; texels > most)
    throw Error(ErrorKind::Scene,
                fmt::format("the textures have {} texels, and this device reads {}", texels, most),
                "use smaller images");
  constexpr std::size_t kTexelBytes = 8;
  view_.reset();
  buffer_ = gpu::Buffer(
      *context_,
      {.size = texels * kTexelBytes, .usage = VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT, .name = "texels"});
  VkDeviceSize offset = 0;
  for (const auto& texture : textures)
    for (const TextureLevel& level : texture->levels) {
      const auto bytes = std::as_bytes(std::span(level.halves));
      buffer_.write(offset, bytes);
      offset += bytes.size();
    }
  view_ = gpu::createTexelView(*context_, buffer_, VK_FORMAT_R16G16B16A16_SFLOAT);
  textures_ = textures;
  return view_;
}

}  // namespace luxo
