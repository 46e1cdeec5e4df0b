// SPDX-License-Identifier: Apache-2.0
// Surfaces of constant negative curvature, and minimal surfaces.
#include "surface/catalogue_inputs.h"

namespace luxo {
namespace {

Surface makeTractricoid(const SurfaceInputs& in) {
  const Expr t = in("extent") * in.v();
  return in.revolve(in("radius") / cosh(t), in("radius") * (t - tanh(t)));
}

Surface makeDini(const SurfaceInputs& in) {
  const Expr turn = in("turns") * in.phi();
  const Expr t = in("tip") * (1 - in.v()) + in("rim") * in.v();
  const Expr r = in("radius") * sin(t);
  return in.surface(upright(r * cos(turn), r * sin(turn),
                            in("radius") * (cos(t) + log(tan(0.5 * t))) + in("pitch") * turn));
}

Surface makeHelicoid(const SurfaceInputs& in) {
  const Expr turn = in("turns") * in.phi(), r = in("radius") * (2 * in.v() - 1);
  return in.surface(point(r * cos(turn), in("height") * (in.u() - 0.5), -(r * sin(turn))));
}

Surface makeCatenoid(const SurfaceInputs& in) {
  const Expr y = in("height") * (in.v() - 0.5);
  return in.revolve(in("radius") * cosh(y / in("radius")), y);
}

Surface makeEnneper(const SurfaceInputs& in) {
  const Expr r = in("extent") * in.v(), phi = in.phi(), third = pow(r, 3) / 3;
  const Expr x = r * cos(phi) - third * cos(3 * phi);
  const Expr y = r * sin(phi) + third * sin(3 * phi);
  const Expr scale = in("scale");
  return in.surface(upright(scale * x, scale * y, scale * (r * r * cos(2 * phi))), {.orientation = -1});
}

Surface makeScherk(const SurfaceInputs& in) {
  const Expr extent = in("extent"), size = in("size"), beyond = 0.5 * (1 - extent);
  // Over 2: cos y = 2 sin sin of half the angles from the two poles, each told by its distance, so that next
  // to a pole nothing of it is rounded away.
  const auto logOfCosine = [&](Expr t) {
    return log(sin(0.5 * kPi * (beyond + extent * t))) + log(sin(0.5 * kPi * (beyond + extent * (1 - t))));
  };
  return in.surface(upright(size * (extent * (in.u() - 0.5)), size * (extent * (in.v() - 0.5)),
                            size / kPi * (logOfCosine(in.v()) - logOfCosine(in.u()))));
}

}  // namespace

std::vector<CatalogueEntry> curvatureSurfaces() {
  return {
      {.name = "tractricoid",
       .summary = "the pseudosphere: Gaussian curvature -1/radius^2; the rim, a cusp edge, around the origin",
       .equation = "r (cos phi / cosh t, t - tanh t, -sin phi / cosh t), t = extent v",
       .source = "Beltrami 1868; the turned tractrix",
       .arguments = {length("radius", 1, "of the rim"),
                     number("extent", 3, "t at the tip: the radius there is radius / cosh(extent)",
                            {0.01, 20})},
       .eulerCharacteristic = 0,
       .make = makeTractricoid},
      {.name = "dini",
       .summary = "the twisted pseudosphere: Gaussian curvature -1/(radius^2 + pitch^2)",
       .equation = "(a sin q cos p, a (cos q + ln tan q/2) + pitch p, -a sin q sin p), p = turns phi, "
                   "q from tip to rim, a = radius",
       .source = "Dini 1865",
       .arguments = {length("radius", 1, "of the rim at q = pi/2"),
                     length("pitch", 0.15, "rise per radian", {-kLengthRange.hi, kLengthRange.hi}),
                     number("turns", 2, "around the axis", {0.001, 1000}),
                     angle("tip", 0.1, "q where it is thin", {1e-6, kPi / 2}),
                     angle("rim", 1, "q where it is wide; pi/2 is the cusp edge", {1e-6, kPi / 2})},
       .requirement = "tip smaller than rim",
       .meets = [](std::span<const double> a) { return a[3] < a[4]; },
       .make = makeDini},
      {.name = "helicoid",
       .summary = "the spiral staircase, a minimal surface; centred on the origin",
       .equation = "(r cos p, height (u - 1/2), -r sin p), p = turns phi, r = radius (2v - 1)",
       .source = "Meusnier 1776",
       .arguments = {length("radius", 1, "from the axis to the edges"), length("height", 2, "along the axis"),
                     number("turns", 1, "around the axis; left-handed when negative", {-1000, 1000})},
       .make = makeHelicoid},
      {.name = "catenoid",
       .summary = "the soap film between two rings, a minimal surface; centred on the origin",
       .equation = "(r cosh(y/r) cos phi, y, -r cosh(y/r) sin phi), y = height (v - 1/2)",
       .source = "Euler 1744",
       .arguments = {length("radius", 0.5, "of the neck"), length("height", 1, "from ring to ring")},
       .requirement = "height at most 100 times radius",
       .eulerCharacteristic = 0,
       .meets = [](std::span<const double> a) { return a[1] <= 100 * a[0]; },
       .make = makeCatenoid},
      {.name = "enneper",
       .summary = "Enneper's minimal surface; it meets itself when extent is above sqrt 3",
       .equation = "scale (r cos phi - r^3 cos(3 phi)/3, r^2 cos(2 phi), -(r sin phi + r^3 sin(3 phi)/3)), "
                   "r = extent v",
       .source = "Enneper 1864",
       .arguments = {length("scale", 0.5, "metres per unit of the equation"),
                     number("extent", 1.6, "r at the border", {0.001, 100})},
       .make = makeEnneper},
      {.name = "scherk",
       .summary = "one cell of Scherk's first minimal surface",
       .equation = "(c x, c ln(cos z / cos x), -c z), x = pi extent (u - 1/2), z = pi extent (v - 1/2), "
                   "c = size / pi",
       .source = "Scherk 1834",
       .arguments = {length("size", 2, "edge of a whole cell"),
                     number("extent", 0.95, "how much of the cell, whose corners are infinitely far",
                            {0.001, 0.999})},
       .make = makeScherk},
  };
}

}  // namespace luxo
