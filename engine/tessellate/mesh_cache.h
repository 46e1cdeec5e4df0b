// SPDX-License-Identifier: Apache-2.0
// Meshes and shells by (surface, parameter values, level of detail): what was tessellated once is not
// tessellated again.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "surface/surface.h"
#include "tessellate/curvature_map.h"
#include "tessellate/mesh.h"
#include "tessellate/shell.h"
#include "tessellate/tessellator.h"

namespace luxo {

/// The tolerance actually used for a wanted one: the next power of sqrt(2) at or below it. A level depends on
/// the tolerance alone, so a moving camera asks for few distinct meshes and equal frames give equal meshes.
/// What is not positive and finite is its own level.
[[nodiscard]] double toleranceLevel(double tolerance);

/// Not thread-safe. Keeps the meshes and shells that are in use elsewhere, and, within a budget of bytes for
/// all, the others that were used most recently.
class MeshCache {
 public:
  explicit MeshCache(std::size_t mostBytes = std::size_t{64} << 20) : mostBytes_(mostBytes) {}

  /// The mesh for the levels of the tolerance and of the longest edge.
  [[nodiscard]] std::shared_ptr<const Mesh> get(const Surface& surface, std::span<const double> parameters,
                                                const MeshDesc& desc);

  /// The shell for the level of the tolerance; null where it has more than so many triangles, and where it
  /// would have to be made since an interruption.
  [[nodiscard]] std::shared_ptr<const Shell> shell(const Surface& surface, std::span<const double> parameters,
                                                   double tolerance, double mostTriangles);

  /// What is asked now and then while a shell is made: whether that should end.
  void setInterruption(std::function<bool()> asked) { interruption_ = std::move(asked); }
  [[nodiscard]] bool interrupted() const { return interrupted_; }  ///< since resume()
  void resume() { interrupted_ = false; }

  /// boundsSolid(), found once.
  [[nodiscard]] bool boundsSolid(const Surface& surface, std::span<const double> parameters);

  /// Of the meshes and shells that it has.
  [[nodiscard]] std::size_t bytes() const { return bytes_; }
  /// Meshes and shells made so far (not found in the cache).
  [[nodiscard]] std::uint64_t tessellated() const { return tessellated_; }

 private:
  /// A surface at certain values of its parameters.
  struct Shape {
    const void* surface = nullptr;
    std::vector<double> parameters;

    friend auto operator<=>(const Shape&, const Shape&) = default;
  };
  struct Key {
    Shape shape;
    Segments uniform;  ///< 0 x 0: none
    double tolerance = 0, longestEdge = 0;
    bool isShell = false;

    friend bool operator<(const Key& a, const Key& b) {
      const auto order = [](const Key& k) {
        return std::tie(k.shape, k.uniform.u, k.uniform.v, k.tolerance, k.longestEdge, k.isShell);
      };
      return order(a) < order(b);
    }
  };
  struct Entry {
    Surface surface;                   ///< keeps the identity in the key alive
    std::shared_ptr<const Mesh> mesh;  ///< or
    std::shared_ptr<const Shell> shell;
    std::size_t bytes = 0;
    std::uint64_t lastUse = 0;

    [[nodiscard]] bool inUse() const { return mesh.use_count() > 1 || shell.use_count() > 1; }
  };
  struct MapEntry {
    Surface surface;
    CurvatureMap map;
    std::map<double, double> leastTriangles;  ///< of shells, by tolerance: they have more
    std::uint64_t lastUse = 0;
  };

  struct SolidEntry {
    Surface surface;
    bool isSolid = false;
    std::uint64_t lastUse = 0;
  };

  MapEntry& mapOf(const Surface& surface, const Shape& shape);
  /// What is there for the key, or what `make` makes: an entry's mesh or its shell.
  template <class Make>
  const Entry& found(const Surface& surface, Key key, const Make& make);
  /// Forgets what is not in use, the oldest first, until so many more bytes fit.
  void makeRoom(std::size_t bytes);

  std::map<Key, Entry> entries_;
  std::map<Shape, MapEntry> maps_;
  std::map<Shape, SolidEntry> solids_;
  std::size_t mostBytes_, bytes_ = 0;
  std::uint64_t uses_ = 0, tessellated_ = 0;
  std::function<bool()> interruption_;
  bool interrupted_ = false;
};

}  // namespace luxo
