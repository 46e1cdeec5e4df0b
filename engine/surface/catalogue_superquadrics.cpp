// SPDX-License-Identifier: Apache-2.0
// Surfaces with powers of sines: exponent 1 is round, toward 0 it becomes a box, 2 is an octahedron.
//
// sgn(cos)|cos|^e has no derivative at the axes. So the curve |x|^p + |y|^p = 1, p = 2/e, is cut at the axes
// and at the diagonals into eight pieces; a piece beside an axis, t = 0 on the axis and 1 on the diagonal, is
// (1, t) / (1 + t^p)^(1/p), mirrored and turned. This is smooth up to both ends for p >= 2. For 1 < p < 2 the
// curve itself is infinitely curved at the axes: there t^2 takes the place of t, so that the second
// derivatives stay finite. For p = 1 the piece is straight, and written so.
#include <cmath>
#include <optional>

#include "surface/catalogue_inputs.h"

namespace luxo {
namespace {

/// What tells a piece apart from the others.
struct Piece {
  double axis;  ///< the piece counter's value on the axis
  double side;  ///< 1 when the piece comes after the axis, -1 when it leads up to it
  double cosine, sine;
};

/// Piece `index` runs over [index, index + 1] of the counter, eight to a turn; the axes are at even values.
Piece pieceAt(int index) {
  constexpr double kCosine[] = {1, 0, -1, 0};
  const bool after = index % 2 == 0;
  const int axis = after ? index : index + 1, quarter = ((axis / 2) % 4 + 4) % 4;
  return {static_cast<double>(axis), after ? 1.0 : -1.0, kCosine[quarter], kCosine[(quarter + 3) % 4]};
}

struct Curve {
  Expr cosine, sine;
};

/// The cosine and the sine at `counter` to the power of an exponent; the piece is patch constants `first` and
/// on.
Curve superellipse(const SurfaceInputs& in, Expr counter, std::size_t which, std::uint32_t first) {
  const Expr exponent = in("exponents", which);
  const std::optional<double> known = in.constant("exponents", which);
  const Expr side = in.patchConstant(first + 1), cosine = in.patchConstant(first + 2),
             sine = in.patchConstant(first + 3);
  const Expr t = side * (counter - in.patchConstant(first));
  const auto turned = [&](Expr along, Expr across) {
    return Curve{cosine * along - sine * (side * across), sine * along + cosine * (side * across)};
  };
  if (known == 2) return turned(1 - 0.5 * t, 0.5 * t);
  const bool regular = known && *known <= 1;
  const Expr p = 2 / exponent;
  const Expr along = pow(1 + pow(t, regular ? p : 2 * p), -0.5 * exponent);
  return turned(along, (regular ? t : t * t) * along);
}

/// All patches whose u pieces and v pieces lie in [0, 8) and [vFirst, vLast).
std::vector<PatchPlace> pieces(int vFirst, int vLast) {
  std::vector<PatchPlace> places;
  const auto span = [](int index, int first, int count) {
    return Interval(static_cast<double>(index - first) / count,
                    static_cast<double>(index - first + 1) / count);
  };
  for (int j = vFirst; j < vLast; ++j)
    for (int i = 0; i < 8; ++i) {
      const Piece a = pieceAt(i), b = pieceAt(j);
      places.push_back({{span(i, 0, 8), span(j, vFirst, vLast - vFirst)},
                        {a.axis, a.side, a.cosine, a.sine, b.axis, b.side, b.cosine, b.sine}});
    }
  return places;
}

Surface makeSuperellipsoid(const SurfaceInputs& in) {
  const Curve level = superellipse(in, 4 * in.v() - 2, 0, 4);
  const Curve around = superellipse(in, 8 * in.u(), 1, 0);
  return in.patchwork(point(in("radii", 0) * (level.cosine * around.cosine), in("radii", 1) * level.sine,
                            -(in("radii", 2) * (level.cosine * around.sine))),
                      pieces(-2, 2));
}

Surface makeSupertoroid(const SurfaceInputs& in) {
  const Curve tube = superellipse(in, 8 * in.v(), 0, 4);
  const Curve ring = superellipse(in, 8 * in.u(), 1, 0);
  const Expr distance = in("major") + in("minor") * tube.cosine;
  return in.patchwork(point(distance * ring.cosine, in("minor") * tube.sine, -(distance * ring.sine)),
                      pieces(0, 8));
}

}  // namespace

std::vector<CatalogueEntry> superquadrics() {
  constexpr Interval kExponent{0.05, 2};
  return {
      {.name = "superellipsoid",
       .summary = "between box, ellipsoid and octahedron; centred on the origin",
       .equation =
           "(a C(L,e) C(phi,f), b S(L,e), -c C(L,e) S(phi,f)), C(x,e) = sgn(cos x) |cos x|^e, S with sin; "
           "L from -pi/2 to pi/2; radii = [a, b, c], exponents = [e, f]",
       .source = "Barr, Superquadrics and Angle-Preserving Transformations, IEEE CG&A 1981",
       .arguments = {{"radii", "half axes along X, Y and Z", ArgumentKind::Length, {1, 1, 1}, kLengthRange},
                     {"exponents",
                      "e of the meridians, f of the equator",
                      ArgumentKind::Number,
                      {0.5, 0.5},
                      kExponent}},
       .borderless = true,
       .eulerCharacteristic = 2,
       .patchConstants = 8,
       .make = makeSuperellipsoid},
      {.name = "supertoroid",
       .summary = "a torus with square or diamond sections; centred on the origin",
       .equation = "(R C(phi,f), minor S(q,e), -R S(phi,f)), R = major + minor C(q,e), q = 2 pi v; "
                   "C and S as for superellipsoid, exponents = [e, f]",
       .source = "Barr, Superquadrics and Angle-Preserving Transformations, IEEE CG&A 1981",
       .arguments =
           {length("major", 1, "radius of the ring, to the middle of the tube"),
            length("minor", 0.4, "radius of the tube"),
            {"exponents", "e of the tube, f of the ring", ArgumentKind::Number, {0.5, 0.5}, kExponent}},
       .requirement = "major larger than minor",
       .borderless = true,
       .eulerCharacteristic = 0,
       .meets = [](std::span<const double> a) { return a[0] > a[1]; },
       .patchConstants = 8,
       .make = makeSupertoroid},
  };
}

}  // namespace luxo
