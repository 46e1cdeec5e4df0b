// SPDX-License-Identifier: Apache-2.0
// The texels of a picture's textures on the device: uploaded when the textures are others than before.
#pragma once

#include "draw/texture_list.h"
#include "gpu/buffer.h"
#include "gpu/context.h"
#include "gpu/handle.h"

namespace luxo {

class TexelStore {
 public:
  explicit TexelStore(gpu::Context& context) : context_(&context) {}

  /// All texels of the textures, in their order; requires some. Four halves each, 8 bytes. Error(Scene): more
  /// than the device reads.
  [[nodiscard]] VkBufferView get(const TextureList& textures);

 private:
  gpu::Context* context_;
  TextureList textures_;
  gpu::Buffer buffer_;
  gpu::Handle<VkBufferView> view_;
};

}  // namespace luxo
