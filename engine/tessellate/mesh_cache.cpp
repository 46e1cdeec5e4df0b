// SPDX-License-Identifier: Apache-2.0
#include "tessellate/mesh_cache.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "surface/equation.h"

namespace luxo {
namespace {

constexpr std::size_t kMaxMaps = 64, kMaxSolids = 256;

/// What comes with any mesh: the surface with its compiled formulas, and what a device has of it. Measured:
/// an edited formula of some ten operations left 100 KB behind, half of them its shell.
constexpr std::size_t kEntryBytes = std::size_t{64} << 10;

template <class... Vectors>
std::size_t bytesIn(const Vectors&... vectors) {
  return (... + (vectors.size() * sizeof(typename Vectors::value_type)));
}

std::size_t bytesOf(const Mesh& mesh) {
  return bytesIn(mesh.positions, mesh.normals, mesh.parameters, mesh.indices);
}

std::size_t bytesOf(const Shell& shell) {
  std::size_t bytes = bytesIn(shell.positions, shell.parameters, shell.cells, shell.changes, shell.patches,
                              shell.indices, shell.cones, shell.occluder, shell.slabs, shell.occluding);
  for (const Shell::OccluderSlab& slab : shell.occluderSlabs)
    bytes += bytesIn(slab.tops, slab.walls, slab.bottoms);
  return bytes;
}

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

MeshCache::MapEntry& MeshCache::mapOf(const Surface& surface, const Shape& shape) {
  auto found = maps_.find(shape);
  if (found == maps_.end()) {
    // Of an animated surface every frame has its own.
    if (maps_.size() >= kMaxMaps) maps_.erase(leastRecentlyUsed(maps_));
    found = maps_.emplace(shape, MapEntry{surface, CurvatureMap(surface, shape.parameters), {}}).first;
  }
  found->second.lastUse = ++uses_;
  return found->second;
}

template <class Make>
const MeshCache::Entry& MeshCache::found(const Surface& surface, Key key, const Make& make) {
  auto entry = entries_.find(key);
  if (entry == entries_.end()) {
    Entry made{.surface = surface, .mesh = nullptr, .shell = nullptr};
    make(key, made);
    ++tessellated_;
    made.bytes = kEntryBytes + (made.mesh ? bytesOf(*made.mesh) : bytesOf(*made.shell));
    makeRoom(made.bytes);
    bytes_ += made.bytes;
    entry = entries_.emplace(std::move(key), std::move(made)).first;
  }
  entry->second.lastUse = ++uses_;
  return entry->second;
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
  return found(surface, std::move(key),
               [&](const Key& k, Entry& entry) {
                 entry.mesh = std::make_shared<const Mesh>(
                     desc.uniform ? tessellate(surface, parameters, desc)
                                  : tessellate(surface, parameters, mapOf(surface, k.shape).map,
                                               {.tolerance = k.tolerance, .longestEdge = k.longestEdge}));
               })
      .mesh;
}

std::shared_ptr<const Shell> MeshCache::shell(const Surface& surface, std::span<const double> parameters,
                                              double tolerance, double mostTriangles) {
  Key key{.shape = {surface.identity(), {parameters.begin(), parameters.end()}},
          .tolerance = toleranceLevel(tolerance),
          .isShell = true};
  const auto tooMany = [&](const std::shared_ptr<const Shell>& shell) {
    return static_cast<double>(shell->triangleCount()) > mostTriangles;
  };
  if (const auto known = entries_.find(key); known != entries_.end()) {
    known->second.lastUse = ++uses_;
    return tooMany(known->second.shell) ? nullptr : known->second.shell;
  }
  MapEntry& map = mapOf(surface, key.shape);
  double& least = map.leastTriangles[key.tolerance];
  if (least >= mostTriangles) return nullptr;
  const auto isInterrupted = [this] {
    interrupted_ = interrupted_ || (interruption_ && interruption_());
    return interrupted_;
  };
  auto shell =
      makeShell(surface, parameters, map.map,
                {.tolerance = key.tolerance, .mostTriangles = mostTriangles, .interrupted = isInterrupted});
  if (!shell && interrupted_) return nullptr;
  if (!shell) {
    least = mostTriangles;
    return nullptr;
  }
  return found(surface, std::move(key),
               [&](const Key&, Entry& entry) {
                 entry.shell = std::make_shared<const Shell>(std::move(*shell));
               })
      .shell;
}

bool MeshCache::boundsSolid(const Surface& surface, std::span<const double> parameters) {
  Shape shape{surface.identity(), {parameters.begin(), parameters.end()}};
  auto found = solids_.find(shape);
  if (found == solids_.end()) {
    if (solids_.size() >= kMaxSolids) solids_.erase(leastRecentlyUsed(solids_));
    found =
        solids_.emplace(std::move(shape), SolidEntry{surface, luxo::boundsSolid(surface, parameters)}).first;
  }
  found->second.lastUse = ++uses_;
  return found->second.isSolid;
}

void MeshCache::makeRoom(std::size_t bytes) {
  if (bytes_ + bytes <= mostBytes_) return;
  std::vector<decltype(entries_)::iterator> idle;
  for (auto entry = entries_.begin(); entry != entries_.end(); ++entry)
    if (!entry->second.inUse()) idle.push_back(entry);
  std::ranges::sort(idle, {}, [](const auto& entry) { return entry->second.lastUse; });
  for (const auto& entry : idle) {
    if (bytes_ + bytes <= mostBytes_) return;
    bytes_ -= entry->second.bytes;
    entries_.erase(entry);
  }
}

}  // namespace luxo
