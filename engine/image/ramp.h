// SPDX-License-Identifier: Apache-2.0
// Numbers as colours, for pictures of errors.
#pragma once

#include <array>

namespace luxo {

/// Scene-linear RGB of t, clamped to 0..1: from dark violet through green to yellow, even in perceived
/// lightness.
[[nodiscard]] std::array<float, 3> rampColor(double t);

}  // namespace luxo
