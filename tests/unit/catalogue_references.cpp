// SPDX-License-Identifier: Apache-2.0
#include "catalogue_references.h"

namespace luxo {
namespace {

void addElementary(std::vector<CatalogueReference>& all) {
  all.push_back({.label = "rectangle",
                 .entry = "rectangle",
                 .arguments = {{"size", {3.0, 2.0}}},
                 .position = [](Real u, Real v) { return upright(3 * (u - 0.5L), 2 * (v - 0.5L), 0); },
                 .normal = [](Real, Real) { return RealPoint(0, 1, 0); },
                 .area = 6,
                 .gaussianCurvature = 0,
                 .minimal = true});
  all.push_back({.label = "disk",
                 .entry = "disk",
                 .arguments = {{"radius", {2.0}}},
                 .position = [](Real u, Real v) { return around(u, 2 * v, 0); },
                 .normal = [](Real, Real) { return RealPoint(0, 1, 0); },
                 .area = 4 * kPi,
                 .gaussianCurvature = 0,
                 .minimal = true});
  all.push_back({.label = "cylinder",
                 .entry = "cylinder",
                 .arguments = {{"radius", {0.5}}, {"height", {3.0}}},
                 .position = [](Real u, Real v) { return around(u, 0.5L, 3 * v); },
                 .normal = [](Real u, Real) { return around(u, 1, 0); },
                 .residual = [](RealPoint p) { return rho(p) - 0.5L; },
                 .area = 3 * kPi,
                 .gaussianCurvature = 0});
  const auto cone = [&](const char* label, Real bottom, Real top, Real h) {
    all.push_back({.label = label,
                   .entry = "cone",
                   .arguments = {{"radius", {static_cast<double>(bottom)}},
                                 {"top_radius", {static_cast<double>(top)}},
                                 {"height", {static_cast<double>(h)}}},
                   .position = [=](Real u, Real v) { return around(u, bottom + (top - bottom) * v, h * v); },
                   .normal = [=](Real u, Real) { return around(u, h, bottom - top); },
                   .residual = [=](RealPoint p) { return rho(p) - bottom - (top - bottom) * p.y / h; },
                   .area = static_cast<double>(kPiL * (bottom + top) * std::hypot(h, bottom - top)),
                   .gaussianCurvature = 0});
  };
  cone("cone", 1.5L, 0, 2);
  cone("cone, apex down", 0, 1.5L, 2);
  cone("frustum", 1.5L, 0.5L, 2);
  all.push_back({.label = "sphere",
                 .entry = "sphere",
                 .arguments = {{"radius", {1.25}}},
                 .position =
                     [](Real u, Real v) {
                       const Real latitude = kPiL * (v - 0.5L);
                       return around(u, 1.25L * std::cos(latitude), 1.25L * std::sin(latitude));
                     },
                 .normal =
                     [](Real u, Real v) {
                       const Real latitude = kPiL * (v - 0.5L);
                       return around(u, std::cos(latitude), std::sin(latitude));
                     },
                 .residual = [](RealPoint p) { return glm::length(p) - 1.25L; },
                 .area = 4 * kPi * 1.5625,
                 .volume = 4 * kPi / 3 * 1.953125,
                 .gaussianCurvature = 1 / 1.5625});
  // Literature: (a cosU sinV, b sinU sinV, c cosV); V is the angle from +z, here upward: V = pi (1 - v).
  all.push_back({.label = "ellipsoid",
                 .entry = "ellipsoid",
                 .arguments = {{"radii", {2.0, 0.5, 1.5}}},
                 .position =
                     [](Real u, Real v) {
                       const Real V = kPiL * (1 - v), U = kTauL * u;
                       return upright(2 * std::cos(U) * std::sin(V), 1.5L * std::sin(U) * std::sin(V),
                                      0.5L * std::cos(V));
                     },
                 .normal =
                     [](Real u, Real v) {
                       const Real V = kPiL * (1 - v), U = kTauL * u;
                       return upright(std::cos(U) * std::sin(V) / 2, std::sin(U) * std::sin(V) / 1.5L,
                                      std::cos(V) / 0.5L);
                     },
                 .residual = [](RealPoint p) { return std::hypot(p.x / 2, p.y / 0.5L, p.z / 1.5L) - 1; },
                 .volume = 4 * kPi / 3 * 1.5});
  all.push_back({.label = "paraboloid",
                 .entry = "paraboloid",
                 .arguments = {{"focal_length", {0.2}}, {"height", {1.8}}},
                 .position = [](Real u, Real v) { return around(u, 1.2L * v, 1.8L * v * v); },
                 .normal = [](Real u, Real v) { return around(u, 1.2L * v, -0.4L); },
                 .residual = [](RealPoint p) { return p.y - rho(p) * rho(p) / 0.8L; },
                 .area = 8 * kPi * 0.04 / 3 * (std::pow(10.0, 1.5) - 1)});
  all.push_back({.label = "torus",
                 .entry = "torus",
                 .arguments = {{"major", {1.0}}, {"minor", {0.25}}},
                 .position =
                     [](Real u, Real v) {
                       return around(u, 1 + 0.25L * std::cos(kTauL * v), 0.25L * std::sin(kTauL * v));
                     },
                 .normal = [](Real u, Real v) { return around(u, std::cos(kTauL * v), std::sin(kTauL * v)); },
                 .residual = [](RealPoint p) { return std::hypot(rho(p) - 1, p.y) - 0.25L; },
                 .area = kTau * kTau * 0.25,
                 .volume = kTau * kPi * 0.0625});
  all.push_back(
      {.label = "flag",
       .entry = "flag",
       .arguments = {{"phase", {0.7}}},
       .position = [](Real u, Real v) { return RealPoint(3 * u, 2 * v, 0.2L * std::sin(8 * u + 0.7L)); },
       .normal = [](Real u, Real) { return RealPoint(-1.6L * std::cos(8 * u + 0.7L), 0, 3); },
       .gaussianCurvature = 0});
  all.push_back({.label = "teapot", .entry = "teapot", .smooth = false});
}

void addAlgebraic(std::vector<CatalogueReference>& all) {
  // Waist 0.5, rim 1.25 at height 1.5: c^2 = 1.5^2 / (1.25^2/0.5^2 - 1).
  all.push_back(
      {.label = "hyperboloid",
       .entry = "hyperboloid",
       .arguments = {{"radius", {0.5}}, {"top_radius", {1.25}}, {"height", {3.0}}},
       .position =
           [](Real u, Real v) {
             const Real z = 3 * (v - 0.5L);
             return around(u, 0.5L * std::sqrt(1 + z * z * 5.25L / 2.25L), z);
           },
       .normal =
           [](Real u, Real v) {
             const Real z = 3 * (v - 0.5L), x = 0.5L * std::sqrt(1 + z * z * 5.25L / 2.25L);
             return around(u, x / 0.25L, -z * 5.25L / 2.25L);
           },
       .residual =
           [](RealPoint p) { return 0.25L * (rho(p) * rho(p) / 0.25L - p.y * p.y * 5.25L / 2.25L - 1); }});
  // c = 0.4, rim 1 at y = 1.2: a^2 = 1 / (1.2^2/0.4^2 - 1) = 1/8.
  const auto sheet = [](Real u, Real v) {
    const Real s = std::abs(2 * v - 1), side = v < 0.5L ? -1 : 1;
    return around(u, s, side * 0.4L * std::sqrt(1 + 8 * s * s));
  };
  all.push_back({.label = "hyperboloid2",
                 .entry = "hyperboloid2",
                 .arguments = {{"radius", {1.0}}, {"gap", {0.8}}, {"height", {2.4}}},
                 .position = sheet,
                 .normal =
                     [=](Real u, Real v) {
                       const RealPoint p = sheet(u, v);
                       return RealPoint(8 * p.x, -p.y / 0.16L, 8 * p.z);
                     },
                 .residual = [](RealPoint p) { return p.y * p.y / 0.16L - 8 * rho(p) * rho(p) - 1; }});
  all.push_back({.label = "hyperbolic_paraboloid",
                 .entry = "hyperbolic_paraboloid",
                 .arguments = {{"size", {2.0, 2.0}}, {"height", {1.0}}},
                 .position =
                     [](Real u, Real v) {
                       const Real x = 2 * u - 1, y = 2 * v - 1;
                       return upright(x, y, (x * x - y * y) / 2);
                     },
                 .normal = [](Real u, Real v) { return upright(-(2 * u - 1), 2 * v - 1, 1); },
                 .residual = [](RealPoint p) { return p.y - (p.x * p.x - p.z * p.z) / 2; }});
  all.push_back({.label = "monkey_saddle",
                 .entry = "monkey_saddle",
                 .arguments = {{"radius", {1.0}}, {"height", {2.0}}},
                 .position = [](Real u, Real v) { return around(u, v, v * v * v * std::cos(3 * kTauL * u)); },
                 .normal =
                     [](Real u, Real v) {
                       const Real x = v * std::cos(kTauL * u), y = v * std::sin(kTauL * u);
                       return upright(-3 * (x * x - y * y), 6 * x * y, 1);
                     },
                 .residual = [](RealPoint p) { return p.y - (p.x * p.x * p.x - 3 * p.x * p.z * p.z); }});
  // a = 1.5, d = 0.75, c = 0.5, b^2 = 2.
  all.push_back({.label = "dupin_cyclide",
                 .entry = "dupin_cyclide",
                 .arguments = {{"major", {1.5}}, {"minor", {0.75}}, {"offset", {0.5}}},
                 .position =
                     [](Real u, Real v) {
                       const Real cu = std::cos(kTauL * u), su = std::sin(kTauL * u);
                       const Real cv = std::cos(kTauL * v), sv = std::sin(kTauL * v);
                       const Real w = 1.5L - 0.5L * cu * cv, b = std::sqrt(2.0L);
                       return upright((0.75L * (0.5L - 1.5L * cu * cv) + 2 * cu) / w,
                                      b * su * (1.5L - 0.75L * cv) / w, b * sv * (0.5L * cu - 0.75L) / w);
                     },
                 .residual =
                     [](RealPoint p) {
                       const Real s = glm::dot(p, p) - 0.5625L + 2, x = 1.5L * p.x - 0.375L;
                       return (s * s - 4 * x * x - 8 * p.z * p.z) / 10;
                     }});
}

void addCurvature(std::vector<CatalogueReference>& all) {
  all.push_back(
      {.label = "tractricoid",
       .entry = "tractricoid",
       .arguments = {{"radius", {1.0}}, {"extent", {3.0}}},
       .position = [](Real u, Real v) { return around(u, 1 / std::cosh(3 * v), 3 * v - std::tanh(3 * v)); },
       .normal = [](Real u, Real v) { return around(u, std::tanh(3 * v), 1 / std::cosh(3 * v)); },
       .area = 2 * kPi * (1 - 1 / std::cosh(3.0)),
       .gaussianCurvature = -1});
  all.push_back({.label = "dini",
                 .entry = "dini",
                 .position =
                     [](Real u, Real v) {
                       const Real U = 2 * kTauL * u, V = 0.1L + 0.9L * v;
                       return upright(std::cos(U) * std::sin(V), std::sin(U) * std::sin(V),
                                      std::cos(V) + std::log(std::tan(V / 2)) + 0.15L * U);
                     },
                 .normal =
                     [](Real u, Real v) {
                       const Real U = 2 * kTauL * u, V = 0.1L + 0.9L * v;
                       return upright(std::cos(U) * std::cos(V) - 0.15L * std::sin(U),
                                      std::sin(U) * std::cos(V) + 0.15L * std::cos(U), -std::sin(V));
                     },
                 .gaussianCurvature = -1 / 1.0225});
  // p = height per radian; |N| = sqrt(p^2 + r^2).
  const double p = 2 / (2.5 * kTau), q = std::hypot(p, 1.0);
  all.push_back({.label = "helicoid",
                 .entry = "helicoid",
                 .arguments = {{"turns", {2.5}}},
                 .position =
                     [](Real u, Real v) {
                       const Real U = 2.5L * kTauL * u, r = 2 * v - 1;
                       return upright(r * std::cos(U), r * std::sin(U), 2 * u - 1);
                     },
                 .normal =
                     [](Real u, Real v) {
                       const Real U = 2.5L * kTauL * u, rise = 2 / (2.5L * kTauL);
                       return upright(-rise * std::sin(U), rise * std::cos(U), 1 - 2 * v);
                     },
                 .area = 2.5 * kTau * (q + p * p * std::asinh(1 / p)),
                 .minimal = true});
  all.push_back({.label = "catenoid",
                 .entry = "catenoid",
                 .arguments = {{"radius", {0.5}}, {"height", {1.6}}},
                 .position =
                     [](Real u, Real v) {
                       const Real z = 1.6L * (v - 0.5L);
                       return around(u, 0.5L * std::cosh(2 * z), z);
                     },
                 .normal = [](Real u, Real v) { return around(u, 1, -std::sinh(3.2L * (v - 0.5L))); },
                 .residual = [](RealPoint s) { return rho(s) - 0.5L * std::cosh(2 * s.y); },
                 .area = kPi * 0.5 * (1.6 + 0.5 * std::sinh(3.2)),
                 .minimal = true});
  // Literature: (x - x^3/3 + x y^2, y - y^3/3 + y x^2, x^2 - y^2); metric (1 + r^2)^2.
  all.push_back({.label = "enneper",
                 .entry = "enneper",
                 .arguments = {{"scale", {0.5}}, {"extent", {1.2}}},
                 .position =
                     [](Real u, Real v) {
                       const Real x = 1.2L * v * std::cos(kTauL * u), y = 1.2L * v * std::sin(kTauL * u);
                       return upright((x - x * x * x / 3 + x * y * y) / 2,
                                      (y - y * y * y / 3 + y * x * x) / 2, (x * x - y * y) / 2);
                     },
                 .normal =
                     [](Real u, Real v) {
                       const Real r = 1.2L * v, a = kTauL * u;
                       return upright(-2 * r * std::cos(a), 2 * r * std::sin(a), 1 - r * r);
                     },
                 .area = 0.25 * kPi * (1.44 + 2.0736 + 2.985984 / 3),
                 .minimal = true});
  all.push_back({.label = "scherk",
                 .entry = "scherk",
                 .arguments = {{"size", {kPi}}, {"extent", {0.9}}},
                 .position =
                     [](Real u, Real v) {
                       const Real x = 0.9L * kPiL * (u - 0.5L), y = 0.9L * kPiL * (v - 0.5L);
                       return upright(x, y, std::log(std::cos(y) / std::cos(x)));
                     },
                 .normal =
                     [](Real u, Real v) {
                       return upright(-std::tan(0.9L * kPiL * (u - 0.5L)), std::tan(0.9L * kPiL * (v - 0.5L)),
                                      1);
                     },
                 .residual = [](RealPoint s) { return std::exp(s.y) * std::cos(s.x) - std::cos(s.z); },
                 .minimal = true});
}

}  // namespace

const std::vector<CatalogueReference>& catalogueReferences() {
  static const std::vector<CatalogueReference> references = [] {
    std::vector<CatalogueReference> all;
    addElementary(all);
    addAlgebraic(all);
    addCurvature(all);
    addOneSided(all);
    addPinched(all);
    addSuperquadrics(all);
    addTubes(all);
    addStructured(all);
    return all;
  }();
  return references;
}

}  // namespace luxo
