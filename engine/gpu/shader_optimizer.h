// SPDX-License-Identifier: Apache-2.0
// SPIR-V made easy for drivers. What a compiler of GLSL writes is mostly copies from variable to variable and
// calls, which a driver takes its time to remove, for every pipeline again: made without them, pipelines take
// an eighth to a third of it.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace luxo::gpu {

/// The same shader in a single function, without names. Arithmetic is not touched: no constants are folded
/// into each other, nothing is reassociated, and what is `precise` stays so. A function that is long and
/// called from several places should be `shared`, by its name in GLSL: it is optimised before it is copied to
/// where it is called from, best with `const` parameters. Cost: linear in the length of the result, 2 us a
/// word. Safe from any thread. Throws Error(Internal) for words that are no shader.
[[nodiscard]] std::vector<std::uint32_t> optimized(std::vector<std::uint32_t> words,
                                                   std::string_view shared = {});

/// A specialization constant and its value.
struct SpecializationConstant {
  std::uint32_t id = 0, bits = 0;
};

struct ShaderStages {
  std::vector<std::uint32_t> vertex, fragment;
};

/// Both stages of a pipeline, which are optimized() already, with the values of their constants and without
/// what these leave unused: what no fragment reads, the vertices do not write. Drivers that do not link
/// stages carry all that is declared, for every vertex. Safe from any thread. Throws as above.
[[nodiscard]] ShaderStages stripped(std::span<const std::uint32_t> vertex,
                                    std::span<const std::uint32_t> fragment,
                                    std::span<const SpecializationConstant> constants);

/// Changes when optimized() gives other words.
[[nodiscard]] std::string optimizerVersion();

}  // namespace luxo::gpu
