// SPDX-License-Identifier: Apache-2.0
// Surfaces with one side. Domains are chosen so that each edge is glued to a whole edge, forwards or
// backwards, and what collapses to a point is an edge.
#include <cmath>

#include "surface/catalogue_inputs.h"

namespace luxo {
namespace {

Surface makeMobius(const SurfaceInputs& in) {
  const Expr half = 0.5 * (in("half_twists") * in.phi());
  const Expr across = in("width") * (in.v() - 0.5);
  const Expr q = in("radius") + across * cos(half);
  return in.surface(upright(q * cos(in.phi()), q * sin(in.phi()), across * sin(half)));
}

/// The bottle of two formulas: around the loop (u < 1/2) and through itself (u > 1/2).
Surface makeKlein(const SurfaceInputs& in) {
  const Expr loop = in.phi(), scale = in("scale");
  // Around the tube from -pi/2: then the end of the tube meets its beginning backwards, edge on edge.
  const Expr q = kTau * in.v() - 0.5 * kPi;
  const Expr a = 0.3 * cos(loop) * (1 + sin(loop)), b = 0.8 * sin(loop), c = 0.2 - 0.1 * cos(loop);
  const auto scaled = [&](Expr x, Expr y, Expr z) { return point(scale * x, scale * y, scale * z); };
  return in.patchwork(
      {{scaled(a + c * (cos(loop) * cos(q)), b + c * (sin(loop) * cos(q)), c * sin(q)), {{0, 0.5}, {0, 1}}},
       {scaled(a - c * cos(q), b, c * sin(q)), {{0.5, 1}, {0, 1}}}});
}

Surface makeKleinFigure8(const SurfaceInputs& in) {
  const Expr half = 0.5 * in.phi(), q = kTau * in.v();
  const Expr ring = in("major") + in("minor") * (cos(half) * sin(q) - sin(half) * sin(2 * q));
  return in.surface(upright(ring * cos(in.phi()), ring * sin(in.phi()),
                            in("minor") * (sin(half) * sin(q) + cos(half) * sin(2 * q))));
}

Surface makeBoy(const SurfaceInputs& in) {
  // The pole is at both v edges: with q = pi v, the customary second parameter is pi/2 + q.
  const Expr p = kPi * (in.u() - 0.5), q = kPi * in.v(), scale = in("scale");
  const double root2 = std::sqrt(2.0);
  const Expr s2 = sin(q) * sin(q), twice = sin(2 * q);
  const Expr w = scale / (2 + root2 * (sin(3 * p) * twice));
  return in.surface(upright(w * (root2 * cos(2 * p) * s2 - cos(p) * twice),
                            w * (root2 * sin(2 * p) * s2 + sin(p) * twice), w * (3 * s2)));
}

/// The patches of a hemisphere whose opposite border points are one, so that half of its border is glued to
/// the other half.
std::vector<PatchPlace> hemisphere() { return {{{{0, 0.5}, {0, 1}}}, {{{0.5, 1}, {0, 1}}}}; }

/// S = g / |g|^2 with g = (-3/2 Im z(1 - z^4)/d, -3/2 Re z(1 + z^4)/d, Im (1 + z^6)/d - 1/2), z = r e^(i phi)
/// and d = z^6 + sqrt5 z^3 - 1, where g runs to infinity at the zeros of d. With g = (x, y, up) / |d|^2,
/// |(x, y, up)|^2 is divisible by |d|^2, because 9 z^6 - (1 + z^6)^2 = -d (z^6 - sqrt5 z^3 - 1): S is
/// (x, y, up) / w. In polar form all four are sums of waves; w is at least 1/4.
Surface makeBryantKusner(const SurfaceInputs& in) {
  const Expr r = in.v(), phi = in.phi(), r2 = r * r, r3 = pow(r, 3), r6 = pow(r, 6), r12 = pow(r, 12);
  const double root5 = std::sqrt(5.0), tilt = std::atan(0.5);
  const Expr once = r * (1 - pow(r, 10)), twice = root5 * (r2 * r2 * (1 + r2 * r2)),
             fivefold = pow(r, 5) * (1 - r2), threefold = r3 * (1 - r6);
  const Expr x = 1.5 * (once * sin(phi) + twice * sin(2 * phi) - fivefold * sin(5 * phi));
  const Expr y = 1.5 * (once * cos(phi) - twice * cos(2 * phi) + fivefold * cos(5 * phi));
  const Expr up = std::sqrt(10.0) * (threefold * cos(3 * phi + 0.25 * kPi)) -
                  root5 * (r6 * sin(6 * phi - tilt)) - 0.5 * (1 + r12 + 5 * r6);
  const Expr s = sin(3 * phi - tilt);
  const Expr w =
      0.25 * (1 + r12) + 2.25 * (r2 * (1 + pow(r, 8))) + r6 * (6.25 - 5 * (s * s)) + 2.5 * (threefold * s);
  const Expr k = in("scale") / w;
  return in.patchwork(upright(k * x, k * y, k * up), hemisphere());
}

Surface makeRoman(const SurfaceInputs& in) {
  const Expr phi = in.phi(), q = 0.5 * kPi * in.v(), level = 0.5 * in("scale") * sin(2 * q);
  return in.patchwork(
      upright(level * sin(phi), level * cos(phi), 0.5 * in("scale") * (sin(q) * sin(q) * sin(2 * phi))),
      hemisphere());
}

Surface makeCrossCap(const SurfaceInputs& in) {
  // An eighth of a turn on: otherwise each half of the border is its own mirror image, glued to nobody knows
  // which end of the other.
  const Expr phi = in.phi() + 0.25 * kPi, q = 0.5 * kPi * in.v(), level = 0.5 * in("scale") * sin(2 * q);
  const Expr x = sin(q) * cos(phi);
  return in.patchwork(
      upright(level * cos(phi), level * sin(phi), 0.5 * in("scale") * (cos(q) * cos(q) - x * x)),
      hemisphere());
}

}  // namespace

std::vector<CatalogueEntry> oneSidedSurfaces() {
  const CatalogueArgument scale = length("scale", 1, "metres per unit of the equation");
  return {
      {.name = "mobius",
       .summary = "the strip with a half twist, around the origin",
       .equation = "(q cos phi, t sin(n phi/2), -q sin phi), q = r + t cos(n phi/2), t = width (v - 1/2)",
       .source = "Moebius 1858",
       .arguments = {length("radius", 1, "of the middle line"), length("width", 0.5, "of the strip"),
                     count("half_twists", 1, "n: two sides when even", {0, 100})},
       .requirement = "width smaller than 2 radius",
       .orientable = false,
       .eulerCharacteristic = 0,
       .meets = [](std::span<const double> a) { return a[1] < 2 * a[0]; },
       .make = makeMobius},
      {.name = "klein",
       .summary =
           "the lecture's Klein bottle: of two formulas, which meet with a slight kink (up to 10.4 degrees)",
       .equation = "(a + c cos p cos q, b + c sin p cos q, c sin q) for p = phi < pi, else (a - c cos q, b, "
                   "c sin q); "
                   "a = 0.3 cos p (1 + sin p), b = 0.8 sin p, c = 0.2 - 0.1 cos p, q = 2 pi v - pi/2",
       .source = "Bourke 1996; Szirmay-Kalos, 3D engine-let",
       .arguments = {scale},
       .borderless = true,
       .orientable = false,
       .eulerCharacteristic = 0,
       .make = makeKlein},
      {.name = "klein_figure8",
       .summary = "Klein's bottle as a figure 8 that turns over once on its way around Y",
       .equation = "(R cos phi, m (sin h sin q + cos h sin 2q), -R sin phi), R = major + m (cos h sin q - "
                   "sin h sin 2q), "
                   "h = phi/2, q = 2 pi v, m = minor",
       .source = "Franzoni, The Klein Bottle: Variations on a Theme, Notices AMS 2012",
       .arguments = {length("major", 2, "radius of the ring"),
                     length("minor", 1, "half height of the 8's lobes")},
       .requirement = "major larger than 1.25 minor",
       .borderless = true,
       .orientable = false,
       .eulerCharacteristic = 0,
       .meets = [](std::span<const double> a) { return a[0] > 1.25 * a[1]; },
       .make = makeKleinFigure8},
      {.name = "boy",
       .summary = "Boy's surface, the projective plane without a pinch; from the origin up",
       .equation =
           "(sqrt2 cos 2p sin^2 q - cos p sin 2q, 3 sin^2 q, -(sqrt2 sin 2p sin^2 q + sin p sin 2q)) / "
           "(2 + sqrt2 sin 3p sin 2q), p = pi (u - 1/2), q = pi v",
       .source = "Apery, Models of the Real Projective Plane, 1987; the lecture's has scale 1/1.8",
       .arguments = {scale},
       .borderless = true,
       .orientable = false,
       .make = makeBoy},
      {.name = "boy_bryant_kusner",
       .summary = "Boy's surface of least bending energy; the triple point is the origin",
       .equation = "g/|g|^2, g = (-3/2 Im z(1 - z^4)/d, Im (1 + z^6)/d - 1/2, 3/2 Re z(1 + z^4)/d), "
                   "d = z^6 + sqrt5 z^3 - 1, z = v e^(i phi)",
       .source = "Kusner, Bulletin AMS 17 (1987)",
       .arguments = {scale},
       .borderless = true,
       .orientable = false,
       .make = makeBryantKusner},
      {.name = "steiner_roman",
       .summary = "Steiner's Roman surface, a projective plane with six pinches, where it has no normal",
       .equation =
           "scale (Y Z, X Y, -X Z) for the points (X, Y, Z) = (sin q cos phi, sin q sin phi, cos q) of the "
           "hemisphere, q = pi v/2: x^2 y^2 + y^2 z^2 + z^2 x^2 + scale x y z = 0",
       .source = "Steiner 1844",
       .arguments = {scale},
       .borderless = true,
       .orientable = false,
       .make = makeRoman},
      {.name = "cross_cap",
       .summary = "the cross-cap, a projective plane with two pinches, where it has no normal",
       .equation =
           "scale/2 (sin 2q cos p, cos^2 q - cos^2 p sin^2 q, -sin 2q sin p), p = phi + pi/4, q = pi v/2",
       .source = "Hilbert, Cohn-Vossen, Geometry and the Imagination, section 46",
       .arguments = {scale},
       .borderless = true,
       .orientable = false,
       .make = makeCrossCap},

  };
}

}  // namespace luxo
