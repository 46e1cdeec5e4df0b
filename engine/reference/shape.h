// SPDX-License-Identifier: Apache-2.0
// What rays are cast against: a surface at given parameter values, as equations where it has them, else as
// cells, or as triangles; and the surfaces of a picture, kept for the next one.
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "reference/cell_tree.h"
#include "reference/closed_form.h"
#include "reference/roots.h"
#include "reference/triangle_tree.h"
#include "surface/surface.h"

namespace luxo::reference {

/// So many are worth the finest cells.
inline constexpr std::size_t kRaysForFinestCells = std::numeric_limits<std::uint32_t>::max();

/// Safe from any thread, but for prepareFor(). Keeps a copy of the surface.
class Shape {
 public:
  Shape(const Surface& surface, std::span<const double> parameters);

  /// The cells of a formula. Cost, on the first call: building them, unless prepareFor() has.
  [[nodiscard]] const CellTree& cells() const;
  /// Null for a formula. Cost, on the first call: building it.
  [[nodiscard]] const TriangleTree* triangles() const;
  /// Builds what rays need, unless it is there.
  void build() const;
  /// Builds the cells that so many more rays are best cast against: few rays find their way through few large
  /// cells sooner than many small ones are built, but leave more of them undecided. Nothing where a closed
  /// form answers; of triangles all. No other call at the same time.
  void prepareFor(std::size_t rays) const;
  [[nodiscard]] bool hasClosedForm() const { return !forms_.empty(); }
  [[nodiscard]] std::span<const ClosedForm> closedForms() const { return forms_; }

 private:
  Surface surface_;
  std::vector<double> parameters_;
  void buildCells(std::size_t mostCells) const;

  std::vector<ClosedForm> forms_;  ///< of every patch, or none
  mutable std::once_flag building_;
  mutable std::unique_ptr<const TriangleTree> triangles_;
  mutable std::size_t rays_ = 0;  ///< that were prepared for
  mutable std::unique_ptr<const CellTree> cells_;
};

/// A shape in the world.
class PlacedShape {
 public:
  PlacedShape(std::shared_ptr<const Shape> shape, const Transform& worldFromObject);

  /// By triangles; or by equations, and what these leave open by cells.
  [[nodiscard]] Roots nearestRoot(const Ray& ray, const RootQuery& query) const;

  [[nodiscard]] const Shape& shape() const { return *shape_; }
  [[nodiscard]] const Transform& worldFromObject() const { return worldFromObject_; }

 private:
  friend class RootWalk;

  /// Nothing where cells have to tell.
  [[nodiscard]] std::optional<Roots> withoutCells(const Ray& ray, const RootQuery& query) const;
  [[nodiscard]] bool passesBy(const Ray& ray) const;

  std::shared_ptr<const Shape> shape_;
  Transform worldFromObject_;
  std::optional<ObjectFromWorld> objectFromWorld_;  ///< where it is of use
  double radius_ = 0;  ///< with closed forms: of a ball around the origin's place
};

/// What a ray meets of a shape, one root after the other, in one traversal of its cells. The shape must
/// outlive it.
class RootWalk {
 public:
  RootWalk(const PlacedShape& shape, const Ray& ray, const RootQuery& query)
      : shape_(shape), ray_(ray), query_(query) {}

  /// As PlacedShape::nearestRoot() of the query from there on, which must not be nearer than the last time.
  [[nodiscard]] Roots from(double nearest);

 private:
  const PlacedShape& shape_;
  Ray ray_;
  RootQuery query_;
  std::optional<RootsInOrder> ofCells_;
};

/// Shapes by surface and parameter values. Not safe from several threads.
class ShapeCache {
 public:
  using Request = std::pair<Surface, std::vector<double>>;

  /// The shape of each request, in order. Shapes that were not asked for are forgotten.
  [[nodiscard]] std::vector<std::shared_ptr<const Shape>> shapes(std::span<const Request> requests);

 private:
  using Key = std::pair<const void*, std::vector<double>>;  // of the surface: its identity
  std::map<Key, std::shared_ptr<const Shape>> shapes_;
};

}  // namespace luxo::reference
