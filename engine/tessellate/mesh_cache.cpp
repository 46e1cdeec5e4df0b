// SPDX-License-Identifier: Apache-2.0
#include "tessellate/mesh_cache.h"

#include <algorithm>
#include <cmath>

namespace luxo {

double toleranceLevel(double tolerance) { return std::exp2(std::floor(2 * std::log2(tolerance)) / 2); }

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
