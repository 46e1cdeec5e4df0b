// SPDX-License-Identifier: Apache-2.0
// What a shader consists of.
#pragma once

#include <cstddef>
#include <cstdint>
#include <set>
#include <span>

#include "gpu/spirv_instructions.h"

namespace luxo::test {

using gpu::forEachInstruction;
using gpu::Instruction;

inline std::size_t countOf(std::span<const std::uint32_t> spirv, std::set<std::uint32_t> operations) {
  std::size_t count = 0;
  forEachInstruction(spirv, [&](const Instruction& i) { count += operations.contains(i.operation); });
  return count;
}

inline std::size_t instructionsIn(std::span<const std::uint32_t> spirv) {
  std::size_t count = 0;
  forEachInstruction(spirv, [&](const Instruction&) { ++count; });
  return count;
}

/// Calls of a function of GLSL.std.450, by its number.
inline std::size_t callsOf(std::span<const std::uint32_t> spirv, std::uint32_t function) {
  constexpr std::uint32_t kExtInst = 12;
  std::size_t count = 0;
  forEachInstruction(
      spirv, [&](const Instruction& i) { count += i.operation == kExtInst && i.words[4] == function; });
  return count;
}

}  // namespace luxo::test
