// SPDX-License-Identifier: Apache-2.0
#include "draw/exact_shaders.h"

#include <algorithm>
#include <string_view>
#include <tuple>

#include "exact/table.h"

namespace luxo {

namespace {

using Formulas = std::tuple<std::string_view, std::string_view, bool, bool, int, bool>;

Formulas formulasOf(const ExactShader& shader) {
  return {shader.surface, shader.pattern, shader.inDouble, shader.grazing, shader.caster, shader.parameters};
}

std::u32string_view builtIn(const Formulas& wanted) {
  const std::span<const ExactShader> all = exactShaders();
  const auto found = std::ranges::lower_bound(all, wanted, {}, formulasOf);
  const bool known = found != all.end() && formulasOf(*found) == wanted;
  return known ? found->spirv : std::u32string_view();
}

}  // namespace

std::u32string_view builtInExactShader(const SurfaceCode& surface, std::string_view pattern, bool grazing,
                                       bool parameters) {
  return builtIn({surface.glsl, pattern, surface.number == GlslNumber::Double, grazing, -1, parameters});
}

std::u32string_view builtInCasterShader(ExactSource::Caster caster, const SurfaceCode& surface,
                                        std::string_view pattern) {
  return builtIn({surface.glsl, pattern, false, true, static_cast<int>(caster), false});
}

std::u32string_view builtInPatternShader(std::string_view name, std::string_view pattern) {
  const std::span<const PatternShader> all = patternShaders();
  const auto found = std::ranges::find_if(
      all, [&](const PatternShader& shader) { return shader.name == name && shader.pattern == pattern; });
  return found == all.end() ? std::u32string_view() : found->spirv;
}

}  // namespace luxo
