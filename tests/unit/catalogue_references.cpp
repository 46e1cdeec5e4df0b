// SPDX-License-Identifier: Apache-2.0
#include "catalogue_references.h"

#include <cmath>
#include <complex>
#include <numbers>

namespace luxo {
namespace {

constexpr Real kPiL = std::numbers::pi_v<Real>;
constexpr Real kTauL = 2 * kPiL;

/// The literature's z-up frame to luxo's.
Point upright(Real x, Real y, Real z) { return {x, z, -y}; }
Point upright(const Point& p) { return upright(p.x, p.y, p.z); }

/// (radius cos phi, radius sin phi, z) of the literature.
Point around(Real u, Real radius, Real z) {
  return upright(radius * std::cos(kTauL * u), radius * std::sin(kTauL * u), z);
}

Real rho(const Point& p) { return std::hypot(p.x, p.z); }

double beta(double a, double b) { return std::tgamma(a) * std::tgamma(b) / std::tgamma(a + b); }

/// Area inside |x|^(2/e) + |y|^(2/e) = 1.
double superellipseArea(double e) { return e * beta(e / 2, e / 2); }

/// The point at angle q of a tube around c, whose section is spanned by n, a unit vector across the velocity,
/// and n x velocity.
Point onTube(const Point& c, const Point& velocity, const Point& n, Real radius, Real q, Real side) {
  const Point b = glm::cross(n, velocity) / glm::length(velocity);
  return c + radius * (std::cos(q) * n + side * std::sin(q) * b);
}

void addElementary(std::vector<CatalogueReference>& all) {
  all.push_back({.label = "rectangle",
                 .entry = "rectangle",
                 .arguments = {{"size", {3.0, 2.0}}},
                 .position = [](Real u, Real v) { return upright(3 * (u - 0.5L), 2 * (v - 0.5L), 0); },
                 .normal = [](Real, Real) { return Point(0, 1, 0); },
                 .area = 6,
                 .gaussianCurvature = 0,
                 .minimal = true});
  all.push_back({.label = "disk",
                 .entry = "disk",
                 .arguments = {{"radius", {2.0}}},
                 .position = [](Real u, Real v) { return around(u, 2 * v, 0); },
                 .normal = [](Real, Real) { return Point(0, 1, 0); },
                 .area = 4 * kPi,
                 .gaussianCurvature = 0,
                 .minimal = true});
  all.push_back({.label = "cylinder",
                 .entry = "cylinder",
                 .arguments = {{"radius", {0.5}}, {"height", {3.0}}},
                 .position = [](Real u, Real v) { return around(u, 0.5L, 3 * v); },
                 .normal = [](Real u, Real) { return around(u, 1, 0); },
                 .residual = [](Point p) { return rho(p) - 0.5L; },
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
                   .residual = [=](Point p) { return rho(p) - bottom - (top - bottom) * p.y / h; },
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
                 .residual = [](Point p) { return glm::length(p) - 1.25L; },
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
                 .residual = [](Point p) { return std::hypot(p.x / 2, p.y / 0.5L, p.z / 1.5L) - 1; },
                 .volume = 4 * kPi / 3 * 1.5});
  all.push_back({.label = "paraboloid",
                 .entry = "paraboloid",
                 .arguments = {{"focal_length", {0.2}}, {"height", {1.8}}},
                 .position = [](Real u, Real v) { return around(u, 1.2L * v, 1.8L * v * v); },
                 .normal = [](Real u, Real v) { return around(u, 1.2L * v, -0.4L); },
                 .residual = [](Point p) { return p.y - rho(p) * rho(p) / 0.8L; },
                 .area = 8 * kPi * 0.04 / 3 * (std::pow(10.0, 1.5) - 1)});
  all.push_back({.label = "torus",
                 .entry = "torus",
                 .arguments = {{"major", {1.0}}, {"minor", {0.25}}},
                 .position =
                     [](Real u, Real v) {
                       return around(u, 1 + 0.25L * std::cos(kTauL * v), 0.25L * std::sin(kTauL * v));
                     },
                 .normal = [](Real u, Real v) { return around(u, std::cos(kTauL * v), std::sin(kTauL * v)); },
                 .residual = [](Point p) { return std::hypot(rho(p) - 1, p.y) - 0.25L; },
                 .area = kTau * kTau * 0.25,
                 .volume = kTau * kPi * 0.0625});
  all.push_back(
      {.label = "flag",
       .entry = "flag",
       .arguments = {{"phase", {0.7}}},
       .position = [](Real u, Real v) { return Point(3 * u, 2 * v, 0.2L * std::sin(8 * u + 0.7L)); },
       .normal = [](Real u, Real) { return Point(-1.6L * std::cos(8 * u + 0.7L), 0, 3); },
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
           [](Point p) { return 0.25L * (rho(p) * rho(p) / 0.25L - p.y * p.y * 5.25L / 2.25L - 1); }});
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
                       const Point p = sheet(u, v);
                       return Point(8 * p.x, -p.y / 0.16L, 8 * p.z);
                     },
                 .residual = [](Point p) { return p.y * p.y / 0.16L - 8 * rho(p) * rho(p) - 1; }});
  all.push_back({.label = "hyperbolic_paraboloid",
                 .entry = "hyperbolic_paraboloid",
                 .arguments = {{"size", {2.0, 2.0}}, {"height", {1.0}}},
                 .position =
                     [](Real u, Real v) {
                       const Real x = 2 * u - 1, y = 2 * v - 1;
                       return upright(x, y, (x * x - y * y) / 2);
                     },
                 .normal = [](Real u, Real v) { return upright(-(2 * u - 1), 2 * v - 1, 1); },
                 .residual = [](Point p) { return p.y - (p.x * p.x - p.z * p.z) / 2; }});
  all.push_back({.label = "monkey_saddle",
                 .entry = "monkey_saddle",
                 .arguments = {{"radius", {1.0}}, {"height", {2.0}}},
                 .position = [](Real u, Real v) { return around(u, v, v * v * v * std::cos(3 * kTauL * u)); },
                 .normal =
                     [](Real u, Real v) {
                       const Real x = v * std::cos(kTauL * u), y = v * std::sin(kTauL * u);
                       return upright(-3 * (x * x - y * y), 6 * x * y, 1);
                     },
                 .residual = [](Point p) { return p.y - (p.x * p.x * p.x - 3 * p.x * p.z * p.z); }});
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
                     [](Point p) {
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
                 .residual = [](Point s) { return rho(s) - 0.5L * std::cosh(2 * s.y); },
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
                 .residual = [](Point s) { return std::exp(s.y) * std::cos(s.x) - std::cos(s.z); },
                 .minimal = true});
}

void addOneSided(std::vector<CatalogueReference>& all) {
  const auto strip = [](int halfTwists) {
    return [halfTwists](Real u, Real v) {
      const Real U = kPiL * u, V = 0.5L * (v - 0.5L), q = 1 + V * std::cos(halfTwists * U);
      return upright(q * std::cos(2 * U), q * std::sin(2 * U), V * std::sin(halfTwists * U));
    };
  };
  all.push_back({.label = "mobius", .entry = "mobius", .position = strip(1), .normal = [](Real u, Real v) {
                   const Real U = kPiL * u, V = 0.5L * (v - 0.5L), q = 1 + V * std::cos(U);
                   return upright(2 * q * std::sin(U) * std::cos(2 * U) - V * std::sin(2 * U),
                                  2 * q * std::sin(U) * std::sin(2 * U) + V * std::cos(2 * U),
                                  -2 * q * std::cos(U));
                 }});
  all.push_back({.label = "mobius, three half twists",
                 .entry = "mobius",
                 .arguments = {{"half_twists", {3.0}}},
                 .position = strip(3)});
  all.push_back({.label = "klein",
                 .entry = "klein",
                 .arguments = {{"scale", {2.0}}},
                 .position =
                     [](Real u, Real v) {
                       const Real U = kTauL * u, V = kTauL * v - kPiL / 2;
                       const Real a = 0.3L * std::cos(U) * (1 + std::sin(U)), b = 0.8L * std::sin(U);
                       const Real c = 0.2L - 0.1L * std::cos(U);
                       return U <= kPiL ? Point(2 * (a + c * std::cos(U) * std::cos(V)),
                                                2 * (b + c * std::sin(U) * std::cos(V)), 2 * c * std::sin(V))
                                        : Point(2 * (a + c * std::cos(V + kPiL)), 2 * b, 2 * c * std::sin(V));
                     },
                 .kinked = true,
                 .smooth = false});
  all.push_back({.label = "klein_figure8", .entry = "klein_figure8", .position = [](Real u, Real v) {
                   const Real U = kTauL * u, V = kTauL * v, c = std::cos(U / 2), s = std::sin(U / 2);
                   const Real q = 2 + c * std::sin(V) - s * std::sin(2 * V);
                   return upright(q * std::cos(U), q * std::sin(U), s * std::sin(V) + c * std::sin(2 * V));
                 }});
  all.push_back(
      {.label = "boy", .entry = "boy", .arguments = {{"scale", {0.5}}}, .position = [](Real u, Real v) {
         const Real U = kPiL * (u - 0.5L), V = kPiL * (v + 0.5L), root2 = std::sqrt(2.0L);
         const Real D = 2 * (2 - root2 * std::sin(3 * U) * std::sin(2 * V));
         const Real cc = std::cos(V) * std::cos(V);
         return upright((root2 * std::cos(2 * U) * cc + std::cos(U) * std::sin(2 * V)) / D,
                        (root2 * std::sin(2 * U) * cc - std::sin(U) * std::sin(2 * V)) / D, 3 * cc / D);
       }});
  all.push_back({.label = "boy_bryant_kusner", .entry = "boy_bryant_kusner", .position = [](Real u, Real v) {
                   using Complex = std::complex<Real>;
                   const Complex z = std::polar(v, kTauL * u), z3 = z * z * z, z4 = z3 * z, z6 = z3 * z3;
                   const Complex d = z6 + std::sqrt(5.0L) * z3 - 1.0L;
                   const Point g(-1.5L * (z * (1.0L - z4) / d).imag(), -1.5L * (z * (1.0L + z4) / d).real(),
                                 ((1.0L + z6) / d).imag() - 0.5L);
                   return upright(g / glm::dot(g, g));
                 }});
}

void addSuperquadrics(std::vector<CatalogueReference>& all) {
  const auto power = [](Real x, Real e) { return std::pow(std::abs(x), 2 / e); };
  // Volumes: Jaklic, Leonardis, Solina, Segmentation and Recovery of Superquadrics, section 2.4.
  for (const auto& [e, f] : {std::pair(0.5, 0.5), std::pair(1.0, 1.0), std::pair(0.3, 0.8),
                             std::pair(2.0, 2.0), std::pair(1.5, 1.25), std::pair(0.1, 2.0)}) {
    const bool smooth = e <= 1 && f <= 1, kinked = e == 2 || f == 2;
    const double E = e, F = f;
    all.push_back({.label = "superellipsoid " + std::to_string(e) + ", " + std::to_string(f),
                   .entry = "superellipsoid",
                   .arguments = {{"radii", {1.5, 0.75, 1.0}}, {"exponents", {e, f}}},
                   .residual =
                       [=](Point p) {
                         const Real level = std::pow(power(p.x / 1.5L, F) + power(p.z, F), F / Real(E));
                         return std::pow(level + power(p.y / 0.75L, E), Real(E) / 2) - 1;
                       },
                   .volume = 2 * 1.5 * 0.75 * e * f * beta(e / 2 + 1, e) * beta(f / 2, f / 2),
                   .kinked = kinked,
                   .smooth = smooth});
    all.push_back(
        {.label = "supertoroid " + std::to_string(e) + ", " + std::to_string(f),
         .entry = "supertoroid",
         .arguments = {{"exponents", {e, f}}},
         .residual =
             [=](Point p) {
               const Real distance = std::pow(power(p.x, F) + power(p.z, F), Real(F) / 2);
               return std::pow(power((distance - 1) / 0.4L, E) + power(p.y / 0.4L, E), Real(E) / 2) - 1;
             },
         .volume = 2 * 0.16 * superellipseArea(e) * superellipseArea(f),
         .kinked = kinked,
         .smooth = smooth});
  }
}

void addTubes(std::vector<CatalogueReference>& all) {
  const double coil = std::hypot(1.5, 2 / (3 * kTau)) * 3 * kTau;
  all.push_back({.label = "spring",
                 .entry = "spring",
                 .arguments = {{"major", {1.5}}, {"minor", {0.2}}, {"height", {2.0}}, {"turns", {3.0}}},
                 .position =
                     [](Real u, Real v) {
                       const Real U = 3 * kTauL * u, c = std::cos(U), s = std::sin(U);
                       return upright(onTube({1.5L * c, 1.5L * s, 2 * u - 1},
                                             {-1.5L * s, 1.5L * c, 2 / (3 * kTauL)}, {c, s, 0}, 0.2L,
                                             kTauL * v, 1));
                     },
                 .area = kTau * 0.2 * coil});
  all.push_back(
      {.label = "twisted_torus",
       .entry = "twisted_torus",
       .arguments =
           {{"major", {1.0}}, {"minor", {0.4}}, {"depth", {0.3}}, {"lobes", {5.0}}, {"twists", {-2.0}}},
       .position =
           [](Real u, Real v) {
             const Real q = kTauL * v, r = 0.4L * (1 + 0.3L * std::cos(5 * q + 2 * kTauL * u));
             return around(u, 1 + r * std::cos(q), r * std::sin(q));
           },
       // Pappus: the sections' centroids are on the ring in the mean over the turn.
       .volume = kTau * kPi * 0.16 * 1.045});
  double knot = 0;  // Length, by the trapezoid rule: exponentially accurate for a periodic integrand.
  constexpr int kSteps = 4096;
  for (int i = 0; i < kSteps; ++i) {
    const double t = kTau * i / kSteps;
    knot += kTau / kSteps * std::hypot(2 * (1 + 0.4 * std::cos(5 * t)), 0.4 * 5);
  }
  all.push_back({.label = "torus_knot",
                 .entry = "torus_knot",
                 .arguments = {{"tube", {0.1}}, {"p", {2.0}}, {"q", {5.0}}},
                 .position =
                     [](Real u, Real v) {
                       const Real a = 2 * kTauL * u, b = 5 * kTauL * u, R = 1 + 0.4L * std::cos(b);
                       const Point n(std::cos(b) * std::cos(a), std::cos(b) * std::sin(a), std::sin(b));
                       const Point dR = -2 * std::sin(b) * Point(std::cos(a), std::sin(a), 0);
                       const Point velocity =
                           dR + 2 * R * Point(-std::sin(a), std::cos(a), 0) + Point(0, 0, 2 * std::cos(b));
                       return upright(onTube({R * std::cos(a), R * std::sin(a), 0.4L * std::sin(b)}, velocity,
                                             n, 0.1L, kTauL * v, -1));
                     },
                 .area = kTau * 0.1 * knot,
                 .volume = kPi * 0.01 * knot});
  all.push_back({.label = "seashell",
                 .entry = "seashell",
                 .arguments = {{"growth", {2.0}}, {"turns", {3.0}}},
                 .position = [](Real u, Real v) {
                   const Real U = 3 * kTauL * u, q = kTauL * v, size = std::exp2(3 * (u - 1));
                   const Real r = size * (0.42L + 0.4L * std::cos(q));
                   return upright(r * std::cos(U), r * std::sin(U),
                                  size * (0.4L * std::sin(q) - 1.8L) + 0.9L);
                 }});
}

}  // namespace

const std::vector<CatalogueReference>& catalogueReferences() {
  static const std::vector<CatalogueReference> references = [] {
    std::vector<CatalogueReference> all;
    addElementary(all);
    addAlgebraic(all);
    addCurvature(all);
    addOneSided(all);
    addSuperquadrics(all);
    addTubes(all);
    return all;
  }();
  return references;
}

}  // namespace luxo
