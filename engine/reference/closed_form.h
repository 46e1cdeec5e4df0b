// SPDX-License-Identifier: Apache-2.0
// Quadrics and the torus as equations: a ray meets them where a polynomial of degree 2 or 4 is zero.
//
// A patch is recognized by its points, not by its name: an equation is taken only when it and its solution
// for (u,v) give back the formula's own points. What rounding leaves open (rays that graze, or pass within
// 1e-12 of the edge of the domain) is not decided here; the cells of the surface are asked then.
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
  /// Rectangle, disk, cylinder, cone, sphere, ellipsoid, paraboloid, hyperboloid, one sheet of the
  /// hyperboloid of two, hyperbolic paraboloid, torus, at given parameter values; nothing for other patches.
  /// The formula's points agree with the form's within 1e-12 of its size at 100 places.
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
  /// xx x^2 + yy y^2 + zz z^2 + y y + constant = 0, in units of `scale_`; with `tube_` a torus of ring radius
  /// 1 and that tube radius.
  struct Equation {
    double xx = 0, yy = 0, zz = 0, y = 0, constant = 0;
  };
  /// What a parameter is a linear function of. Radius: sqrt(x^2 + z^2).
  enum class Along : std::uint8_t { X, Y, Z, Radius, Turn, Latitude, Tube };
  struct Parameter {
    Along along = Along::Turn;
    double start = 0, rate = 1;
  };
  struct Recognition;

  [[nodiscard]] double at(const Vec3& unitPoint) const;
  [[nodiscard]] Vec3 gradient(const Vec3& unitPoint) const;
  [[nodiscard]] double parameter(const Parameter& p, const Vec3& unitPoint) const;
  [[nodiscard]] Interval parameter(const Parameter& p, const IntervalVec& unitPoint) const;
  [[nodiscard]] Vec2 parametersOf(const Vec3& unitPoint) const;
  [[nodiscard]] bool agrees(const Surface& surface, std::span<const double> parameters);
  /// Whether a point of the equation is one of the patch; nothing when that is within rounding.
  [[nodiscard]] std::optional<bool> contains(const IntervalVec& unitPoint) const;

  /// The coefficients of F along a ray, and how many.
  [[nodiscard]] std::pair<std::array<Interval, 5>, std::size_t> polynomialAlong(
      const IntervalVec& origin, const IntervalVec& direction) const;
  [[nodiscard]] double polished(const RealRoot& root, const Vec3& origin, const Vec3& direction) const;

  std::uint32_t patch_ = 0;
  Domain domain_;
  Vec3 scale_{1};  ///< metres per unit, by axis
  Equation equation_;
  double tube_ = 0;
  Parameter u_, v_;
  double sheet_ = 0;    ///< sign of y where the equation has two sheets
  double reach_ = 1;    ///< of all points from the middle, in units
  double outward_ = 1;  ///< sign of F outside
};

}  // namespace luxo::reference
