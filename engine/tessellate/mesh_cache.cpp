// SPDX-License-Identifier: Apache-2.0
#include "tessellate/mesh_cache.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace luxo {

double toleranceLevel(double tolerance) {
  if (!(tolerance > 0 && std::isfinite(tolerance))) return tolerance;
  int exponent = 0;
  std::frexp(tolerance, &exponent);
  // Scaling by a power of two is exact, so a level is its own level.
  const double power = std::ldexp(1.0, exponent - 1), between = std::ldexp(std::numbers::sqrt2, exponent - 1);
  return between <= tolerance ? between : power;
}

std::shared_ptr<const Mesh> MeshCache::get(const Surface& surface, std::span<const double> parameters,
                                           Segments segments) {
  segments = atLeastMinimal(surface, segments);
  Key key{surface.identity(), {parameters.begin(), parameters.end()}, segments.u, segments.v};
  auto found = entries_.find(key);
  if (found == entries_.end()) {
    auto mesh = std::make_shared<const Mesh>(tessellate(surface, parameters, segments));
    ++tessellated_;
    vertices_ += mesh->positions.size();
    found = entries_.emplace(std::move(key), Entry{surface, std::move(mesh)}).first;
  }
  found->second.lastUse = ++uses_;
  std::shared_ptr<const Mesh> mesh = found->second.mesh;
  evict();
  return mesh;
}

void MeshCache::evict() {
  while (vertices_ > mostVertices_ && entries_.size() > 1) {
    const auto oldest = std::min_element(entries_.begin(), entries_.end(), [](const auto& a, const auto& b) {
      return a.second.lastUse < b.second.lastUse;
    });
    vertices_ -= oldest->second.mesh->positions.size();
    entries_.erase(oldest);
  }
}

}  // namespace luxo
