// SPDX-License-Identifier: Apache-2.0
#include "scene/light.h"

#include <fmt/format.h>

#include <cmath>

#include "base/error.h"

namespace luxo {

Vec3 radianceAt(const Light& light, const Moment& moment, std::string_view nodeName) {
  const Vec3 color = light.color.at(moment);
  const double intensity = light.intensity.at(moment);
  for (int i = 0; i < 3; ++i)
    if (!(color[i] >= 0 && std::isfinite(color[i])))
      throw Error(ErrorKind::Scene,
                  fmt::format("light of node '{}': color is ({}, {}, {}); it must be finite and not negative",
                              nodeName, color.x, color.y, color.z));
  if (!(intensity >= 0 && std::isfinite(intensity)))
    throw Error(ErrorKind::Scene,
                fmt::format("light of node '{}': intensity is {}; it must be finite and not negative",
                            nodeName, intensity));
  return color * intensity;
}

}  // namespace luxo
