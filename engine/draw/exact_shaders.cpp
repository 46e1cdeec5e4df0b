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

std::span<const std::uint32_t> builtIn(const Formulas& wanted) {
  const auto found = std::ranges::lower_bound(kExactShaders, wanted, {}, formulasOf);
  const bool known = found != std::end(kExactShaders) && formulasOf(*found) == wanted;
  return known ? found->spirv : std::span<const std::uint32_t>();
}

}  // namespace

std::span<const std::uint32_t> builtInExactShader(const SurfaceCode& surface, std::string_view pattern,
                                                  bool grazing, bool parameters) {
  return builtIn({surface.glsl, pattern, surface.number == GlslNumber::Double, grazing, -1, parameters});
}

std::span<const std::uint32_t> builtInCasterShader(ExactSource::Caster caster, const SurfaceCode& surface,
                                                   std::string_view pattern) {
  return builtIn({surface.glsl, pattern, false, true, static_cast<int>(caster), false});
}

std::span<const std::uint32_t> builtInPatternShader(std::string_view name, std::string_view pattern) {
  const auto found = std::ranges::find_if(kPatternShaders, [&](const PatternShader& shader) {
    return shader.name == name && shader.pattern == pattern;
  });
  return found == kPatternShaders.end() ? std::span<const std::uint32_t>() : found->spirv;
}

}  // namespace luxo
