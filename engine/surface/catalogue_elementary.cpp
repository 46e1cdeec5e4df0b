// SPDX-License-Identifier: Apache-2.0
// The bodies that scenes are built of.
#include <algorithm>

#include "surface/catalogue_inputs.h"
#include "surface/teapot.h"

namespace luxo {
namespace {

Surface makeRectangle(const SurfaceInputs& in) {
  return in.surface(point(in("size", 0) * (in.u() - 0.5), 0, -(in("size", 1) * (in.v() - 0.5))),
                    {.flatNormal = Vec3(0, 1, 0)});
}

Surface makeDisk(const SurfaceInputs& in) {
  // Su x Sv points down.
  return in.revolve(in("radius") * in.v(), 0, {.orientation = -1, .flatNormal = Vec3(0, 1, 0)});
}

Surface makeCylinder(const SurfaceInputs& in) { return in.revolve(in("radius"), in("height") * in.v()); }

Surface makeCone(const SurfaceInputs& in) {
  return in.revolve(in("radius") * (1 - in.v()) + in("top_radius") * in.v(), in("height") * in.v());
}

Expr latitude(const SurfaceInputs& in) { return kPi * (in.v() - 0.5); }

Surface makeSphere(const SurfaceInputs& in) {
  return in.revolve(in("radius") * cos(latitude(in)), in("radius") * sin(latitude(in)));
}

Surface makeEllipsoid(const SurfaceInputs& in) {
  const Expr level = cos(latitude(in));
  return in.surface(point(in("radii", 0) * (level * cos(in.phi())), in("radii", 1) * sin(latitude(in)),
                          -(in("radii", 2) * (level * sin(in.phi())))));
}

Surface makeParaboloid(const SurfaceInputs& in) {
  const Expr rim = 2 * sqrt(in("focal_length") * in("height"));
  SurfaceTraits traits;
  if (const auto f = in.constant("focal_length"), h = in.constant("height"); f && h)
    traits.paraboloid = Paraboloid{*f, *h};
  return in.revolve(rim * in.v(), in("height") * (in.v() * in.v()), std::move(traits));
}

Surface makeTorus(const SurfaceInputs& in) {
  return in.revolve(in("major") + in("minor") * cos(kTau * in.v()), in("minor") * sin(kTau * in.v()));
}

Surface makeFlag(const SurfaceInputs& in) {
  return in.surface(point(in("width") * in.u(), in("height") * in.v(),
                          in("depth") * sin(in("waves") * in.u() + in("phase"))));
}

Surface makeTeapot(const SurfaceInputs& in) { return teapot(*in.constant("height")); }

constexpr Interval kAnyLength{-kLengthRange.hi, kLengthRange.hi};
constexpr Interval kRadiusOrApex{0, kLengthRange.hi};

}  // namespace

std::vector<CatalogueEntry> elementarySurfaces() {
  return {
      {.name = "rectangle",
       .summary = "flat, centred on the origin, normal +Y",
       .equation = "(x (u - 1/2), 0, -z (v - 1/2)), size = [x, z]",
       .source = "plane geometry",
       .arguments = {{"size", "edges along X and Z", ArgumentKind::Length, {1, 1}, kLengthRange}},
       .make = makeRectangle},
      {.name = "disk",
       .summary = "flat, centred on the origin, normal +Y",
       .equation = "r v (cos phi, 0, -sin phi)",
       .source = "plane geometry",
       .arguments = {length("radius", 1, "of the rim")},
       .make = makeDisk},
      {.name = "cylinder",
       .summary = "round, without lids, rises from the origin",
       .equation = "(r cos phi, h v, -r sin phi)",
       .source = "solid geometry",
       .arguments = {length("radius", 1, "of the cylinder"), length("height", 1, "along the axis")},
       .eulerCharacteristic = 0,
       .make = makeCylinder},
      {.name = "cone",
       .summary = "round, without lids, rises from the origin; a frustum when both radii are given",
       .equation = "(R cos phi, h v, -R sin phi), R = radius (1 - v) + top_radius v",
       .source = "solid geometry",
       .arguments = {length("radius", 1, "at the bottom", kRadiusOrApex),
                     length("top_radius", 0, "at the top", kRadiusOrApex),
                     length("height", 1, "along the axis")},
       .requirement = "radius or top_radius larger than 0",
       .meets = [](std::span<const double> a) { return std::max(a[0], a[1]) >= kLengthRange.lo; },
       .make = makeCone},
      {.name = "sphere",
       .summary = "centred on the origin",
       .equation = "r (cos L cos phi, sin L, -cos L sin phi), latitude L = pi (v - 1/2)",
       .source = "solid geometry",
       .arguments = {length("radius", 1, "of the sphere")},
       .borderless = true,
       .eulerCharacteristic = 2,
       .make = makeSphere},
      {.name = "ellipsoid",
       .summary = "centred on the origin",
       .equation =
           "(a cos L cos phi, b sin L, -c cos L sin phi), latitude L = pi (v - 1/2), radii = [a, b, c]",
       .source = "quadric x^2/a^2 + y^2/b^2 + z^2/c^2 = 1",
       .arguments =
           {{"radii", "half axes along X, Y and Z", ArgumentKind::Length, {1, 0.6, 0.8}, kLengthRange}},
       .borderless = true,
       .eulerCharacteristic = 2,
       .make = makeEllipsoid},
      {.name = "paraboloid",
       .summary = "vertex at the origin, opening along +Y; Su x Sv points to the outer, convex side",
       .equation = "(R v cos phi, h v^2, -R v sin phi), R = 2 sqrt(f h): y = (x^2 + z^2) / 4f",
       .source = "quadric; the focus is at (0, f, 0)",
       .arguments = {length("focal_length", 0.25, "from the vertex to the focus"),
                     length("height", 1, "along the axis")},
       .make = makeParaboloid},
      {.name = "torus",
       .summary = "a ring around Y, centred on the origin",
       .equation = "(R cos phi, minor sin 2 pi v, -R sin phi), R = major + minor cos 2 pi v",
       .source = "solid geometry",
       .arguments = {length("major", 1, "radius of the ring, to the middle of the tube"),
                     length("minor", 0.4, "radius of the tube")},
       .requirement = "major larger than minor: otherwise the tube runs through itself",
       .borderless = true,
       .eulerCharacteristic = 0,
       .meets = [](std::span<const double> a) { return a[0] > a[1]; },
       .make = makeTorus},
      {.name = "flag",
       .summary = "the lecture's waving flag, in the X-Y plane from the origin",
       .equation = "(width u, height v, depth sin(waves u + phase))",
       .source = "Szirmay-Kalos, Incremental image synthesis 2",
       .arguments = {length("width", 3, "along X"), length("height", 2, "along Y"),
                     length("depth", 0.2, "amplitude of the waves along Z", kAnyLength),
                     angle("waves", 8, "phase from one end of the width to the other", {-1e6, 1e6}),
                     angle("phase", 0, "of the waves at u = 0", {-1e12, 1e12})},
       .make = makeFlag},
      {.name = "teapot",
       .summary = "the Utah teapot, standing on the origin, spout toward +X",
       .equation = "32 bicubic Bezier patches",
       .source = "Newell 1975, bottom by Crow, height as Blinn drew it",
       .arguments =
           {{"height", "to the top of the knob", ArgumentKind::Length, {kTeapotHeight}, kLengthRange, true}},
       .eulerCharacteristic = 2,
       .make = makeTeapot},

  };
}

}  // namespace luxo
