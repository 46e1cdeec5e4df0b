// SPDX-License-Identifier: Apache-2.0
#include "scene/material.h"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <string_view>

#include "base/error.h"

namespace luxo {

namespace {

[[noreturn]] void reject(const Material& material, std::string_view value, const std::string& found,
                         std::string_view wanted) {
  throw Error(ErrorKind::Scene,
              fmt::format("material '{}': {} is {}; it must be {}", material.name, value, found, wanted));
}

void requireColor(const Material& material, std::string_view value, const Vec3& color) {
  for (int i = 0; i < 3; ++i)
    if (!(color[i] >= 0 && std::isfinite(color[i])))
      reject(material, value, fmt::format("({}, {}, {})", color.x, color.y, color.z),
             "finite and not negative");
}

}  // namespace

void validate(const Material& material) {
  requireColor(material, "diffuse", material.diffuse);
  if (material.ambient) requireColor(material, "ambient", *material.ambient);
  requireColor(material, "specular", material.specular);
  if (!(material.shininess >= 0 && std::isfinite(material.shininess)))
    reject(material, "shininess", fmt::format("{}", material.shininess), "finite and not negative");
  if (!(material.opacity >= 0 && material.opacity <= 1))
    reject(material, "opacity", fmt::format("{}", material.opacity), "from 0 to 1");
  if (material.patternParameters.size() != material.diffusePattern.parameterCount())
    reject(material, "the number of pattern parameters", fmt::format("{}", material.patternParameters.size()),
           fmt::format("{}", material.diffusePattern.parameterCount()));
  for (const double parameter : material.patternParameters)
    if (!std::isfinite(parameter))
      reject(material, "a pattern parameter", fmt::format("{}", parameter), "finite");
}

}  // namespace luxo
