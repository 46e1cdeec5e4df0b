// SPDX-License-Identifier: Apache-2.0
// How much work a program is for a driver, which compiles whatever it is given: found before anyone tries.
#pragma once

#include <cstdint>
#include <span>

namespace luxo::gpu {

/// All stop counting at 1e15.
struct ShaderCost {
  std::uint64_t instructions = 0;   ///< of the entry point, with a copy of each function at each of its calls
  std::uint64_t variableBytes = 0;  ///< that an invocation holds, the variables of those copies among them
  std::uint64_t longestTable = 0;   ///< elements of the longest array that is a constant
  /// Branches and loops in each other, through calls. What follows a branch that may leave its function or
  /// loop is in one more: drivers give it a condition of its own.
  std::uint64_t nesting = 0;
};

/// Of SPIR-V without recursion, as GLSL is. Words that are none count as nothing. Cost: linear.
[[nodiscard]] ShaderCost costOf(std::span<const std::uint32_t> spirv);

}  // namespace luxo::gpu
