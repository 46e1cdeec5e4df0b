// SPDX-License-Identifier: Apache-2.0
// Meshes by (surface, parameter values, segments): what was tessellated once is not tessellated again.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <tuple>
#include <vector>

#include "surface/surface.h"
#include "tessellate/mesh.h"
#include "tessellate/tessellator.h"

namespace luxo {

/// The tolerance actually used for a wanted one: the next power of sqrt(2) at or below it. A level depends on
/// the tolerance alone, so a moving camera asks for few distinct meshes and equal frames give equal meshes.
/// What is not positive and finite is its own level.
[[nodiscard]] double toleranceLevel(double tolerance);

/// Not thread-safe. Keeps the most recently used meshes within a budget of vertices; a mesh in use elsewhere
/// stays alive through its own shared pointer.
class MeshCache {
 public:
  explicit MeshCache(std::size_t mostVertices = std::size_t{1} << 22) : mostVertices_(mostVertices) {}

  [[nodiscard]] std::shared_ptr<const Mesh> get(const Surface& surface, std::span<const double> parameters,
                                                Segments segments);

  /// Meshes made so far (not found in the cache).
  [[nodiscard]] std::uint64_t tessellated() const { return tessellated_; }

 private:
  using Key = std::tuple<const void*, std::vector<double>, std::uint32_t, std::uint32_t>;
  struct Entry {
    Surface surface;  ///< keeps the identity in the key alive
    std::shared_ptr<const Mesh> mesh;
    std::uint64_t lastUse = 0;
  };

  void evict();

  std::map<Key, Entry> entries_;
  std::size_t mostVertices_, vertices_ = 0;
  std::uint64_t uses_ = 0, tessellated_ = 0;
};

}  // namespace luxo
