// SPDX-License-Identifier: Apache-2.0
#include "scene/light.h"

#include <fmt/format.h>

#include "base/error.h"
#include "math/interval.h"
#include "scene/ranges.h"

namespace luxo {

Vec3 radianceAt(const Light& light, const Moment& moment, const std::function<std::string()>& nodeName,
                std::uint32_t* cutNumbers) {
  Vec3 color = light.color.at(moment);
  double intensity = light.intensity.at(moment);
  std::uint32_t cut = 0;
  if (cutNumbers && !light.color.isConstant()) cut += cutToRange(color);
  if (cutNumbers && !light.intensity.isConstant()) cut += cutToRange(intensity, kMaxLight);
  if (!isColor(color))
    throw Error(ErrorKind::Scene,
                fmt::format("light of node {}: color is ({}, {}, {}); it must be from 0 to {}", nodeName(),
                            color.x, color.y, color.z, kMaxSceneNumber));
  if (!isColor(Vec3(intensity), kMaxLight))
    throw Error(ErrorKind::Scene, fmt::format("light of node {}: intensity is {}; it must be from 0 to {}",
                                              nodeName(), intensity, kMaxLight));
  Vec3 radiance = color * intensity;
  if (cutNumbers && !(light.color.isConstant() && light.intensity.isConstant()))
    cut += cutToRange(radiance, kMaxLight);
  if (!isColor(radiance, kMaxLight))
    throw Error(ErrorKind::Scene,
                fmt::format("light of node {}: color * intensity is ({}, {}, {}); it must be at most {}",
                            nodeName(), radiance.x, radiance.y, radiance.z, kMaxLight));
  if (cutNumbers) *cutNumbers += cut;
  return radiance;
}

ShadowMapThen shadowMapAt(const Light& light, const Moment& moment,
                          const std::function<std::string()>& nodeName) {
  const auto value = [&](const char* name, const Animated<double>& animated) {
    const double number = animated.at(moment);
    if (!Interval{0, kMaxSceneNumber}.contains(number))
      throw Error(ErrorKind::Scene,
                  fmt::format("light of node {}: its map's {} is {}; it must be from 0 to 1e18", nodeName(),
                              name, number));
    return number;
  };
  const ShadowMap& map = light.map;
  return {.size = map.size,
          .bias = value("bias", map.bias),
          .slopeBias = value("slope_bias", map.slopeBias),
          .normalOffset = value("normal_offset", map.normalOffset),
          .pcf = map.pcf,
          .receiverPlane = map.receiverPlane,
          .radius = radiusAt(light, moment, nodeName)};
}

double radiusAt(const Light& light, const Moment& moment, const std::function<std::string()>& nodeName) {
  const double radius = light.radius.at(moment);
  const bool angle = light.type == Light::Type::Directional;
  const Interval range{0, angle ? kMaxLightAngle : kMaxSceneNumber};
  if (!range.contains(radius))
    throw Error(ErrorKind::Scene,
                fmt::format("light of node {}: radius is {}; {}", nodeName(), radius,
                            angle ? "of a directional light it is the half-angle of its disc in radians, "
                                    "from 0 to pi/2, half the sky"
                                  : "it must be from 0 to 1e18 metres"),
                "0 makes hard shadows");
  return radius;
}

SpotCone spotConeAt(const Light& light, const Vec3& axis, const Moment& moment,
                    const std::function<std::string()>& nodeName) {
  if (light.type != Light::Type::Point)
    throw Error(ErrorKind::Scene,
                fmt::format("light of node {}: a directional light has no cone", nodeName()),
                "make it a point light, or take its spot away");
  const SpotCone cone{
      .axis = axis, .inner = light.spot->inner.at(moment), .outer = light.spot->outer.at(moment)};
  if (!Interval{kLeastSpotAngle, kMaxLightAngle}.contains(cone.outer))
    throw Error(
        ErrorKind::Scene,
        fmt::format("light of node {}: the outer angle of its spot is {} radians; it must be from 1e-9 to "
                    "90 degrees",
                    nodeName(), cone.outer));
  if (!(cone.inner >= 0 && cone.inner < cone.outer))
    throw Error(
        ErrorKind::Scene,
        fmt::format("light of node {}: the inner angle of its spot is {} radians; it must be from 0 to "
                    "below the outer one, {}",
                    nodeName(), cone.inner, cone.outer));
  return cone;
}

}  // namespace luxo
