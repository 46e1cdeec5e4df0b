// SPDX-License-Identifier: Apache-2.0
#include "draw/exact_shaders.h"

#include <algorithm>
#include <iterator>
#include <string_view>
#include <tuple>

#include "luxo/shaders/exact_shaders.h"

namespace luxo {

std::span<const std::uint32_t> builtInExactShader(const SurfaceCode& surface, const Pattern& pattern,
                                                  bool grazing) {
  const auto formulasOf = [](const ExactShader& shader) {
    return std::tuple(shader.surface, shader.pattern, shader.inDouble, shader.grazing);
  };
  const std::tuple wanted(std::string_view(surface.glsl),
                          pattern.valid() ? std::string_view(pattern.glsl()) : std::string_view(),
                          surface.number == GlslNumber::Double, grazing);
  const auto found = std::ranges::lower_bound(kExactShaders, wanted, {}, formulasOf);
  const bool known = found != std::end(kExactShaders) && formulasOf(*found) == wanted;
  return known ? found->spirv : std::span<const std::uint32_t>();
}

}  // namespace luxo
