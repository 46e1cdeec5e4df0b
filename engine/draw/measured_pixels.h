// SPDX-License-Identifier: Apache-2.0
// What the pixels of a picture tell beside their colours: the largest residual, and values that are no
// numbers.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "scene/snapshot.h"
#include "shared/scene_data.h"

namespace luxo {

/// What the values of pixels tell, by the bits of floats, so that a compiler may take many at once: the order
/// of positive floats is that of their bits. From the largest one on they are no numbers: devices whose
/// blending knows no infinity (an H100's) make it of one.
struct MeasuredPixels {
  static constexpr std::uint32_t kMagnitude = 0x7fffffffU, kInfinity = 0x7f800000U, kLargest = kInfinity - 1;
  std::uint32_t residual = 0;  ///< the largest of the alphas, as bits
  std::uint32_t nonfinite = 0;
  shared::ShaderFaults faults{};  ///< what shaders mean by infinities

  void add(const MeasuredPixels& other) {
    residual = std::max(residual, other.residual);
    nonfinite += other.nonfinite;
    faults.endless += other.faults.endless;
    faults.seenThrough += other.faults.seenThrough;
    faults.moved += other.faults.moved;
    faults.manyTraces += other.faults.manyTraces;
  }
  void add(float alpha) { residual = std::max(residual, std::bit_cast<std::uint32_t>(alpha) & kMagnitude); }
};

/// In a row of RGBA floats.
[[nodiscard]] float alphaAt(const std::byte* texels, int x);

/// Of a row of RGBA floats the alphas, those of a mean of pictures (draw/accumulation.h), the colours.
void addAlphas(const std::byte* texels, int width, MeasuredPixels& measured);
void addMeanAlphas(const std::byte* texels, int width, MeasuredPixels& measured);
void addColors(const std::byte* texels, int width, MeasuredPixels& measured);

/// Of RGB: nobody overlooks what is no number.
void showInMagenta(std::span<float> row);

/// Error(Scene): shaders of materials have done so (shaders/lib/lit_shader.glsl).
void refuseShaders(const Snapshot& snapshot, const shared::ShaderFaults& faults);

}  // namespace luxo
