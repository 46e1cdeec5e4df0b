// SPDX-License-Identifier: Apache-2.0
#include "draw/closed_caster.h"

#include <algorithm>
#include <cmath>

#include "math/transform.h"

namespace luxo {
namespace {

/// Of the distances involved: what a dozen operations of single precision round away.
constexpr double kEquationRounding = 0x1p-21;
/// A light this near to the surface, of what F is a sum of, does not tell its side.
constexpr double kOnSurface = 1e-6;
/// Of the distances involved: much more than a place's way through matrices of doubles loses.
constexpr double kLostOfPlaces = 1e-8;
/// Of the ring: in the narrow middle of a torus with less room than that steps are short.
constexpr double kWidestTube = 0.9;

constexpr double kNowhere = 1e30;

/// F at the light, or its sign toward one at infinity; 0 where that is not clear. Of one in a place doubles
/// may have lost `lost`: at an apex F is 0, and so is all that it is a sum of.
double quadricAt(const shared::ClosedCaster& caster, const Vec4& light, const Vec3& lost) {
  const Vec3 squares(caster.squares), at(light), near = glm::abs(at) + light.w * lost;
  const double halfY = caster.halfY, constant = caster.constant;
  const bool flat = squares == Vec3(0);
  double of = glm::dot(squares * at, at), size = glm::dot(glm::abs(squares) * near, near);
  if (light.w != 0) {
    of += 2 * halfY * at.y + constant;
    size += 2 * std::abs(halfY) * near.y + std::abs(constant);
  } else if (flat) {
    of = halfY * at.y;
    size = std::abs(halfY) * glm::length(at);
  }
  return std::abs(of) > kOnSurface * size ? of : 0;
}

double torusAt(double tube, const Vec4& light) {
  if (light.w == 0) return 1;
  const double off = std::hypot(light.x, light.z) - 1, of = off * off + (light.y - tube) * (light.y + tube);
  return of > kOnSurface * (off * off + light.y * light.y + tube * tube) ? of : 0;
}

bool isFinite(const shared::ClosedCaster& caster) {
  double sum = caster.halfY + caster.constant + caster.tube + caster.atLight + caster.offPerPixel;
  for (const Vec4f& row : caster.unitFromRelative) sum += glm::dot(Vec4(row), Vec4(1));
  for (const Vec4f& v : {caster.light, caster.lightRelative}) sum += glm::dot(Vec4(v), Vec4(1));
  for (const Vec3f& v : {caster.squares, caster.rounding, caster.roundingPerMetre})
    sum += glm::dot(Vec3(v), Vec3(1));
  return std::isfinite(sum);
}

}  // namespace

std::optional<ClosedCaster> closedCaster(const Snapshot& snapshot, const SnapshotNode& node,
                                         const Vec4& light, const Vec3& origin, const OffSurfaces& off,
                                         CasterCache& casters) {
  const std::optional<CasterEquation>& known = casters.equation(node.surface, node.parameters);
  if (!known) return std::nullopt;
  const Equation& equation = known->equation;
  const bool torus = equation.form() == Equation::Form::Torus;
  if (torus && equation.tube > kWidestTube) return std::nullopt;

  const double center = equation.center();
  const Vec3 middle(0, center, 0), perScale = 1.0 / equation.scale;
  Mat3 unitFromWorld = glm::inverse(node.worldFromObject.linear);
  for (int column = 0; column < 3; ++column) unitFromWorld[column] *= perScale;
  const auto inUnits = [&](const Vec3& world) {
    return unitFromWorld * (world - node.worldFromObject.translation) - middle;
  };
  const Vec3 from = inUnits(origin);
  const Vec4 at(light.w != 0 ? inUnits(Vec3(light)) : unitFromWorld * Vec3(light), light.w);
  const Mat3 rows = glm::transpose(unitFromWorld);
  const Vec3 lengths(glm::length(rows[0]), glm::length(rows[1]), glm::length(rows[2]));

  ClosedCaster made;
  shared::ClosedCaster& caster = made.data;
  for (int i = 0; i < 3; ++i) caster.unitFromRelative[i] = Vec4f(Vec4(rows[i], from[i]));
  caster.light = Vec4f(at);
  caster.lightRelative = Vec4f(Vec3f(Vec3(light) - light.w * origin), light.w);
  caster.squares = Vec3f(equation.xx, equation.yy, equation.zz);
  caster.halfY = static_cast<float>(0.5 * equation.y + equation.yy * center);
  caster.constant = static_cast<float>(equation.constant + (equation.y + equation.yy * center) * center);
  caster.tube = static_cast<float>(equation.tube);
  const Vec3 lost =
      kLostOfPlaces * (Vec3(equation.reach + std::abs(center)) +
                       lengths * (glm::length(Vec3(light)) + glm::length(node.worldFromObject.translation)));
  caster.atLight = static_cast<float>(torus ? torusAt(equation.tube, at) : quadricAt(caster, at, lost));
  caster.lowest = Vec3f(glm::max(known->edges.min - middle, Vec3(-kNowhere)));
  caster.highest = Vec3f(glm::min(known->edges.max - middle, Vec3(kNowhere)));
  caster.rounding = Vec3f(kEquationRounding * (glm::abs(from) + equation.reach + std::abs(center)) +
                          off.rounding * lengths);
  caster.roundingPerMetre = Vec3f(kEquationRounding * lengths);
  caster.offPerPixel = static_cast<float>(off.px / (snapshot.view.pixelsPerUnit * kEquationRounding));
  if (off.rounding > 0) caster.flags |= shared::kRoundedPoints;
  if (equation.isRadial()) {
    caster.flags |= shared::kRadialCaster;
    if (caster.lowest.x <= 0) caster.lowest.x = static_cast<float>(-kNowhere);  // the axis is no edge
  }
  made.kind = torus                ? shared::kClosedTorus
              : equation.isPlane() ? shared::kClosedPlane
              : known->convex      ? shared::kClosedBall
              : caster.halfY == 0  ? shared::kClosedCentered
                                   : shared::kClosedQuadric;
  if (caster.atLight == 0 || !isFinite(caster)) return std::nullopt;
  return made;
}

}  // namespace luxo
