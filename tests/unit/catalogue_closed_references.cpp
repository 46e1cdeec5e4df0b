// SPDX-License-Identifier: Apache-2.0
#include "catalogue_references.h"

#include <complex>

#include "surface/bezier.h"
#include "surface/tube.h"

namespace luxo {
namespace {

double beta(double a, double b) { return std::tgamma(a) * std::tgamma(b) / std::tgamma(a + b); }

/// Area inside |x|^(2/e) + |y|^(2/e) = 1.
double superellipseArea(double e) { return e * beta(e / 2, e / 2); }

/// The point at angle q of a tube around c, whose section is spanned by n, a unit vector across the velocity,
/// and n x velocity.
RealPoint onTube(const RealPoint& c, const RealPoint& velocity, const RealPoint& n, Real radius, Real q,
                 Real side) {
  const RealPoint b = glm::cross(n, velocity) / glm::length(velocity);
  return c + radius * (std::cos(q) * n + side * std::sin(q) * b);
}

}  // namespace

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
                       return U <= kPiL
                                  ? RealPoint(2 * (a + c * std::cos(U) * std::cos(V)),
                                              2 * (b + c * std::sin(U) * std::cos(V)), 2 * c * std::sin(V))
                                  : RealPoint(2 * (a + c * std::cos(V + kPiL)), 2 * b, 2 * c * std::sin(V));
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
                   const RealPoint g(-1.5L * (z * (1.0L - z4) / d).imag(),
                                     -1.5L * (z * (1.0L + z4) / d).real(), ((1.0L + z6) / d).imag() - 0.5L);
                   return upright(g / glm::dot(g, g));
                 }});
}

/// Surfaces with pinches.
void addPinched(std::vector<CatalogueReference>& all) {
  const auto onSphere = [](Real u, Real v, Real start) {
    const Real q = kPiL * v / 2, phi = kTauL * u + start;
    return RealPoint(std::sin(q) * std::cos(phi), std::sin(q) * std::sin(phi), std::cos(q));
  };
  all.push_back({.label = "steiner_roman",
                 .entry = "steiner_roman",
                 .arguments = {{"scale", {2.0}}},
                 .position =
                     [=](Real u, Real v) {
                       const RealPoint p = onSphere(u, v, 0);
                       return upright(2 * p.y * p.z, 2 * p.z * p.x, 2 * p.x * p.y);
                     },
                 .residual =
                     [](RealPoint p) {
                       const Real xy = p.x * p.y, yz = p.y * p.z, zx = p.z * p.x;
                       return xy * xy + yz * yz + zx * zx + 2 * p.x * yz;
                     },
                 .smooth = false});
  all.push_back({.label = "cross_cap",
                 .entry = "cross_cap",
                 .position =
                     [=](Real u, Real v) {
                       const RealPoint p = onSphere(u, v, kPiL / 4);
                       return upright(p.x * p.z, p.y * p.z, (p.z * p.z - p.x * p.x) / 2);
                     },
                 .smooth = false});
  all.push_back({.label = "whitney_umbrella",
                 .entry = "whitney_umbrella",
                 .position =
                     [](Real u, Real v) {
                       const Real s = 2 * u - 1, t = 2 * v - 1;
                       return upright(s * t, s, t * t);
                     },
                 .residual = [](RealPoint p) { return p.x * p.x - p.z * p.z * p.y; },
                 .smooth = false});
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
                       [=](RealPoint p) {
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
             [=](RealPoint p) {
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
                       const RealPoint n(std::cos(b) * std::cos(a), std::cos(b) * std::sin(a), std::sin(b));
                       const RealPoint dR = -2 * std::sin(b) * RealPoint(std::cos(a), std::sin(a), 0);
                       const RealPoint velocity = dR + 2 * R * RealPoint(-std::sin(a), std::cos(a), 0) +
                                                  RealPoint(0, 0, 2 * std::cos(b));
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

void addStructured(std::vector<CatalogueReference>& all) {
  all.push_back(
      {.label = "revolve",
       .entry = "",
       .position = [](Real u, Real v) { return around(u, 0.6L + 0.25L * std::sin(kTauL * v), 2 * v); },
       .build =
           [] { return revolve([](auto v) {
                  return ProfilePoint{0.6 + 0.25 * sin(kTau * v), 2 * v};
                }); }});
  // A tube around a circle is a torus.
  all.push_back({.label = "tube",
                 .entry = "",
                 .residual = [](RealPoint p) { return std::hypot(rho(p) - 1, p.y) - 0.3L; },
                 .area = kTau * kTau * 0.3,
                 .volume = kTau * kPi * 0.09,
                 .build =
                     [] {
                       return tube([](auto u) { return point(cos(u), 0, -sin(u)); },
                                   [](auto, auto) { return 0.3; }, Interval(0, kTau));
                     }});
  BezierPatch patch;
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i) patch[4 * j + i] = Vec3(i, std::sin(3 * i + 5 * j), -j - 0.2 * i * i);
  const auto bernstein = [](int i, Real x) {
    constexpr Real kChoose[] = {1, 3, 3, 1};
    return kChoose[i] * std::pow(x, static_cast<Real>(i)) * std::pow(1 - x, static_cast<Real>(3 - i));
  };
  all.push_back({.label = "bezier",
                 .entry = "",
                 .position =
                     [=](Real u, Real v) {
                       RealPoint sum(0);
                       for (int j = 0; j < 4; ++j)
                         for (int i = 0; i < 4; ++i)
                           sum += bernstein(i, u) * bernstein(j, v) * RealPoint(patch[4 * j + i]);
                       return sum;
                     },
                 .build = [=] { return bezier({patch}); }});
}

}  // namespace luxo
