// SPDX-License-Identifier: Apache-2.0
// The exact shaders that were compiled when luxo was built (emit.cpp), by what they are made of.
//
// Their SPIR-V is in texts, each of whose characters is a word: a compiler reads a text as one token, and so
// a table of them in a fifth of the time that it takes for as many numbers.
#pragma once

#include <span>
#include <string_view>

namespace luxo {

/// The fragment shader of a surface and its pattern, in GLSL.
struct ExactShader {
  std::string_view surface, pattern;
  bool inDouble, grazing;
  int caster;       ///< which ExactSource::Caster it finds, -1: none
  bool parameters;  ///< are told, too
  std::u32string_view spirv;
};

/// A shader (shaders/pattern) of the light on a pattern.
struct PatternShader {
  std::string_view name, pattern;
  std::u32string_view spirv;
};

/// In the order of their members.
[[nodiscard]] std::span<const ExactShader> exactShaders();
[[nodiscard]] std::span<const PatternShader> patternShaders();

}  // namespace luxo
