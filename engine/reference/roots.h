// SPDX-License-Identifier: Apache-2.0
// Where a ray meets a surface: the nearest point, certified.
//
// With the ray's own directions as coordinates the surface's point S(u,v) has an offset (f1, f2) from the ray
// and a distance t along it. Cells whose offsets cannot be (0, 0) are left out by their bounds; in the others
// Krawczyk's test proves that there is no root, or exactly one, or narrows the cell, or it is cut in half
// (R. Krawczyk 1969; D. Toth, "On ray tracing parametric surfaces", 1985). What neither test decides before
// the cell is smaller than 1e-13 of the surface or of its domain is reported as undecided: grazing rays,
// within rounding.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "math/transform.h"
#include "reference/cell_tree.h"

namespace luxo::reference {

/// Of the domain: how far outside a root may be found.
constexpr double kOnTheEdge = 1e-12;

/// World space. `direction` is unit.
struct Ray {
  Vec3 origin{0}, direction{0, 0, -1};
};

/// The ray as a surface placed in the world sees it: three linear functions of its points. Right for singular
/// transforms too, as nothing is inverted. Built in double: it stands for a ray that differs from the true
/// one by rounding, about 1e-15 of the distances involved.
struct RayFunctions {
  RayFunctions(const Ray& ray, const Transform& worldFromObject);

  Vec3 across1, across2, along;
  double offset1, offset2, start;

  [[nodiscard]] double f1(const Vec3& p) const { return glm::dot(across1, p) + offset1; }
  [[nodiscard]] double f2(const Vec3& p) const { return glm::dot(across2, p) + offset2; }
  [[nodiscard]] double t(const Vec3& p) const { return glm::dot(along, p) + start; }

  /// Whether the line passes by all of a box. Exact but for rounding: a line and a box are parted by a plane
  /// along one of the box's axes, or not at all (S. Gottschalk et al., "OBBTree", 1996).
  [[nodiscard]] bool misses(const Enclosure& box) const;

 private:
  /// The combination of f1 and f2 that does not depend on one of the axes, as a function of the two others.
  struct Beside {
    std::array<double, 2> slopes, rounding;  ///< what products may have rounded away is 2^-53 of `rounding`
    double offset, offsetRounding;
  };
  std::array<Beside, 3> beside_;
};

struct Root {
  double t = 0;  ///< metres along the ray
  std::uint32_t patch = 0;
  double u = 0, v = 0;  ///< of triangles see reference/triangle_tree.h
};

/// Which side of a surface counts.
enum class Facing { Both, Front };

struct RootQuery {
  double nearest = 0, farthest = 0;  ///< of t; roots outside do not count
  Facing facing = Facing::Both;
  bool mirrored = false;  ///< the transform turns fronts into backs
};

struct Roots {
  std::optional<Root> nearest;  ///< an undecided one counts as a root
  bool certified = true;  ///< nothing undecided lies before the nearest root (before `farthest` if none)
  int cells = 0;          ///< parts of cells that were looked at: the cost, 4,096 at most
};

/// Cost: a few dozen box tests and a few cells; at most 4,096 cells, or 65,536 where
/// the formula ends, after which the rest is undecided.
[[nodiscard]] Roots nearestRoot(const CellTree& tree, const RayFunctions& ray, const RootQuery& query);

/// All roots of a ray, found in one traversal of the tree, which must outlive it, for who asks for one after
/// the other. Cost: about that of one nearestRoot() that finds nothing; at most as many cells again for each
/// root.
class RootsInOrder {
 public:
  RootsInOrder(const CellTree& tree, const RayFunctions& ray, const RootQuery& query);

  /// As nearestRoot() of the query from there on, which must not be nearer than the query's own nearest.
  [[nodiscard]] Roots from(double nearest) const;

  /// A part of a cell that was left undecided: its distances, and its middle; nothing of a search that was
  /// given up.
  struct Doubt {
    double low = 0, high = 0;
    std::optional<Root> root;
  };

 private:
  const CellTree& tree_;
  std::vector<Root> roots_;  // by distance
  std::vector<Doubt> doubts_;
  int cells_ = 0;
};

}  // namespace luxo::reference
