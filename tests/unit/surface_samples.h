// SPDX-License-Identifier: Apache-2.0
// The surfaces that the tests of engine/surface and engine/tessellate share, each with what mathematics knows
// about it: normal, area, volume, Euler characteristic, suprema of the second derivatives.
#pragma once

#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "surface/library.h"

namespace luxo {

struct SurfaceSample {
  std::string name;
  Surface surface;
  std::vector<double> parameters;
  std::function<Vec3(double u, double v)> normal;  ///< unit, outward; the limit where Su x Sv vanishes
  double area = 0;
  std::optional<double> volume;
  int euler = 1;                          ///< of the whole surface, seams and apexes closed
  int borders = 1;                        ///< how many closed border curves
  std::optional<PartialBounds> partials;  ///< true suprema of |Suu|, |Suv|, |Svv|
  Edge u = Edge::Border, vMin = Edge::Border, vMax = Edge::Border;
  double orientation = 1;
  bool orientable = true;
};

/// Seeds' parameter order: u around the tube, v around the ring (about +Z). Su x Sv points inward.
inline Surface lectureTorus(double ring, double tube) {
  return surface(
      [=](auto u, auto v) {
        const auto rho = ring + tube * cos(u);
        return point(rho * cos(v), rho * sin(v), tube * sin(u));
      },
      {{0, kTau}, {0, kTau}}, {.name = "user's torus"});
}

/// One half twist: (0, v) and (pi, -v) are the same point.
inline Surface moebius(double radius, double width) {
  return surface(
      [=](auto u, auto v) {
        const auto q = radius + v * cos(u);
        return point(q * cos(2 * u), q * sin(2 * u), v * sin(u));
      },
      {{0, kPi}, {-width / 2, width / 2}}, {.name = "user's moebius"});
}

inline std::vector<SurfaceSample> surfaceSamples() {
  const auto around = [](double u, double outward, double up) {
    const Vec3 n(outward * std::cos(kTau * u), up, -outward * std::sin(kTau * u));
    return n / std::sqrt(outward * outward + up * up);
  };
  const auto coneSample = [&](const std::string& name, double radius, double top, double height) {
    const double slant = std::hypot(height, radius - top);
    return SurfaceSample{
        .name = name,
        .surface = cone(radius, top, height),
        .normal = [=](double u, double) { return around(u, height, radius - top); },
        .area = kPi * (radius + top) * slant,
        .euler = radius > 0 && top > 0 ? 0 : 1,
        .borders = radius > 0 && top > 0 ? 2 : 1,
        .partials = PartialBounds{std::max(radius, top) * kTau * kTau, std::abs(radius - top) * kTau, 0},
        .u = Edge::Seam,
        .vMin = radius > 0 ? Edge::Border : Edge::Apex,
        .vMax = top > 0 ? Edge::Border : Edge::Apex};
  };

  std::vector<SurfaceSample> samples;
  samples.push_back({.name = "rectangle",
                     .surface = rectangle(3, 2),
                     .normal = [](double, double) { return Vec3(0, 1, 0); },
                     .area = 6,
                     .partials = PartialBounds{0, 0, 0}});
  samples.push_back({.name = "disk",
                     .surface = disk(2),
                     .normal = [](double, double) { return Vec3(0, 1, 0); },
                     .area = 4 * kPi,
                     .partials = PartialBounds{2 * kTau * kTau, 2 * kTau, 0},
                     .u = Edge::Seam,
                     .vMin = Edge::Pole,
                     .orientation = -1});
  samples.push_back({.name = "cylinder",
                     .surface = cylinder(0.5, 3),
                     .normal = [=](double u, double) { return around(u, 1, 0); },
                     .area = 3 * kPi,
                     .euler = 0,
                     .borders = 2,
                     .partials = PartialBounds{0.5 * kTau * kTau, 0, 0},
                     .u = Edge::Seam});
  samples.push_back(coneSample("cone, apex up", 1.5, 0, 2));
  samples.push_back(coneSample("cone, apex down", 0, 1.5, 2));
  samples.push_back(coneSample("frustum", 1.5, 0.5, 2));
  samples.push_back({.name = "sphere",
                     .surface = sphere(1.25),
                     .normal =
                         [=](double u, double v) {
                           return around(u, v == 0 || v == 1 ? 0 : std::cos(kPi * (v - 0.5)),
                                         std::sin(kPi * (v - 0.5)));
                         },
                     .area = 4 * kPi * 1.25 * 1.25,
                     .volume = 4 * kPi / 3 * 1.25 * 1.25 * 1.25,
                     .euler = 2,
                     .borders = 0,
                     .partials = PartialBounds{1.25 * kTau * kTau, 1.25 * kPi * kTau, 1.25 * kPi * kPi},
                     .u = Edge::Seam,
                     .vMin = Edge::Pole,
                     .vMax = Edge::Pole});
  // f = 0.2, h = 1.8: the rim's radius is 1.2. The shade of the lamp; area 10.26179.
  samples.push_back({.name = "paraboloid",
                     .surface = paraboloid(0.2, 1.8),
                     .normal = [=](double u, double v) { return around(u, 1.2 * v, -0.4); },
                     .area = 8 * kPi * 0.04 / 3 * (std::pow(10.0, 1.5) - 1),
                     .partials = PartialBounds{1.2 * kTau * kTau, 1.2 * kTau, 3.6},
                     .u = Edge::Seam,
                     .vMin = Edge::Pole});
  samples.push_back(
      {.name = "torus",
       .surface = torus(1, 0.25),
       .normal = [=](double u, double v) { return around(u, std::cos(kTau * v), std::sin(kTau * v)); },
       .area = kTau * kTau * 0.25,
       .volume = kTau * kPi * 0.0625,
       .euler = 0,
       .borders = 0,
       .partials = PartialBounds{1.25 * kTau * kTau, 0.25 * kTau * kTau, 0.25 * kTau * kTau},
       .u = Edge::Seam,
       .vMin = Edge::Seam,
       .vMax = Edge::Seam});
  // Area: the width's arc length times the height; 2.0 * integral of sqrt(9 + 2.56 cos^2(8u + 0.7)) du by the
  // midpoint rule, whose error for a smooth integrand at 20,000 points is below 1e-8.
  double arc = 0;
  for (int i = 0; i < 20'000; ++i)
    arc += std::hypot(3.0, 1.6 * std::cos(8 * (i + 0.5) / 20'000 + 0.7)) / 20'000;
  samples.push_back({.name = "flag",
                     .surface = flag({.phase = [](double t) { return t; }}),
                     .parameters = {0.7},
                     .normal =
                         [](double u, double) {
                           const Vec3 n(-1.6 * std::cos(8 * u + 0.7), 0, 3);
                           return n / std::hypot(n.x, n.z);
                         },
                     .area = 2 * arc,
                     .partials = PartialBounds{0.2 * 64, 0, 0}});
  samples.push_back({.name = "lecture torus",
                     .surface = lectureTorus(1, 0.5),
                     .normal =
                         [](double u, double v) {
                           return Vec3(std::cos(u) * std::cos(v), std::cos(u) * std::sin(v), std::sin(u));
                         },
                     .area = kTau * kTau * 0.5,
                     .volume = kTau * kPi * 0.25,
                     .euler = 0,
                     .borders = 0,
                     .partials = PartialBounds{0.5, 0.5, 1.5},
                     .u = Edge::Seam,
                     .vMin = Edge::Seam,
                     .vMax = Edge::Seam,
                     .orientation = -1});
  samples.push_back({.name = "moebius",
                     .surface = moebius(1, 0.5),
                     .normal =
                         [](double u, double v) {
                           const double q = 1 + v * std::cos(u);
                           const Vec3 n(2 * q * std::sin(u) * std::cos(2 * u) - v * std::sin(2 * u),
                                        2 * q * std::sin(u) * std::sin(2 * u) + v * std::cos(2 * u),
                                        -2 * q * std::cos(u));
                           return n / glm::length(n);
                         },
                     .area = 3.149911,
                     .euler = 0,
                     .u = Edge::Seam,
                     .orientable = false});
  return samples;
}

}  // namespace luxo
