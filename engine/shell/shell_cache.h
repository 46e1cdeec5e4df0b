// SPDX-License-Identifier: Apache-2.0
// Shells by (surface, parameter values, level of detail): what was made once is not made again.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <tuple>
#include <utility>

#include "shell/shell.h"
#include "surface/surface.h"
#include "tessellate/curvature_map.h"
#include "tessellate/shape_cache.h"

namespace luxo {

/// Not thread-safe.
class ShellCache {
 public:
  explicit ShellCache(std::size_t mostBytes = kUsualCacheBytes) : shells_(mostBytes) {}

  /// The shell for the level of the tolerance (toleranceLevel()) and of the half axes of the margin, object
  /// units (parts of the tolerance: the next powers of 4 at or above them, kLeastMargin at least); null where
  /// it has more than so many triangles, whether or not it was made before, and where it would have to be made
  /// since an interruption.
  [[nodiscard]] std::shared_ptr<const Shell> get(const Surface& surface, std::span<const double> parameters,
                                                 double tolerance, const Vec3& margin, double mostTriangles);

  /// What is asked now and then while a shell is made: whether that should end.
  void setInterruption(std::function<bool()> asked) { interruption_ = std::move(asked); }
  [[nodiscard]] bool interrupted() const { return interrupted_; }  ///< since resume()
  void resume() { interrupted_ = false; }

  [[nodiscard]] std::size_t bytes() const { return shells_.bytes(); }
  /// Shells made so far (not found in the cache).
  [[nodiscard]] std::uint64_t made() const { return shells_.made(); }

 private:
  struct Key {
    Shape shape;
    double tolerance = 0;
    std::array<double, 3> margin{};

    friend bool operator<(const Key& a, const Key& b) {
      return std::tie(a.shape, a.tolerance, a.margin) < std::tie(b.shape, b.tolerance, b.margin);
    }
  };
  struct Known {
    CurvatureMap map;
    std::map<double, double> leastTriangles;  ///< by tolerance: such shells have more
  };

  [[nodiscard]] bool isInterrupted();

  ShapeCache<Key, Shell> shells_;
  ShapeTable<Known> known_{64};
  std::function<bool()> interruption_;
  bool interrupted_ = false;
};

}  // namespace luxo
