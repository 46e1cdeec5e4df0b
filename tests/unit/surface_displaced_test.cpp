// SPDX-License-Identifier: Apache-2.0
#include "surface/displaced.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "base/error.h"
#include "math/interval.h"
#include "surface/catalogue.h"
#include "surface/cloth.h"
#include "surface/curvature.h"
#include "surface/equation.h"
#include "surface/library.h"

namespace luxo {
namespace {

Surface shifted(const Surface& surface, double by) {
  return displacedBy(surface, [=](auto, auto) { return Expr(by); });
}

/// Points, normals and curvatures of the first patch, its edges included.
void expectSame(const Surface& a, const Surface& b, double size) {
  ASSERT_EQ(a.patchCount(), b.patchCount());
  EXPECT_EQ(a.closed(), b.closed());
  EXPECT_EQ(a.topology().eulerCharacteristic, b.topology().eulerCharacteristic);
  for (const double u : {0.0, 0.13, 0.5, 0.77, 1.0})
    for (const double v : {0.0, 1e-9, 0.21, 0.5, 0.93, 1.0}) {
      EXPECT_LE(glm::length(a.position(u, v) - b.position(u, v)), 1e-14 * size) << u << ", " << v;
      EXPECT_LE(glm::length(a.normal(u, v) - b.normal(u, v)), 1e-12) << u << ", " << v;
      const auto one = curvatureAt(a, 0, u, v, {}), other = curvatureAt(b, 0, u, v, {});
      ASSERT_EQ(one.has_value(), other.has_value()) << u << ", " << v;
      if (!one) continue;
      EXPECT_NEAR(one->k1 * size, other->k1 * size, 1e-10);
      EXPECT_NEAR(one->k2 * size, other->k2 * size, 1e-10);
    }
}

TEST(Displaced, ABallByAConstantIsALargerBall) {
  expectSame(shifted(sphere(2), 0.25), sphere(2.25), 2.25);
  expectSame(shifted(sphere(2), -0.5), sphere(1.5), 1.5);
  EXPECT_TRUE(shifted(sphere(2), 0.25).closed());
  EXPECT_TRUE(shifted(sphere(2), 0.25).revolution());
}

TEST(Displaced, ATorusByAConstantHasAThickerTube) {
  expectSame(shifted(torus(2, 0.5), 0.2), torus(2, 0.7), 3);
}

TEST(Displaced, ACylinderByAConstantIsWider) {
  expectSame(shifted(cylinder(1, 3), 0.5), cylinder(1.5, 3), 3);
}

TEST(Displaced, APlaneIsTheGraphOfItsDisplacement) {
  const auto hill = [](auto u, auto v) { return 0.3 * sin(5 * u) * exp(-v); };
  const Surface moved = displacedBy(rectangle(2, 3), hill);
  const Surface graph =
      surface([&](auto u, auto v) { return point(2 * (u - 0.5), hill(u, v), -3 * (v - 0.5)); }, {});
  expectSame(moved, graph, 3);
  EXPECT_FALSE(moved.flatNormal());
  EXPECT_EQ(shifted(rectangle(2, 3), 0.5).flatNormal(), Vec3(0, 1, 0));
  EXPECT_LE(glm::length(shifted(rectangle(2, 3), 0.5).position(0.3, 0.8) - Vec3(-0.4, 0.5, -0.9)), 1e-15);
  // Su x Sv of the disk points down, its outside is up.
  EXPECT_NEAR(shifted(disk(2), 0.5).position(0.3, 0.8).y, 0.5, 1e-15);
}

TEST(Displaced, WhatVariesHasNoEquation) {
  const auto needle = [](auto u, auto v) {
    return 0.2 * exp(-1e6 * (pow(u - 0.513, 2) + pow(v - 0.377, 2)));
  };
  const Surface moved = displacedBy(sphere(1), needle);
  EXPECT_NEAR(glm::length(moved.position(0.513, 0.377)), 1.2, 1e-12);
  EXPECT_FALSE(equationOf(moved, 0, {}));
  EXPECT_FALSE(boundsSolid(moved, {}));
  EXPECT_TRUE(moved.closed());
  EXPECT_TRUE(equationOf(shifted(sphere(1), 0.2), 0, {}));
}

TEST(Displaced, MovesWithItsParametersAndThoseOfTheSurface) {
  const Surface breathing =
      surface([](auto u, auto v, auto r) { return point(r * cos(kTau * u), v, -r * sin(kTau * u)); }, {}, {},
              Animated<double>([](double t) { return 1 + t; }));
  const Surface moved = displacedBy(
      breathing, [](auto, auto v, auto k) { return k * v; },
      Animated<double>([](double t) { return 10 * t; }));
  ASSERT_EQ(moved.parameters().size(), 2U);
  const double then[] = {moved.parameters()[0].at(2), moved.parameters()[1].at(2)};
  EXPECT_LE(glm::length(moved.position(0, 0.5, then) - Vec3(13, 0.5, 0)), 1e-14);
}

// What is divided out may be negative, or change its sign: then it stays.
TEST(Displaced, KnowsTheSideOfWhatIsTurnedInsideOut) {
  const auto plane = [](auto u, auto v) { return point(v * cos(kTau * u), v * v, -(v * sin(kTau * u))); };
  for (const Interval& range : {Interval(-1, 0), Interval(-1, 1)}) {
    const Surface from = surface(plane, {{0, 1}, range}), moved = shifted(from, 0.1);
    for (const double v : {-1.0, -0.6, -1e-3})
      EXPECT_LE(glm::length(moved.position(0.3, v) - from.position(0.3, v) - 0.1 * from.normal(0.3, v)),
                1e-14);
  }
  EXPECT_NEAR(glm::length(shifted(surface(plane, {{0, 1}, {-1, 0}}), 0.1).position(0.3, 0)), 0.1, 1e-15);
}

TEST(Displaced, OpensCreases) {
  const Surface roof = surface([](auto u, auto v) { return point(u, -abs(u), v); }, {{-1, 1}, {0, 1}});
  ASSERT_EQ(roof.topology().joints.size(), 1U);
  EXPECT_TRUE(shifted(roof, 0.1).topology().joints.empty());
  EXPECT_EQ(displacedBy(roof, [](auto u, auto) { return u * u; }).topology().joints.size(), 1U);
  const auto needle = [](auto, auto v) { return 0.1 * exp(-1e7 * pow(v - 0.377, 2)); };
  EXPECT_TRUE(displacedBy(roof, needle).topology().joints.empty());
}

TEST(Displaced, IsCutWhereItIsKinked) {
  const Surface moved = displacedBy(torus(2, 0.5), [](auto u, auto) { return 0.1 * abs(u - 0.25); });
  ASSERT_EQ(moved.patchCount(), 2U);
  EXPECT_EQ(moved.patchDomain(0).u, Interval(0, 0.25));
  EXPECT_FALSE(moved.closed()) << "0.025 at one end, 0.075 at the other";
}

TEST(Displaced, TrianglesHaveNoNormalAsAFormula) {
  EXPECT_THROW(static_cast<void>(shifted(Surface(Cloth{}), 0.1)), Error);
}

TEST(Displaced, IsTheParallelSurfaceOfEveryNamedOne) {
  std::vector<std::string> refused;
  for (const CatalogueEntry& entry : catalogue()) {
    const Surface from = makeSurface(entry);
    const auto wave = [](double u, double v) { return 0.03 + 0.01 * std::sin(4 * u + 3 * v); };
    Surface moved;
    try {
      moved = displacedBy(from, [](auto u, auto v) { return 0.03 + 0.01 * sin(4 * u + 3 * v); });
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("does not show the normal"), std::string::npos)
          << error.what();
      refused.emplace_back(entry.name);
      continue;
    }
    ASSERT_EQ(moved.patchCount(), from.patchCount()) << entry.name;
    EXPECT_EQ(moved.name(), entry.name);
    for (std::uint32_t patch = 0; patch < from.patchCount(); ++patch) {
      const Domain& d = from.patchDomain(patch);
      EXPECT_EQ(moved.patchDomain(patch), d);
      for (const double part : {0.0, 0.13, 0.47, 0.77, 1.0}) {
        const EdgePoint p = edgePoint(d, Side::VMin, part);
        const double u = p.u, v = edgePoint(d, Side::UMin, part * (2 - part)).v;
        const Vec3 normal = from.normal(patch, u, v);
        const Vec3 expected = from.position(patch, u, v) + wave(u, v) * normal;
        const Vec3 got = moved.position(patch, u, v);
        if (!std::isfinite(got.x + got.y + got.z)) {
          ADD_FAILURE() << entry.name << " has no point at " << u << ", " << v;
          continue;
        }
        EXPECT_LE(glm::length(got - expected), 1e-9 * (1 + glm::length(expected)))
            << entry.name << " " << patch << ": " << u << ", " << v;
      }
    }
  }
  std::string names;
  for (const std::string& name : refused) names += name + " ";
  EXPECT_EQ(names, "boy superellipsoid ");
}

}  // namespace
}  // namespace luxo
