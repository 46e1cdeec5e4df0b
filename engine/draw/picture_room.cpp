// SPDX-License-Identifier: Apache-2.0
#include "draw/picture_room.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "gpu/address_space.h"
#include "gpu/context.h"

namespace luxo {
namespace {

// Bytes of a sample of the targets, of a texel that is read back, and of a pixel of an image.
constexpr std::uint64_t kColor = 16, kDepth = 4, kTexel = 16, kPixel = 12;
/// Drivers pad sides to whole tiles: llvmpipe's are 64.
constexpr std::uint64_t kTile = 64;

std::uint64_t padded(int side) { return (static_cast<std::uint64_t>(side) + kTile - 1) / kTile * kTile; }

bool fits(const PictureRoom& needed, const PictureRoom& room) {
  return needed.largest <= room.largest && needed.device <= room.device && needed.all <= room.all;
}

}  // namespace

PictureRoom roomOf(PixelSize size, int samples, bool native) {
  const std::uint64_t pixels = padded(size.width) * padded(size.height);
  const auto inOnePass = static_cast<std::uint64_t>(native ? samples : 1);
  // A target that is averaged into, where there are more samples than one.
  const std::uint64_t mean = samples > 1 ? kTexel : 0;
  const std::uint64_t device = pixels * ((kColor + kDepth) * inOnePass + mean);
  return {.largest = pixels * std::max(kColor * inOnePass, kTexel),
          .device = device,
          .all = device + pixels * (kTexel + kPixel)};
}

std::optional<PixelSize> sizeThatFits(PixelSize size, int samples, bool native, const PictureRoom& room) {
  if (fits(roomOf(size, samples, native), room)) return std::nullopt;
  // By halves: what is needed grows with the scale.
  double small = 0, large = 1;
  const auto scaled = [&](double scale) {
    return PixelSize{std::max(1, static_cast<int>(size.width * scale)),
                     std::max(1, static_cast<int>(size.height * scale))};
  };
  constexpr int kHalves = 20;  // finer than a pixel of the largest picture
  for (int i = 0; i < kHalves; ++i) {
    const double middle = 0.5 * (small + large);
    (fits(roomOf(scaled(middle), samples, native), room) ? small : large) = middle;
  }
  return scaled(small);
}

std::optional<PixelSize> sizeThatFits(gpu::Context& context, PixelSize size, int samples) {
  const auto side =
      static_cast<int>(std::min<std::uint32_t>(context.limits().maxImageDimension2D, 1U << 30U));
  const bool native =
      (samples == 1 || samples == 4) &&
      static_cast<int>(context.supportedSamples(static_cast<std::uint32_t>(samples))) == samples;
  const bool ofProcess = context.deviceInfo().type == gpu::DeviceType::Cpu;
  const std::uint64_t machine =
      static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
  const std::uint64_t left = gpu::addressSpaceLeft();
  const PictureRoom room{
      .largest = context.memory().largestAllocation(),
      .device = ofProcess ? machine : context.memory().largestHeap(),
      .all = std::min(machine, left > gpu::kCompilerBytes ? left - gpu::kCompilerBytes : 0)};
  const PixelSize shown{std::min(size.width, side), std::min(size.height, side)};
  if (const auto smaller = sizeThatFits(shown, samples, native, room)) return smaller;
  return shown == size ? std::nullopt : std::optional(shown);
}

}  // namespace luxo
