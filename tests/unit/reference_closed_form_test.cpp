// SPDX-License-Identifier: Apache-2.0
// Two ways to the same roots that share nothing: equations of degree 2 and 4, and proven cells of the
// formula.
#include "reference/closed_form.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "reference/shape.h"
#include "support/equation_names.h"
#include "surface/catalogue.h"
#include "surface/library.h"

namespace luxo::reference {
namespace {

Vec3 randomDirection(std::mt19937& random) {
  std::normal_distribution<double> normal;
  // One after the other: the order in which arguments are evaluated is the compiler's.
  const double z = normal(random), y = normal(random), x = normal(random);
  return unit(Vec3(x, y, z));
}

Roots byForms(const Shape& shape, const Transform& place, const Ray& ray, const RootQuery& query) {
  const auto inverse = ObjectFromWorld::of(place);
  Roots roots;
  for (const ClosedForm& form : shape.closedForms()) {
    const ClosedForm::Answer answer = form.nearestRoot((*inverse)(ray), query);
    roots.certified &= answer.decided;
    if (answer.nearest && (!roots.nearest || answer.nearest->t < roots.nearest->t))
      roots.nearest = answer.nearest;
  }
  return roots;
}

TEST(ReferenceClosedForm, TheCataloguesQuadricsAndTheTorusHaveOne) {
  for (const CatalogueEntry& entry : catalogue()) {
    const Surface surface = makeSurface(entry);
    bool closed = true;
    for (std::uint32_t patch = 0; patch < surface.patchCount(); ++patch)
      closed &= ClosedForm::of(surface, patch, {}).has_value();
    EXPECT_EQ(closed, test::kEquationNames.contains(std::string(entry.name))) << entry.name;
  }
}

TEST(ReferenceClosedForm, AgreesWithTheCells) {
  std::mt19937 random(5);
  std::vector<Surface> surfaces{torus(1, 0.01), cone(0.3, 0.9, 1.2)};
  for (const std::string& name : test::kEquationNames) surfaces.push_back(makeSurface(name));
  // A rotation with unequal scales; the same mirrored.
  const Mat3 turned = rotation({1, 2, -0.5}, 0.8) * Mat3(1.3, 0, 0, 0, 0.7, 0, 0, 0, 0.9);
  for (const double mirror : {1.0, -1.0})
    for (const Surface& surface : surfaces) {
      const Transform place{turned * Mat3(mirror, 0, 0, 0, 1, 0, 0, 0, 1), {0.4, -0.2, 0.1}};
      const Shape shape(surface, {});
      ASSERT_TRUE(shape.hasClosedForm()) << surface.name();
      int hits = 0, undecided = 0;
      constexpr int kRays = 1500;
      for (int i = 0; i < kRays; ++i) {
        const Vec3 target = place.translation + 1.2 * randomDirection(random);
        const Vec3 origin = place.translation + (i % 3 == 0 ? 0.3 : 6.0) * randomDirection(random);
        const Ray ray{origin, unit(target - origin)};
        const RootQuery query{0, 100, i % 2 == 0 ? Facing::Both : Facing::Front, mirror < 0};
        const Roots cells = nearestRoot(shape.cells(), {ray, place}, query);
        const Roots forms = byForms(shape, place, ray, query);
        undecided += !forms.certified || !cells.certified;
        if (!forms.certified || !cells.certified) continue;
        ASSERT_EQ(forms.nearest.has_value(), cells.nearest.has_value()) << surface.name() << ' ' << i;
        if (!forms.nearest) continue;
        ++hits;
        const Root &a = *forms.nearest, &b = *cells.nearest;
        const Vec3 normal = unit(normalMatrix(place.linear) * surface.normal(a.patch, a.u, a.v));
        // 1e-12 of the scale, along the normal: that is what both know of the surface.
        EXPECT_NEAR(a.t, b.t, 1e-12 / std::max(1e-6, std::abs(glm::dot(normal, ray.direction))))
            << surface.name() << ' ' << i;
        EXPECT_EQ(a.patch, b.patch);
        const Vec3 p = transformPoint(place, surface.position(a.patch, a.u, a.v));
        EXPECT_LT(glm::length(p - (ray.origin + a.t * ray.direction)), 1e-11) << surface.name() << ' ' << i;
      }
      EXPECT_GT(hits, surface.name() == "torus" ? 20 : 150) << surface.name();
      EXPECT_EQ(undecided, 0) << surface.name();  // random rays are never within rounding of a silhouette
    }
}

// Seen along an axis the torus covers a ring; from the side a strip with round ends. Rays a billionth of the
// size to either side of those silhouettes are told apart, by both ways.
TEST(ReferenceClosedForm, TorusSilhouettes) {
  const double ring = 1, tube = 0.4, aside = 1e-9;
  int undecided = 0;
  const Shape shape(torus(ring, tube), {});
  const auto expectHit = [&](const Ray& ray, bool hit) {
    const Roots forms = byForms(shape, {}, ray, {0, 100}),
                cells = nearestRoot(shape.cells(), {ray, {}}, {0, 100});
    EXPECT_TRUE(forms.certified);
    EXPECT_EQ(forms.nearest.has_value(), hit);
    undecided += !cells.certified;
    EXPECT_EQ(cells.nearest.has_value(), hit);
  };
  for (int i = 0; i < 50; ++i) {
    const double angle = 0.01 + i * kTau / 50;
    const Vec3 outward(std::cos(angle), 0, std::sin(angle));
    for (const double sign : {-1.0, 1.0}) {
      expectHit({(ring + tube + sign * aside) * outward + Vec3(0, 5, 0), {0, -1, 0}}, sign < 0);
      expectHit({(ring - tube + sign * aside) * outward + Vec3(0, 5, 0), {0, -1, 0}}, sign > 0);
      const double x = std::cos(angle);
      const Vec3 strip(x * ring, tube + sign * aside, 5);
      expectHit({strip, {0, 0, -1}}, sign < 0);
      const Vec3 end = Vec3(ring, 0, 5) + (tube + sign * aside) * Vec3(std::abs(x), std::sin(angle), 0);
      expectHit({end, {0, 0, -1}}, sign < 0);
    }
  }
  // Where the ray runs along the flat top of the tube it is within 1e-9 of very many cells.
  EXPECT_LT(undecided, 400 / 10);
}

// A ray that only touches, or that runs within the surface, is left to the cells.
TEST(ReferenceClosedForm, GrazingRaysAreNotDecided) {
  const Shape ball(sphere(1), {});
  EXPECT_FALSE(byForms(ball, {}, {{1, 0, 5}, {0, 0, -1}}, {0, 100}).certified);
  EXPECT_TRUE(PlacedShape(std::make_shared<const Shape>(sphere(1), std::vector<double>{}), {})
                  .nearestRoot({{1 - 1e-15, 0, 5}, {0, 0, -1}}, {0, 100})
                  .nearest);
  const Shape flat(rectangle(2, 2), {});
  EXPECT_FALSE(byForms(flat, {}, {{0, 0, 5}, {0, 0, -1}}, {0, 100}).certified);
}

// A formula that is nearly a sphere is none.
TEST(ReferenceClosedForm, NearlyIsNotEnough) {
  const auto ball = [](double dent) {
    return revolve([dent](auto v) {
      const Expr latitude = kPi * (v - 0.5), r = 1 + dent * sin(3 * latitude);
      return ProfilePoint{r * cos(latitude), r * sin(latitude)};
    });
  };
  EXPECT_TRUE(ClosedForm::of(ball(0), 0, {}));
  EXPECT_FALSE(ClosedForm::of(ball(1e-11), 0, {}));
}

// The next picture of a scene takes the shapes of the last; others are built, and unused ones forgotten.
TEST(ReferenceClosedForm, ShapesAreKept) {
  const Surface ball = sphere(1), ring = torus(1, 0.3);
  using Requests = std::vector<ShapeCache::Request>;
  ShapeCache cache;
  const auto first = cache.shapes(Requests{{ball, {}}, {ring, {}}, {ball, {}}});
  EXPECT_EQ(first[0], first[2]);
  EXPECT_NE(first[0], first[1]);
  const auto second = cache.shapes(Requests{{ring, {}}});
  EXPECT_EQ(second[0], first[1]);
  EXPECT_NE(cache.shapes(Requests{{ball, {}}})[0], first[0]);
}

}  // namespace
}  // namespace luxo::reference
