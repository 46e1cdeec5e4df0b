// SPDX-License-Identifier: Apache-2.0
// Curvatures against those that books have.
#include "surface/curvature.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "surface/catalogue.h"
#include "surface/library.h"

namespace luxo {
namespace {

/// Some places, away from the edges.
std::vector<Vec2> places(const Surface& surface) {
  std::vector<Vec2> all;
  for (const double i : {0.07, 0.31, 0.55, 0.83})
    for (const double j : {0.13, 0.4, 0.71, 0.93})
      all.emplace_back(surface.domain().u.lo + i * surface.domain().u.width(),
                       surface.domain().v.lo + j * surface.domain().v.width());
  return all;
}

PrincipalCurvatures at(const Surface& surface, const Vec2& p, const Mat3& linear = Mat3(1)) {
  const auto k = curvatureAt(surface, surface.patchAt(p.x, p.y), p.x, p.y, {}, linear);
  EXPECT_TRUE(k.has_value());
  return k.value_or(PrincipalCurvatures{});
}

TEST(Curvature, OfASphereIsOneOverItsRadius) {
  const Surface ball = sphere(2.5);
  for (const Vec2& p : places(ball)) {
    const PrincipalCurvatures k = at(ball, p);
    EXPECT_NEAR(k.gaussian, 1 / 6.25, 1e-13);
    EXPECT_NEAR(k.mean, 0.4, 1e-13);
    EXPECT_NEAR(k.k1, 0.4, 1e-12);
    EXPECT_NEAR(k.k2, 0.4, 1e-12);
  }
}

TEST(Curvature, OfATorusInnerAndOuterSide) {
  const Surface ring = torus(2, 0.5);
  bool inner = false, outer = false;
  for (const Vec2& p : places(ring)) {
    const Vec3 position = ring.position(p.x, p.y);
    const double fromAxis = std::hypot(position.x, position.z), along = (fromAxis - 2) / fromAxis;
    const PrincipalCurvatures k = at(ring, p);
    EXPECT_NEAR(k.k1, 1 / 0.5, 1e-12);
    EXPECT_NEAR(k.k2, along / 0.5, 1e-12);
    EXPECT_NEAR(k.gaussian, along / 0.25, 1e-12);
    (k.gaussian < 0 ? inner : outer) = true;
    // The larger one is around the tube, across the ring.
    const Vec3 around = unit(Vec3(-position.z, 0, position.x));
    EXPECT_NEAR(glm::dot(k.direction1, around), 0, 1e-12);
    EXPECT_NEAR(std::abs(glm::dot(k.direction2, around)), 1, 1e-12);
    EXPECT_NEAR(glm::dot(k.direction1, ring.normal(p.x, p.y)), 0, 1e-12);
  }
  EXPECT_TRUE(inner);
  EXPECT_TRUE(outer);
}

TEST(Curvature, OfMinimalAndPseudosphericalSurfaces) {
  for (const char* name : {"catenoid", "helicoid", "enneper"}) {
    const Surface minimal = makeSurface(name);
    for (const Vec2& p : places(minimal)) {
      const PrincipalCurvatures k = at(minimal, p);
      EXPECT_NEAR(k.mean, 0, 1e-12) << name;
      EXPECT_LT(k.gaussian, 0) << name;
    }
  }
  const Surface pseudosphere = makeSurface("tractricoid");
  for (const Vec2& p : places(pseudosphere)) EXPECT_NEAR(at(pseudosphere, p).gaussian, -1, 1e-9);
}

// A ball that is stretched: K = 1 / (a b c (x^2/a^4 + y^2/b^4 + z^2/c^4))^2.
TEST(Curvature, OfWhatIsStretchedIsThatOfItsImage) {
  const Surface ball = sphere(1);
  const Mat3 stretch(Vec3(3, 0, 0), Vec3(0, 2, 0), Vec3(0, 0, -1));
  for (const Vec2& p : places(ball)) {
    const Vec3 q = stretch * ball.position(p.x, p.y);
    const double s = q.x * q.x / 81 + q.y * q.y / 16 + q.z * q.z;
    const PrincipalCurvatures k = at(ball, p, stretch);
    EXPECT_NEAR(k.gaussian, 1 / (9.0 * 4 * 1 * s * s), 1e-12);
    EXPECT_GT(k.k2, 0);
  }
}

// The graph of y = f(x, z) by parameters that cross at a slant: Su and Sv are not perpendicular.
TEST(Curvature, DoesNotDependOnTheParameters) {
  const Surface graph = surface(
      [](auto u, auto v) {
        const auto x = u + 0.7 * v;
        return point(x, x * x + 0.5 * x * v - 0.3 * v * v, v);
      },
      {{-1, 1}, {-1, 1}});
  for (const Vec2& p : places(graph)) {
    const double x = p.x + 0.7 * p.y, z = p.y, fx = 2 * x + 0.5 * z, fz = 0.5 * x - 0.6 * z;
    const double fxx = 2, fxz = 0.5, fzz = -0.6, w = 1 + fx * fx + fz * fz;
    const PrincipalCurvatures k = at(graph, p);
    EXPECT_NEAR(k.gaussian, (fxx * fzz - fxz * fxz) / (w * w), 1e-12);
    EXPECT_NEAR(
        std::abs(k.mean),
        std::abs((1 + fx * fx) * fzz - 2 * fx * fz * fxz + (1 + fz * fz) * fxx) / (2 * std::pow(w, 1.5)),
        1e-12);
  }
}

TEST(Curvature, IsNotKnownAtPoles) {
  const Surface ball = sphere(1);
  EXPECT_FALSE(curvatureAt(ball, 0, 0.3, ball.domain().v.hi, {}));
  const Surface tip = cone(1, 0, 1);
  EXPECT_FALSE(curvatureAt(tip, 0, 0.3, 1, {}));
  const PrincipalCurvatures k = at(tip, {0.3, 0.5});
  EXPECT_NEAR(k.gaussian, 0, 1e-13);
  EXPECT_NEAR(k.k1, 2 / std::sqrt(2.0), 1e-12);  // the cosine of the slope over the radius, 0.5
}

}  // namespace
}  // namespace luxo
