// SPDX-License-Identifier: Apache-2.0
#include "tessellate/mesh_cache.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace luxo {
namespace {

constexpr std::size_t kMostMaps = 64;

template <class Entries>
auto leastRecentlyUsed(Entries& entries) {
  return std::min_element(entries.begin(), entries.end(),
                          [](const auto& a, const auto& b) { return a.second.lastUse < b.second.lastUse; });
}

}  // namespace

double toleranceLevel(double tolerance) {
  if (!(tolerance > 0 && std::isfinite(tolerance))) return tolerance;
  int exponent = 0;
  std::frexp(tolerance, &exponent);
  // Scaling by a power of two is exact, so a level is its own level.
  const double power = std::ldexp(1.0, exponent - 1), between = std::ldexp(std::numbers::sqrt2, exponent - 1);
  return between <= tolerance ? between : power;
}

const CurvatureMap& MeshCache::mapOf(const Surface& surface, const Shape& shape) {
  auto found = maps_.find(shape);
  if (found == maps_.end()) {
    // Of an animated surface every frame has its own.
    if (maps_.size() >= kMostMaps) maps_.erase(leastRecentlyUsed(maps_));
    found = maps_.emplace(shape, MapEntry{surface, CurvatureMap(surface, shape.parameters)}).first;
  }
  found->second.lastUse = ++uses_;
  return found->second.map;
}

std::shared_ptr<const Mesh> MeshCache::get(const Surface& surface, std::span<const double> parameters,
                                           const MeshDesc& desc) {
  Key key{.shape = {surface.identity(), {parameters.begin(), parameters.end()}}};
  if (desc.uniform) {
    key.uniform = *desc.uniform;
  } else {
    key.tolerance = toleranceLevel(desc.tolerance);
    key.longestEdge = toleranceLevel(desc.longestEdge);
  }
  auto found = entries_.find(key);
  if (found == entries_.end()) {
    auto mesh = std::make_shared<const Mesh>(
        desc.uniform ? tessellate(surface, parameters, desc)
                     : tessellate(surface, parameters, mapOf(surface, key.shape),
                                  {.tolerance = key.tolerance, .longestEdge = key.longestEdge}));
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
    const auto oldest = leastRecentlyUsed(entries_);
    vertices_ -= oldest->second.mesh->positions.size();
    entries_.erase(oldest);
  }
}

}  // namespace luxo
