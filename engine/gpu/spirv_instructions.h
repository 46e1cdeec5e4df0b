// SPDX-License-Identifier: Apache-2.0
// SPIR-V, one instruction after the other (specification 2.3).
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>

namespace luxo::gpu {

/// Its operation, and its words, the first of which holds that and their number.
struct Instruction {
  std::uint32_t operation;
  std::span<const std::uint32_t> words;
};

/// As far as the words are whole instructions.
template <class Action>
void forEachInstruction(std::span<const std::uint32_t> spirv, const Action& action) {
  constexpr std::size_t kHeaderWords = 5;
  for (std::size_t at = kHeaderWords; at < spirv.size();) {
    const std::uint32_t length = spirv[at] >> 16;
    if (length == 0 || at + length > spirv.size()) break;
    action(Instruction{spirv[at] & 0xffff, spirv.subspan(at, length)});
    at += length;
  }
}

/// The text that begins with words[first], as long as these words are there.
inline std::string_view textAt(std::span<const std::uint32_t> words, std::size_t first) {
  if (first >= words.size()) return {};
  const auto* text = reinterpret_cast<const char*>(&words[first]);
  return {text, strnlen(text, 4 * (words.size() - first))};
}

}  // namespace luxo::gpu
