// SPDX-License-Identifier: Apache-2.0
#include "cull/reach.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace luxo {

namespace {

/// Of the distance from the apex: nearer to the axis than that, rounding is much of what is aside.
constexpr double kOnAxis = 1e-6;
/// Of all lengths involved: some ten roundings.
constexpr double kRounding = 1e-14;

/// Corners of the box in the plane through an axis and the box's centre: seen from an apex on it, `along` the
/// axis and `aside` toward the centre. `distance` is the true distance from the apex.
struct Corner {
  double along = 0, aside = 0, distance = 0;
};

using Corners = std::array<Corner, 8>;

/// Unit, across the axis: toward a point, or of one on the axis itself, as near as rounding tells, any.
Vec3 across(const Vec3& axis, const Vec3& point) {
  const auto without = [&](const Vec3& v) { return v - glm::dot(v, axis) * axis; };
  Vec3 aside = without(point);
  if (!(glm::length(aside) > kOnAxis * glm::length(point)))
    aside = without(std::abs(axis.x) < 0.5 ? Vec3(1, 0, 0) : Vec3(0, 1, 0));
  return unit(without(aside));  // twice is enough (B. Parlett, The Symmetric Eigenvalue Problem, 1980)
}

/// `axis`: unit.
Corners cornersFrom(const Vec3& apex, const Vec3& axis, const Transform& worldFromObject, const Box& box) {
  const auto fromApex = [&](const Vec3& p) { return transformPoint(worldFromObject, p) - apex; };
  const Vec3 toward = across(axis, fromApex(box.center()));
  Corners corners;
  for (int i = 0; i < 8; ++i) {
    const Vec3 q = fromApex(
        {i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y, i & 4 ? box.max.z : box.min.z});
    corners[i] = {glm::dot(q, axis), glm::dot(q, toward), glm::length(q)};
  }
  return corners;
}

/// Whether all corners, and so the whole box, are beyond the plane a * along + b * aside = c, by `slack`
/// metres.
bool beyond(const Corners& corners, double a, double b, double c, double slack) {
  const double margin = c + slack * std::hypot(a, b);
  return std::ranges::all_of(corners, [&](const Corner& q) { return a * q.along + b * q.aside > margin; });
}

/// Metres that corners may be beside where they are.
double roundingOf(const Corners& corners, const Vec3& apex) {
  double farthest = 0;
  for (const Corner& corner : corners) farthest = std::max(farthest, corner.distance);
  return kRounding * (glm::length(apex) + farthest);
}

bool outsideCone(const Corners& corners, double cosRim, double slack) {
  const double sinRim = std::sqrt((1 - cosRim) * (1 + cosRim));
  // Wider than a half space, the cone's dark complement is convex: its corners decide for the box.
  if (cosRim < 0)
    return std::ranges::all_of(corners,
                               [&](const Corner& q) { return q.along < cosRim * q.distance - slack; });
  return beyond(corners, -1, 0, 0, slack) || beyond(corners, -sinRim, cosRim, 0, slack);
}

/// Outside the solid of points nearer to the focus than to the directrix, cut at the rim: beyond the rim it
/// lies within the cone, unless the focus is beyond the rim, too: then whatever is beyond the rim is lit. Its
/// tangent plane at radius r is r * aside - 2 f * (along + f) = r^2 / 2.
bool outsideShade(const Corners& corners, const ShadeRule& rule, double slack) {
  const double f = rule.focalLength, rim = 2 * std::sqrt(f * rule.height);
  if (rule.cosRim >= 0 && beyond(corners, 1, 0, rule.height - f, slack)) return true;
  for (const double part : {0.0, 0.25, 0.5, 1.0}) {
    const double r = part * rim;
    if (beyond(corners, -2 * f, r, 0.5 * r * r + 2 * f * f, slack)) return true;
  }
  return false;
}

}  // namespace

bool canLight(const ShadeRule& rule, const Transform& worldFromObject, const Box& boundsObject,
              double slack) {
  const Corners corners = cornersFrom(rule.focus, rule.axis, worldFromObject, boundsObject);
  slack += roundingOf(corners, rule.focus);
  return !(outsideCone(corners, rule.cosRim, slack) && outsideShade(corners, rule, slack));
}

bool canLight(const SpotCone& cone, const Vec3& positionWorld, const Transform& worldFromObject,
              const Box& boundsObject, double slack) {
  const Corners corners = cornersFrom(positionWorld, cone.axis, worldFromObject, boundsObject);
  return !outsideCone(corners, std::cos(cone.outer), slack + roundingOf(corners, positionWorld));
}

}  // namespace luxo
