// SPDX-License-Identifier: Apache-2.0
#include "scene/light.h"

#include <fmt/format.h>

#include <cmath>

#include "base/error.h"

namespace luxo {

void validate(const Light& light, std::string_view nodeName) {
  for (int i = 0; i < 3; ++i)
    if (!(light.color[i] >= 0 && std::isfinite(light.color[i])))
      throw Error(ErrorKind::Scene,
                  fmt::format("light of node '{}': color is ({}, {}, {}); it must be finite and not negative",
                              nodeName, light.color.x, light.color.y, light.color.z));
  if (!(light.intensity >= 0 && std::isfinite(light.intensity)))
    throw Error(ErrorKind::Scene,
                fmt::format("light of node '{}': intensity is {}; it must be finite and not negative",
                            nodeName, light.intensity));
}

}  // namespace luxo
