// SPDX-License-Identifier: Apache-2.0
// Surfaces that are known as equations, too: quadrics and the torus are where a polynomial F(x, y, z) is
// zero.
//
// A patch is recognized by its points, not by its name or its text: an equation is taken only when it and its
// solution for (u, v) give back the formula's own points.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "math/bounds.h"
#include "math/vec.h"
#include "surface/patch.h"

namespace luxo {

class Surface;

/// F(x, y, z) = 0 of one patch, around the Y axis and in units of `scale`, and (u, v) of its points. F is
///
///     xx x^2 + yy y^2 + zz z^2 + y y + constant                  of a quadric,
///     (x^2 + y^2 + z^2 + 1 - tube^2)^2 - 4 (x^2 + z^2)           of a torus with a ring of radius 1.
struct Equation {
  enum class Form : std::uint8_t { Quadric, Torus };
  /// What a parameter is a linear function of. Radius: sqrt(x^2 + z^2). The last three are whole: a patch has
  /// all of the circle around the axis, of the meridian, of the circle around the tube.
  enum class Along : std::uint8_t { X, Y, Z, Radius, Turn, Latitude, Tube };
  struct Parameter {
    Along along = Along::Turn;
    double start = 0, rate = 1;
  };

  Vec3 scale{1};  ///< metres per unit, by axis
  double xx = 0, yy = 0, zz = 0, y = 0, constant = 0;
  double tube = 0;  ///< a torus where it is not 0
  Parameter u, v;
  double sheet = 0;    ///< sign of y where a quadric has two sheets, of which this is one
  double reach = 1;    ///< of all points from the middle, in units
  double outward = 1;  ///< sign of F on the outer side

  [[nodiscard]] Form form() const { return tube == 0 ? Form::Quadric : Form::Torus; }
  /// y = 0.
  [[nodiscard]] bool isPlane() const {
    return form() == Form::Quadric && xx == 0 && yy == 0 && zz == 0 && constant == 0;
  }
  [[nodiscard]] double at(const Vec3& unitPoint) const;
  [[nodiscard]] Vec3 gradient(const Vec3& unitPoint) const;
  /// Not clamped to the patch's domain.
  [[nodiscard]] Vec2 parametersOf(const Vec3& unitPoint) const;
  /// Where a domain ends, metres: in x, or (isRadial) in the distance from the axis, and in y and z; infinite
  /// where nothing ends.
  [[nodiscard]] Box edgesOf(const Domain& domain) const;
  [[nodiscard]] bool isRadial() const { return v.along == Along::Radius; }
  /// Where a quadric is written about, by y: its centre, which a cone has at its apex, as around it F is free
  /// of differences of large numbers. Not so far away that places lose more than F gains.
  [[nodiscard]] double center() const;
};

/// The equation of a rectangle, disk, cylinder, cone, sphere, ellipsoid, paraboloid, hyperboloid, one sheet
/// of the hyperboloid of two, hyperbolic paraboloid or torus at given parameter values; nothing for other
/// patches. The formula has no kinks, its points agree with the equation within 1e-12 of the size at 400
/// places, whose gaps are a sixteenth of the domain, and its degree (formula/degree.h) is 2 at most, of a
/// torus 1: so it has no points elsewhere. Cost: some 20 evaluations of the formula for other patches, 1200
/// for these.
[[nodiscard]] std::optional<Equation> equationOf(const Surface& surface, std::uint32_t patch,
                                                 std::span<const double> parameters);

/// Of every patch. Patches that share a function have equations of one form, or none: so they share code.
[[nodiscard]] std::vector<std::optional<Equation>> equationsOf(const Surface& surface,
                                                               std::span<const double> parameters);

/// Whether the surface is all of an ellipsoid or of a torus (which may pass through itself): there F has one
/// sign outside and the other behind what is seen from there. So whoever looks at it from outside sees its
/// outer side first. Of surfaces in general that is false, closed ones too: where one passes through itself,
/// parts of the space behind it are outside again, and turned inside out. Cost: that of equationOf(). Of
/// triangles: mesh/mesh_solid.h; those of one material among several bound nothing.
[[nodiscard]] bool boundsSolid(const Surface& surface, std::span<const double> parameters);

}  // namespace luxo
