// SPDX-License-Identifier: Apache-2.0
// Where a ray meets a quadric or a torus: a polynomial of degree 2 or 4 is zero (surface/equation.h).
//
// What rounding leaves open (rays that graze, or pass within 1e-12 of the edge of the domain) is not decided
// here; the cells of the surface are asked then.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

#include "math/interval.h"
#include "math/transform.h"
#include "reference/polynomial.h"
#include "reference/roots.h"
#include "surface/equation.h"
#include "surface/surface.h"

namespace luxo::reference {

using IntervalVec = std::array<Interval, 3>;

/// A world ray in object space, rounding enclosed: origin + t * direction, t in metres of the world.
struct ObjectRay {
  IntervalVec origin, direction;
};

/// The inverse of a transform, rounding enclosed.
class ObjectFromWorld {
 public:
  /// Nothing for what is singular within rounding.
  [[nodiscard]] static std::optional<ObjectFromWorld> of(const Transform& worldFromObject);

  [[nodiscard]] ObjectRay operator()(const Ray& ray) const;

 private:
  std::array<IntervalVec, 3> rows_;
  Vec3 translation_{0};
};

/// One patch: F(x, y, z) = 0 in object space, and (u,v) of its points.
class ClosedForm {
 public:
  /// Of a patch that has an equation at these parameter values; nothing for others.
  [[nodiscard]] static std::optional<ClosedForm> of(const Surface& surface, std::uint32_t patch,
                                                    std::span<const double> parameters);

  /// Of a ball around the origin that holds the patch. Object space.
  [[nodiscard]] double radius() const;

  struct Answer {
    bool decided = true;
    std::optional<Root> nearest;  ///< proven
  };
  /// Cost: a microsecond for quadrics, some five for the torus.
  [[nodiscard]] Answer nearestRoot(const ObjectRay& ray, const RootQuery& query) const;

 private:
  ClosedForm(const Equation& equation, std::uint32_t patch, const Domain& domain)
      : equation_(equation), patch_(patch), domain_(domain) {}

  [[nodiscard]] Vec2 parametersOf(const Vec3& unitPoint) const;
  /// Whether a point of the equation is one of the patch; nothing when that is within rounding.
  [[nodiscard]] std::optional<bool> contains(const IntervalVec& unitPoint) const;

  /// The coefficients of F along a ray, and how many.
  [[nodiscard]] std::pair<std::array<Interval, 5>, std::size_t> polynomialAlong(
      const IntervalVec& origin, const IntervalVec& direction) const;
  [[nodiscard]] double polished(const RealRoot& root, const Vec3& origin, const Vec3& direction) const;

  Equation equation_;
  std::uint32_t patch_;
  Domain domain_;
};

}  // namespace luxo::reference
