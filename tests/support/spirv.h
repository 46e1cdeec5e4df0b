// SPDX-License-Identifier: Apache-2.0
// What a shader consists of.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
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

/// What a fragment shader may write to: storage buffers that it uses and that are not declared `readonly`,
/// and colours, by their locations.
inline std::size_t outputsOf(std::span<const std::uint32_t> spirv) {
  enum : std::uint32_t {
    TypePointer = 32,
    Variable = 59,
    Load = 61,
    Store = 62,
    AccessChain = 65,
    InBoundsAccessChain = 66,
    ArrayLength = 68,
    Decorate = 71,
    MemberDecorate = 72
  };
  constexpr std::uint32_t kNonWritable = 24, kLocation = 30, kOutput = 3, kStorageBuffer = 12;
  std::set<std::uint32_t> readOnly, used, buffers, colors;
  std::map<std::uint32_t, std::uint32_t> pointees, locations;
  forEachInstruction(spirv, [&](const Instruction& i) {
    const auto& w = i.words;
    switch (i.operation) {
      case MemberDecorate:
        if (w[3] == kNonWritable) readOnly.insert(w[1]);
        break;
      case Decorate:
        if (w[2] == kLocation) locations[w[1]] = w[3];
        break;
      case TypePointer:
        pointees[w[1]] = w[3];
        break;
      case Variable:
        if (w[3] == kStorageBuffer && !readOnly.contains(pointees.at(w[1]))) buffers.insert(w[2]);
        if (w[3] == kOutput && locations.contains(w[2])) colors.insert(locations.at(w[2]));
        break;
      case Store:
        used.insert(w[1]);
        break;
      case Load:
      case AccessChain:
      case InBoundsAccessChain:
      case ArrayLength:
        used.insert(w[3]);
        break;
      default:
        break;
    }
  });
  std::erase_if(buffers, [&](std::uint32_t id) { return !used.contains(id); });
  return buffers.size() + colors.size();
}

}  // namespace luxo::test
