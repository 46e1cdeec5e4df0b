// SPDX-License-Identifier: Apache-2.0
#include "scene/shade.h"

#include <cmath>

namespace luxo {

namespace {

/// Relative: rotations composed down a deep hierarchy stay orthogonal to far less.
constexpr double kSimilarityTolerance = 1e-9;

/// Metres of the world per metre of the source, where columns are equally long and perpendicular.
std::optional<double> similarityScale(const Mat3& linear) {
  const Mat3 products = glm::transpose(linear) * linear;
  const double squared = products[0][0];
  if (!(squared > 0)) return std::nullopt;
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row)
      if (!(std::abs(products[column][row] - (row == column ? squared : 0)) <=
            kSimilarityTolerance * squared))
        return std::nullopt;
  return std::sqrt(squared);
}

}  // namespace

std::optional<ShadeRule> shadeRule(const Paraboloid& paraboloid, const Transform& worldFromShade,
                                   NodeId caster) {
  const std::optional<double> scale = similarityScale(worldFromShade.linear);
  if (!scale) return std::nullopt;
  const double f = paraboloid.focalLength, h = paraboloid.height;
  return ShadeRule{.caster = caster,
                   .vertex = worldFromShade.translation,
                   .focus = transformPoint(worldFromShade, Vec3(0, f, 0)),
                   .axis = unit(transformDirection(worldFromShade, Vec3(0, 1, 0))),
                   .cosRim = (h - f) / (h + f),
                   .focalLength = *scale * f,
                   .height = *scale * h,
                   .scale = *scale};
}

bool lit(const ShadeRule& rule, const Vec3& pointWorld) {
  const Vec3 fromFocus = pointWorld - rule.focus;
  const double along = glm::dot(fromFocus, rule.axis), distance = glm::length(fromFocus);
  // Inside a paraboloid, every point is nearer to the focus than to the directrix plane, 2 f behind the
  // focus.
  return distance <= along + 2 * rule.focalLength || along >= rule.cosRim * distance;
}

}  // namespace luxo
