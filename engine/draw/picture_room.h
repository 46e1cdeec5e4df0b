// SPDX-License-Identifier: Apache-2.0
// Whether a picture fits on a device, known before anything is drawn.
#pragma once

#include <cstdint>
#include <optional>

#include "scene/camera.h"

namespace luxo::gpu {
class Context;
}

namespace luxo {

/// Bytes.
struct PictureRoom {
  std::uint64_t largest = 0;  ///< in one allocation
  std::uint64_t device = 0;   ///< for targets
  std::uint64_t all = 0;      ///< and for what is read back, and the image that it becomes

  friend bool operator==(const PictureRoom&, const PictureRoom&) = default;
};

/// What a picture needs. `native`: samples that are drawn in one pass (Renderer).
[[nodiscard]] PictureRoom roomOf(PixelSize size, int samples, bool native);

/// The largest size of the same shape that fits into `room`; nothing where all of `size` does. At least 1x1.
[[nodiscard]] std::optional<PixelSize> sizeThatFits(PixelSize size, int samples, bool native,
                                                    const PictureRoom& room);

/// On this device. One that draws on the processor has all of the machine's memory, whatever its driver says
/// (lavapipe: 2 GiB), and everything lies there.
[[nodiscard]] std::optional<PixelSize> sizeThatFits(gpu::Context& context, PixelSize size, int samples);

}  // namespace luxo
