// SPDX-License-Identifier: Apache-2.0
#include "draw/exact_shaders.h"

#include <algorithm>
#include <iterator>
#include <string_view>
#include <tuple>

#include "luxo/shaders/exact_shaders.h"

namespace luxo {

namespace {

using Formulas = std::tuple<std::string_view, std::string_view, bool, bool, int, bool>;

Formulas formulasOf(const ExactShader& shader) {
  return {shader.surface, shader.pattern, shader.inDouble, shader.grazing, shader.caster, shader.parameters};
}

std::string_view textOf(const Pattern& pattern) {
  return pattern.valid() ? std::string_view(pattern.glsl()) : std::string_view();
}

std::span<const std::uint32_t> builtIn(const Formulas& wanted) {
  const auto found = std::ranges::lower_bound(kExactShaders, wanted, {}, formulasOf);
  const bool known = found != std::end(kExactShaders) && formulasOf(*found) == wanted;
  return known ? found->spirv : std::span<const std::uint32_t>();
}

}  // namespace

std::span<const std::uint32_t> builtInExactShader(const SurfaceCode& surface, const Pattern& pattern,
                                                  bool grazing, bool parameters) {
  return builtIn(
      {surface.glsl, textOf(pattern), surface.number == GlslNumber::Double, grazing, -1, parameters});
}

std::span<const std::uint32_t> builtInCasterShader(ExactSource::Caster caster, const SurfaceCode& surface,
                                                   const Pattern& pattern) {
  return builtIn({surface.glsl, textOf(pattern), false, true, static_cast<int>(caster), false});
}

std::span<const std::uint32_t> builtInPatternShader(std::string_view name, const Pattern& pattern) {
  const auto found = std::ranges::find_if(kPatternShaders, [&](const PatternShader& shader) {
    return shader.name == name && shader.pattern == textOf(pattern);
  });
  return found == kPatternShaders.end() ? std::span<const std::uint32_t>() : found->spirv;
}

}  // namespace luxo
