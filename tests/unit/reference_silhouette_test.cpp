// SPDX-License-Identifier: Apache-2.0
// Distances to shapes that are known.
#include "reference/silhouette.h"

#include <gtest/gtest.h>

#include <cmath>

namespace luxo::reference {
namespace {

const Vec2 kCenter(10.5, 7.5);

/// 1 % or 1e-4, and never too near.
void expectDistance(double found, double expected) {
  EXPECT_GE(found, expected - 1e-12);
  EXPECT_LE(found, expected + std::max(1e-4, 0.01 * expected));
}

TEST(DistanceTo, AHalfPlaneInAnyDirection) {
  for (const double angle : {0.0, 0.1, 0.196, 1.0, 2.5, 4.4})
    for (const double distance : {3e-4, 0.0099, 0.4, 3.3}) {
      const Vec2 normal(std::cos(angle), std::sin(angle));
      expectDistance(
          distanceTo([&](const Vec2& p) { return glm::dot(p - kCenter, normal) >= distance; }, kCenter, 4),
          distance);
    }
}

TEST(DistanceTo, InsideADisc) {
  const Vec2 middle = kCenter + Vec2(1.1, -0.4);
  expectDistance(distanceTo([&](const Vec2& p) { return glm::distance(p, middle) > 2.5; }, kCenter, 4),
                 2.5 - glm::length(Vec2(1.1, -0.4)));
}

TEST(DistanceTo, NothingFoundIsTheFarthest) {
  int tries = 0;
  EXPECT_EQ(distanceTo([&](const Vec2&) { return ++tries < 0; }, kCenter, 4), 4);
  EXPECT_LE(tries, 300);
}

}  // namespace
}  // namespace luxo::reference
