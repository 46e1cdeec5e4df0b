// SPDX-License-Identifier: Apache-2.0
// Quadrics and other surfaces of low degree.
#include "surface/catalogue_inputs.h"

namespace luxo {
namespace {

/// From -1 at v = 0 to 1 at v = 1.
Expr across(Expr v) { return 2 * v - 1; }

Surface makeHyperboloid(const SurfaceInputs& in) {
  // By height, not by the usual cosh and sinh: smooth too, and the rims are where they are asked to be.
  const Expr s = across(in.v()), waist = in("radius"), rim = in("top_radius");
  return in.revolve(sqrt(waist * waist + (rim * rim - waist * waist) * (s * s)), in("height") * (0.5 * s));
}

Surface makeTwoSheets(const SurfaceInputs& in) {
  const Expr gap = in("gap"), height = in("height");
  const auto sheet = [&](Expr distance, double side) {
    const Expr y = (0.5 * side) * sqrt(gap * gap + (height * height - gap * gap) * (distance * distance));
    const Expr r = in("radius") * distance;
    return point(r * cos(in.phi()), y, -(r * sin(in.phi())));
  };
  return in.patchwork({{sheet(1 - 2 * in.v(), -1), {{0, 1}, {0, 0.5}}},  //
                       {sheet(2 * in.v() - 1, 1), {{0, 1}, {0.5, 1}}}});
}

Surface makeSaddle(const SurfaceInputs& in) {
  const Expr s = across(in.u()), t = across(in.v());
  return in.surface(point(in("size", 0) * (in.u() - 0.5), 0.5 * in("height") * (s * s - t * t),
                          -(in("size", 1) * (in.v() - 0.5))));
}

Surface makeMonkeySaddle(const SurfaceInputs& in) {
  const Expr r = in("radius") * in.v(), phi = in.phi();
  return in.surface(
      point(r * cos(phi), 0.5 * in("height") * (pow(in.v(), 3) * cos(3 * phi)), -(r * sin(phi))),
      {.orientation = -1});
}

Surface makeCyclide(const SurfaceInputs& in) {
  const Expr a = in("major"), d = in("minor"), c = in("offset");
  const Expr cu = cos(in.phi()), su = sin(in.phi()), cv = cos(kTau * in.v()), sv = sin(kTau * in.v());
  const Expr squared = a * a - c * c, w = a - c * (cu * cv);
  return in.surface(upright((d * (c - a * (cu * cv)) + squared * cu) / w,  //
                            sqrt(squared) * su * (a - d * cv) / w,         //
                            sqrt(squared) * sv * (c * cu - d) / w));
}

Surface makeWhitneyUmbrella(const SurfaceInputs& in) {
  const Expr s = across(in.u()), t = across(in.v()), scale = in("scale");
  return in.surface(upright(scale * (s * t), scale * s, scale * (t * t)));
}

}  // namespace

std::vector<CatalogueEntry> algebraicSurfaces() {
  return {
      {.name = "hyperboloid",
       .summary = "of one sheet, the cooling tower; centred on the origin",
       .equation =
           "(R cos phi, h s/2, -R sin phi), s = 2v - 1, R^2 = radius^2 + (top_radius^2 - radius^2) s^2",
       .source = "quadric (x^2 + z^2)/a^2 - y^2/c^2 = 1",
       .arguments = {length("radius", 0.5, "of the waist"), length("top_radius", 1, "of both rims"),
                     length("height", 2, "from rim to rim")},
       .requirement = "top_radius larger than radius",
       .eulerCharacteristic = 0,
       .meets = [](std::span<const double> a) { return a[1] > a[0]; },
       .make = makeHyperboloid},
      {.name = "hyperboloid2",
       .summary = "of two sheets, one bowl above and one below the origin; outside is the convex side",
       .equation =
           "(radius s cos phi, y, -radius s sin phi), s = |2v - 1|, 4 y^2 = gap^2 + (height^2 - gap^2) s^2, "
           "y < 0 for v < 1/2",
       .source = "quadric y^2/c^2 - (x^2 + z^2)/a^2 = 1",
       .arguments = {length("radius", 1, "of both rims"), length("gap", 0.8, "between the two vertices"),
                     length("height", 2.4, "from rim to rim")},
       .requirement = "height larger than gap",
       .eulerCharacteristic = 2,
       .meets = [](std::span<const double> a) { return a[2] > a[1]; },
       .make = makeTwoSheets},
      {.name = "hyperbolic_paraboloid",
       .summary = "the saddle over a rectangle, centred on the origin",
       .equation = "(x s/2, height (s^2 - t^2)/2, -z t/2), s = 2u - 1, t = 2v - 1, size = [x, z]",
       .source = "quadric",
       .arguments = {{"size", "edges along X and Z", ArgumentKind::Length, {2, 2}, kLengthRange},
                     length("height", 1, "from the lowest point to the highest")},
       .make = makeSaddle},
      {.name = "monkey_saddle",
       .summary = "the saddle with three ways down, over a disk",
       .equation = "(r v cos phi, height v^3 cos(3 phi)/2, -r v sin phi): y ~ x^3 - 3 x z^2",
       .source = "Hilbert, Cohn-Vossen, Geometry and the Imagination, section 28",
       .arguments = {length("radius", 1, "of the disk"),
                     length("height", 1, "from the lowest point to the highest")},
       .make = makeMonkeySaddle},
      {.name = "dupin_cyclide",
       .summary = "the ring cyclide: a torus whose tube is thin on one side, thick on the other",
       .equation =
           "(d (c - a cos phi cos q) + b^2 cos phi, b sin q (c cos phi - d), -b sin phi (a - d cos q)) / "
           "(a - c cos phi cos q), q = 2 pi v, b^2 = a^2 - c^2",
       .source = "Dupin 1822; (x^2 + y^2 + z^2 - d^2 + b^2)^2 = 4 (a x - c d)^2 + 4 b^2 z^2",
       .arguments = {length("major", 1, "a: half the length between the tube's middles"),
                     length("minor", 0.5, "d: mean radius of the tube"),
                     length("offset", 0.3, "c: how much the tube's radius varies; 0 is a torus",
                            {0, kLengthRange.hi})},
       .requirement = "offset smaller than minor and minor smaller than major",
       .borderless = true,
       .eulerCharacteristic = 0,
       .meets = [](std::span<const double> a) { return a[2] < a[1] && a[1] < a[0]; },
       .make = makeCyclide},
      {.name = "whitney_umbrella",
       .summary = "a sheet that passes through itself along +Y, down to a pinch at the origin, where it has "
                  "no normal",
       .equation = "scale (s t, t^2, -s), s = 2u - 1, t = 2v - 1: x^2 = y z^2",
       .source = "Whitney 1944",
       .arguments = {length("scale", 1, "metres per unit of the equation")},
       .make = makeWhitneyUmbrella},

  };
}

}  // namespace luxo
