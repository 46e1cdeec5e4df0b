// SPDX-License-Identifier: Apache-2.0
// How good this device's arithmetic is where Vulkan promises little: sin and cos may be wrong by 2^-11.
//
// Formulas on the device never use the driver's: theirs (shaders/lib/formula.glsl) are as fast, and the same
// on every device. What is measured here says so in reports, and would tell of a driver that breaks them.
#pragma once

#include <filesystem>
#include <span>

#include "gpu/cache_file.h"
#include "gpu/context.h"
#include "math/vec.h"

namespace luxo {

/// Largest absolute errors of sin and cos at 8192 angles from -pi to pi; infinite where one is not a number.
struct SinCosError {
  double ofFormulas = 0;  ///< what is drawn with
  double ofDriver = 0;

  friend bool operator==(const SinCosError&, const SinCosError&) = default;
};

/// What formulas are sure of on a device that keeps Vulkan's promises for + and *: 2^-20.
inline constexpr double kSinCosTolerance = 0x1p-20;

/// Measured by drawing 8192 pixels, once per device and driver: then it is known from a file in `directory`,
/// in some 50 microseconds. A file that is damaged, missing or of another driver is measured anew and
/// replaced; an empty directory means none.
[[nodiscard]] SinCosError sinCosError(gpu::Context& context,
                                      const std::filesystem::path& directory = gpu::cacheDirectory());

/// Of what sin_cos.frag wrote, row by row: sin and cos of the driver, then of formulas.
[[nodiscard]] SinCosError sinCosErrorOf(std::span<const Vec4f> values);

}  // namespace luxo
