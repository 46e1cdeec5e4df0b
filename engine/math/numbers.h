// SPDX-License-Identifier: Apache-2.0
// Numbers that have names.
#pragma once

#include <limits>
#include <numbers>

namespace luxo {

inline constexpr double kPi = std::numbers::pi;
inline constexpr double kTau = 2 * std::numbers::pi;
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace luxo
