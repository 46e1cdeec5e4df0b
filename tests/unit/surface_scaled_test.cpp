// SPDX-License-Identifier: Apache-2.0
#include "surface/scaled.h"

#include <gtest/gtest.h>

#include "surface/catalogue.h"
#include "surface/equation.h"
#include "surface/library.h"

namespace luxo {
namespace {

const Vec3 kScale(4, 0.125, 32);

TEST(Scaled, PointsAreScaledWithoutRounding) {
  for (const CatalogueEntry& entry : catalogue()) {
    const Surface surface = makeSurface(entry), other = scaled(surface, kScale);
    ASSERT_EQ(other.patchCount(), surface.patchCount());
    EXPECT_EQ(other.name(), surface.name());
    for (std::uint32_t patch = 0; patch < surface.patchCount(); ++patch) {
      const Domain& d = surface.patchDomain(patch);
      for (const double part : {0.13, 0.5, 0.77}) {
        const double u = d.u.lo + part * d.u.width(), v = d.v.lo + (1 - part * part) * d.v.width();
        const Vec3 expected = kScale * surface.position(patch, u, v), got = other.position(patch, u, v);
        // Terms are put in another order, here and there: a few units of the last place of the largest.
        EXPECT_LE(glm::length((got - expected) / kScale), 1e-15 * (1 + glm::length(expected / kScale)))
            << entry.name << " " << u << ", " << v;
        const Vec3 normal = unit(surface.normal(patch, u, v) / kScale);
        if (surface.topology().orientable) {
          EXPECT_GT(glm::dot(normal, other.normal(patch, u, v)), 1 - 1e-9) << entry.name;
        }
      }
    }
  }
}

TEST(Scaled, AScaledBallIsAnEllipsoid) {
  const auto equation = equationOf(scaled(sphere(1), kScale), 0, {});
  ASSERT_TRUE(equation);
  EXPECT_EQ(equation->scale, kScale);
}

TEST(Scaled, KeepsParametersAndThePlaneOfFlatSurfaces) {
  const Surface moving =
      surface([](auto u, auto v, auto h) { return point(u, h * u * v, v); }, {}, {}, Animated<double>(3.0));
  const double h[] = {5};
  EXPECT_EQ(scaled(moving, kScale).position(0.5, 0.5, h), kScale * moving.position(0.5, 0.5, h));
  EXPECT_EQ(scaled(rectangle(2, 3), kScale).flatNormal(), Vec3(0, 1, 0));
}

// It is that of time 0, as of any surface: a ring that opens in time.
TEST(Scaled, TheTopologyIsThatOfWhatIsScaled) {
  const auto ring = [](auto u, auto v, auto turn) {
    const auto radius = 2 + 0.7 * cos(kTau * v);
    return point(radius * cos(turn * u), 0.7 * sin(kTau * v), radius * sin(turn * u));
  };
  const Animated<double> opening([](double t) { return kTau * (1 - 0.5 * t); });
  const Surface moving = surface(ring, {}, {}, opening);
  ASSERT_TRUE(moving.closed());
  const Surface open = moving.withParameters({Animated<double>(kPi)});
  EXPECT_TRUE(open.closed());
  EXPECT_TRUE(scaled(open, kScale).closed());
  EXPECT_EQ(scaled(open, kScale).topology().orientation(), open.topology().orientation());
}

}  // namespace
}  // namespace luxo
