// SPDX-License-Identifier: Apache-2.0
// A surface cut into small cells with proven bounds, in a hierarchy of boxes: what rays are cast against.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "math/bounds.h"
#include "math/interval.h"
#include "surface/surface.h"

namespace luxo::reference {

/// Of doubles: twice what one operation rounds away of its result.
inline constexpr double kEpsilon = 0x1p-52;

/// A vector known up to a radius per component: it holds the true one, rounding included.
struct Enclosure {
  Vec3 center{0}, radius{0};

  [[nodiscard]] bool finite() const;
};

/// What intervals prove about a rectangle of a patch.
struct CellBounds {
  Enclosure position;   ///< of every point
  Enclosure middle;     ///< of the point in the middle
  Enclosure du, dv;     ///< of the tangents at every point
  bool smooth = false;  ///< du and dv are finite and the formula has no kink here
  bool empty = false;   ///< the formula has no value anywhere in it, and the others say nothing
};

/// The formula of one patch at given parameter values, and its proven bounds.
class BoundedPatch {
 public:
  /// What is farther from the origin than `farthest` does not count: poles have no end.
  BoundedPatch(const Surface& surface, std::uint32_t patch, std::span<const double> parameters,
               double farthest = std::numeric_limits<double>::max());

  /// Two or three interval evaluations, unless the family of the formula bounds itself.
  [[nodiscard]] CellBounds bound(const Domain& cell) const;

  /// S, Su, Sv.
  struct Point {
    Vec3 position, du, dv;
  };
  [[nodiscard]] Point at(double u, double v) const;

  [[nodiscard]] const Domain& domain() const { return domain_; }
  /// The domain and a millionth of its size on every side: a root on an edge is inside of this one.
  [[nodiscard]] const Domain& extended() const { return extended_; }

 private:
  [[nodiscard]] CellBounds boundByFamily(const Domain& cell) const;
  [[nodiscard]] CellBounds boundByIntervals(const Domain& cell) const;

  const SurfaceFunction* function_;
  std::vector<double> values_;  // of variables 2, 3, ...
  Domain domain_, extended_;
  double farthest_;
};

struct Cell {
  std::uint32_t patch = 0;
  Domain domain;
  CellBounds bounds;
};

using Halves = std::array<Domain, 2>;
[[nodiscard]] Halves halvesInU(const Domain& d);
[[nodiscard]] Halves halvesInV(const Domain& d);
/// Cut across the longer side in space; where that is unknown, across the larger part of the whole domain's.
[[nodiscard]] Halves halves(const Cell& cell, const Domain& whole);

/// Immutable; safe from any thread. Keeps a copy of the surface.
class CellTree {
 public:
  /// Cells are split in rounds, those that bend most first, until none bends by more than 1/512 of the
  /// surface's size or there are `mostCells`. Those in which it has no points are left out. In parallel; the
  /// tree does not depend on the number of threads. Cost: a few interval evaluations per cell.
  CellTree(const Surface& surface, std::span<const double> parameters, std::size_t mostCells = 1U << 14);

  /// A node of the hierarchy: its two children stand behind it, or it is one cell.
  struct Node {
    Vec3 center{0}, half{0};   ///< holds everything below
    std::uint32_t second = 0;  ///< index of the second child (the first follows the node); 0: a cell
    std::uint32_t cell = 0;
  };

  [[nodiscard]] const Surface& surface() const { return surface_; }
  [[nodiscard]] std::span<const double> parameters() const { return parameters_; }
  [[nodiscard]] double size() const { return size_; }  ///< of the surface, finite: Surface::framing()
  [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }  ///< the first is the root, if any
  [[nodiscard]] const std::vector<Cell>& cells() const { return cells_; }
  [[nodiscard]] const BoundedPatch& patch(std::uint32_t index) const { return patches_[index]; }

 private:
  void cut(std::size_t mostCells);
  void build(std::span<std::uint32_t> cells, std::uint32_t index);

  Surface surface_;
  std::vector<double> parameters_;
  double size_;
  std::vector<BoundedPatch> patches_;
  std::vector<Cell> cells_;
  std::vector<Node> nodes_;
};

}  // namespace luxo::reference
