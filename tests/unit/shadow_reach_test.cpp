// SPDX-License-Identifier: Apache-2.0
// A caster is left out only where no ray to the light from what is seen meets its box.
#include "shadow/shadow_reach.h"

#include <gtest/gtest.h>

#include <limits>

#include "scene_test_support.h"

namespace luxo {
namespace {

/// Slab by slab.
bool meets(const Box& box, const Vec3& from, const Vec3& way, double last) {
  double first = 0;
  for (int k = 0; k < 3; ++k) {
    const double a = (box.min[k] - from[k]) / way[k], b = (box.max[k] - from[k]) / way[k];
    first = std::max(first, std::min(a, b));
    last = std::min(last, std::max(a, b));
  }
  return first <= last;
}

TEST(ShadowReach, NoBoxWithAPointInShadowIsOutOfReach) {
  test::Random random(41);
  int none = 0, found = 0;
  for (int i = 0; i < 20'000; ++i) {
    const auto box = [&] {
      const Vec3 middle = random.inCube(3),
                 half(random.uniform(0.01, 1), random.uniform(0.01, 1), random.uniform(0.01, 1));
      return Box{middle - half, middle + half};
    };
    const Box caster = box(), receiver = box();
    const double w = i % 2;
    const Vec4 light(random.inCube(w == 0 ? 1 : 4), w);
    bool any = false;
    for (int k = 0; k < 60 && !any; ++k) {
      const Vec3 at = receiver.min + Vec3(random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1)) *
                                         receiver.extent();
      any = meets(caster, at, Vec3(light) - w * at, w == 0 ? std::numeric_limits<double>::infinity() : 1);
    }
    const bool may = mayShadow(light, caster, receiver);
    ASSERT_TRUE(may || !any) << i;
    none += !any;
    found += !may;
  }
  EXPECT_GT(none, 5000);
  EXPECT_GT(found, none * 95 / 100) << "some of what is told to be in reach has few points in shadow";
}

TEST(ShadowReach, WhatHoldsTheLightOrHasNoEndMay) {
  const Box one{Vec3(-1), Vec3(1)}, far{Vec3(5), Vec3(6)};
  EXPECT_TRUE(mayShadow({0, 0, 0, 1}, one, far)) << "the light is inside of the caster";
  EXPECT_TRUE(mayShadow({5.5, 5.5, 5.5, 1}, one, far) == false)
      << "inside of the receiver, which is in front of it";
  EXPECT_TRUE(mayShadow({0, 9, 0, 1}, Box{Vec3(-kInfinity), Vec3(kInfinity)}, far));
  EXPECT_TRUE(mayShadow({0, 9, 0, 1}, one, Box{Vec3(-1, -2, -1), Vec3(1, kInfinity, 1)}));
  EXPECT_FALSE(mayShadow({0, 9, 0, 1}, Box{}, one));
  EXPECT_TRUE(mayShadow({0, 1, 0, 0}, one, one)) << "of itself";
  // Straight down: beside it, above it, below it, touching it.
  EXPECT_FALSE(mayShadow({0, 1, 0, 0}, one, Box{Vec3(1.001, -9, -1), Vec3(2, -8, 1)}));
  EXPECT_FALSE(mayShadow({0, 1, 0, 0}, one, Box{Vec3(-1, 1.001, -1), Vec3(1, 2, 1)}));
  EXPECT_TRUE(mayShadow({0, 1, 0, 0}, one, Box{Vec3(0.999, -9, -1), Vec3(2, -8, 1)}));
  EXPECT_TRUE(mayShadow({0, 1, 0, 0}, one, Box{Vec3(-1, 1, -1), Vec3(1, 2, 1)}));
}

}  // namespace
}  // namespace luxo
