// SPDX-License-Identifier: Apache-2.0
#include "draw/exact_surfaces.h"

#include <algorithm>
#include <iterator>
#include <string_view>

#include "luxo/shaders/exact_surfaces.h"

namespace luxo {

std::span<const std::uint32_t> builtInExactShader(const SurfaceCode& surface) {
  const auto found = std::ranges::lower_bound(kExactSurfaces, std::string_view(surface.glsl), {},
                                              &ExactSurfaceShader::formula);
  const bool known = found != std::end(kExactSurfaces) && found->formula == surface.glsl;
  return known ? found->spirv : std::span<const std::uint32_t>();
}

}  // namespace luxo
