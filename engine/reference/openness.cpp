// SPDX-License-Identifier: Apache-2.0
// How much of the ambient light gets to a point, by brute force.
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "math/basis.h"
#include "math/sampling.h"
#include "reference/caster.h"

namespace luxo::reference {
bool Caster::occludes(std::uint32_t node, const Ray& ray, double nearest, double farthest) const {
  const RootQuery query{nearest, farthest, Facing::Both, false};
  if (!mayMeet(ray, node)) return false;
  if (!bodies_[node].transparent) return bodies_[node].shape.nearestRoot(ray, query).nearest.has_value();
  if (materialOf(node).cutoff == 0) return false;
  RootWalk walk(bodies_[node].shape, ray, query);
  for (int layer = 0; layer < kMaxLayers; ++layer) {
    const Roots roots = walk.from(nearest);
    if (!roots.nearest) return false;
    Hit met = hitAt({ray}, node, *roots.nearest);
    met.footprint = Footprint(0);  // the sky has no pixels
    if (opacityOf(met) > 0) return true;
    if (snapshot_.nodes[node].surface.flatNormal()) return false;  // it leaves a plane where it meets it
    nearest = beyond(ray, met);
  }
  return false;
}

double Caster::openness(const Hit& hit) const {
  const double radius = snapshot_.ambientOcclusion.radius;
  if (!(radius > 0)) return 1;
  const auto [right, up] = completed(hit.normal);
  int open = 0;
  // What is above points of the disc on the half sphere is spread by the cosine (Malley's method).
  for (int k = 0; k < kOpennessRays; ++k) {
    const Vec2 at = discPoint(k, kOpennessRays);
    const double height = std::sqrt(std::max(1 - glm::dot(at, at), 0.0));
    const Ray ray{hit.position, at.x * right + at.y * up + height * hit.normal};
    const double own = ownReach(hit, ray.direction);
    bool isBlocked = false;
    for (std::uint32_t node = 0; node < bodies_.size() && !isBlocked; ++node)
      isBlocked = occludes(node, ray, own, radius);
    open += isBlocked ? 0 : 1;
  }
  return static_cast<double>(open) / kOpennessRays;
}

}  // namespace luxo::reference
