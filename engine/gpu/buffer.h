// SPDX-License-Identifier: Apache-2.0
// Buffers: memory with a use.
#pragma once

#include "gpu/handle.h"
#include "gpu/memory.h"
#include "gpu/usage.h"
#include "gpu/vk.h"

#include <cstddef>
#include <span>
#include <string_view>

namespace luxo::gpu {

struct BufferDesc {
  VkDeviceSize size = 0;         ///< bytes
  VkBufferUsageFlags usage = 0;  ///< what write() and reading back need is added
  /// Upload for what changes every frame (one buffer per FrameRing slot), Device for what is drawn many
  /// times.
  MemoryUse memory = MemoryUse::Device;
  std::string_view name;
};

class Buffer {
 public:
  Buffer() = default;
  /// Requires size > 0. Throws Error(Retry) when memory runs out.
  Buffer(Context& context, const BufferDesc& desc);

  operator VkBuffer() const noexcept { return buffer_; }
  explicit operator bool() const noexcept { return static_cast<bool>(buffer_); }
  [[nodiscard]] const VkBuffer* pointer() const noexcept { return buffer_.pointer(); }
  [[nodiscard]] VkDeviceSize size() const noexcept { return size_; }

  /// Every submission from now on sees `bytes` at `offset`, with no barrier needed. The host writes them at
  /// once where it can map the buffer and else stages a copy that goes ahead of the next submission; so no
  /// submission in flight and no open recording may be using those bytes. Requires that they fit. Counted as
  /// uploaded.
  void write(VkDeviceSize offset, std::span<const std::byte> bytes);

  /// Empty when the host cannot see it; never empty for Upload and Readback. After writing here, call
  /// flush().
  [[nodiscard]] std::span<std::byte> mapped() const noexcept;
  void flush();

  /// What the device wrote. Requires mapped memory, and that the submission, in which Use::HostRead came
  /// last, is complete.
  [[nodiscard]] std::span<const std::byte> read();

  [[nodiscard]] ResourceState& state() noexcept { return state_; }

 private:
  Handle<VkBuffer> buffer_;
  VkDeviceSize size_ = 0;
  ResourceState state_{ResourceKind::Buffer};
};

/// All of a buffer, whose usage has to allow it, as texels.
[[nodiscard]] Handle<VkBufferView> createTexelView(Context& context, const Buffer& buffer, VkFormat format);

}  // namespace luxo::gpu
