// SPDX-License-Identifier: Apache-2.0
// Casters and lights' maps of them: what was made once is not made again.
#pragma once

#include <compare>
#include <memory>
#include <optional>
#include <span>
#include <tuple>
#include <vector>

#include "shadow/caster_cells.h"
#include "shadow/light_grid.h"
#include "surface/equation.h"
#include "tessellate/curvature_map.h"
#include "tessellate/shape_cache.h"

namespace luxo {

/// A surface that is all of one equation, but for its edges.
struct CasterEquation {
  Equation equation;
  Box edges;            ///< Equation::edgesOf(), in the equation's units
  bool convex = false;  ///< all of an ellipsoid: no point that faces a light is in its shadow
};

/// Of a surface of one patch, or of the two sheets of a hyperboloid; nothing of others.
[[nodiscard]] std::optional<CasterEquation> casterEquation(const Surface& surface,
                                                           std::span<const double> parameters);

/// Not thread-safe.
class CasterCache {
 public:
  explicit CasterCache(std::size_t mostBytes = kUsualCacheBytes) : cells_(mostBytes), grids_(mostBytes) {}

  [[nodiscard]] std::shared_ptr<const CasterCells> cells(const Surface& surface,
                                                         std::span<const double> parameters);
  /// What a light (object space, see makeLightGrid()) sees of these.
  [[nodiscard]] std::shared_ptr<const LightGrid> grid(const Surface& surface,
                                                      std::span<const double> parameters, const Vec4& light,
                                                      int size);

  /// casterEquation(). Valid until the next call.
  [[nodiscard]] const std::optional<CasterEquation>& equation(const Surface& surface,
                                                              std::span<const double> parameters);

  /// formulaRounding() of all patches; object units.
  [[nodiscard]] double rounding(const Surface& surface, std::span<const double> parameters);

  /// Casters and maps made so far (not found here).
  [[nodiscard]] std::uint64_t made() const { return cells_.made() + grids_.made(); }

 private:
  struct Key {
    Shape shape;
    Vec4 light{0};
    int size = 0;

    friend bool operator<(const Key& a, const Key& b) {
      const auto tied = [](const Key& k) {
        return std::tie(k.shape, k.light.x, k.light.y, k.light.z, k.light.w, k.size);
      };
      return tied(a) < tied(b);
    }
  };

  ShapeCache<Key, CasterCells> cells_;
  ShapeCache<Key, LightGrid> grids_;
  ShapeTable<CurvatureMap> maps_{64};
  ShapeTable<std::optional<CasterEquation>> equations_{1024};
  ShapeTable<double> roundings_{1024};
};

/// How far from where they should be rays may be, at most, of a caster's size: its maps have room for it.
inline constexpr double kGridMargin = 1.0 / 1024;

}  // namespace luxo
