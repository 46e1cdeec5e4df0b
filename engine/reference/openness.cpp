// SPDX-License-Identifier: Apache-2.0
// How much of the ambient light gets to a point, by brute force.
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "math/basis.h"
#include "reference/caster.h"

namespace luxo::reference {
namespace {

/// Point k of n in the unit disc, spread evenly (H. Vogel, A better way to construct the sunflower head,
/// 1979). What is above it on the half sphere is spread by the cosine (Malley's method).
Vec2 discPoint(int k, int n) {
  constexpr double kGoldenAngle = 2.399963229728653;  // pi (3 - sqrt 5)
  const double radius = std::sqrt((k + 0.5) / n), turn = kGoldenAngle * k;
  return {radius * std::cos(turn), radius * std::sin(turn)};
}

}  // namespace

double Caster::openness(const Hit& hit) const {
  const double radius = snapshot_.ambientOcclusion.radius;
  if (!(radius > 0) || bodies_[hit.node].transparent) return 1;
  const auto [right, up] = completed(hit.normal);
  int open = 0;
  for (int k = 0; k < kOpennessRays; ++k) {
    const Vec2 at = discPoint(k, kOpennessRays);
    const double height = std::sqrt(std::max(1 - glm::dot(at, at), 0.0));
    const Ray ray{hit.position, at.x * right + at.y * up + height * hit.normal};
    const double own = ownReach(hit, ray.direction);
    const auto blocks = [&](std::uint32_t node) {
      return !bodies_[node].transparent && mayMeet(ray, node) &&
             bodies_[node].shape.nearestRoot(ray, {own, radius, Facing::Both, false}).nearest.has_value();
    };
    bool isBlocked = false;
    for (std::uint32_t node = 0; node < bodies_.size() && !isBlocked; ++node) isBlocked = blocks(node);
    open += isBlocked ? 0 : 1;
  }
  return static_cast<double>(open) / kOpennessRays;
}

}  // namespace luxo::reference
