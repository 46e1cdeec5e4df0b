// SPDX-License-Identifier: Apache-2.0
// Data to and from the device.
#pragma once

#include "gpu/buffer.h"
#include "gpu/command_pool.h"
#include "gpu/texture.h"
#include "gpu/vk.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace luxo::gpu {

/// Reads a texture back. May be used again and again, once per submission:
///     readback.record(commands, color);
///     frames.wait(frames.submit());
///     readback.row(y) ...
class Readback {
 public:
  Readback() = default;
  /// Rows start every `rowPitch` bytes: 0 for no gap between them, else a multiple of the texel's size that
  /// holds a row (required).
  Readback(Context& context, VkExtent2D extent, VkFormat format, std::uint32_t rowPitch = 0);

  /// Copies the whole texture, barriers included. Requires the extent and format above, one sample, and
  /// VK_IMAGE_USAGE_TRANSFER_SRC_BIT.
  void record(VkCommandBuffer commands, Texture& texture);

  /// Of a texture: `count` rows from `first` on.
  struct Rows {
    std::uint32_t first = 0, count = 0;
  };
  /// The same of these rows alone, one or more: the others stay as they were read before.
  void record(VkCommandBuffer commands, Texture& texture, std::span<const Rows> rows);

  [[nodiscard]] std::uint32_t rowPitch() const noexcept { return rowPitch_; }
  /// Top row first. Require that the submission is complete.
  [[nodiscard]] std::span<const std::byte> bytes() { return buffer_.read(); }
  [[nodiscard]] std::span<const std::byte> row(std::uint32_t y);

 private:
  VkExtent2D extent_{};
  VkFormat format_ = VK_FORMAT_UNDEFINED;
  std::uint32_t rowPitch_ = 0;
  Buffer buffer_;
};

/// Buffer writes on their way to memory the host cannot see: copied to staging memory at once, to their place
/// by a command buffer that goes ahead of the next submission. Owned by the context; Buffer::write uses it.
class Uploads {
 public:
  static constexpr VkDeviceSize kChunkSize = VkDeviceSize{1} << 20;

  explicit Uploads(Context& context) : context_(&context) {}

  void add(VkBuffer destination, VkDeviceSize offset, std::span<const std::byte> bytes);

  /// The commands to submit ahead of the next ones, or null when nothing is staged. The caller must submit
  /// them next and then call submitted().
  [[nodiscard]] VkCommandBuffer finish();
  void submitted();

 private:
  struct Chunk {
    Buffer buffer;
    VkDeviceSize used = 0;
  };
  struct Batch {  // what one submission carries
    CommandPool pool;
    std::vector<Chunk> chunks;
    std::vector<VkBuffer> written;  // since the last barrier
  };

  [[nodiscard]] bool staged() const noexcept { return static_cast<bool>(batch_.pool.pool); }
  void begin();
  void orderAfterEarlierWrites(VkBuffer destination);
  [[nodiscard]] Chunk& room(VkDeviceSize size);

  Context* context_;
  Batch batch_;
};

}  // namespace luxo::gpu
