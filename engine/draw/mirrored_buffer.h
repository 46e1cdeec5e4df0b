// SPDX-License-Identifier: Apache-2.0
// A buffer that follows what the host has: written only when its bytes differ from the last.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "gpu/buffer.h"
#include "gpu/context.h"
#include "gpu/frame.h"

namespace luxo {

/// A ring of buffers, so that one can be written while the device reads another. What was recorded with it
/// has to be the next submission. The second one is made when it is first needed.
class MirroredBuffer {
 public:
  /// The next submission reads these bytes; requires some. Waits only for a slot that is still in use.
  void write(gpu::Context& context, std::span<const std::byte> bytes, VkBufferUsageFlags usage,
             const char* name, bool always);

  /// What was written last, for the next submission.
  [[nodiscard]] const gpu::Buffer& use(gpu::Context& context);

 private:
  struct Slot {
    gpu::Buffer buffer;
    std::uint64_t lastUse = 0;  ///< number of a submission
  };

  std::array<Slot, gpu::FrameRing::kFrames> slots_;
  std::size_t current_ = 0;
  std::vector<std::byte> bytes_;
};

}  // namespace luxo
