// SPDX-License-Identifier: Apache-2.0
// Named constants of rounding-error theory (Higham, Accuracy and Stability of Numerical Algorithms, chapter
// 3).
#pragma once

namespace luxo {

inline constexpr double kRoundoff = 0x1p-53;  ///< unit roundoff of double

/// n rounded operations in a row change a result by at most this, relative to the magnitudes involved.
[[nodiscard]] constexpr double roundingGamma(int n) { return n * kRoundoff / (1 - n * kRoundoff); }

}  // namespace luxo
