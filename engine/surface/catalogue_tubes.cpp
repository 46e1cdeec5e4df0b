// SPDX-License-Identifier: Apache-2.0
// Tubes around curves, and a shell.
#include <cmath>
#include <numeric>

#include "surface/catalogue_inputs.h"

namespace luxo {
namespace {

/// Components along "outward", "onward" (as phi grows) and up, at an angle around the axis.
template <class Number>
struct Cylindrical {
  Number out, on, up;
};

ExprPoint placed(const Cylindrical<Expr>& p, Expr turn) {
  return upright(p.out * cos(turn) - p.on * sin(turn), p.out * sin(turn) + p.on * cos(turn), p.up);
}

Surface makeSpring(const SurfaceInputs& in) {
  // v goes around the wire, in the plane across it: spanned by "outward" and by `slope` of the tangent.
  const Expr turn = in("turns") * in.phi(), wire = in("minor");
  const Expr rise = in("height") / (kTau * in("turns")),
             speed = sqrt(in("major") * in("major") + rise * rise);
  const Expr c = wire * cos(kTau * in.v()), s = wire * sin(kTau * in.v()) / speed;
  return in.surface(
      placed({in("major") + c, -(rise * s), in("height") * (in.u() - 0.5) + in("major") * s}, turn));
}

Surface makeTwistedTorus(const SurfaceInputs& in) {
  const Expr q = kTau * in.v();
  const Expr r = in("minor") * (1 + in("depth") * cos(in("lobes") * q - in("twists") * in.phi()));
  return in.surface(placed({in("major") + r * cos(q), 0, r * sin(q)}, in.phi()));
}

Surface makeTorusKnot(const SurfaceInputs& in) {
  // The curve lies on a torus, whose normal n is never along it: n and tangent x n span the tube's section.
  const Expr around = in("p") * in.phi(), through = in("q") * in.phi();
  const Expr distance = in("major") + in("minor") * cos(through);
  const Expr on = in("p") * distance, along = in("minor") * in("q"), speed = sqrt(on * on + along * along);
  const Expr c = in("tube") * cos(kTau * in.v()), s = in("tube") * sin(kTau * in.v()) / speed;
  // Tangent: `on` onward, `along` in the direction (-sin, cos) of (out, up); n = (cos, sin) of (out, up).
  return in.surface(placed({distance + c * cos(through) + s * (on * sin(through)), s * along,
                            in("minor") * sin(through) + c * sin(through) - s * (on * cos(through))},
                           around));
}

/// The curve of makeTorusKnot() may be thickened up to its smallest radius of curvature.
bool knotBendsEnough(std::span<const double> a) {
  const double major = a[0], minor = a[1], tube = a[2], p = a[3], q = a[4];
  if (!(minor < major) || std::gcd(static_cast<int>(p), static_cast<int>(q)) != 1) return false;
  constexpr int kSteps = 256;
  for (int i = 0; i <= kSteps; ++i) {
    const double t = kPi * i / kSteps, c = minor * std::cos(t), s = minor * std::sin(t), distance = major + c;
    const Cylindrical<double> first{-q * s, p * distance, q * c};
    const Cylindrical<double> second{-q * q * c - p * p * distance, -2 * p * q * s, -q * q * s};
    const Vec3 velocity(first.out, first.on, first.up), bend(second.out, second.on, second.up);
    const double speed = glm::length(velocity);
    if (tube * glm::length(glm::cross(velocity, bend)) >= 0.999 * speed * speed * speed) return false;
  }
  return true;
}

Surface makeSeashell(const SurfaceInputs& in) {
  const Expr turn = in("turns") * in.phi(), size = exp(log(in("growth")) * (in("turns") * (in.u() - 1)));
  const Expr q = kTau * in.v(), height = in("height");
  return in.surface(placed({size * (in("ring") + in("radius") * cos(q)), 0,
                            size * (in("radius") * sin(q) - height) + 0.5 * height},
                           turn));
}

}  // namespace

std::vector<CatalogueEntry> tubeSurfaces() {
  return {
      {.name = "spring",
       .summary = "a round wire along a helix, open at both ends; centred on the origin",
       .equation = "helix c(p) = (major cos p, height (u - 1/2), -major sin p), p = turns phi, plus minor "
                   "(cos q out + "
                   "sin q (out x tangent)), q = 2 pi v",
       .source = "the tube of a curve of constant curvature",
       .arguments = {length("major", 1, "radius of the coil, to the middle of the wire"),
                     length("minor", 0.15, "radius of the wire"),
                     length("height", 2, "from end to end, middle of the wire"),
                     number("turns", 4, "around the axis", {0.01, 1000})},
       .requirement = "minor smaller than major",
       .eulerCharacteristic = 0,
       .meets = [](std::span<const double> a) { return a[1] < a[0]; },
       .make = makeSpring},
      {.name = "twisted_torus",
       .summary = "a torus whose section has lobes that wind around it; centred on the origin",
       .equation = "(R cos phi, r sin q, -R sin phi), R = major + r cos q, r = minor (1 + depth cos(lobes q "
                   "- twists phi)), "
                   "q = 2 pi v",
       .source = "a torus in polar coordinates of its section",
       .arguments = {length("major", 1, "radius of the ring"),
                     length("minor", 0.35, "mean radius of the section"),
                     number("depth", 0.25, "of the lobes, as part of minor", {0, 0.99}),
                     count("lobes", 3, "around the section", {0, 1000}),
                     count("twists", 4, "lobes passed on the way around the ring", {-1000, 1000})},
       .requirement = "major larger than minor (1 + depth)",
       .borderless = true,
       .eulerCharacteristic = 0,
       .meets = [](std::span<const double> a) { return a[0] > a[1] * (1 + a[2]); },
       .make = makeTwistedTorus},
      {.name = "torus_knot",
       .summary =
           "a tube along the (p, q) torus knot: p times around Y while it goes q times through the ring",
       .equation =
           "c = (R cos a, minor sin b, -R sin a), R = major + minor cos b, a = p phi, b = q phi, plus "
           "tube (cos t n + sin t (tangent x n)), t = 2 pi v, n the normal of the torus",
       .source = "Adams, The Knot Book, section 5.1",
       .arguments = {length("major", 1, "radius of the torus"),
                     length("minor", 0.4, "radius of the torus' tube"),
                     length("tube", 0.15, "radius of the tube along the knot"),
                     count("p", 2, "around the axis", {1, 100}), count("q", 3, "through the ring", {1, 100})},
       .requirement =
           "minor smaller than major, p and q without a common divisor, and tube smaller than the knot's "
           "radius of curvature",
       .borderless = true,
       .eulerCharacteristic = 0,
       .meets = knotBendsEnough,
       .make = makeTorusKnot},
      {.name = "seashell",
       .summary = "a tube that grows on its way around Y, its mouth open and its tip up",
       .equation = "(s (ring + r cos q) cos p, s (r sin q - height) + height/2, -s (ring + r cos q) sin p), "
                   "p = turns phi, s = growth^(turns (u - 1)), q = 2 pi v",
       .source = "Thompson, On Growth and Form, chapter XI",
       .arguments = {length("radius", 0.4, "r: of the tube, at the mouth"),
                     length("ring", 0.42, "from the axis to the mouth's middle"),
                     length("height", 1.8, "from the tip to the mouth's middle"),
                     number("growth", 1.7, "factor per turn", {1.01, 100}),
                     number("turns", 6, "around the axis", {0.01, 100})},
       .requirement = "ring larger than radius",
       .eulerCharacteristic = 0,
       .meets = [](std::span<const double> a) { return a[1] > a[0]; },
       .make = makeSeashell},
  };
}

}  // namespace luxo
