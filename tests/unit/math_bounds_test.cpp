// SPDX-License-Identifier: Apache-2.0
#include "math/bounds.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace luxo {
namespace {

using Real = long double;

class RandomBoxes {
 public:
  explicit RandomBoxes(std::uint64_t seed) : engine_(seed) {}
  double between(double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(engine_); }
  double anySize() { return std::exp(between(-20, 20)) * (between(-1, 1) < 0 ? -1 : 1); }
  Vec3 vector(double size) { return {between(-size, size), between(-size, size), between(-size, size)}; }
  /// Often far from the origin compared with its size, where centres are hard to round.
  Box box() {
    const Vec3 corner = vector(std::abs(anySize()));
    Box box;
    box.add(corner);
    box.add(corner + vector(std::abs(anySize())));
    return box;
  }

 private:
  std::mt19937_64 engine_;
};

Vec3 corner(const Box& box, int i) {
  return {i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y, i & 4 ? box.max.z : box.min.z};
}

TEST(Box, GrowsFromNothing) {
  Box box;
  EXPECT_TRUE(box.empty());
  EXPECT_FALSE(box.contains(Vec3(0)));
  box.add(Vec3(1, 2, 3));
  EXPECT_FALSE(box.empty());
  EXPECT_TRUE(box.contains(Vec3(1, 2, 3)));
  box.add(Vec3(-1, 0, 5));
  EXPECT_EQ(box.min, Vec3(-1, 0, 3));
  EXPECT_EQ(box.max, Vec3(1, 2, 5));
  EXPECT_EQ(box.center(), Vec3(0, 1, 4));
  EXPECT_EQ(box.extent(), Vec3(2, 2, 2));
  box.add(Box{});
  EXPECT_EQ(box.min, Vec3(-1, 0, 3));
}

TEST(Box, TransformedHoldsEveryTransformedPoint) {
  // Against the exact image of the corners in long double, which an affine map's box must hold. Translations
  // that cancel the box's own distance leave rounding errors much larger than the result.
  RandomBoxes random(1);
  for (int i = 0; i < 50'000; ++i) {
    const Box box = random.box();
    Transform t{{random.vector(2), random.vector(2), random.vector(2)}, random.vector(10)};
    if (i % 2 == 0) t.translation = -(t.linear * box.center());
    const Box result = transformBounds(t, box);
    for (int k = 0; k < 8; ++k) {
      const Vec3 p = corner(box, k);
      for (int axis = 0; axis < 3; ++axis) {
        const Real exact = Real(t.linear[0][axis]) * p.x + Real(t.linear[1][axis]) * p.y +
                           Real(t.linear[2][axis]) * p.z + Real(t.translation[axis]);
        ASSERT_LE(Real(result.min[axis]), exact);
        ASSERT_GE(Real(result.max[axis]), exact);
      }
    }
  }
}

TEST(Box, TransformedIsTight) {
  // A quarter turn permutes the extents; the unit cube turned by 45 degrees is sqrt(2) wide.
  const Box cube{Vec3(-0.5), Vec3(0.5)};
  const Box turned = transformBounds({rotation({0, 0, 1}, kPi / 4), {10, 0, 0}}, cube);
  EXPECT_NEAR(turned.min.x, 10 - std::sqrt(0.5), 1e-13);
  EXPECT_NEAR(turned.max.y, std::sqrt(0.5), 1e-13);
  EXPECT_NEAR(turned.max.z, 0.5, 1e-13);
  const Box quarter = transformBounds({rotation({0, 0, 1}, kPi / 2), {}}, {{1, 2, 3}, {4, 6, 8}});
  EXPECT_NEAR(quarter.min.x, -6, 1e-14);
  EXPECT_NEAR(quarter.max.x, -2, 1e-14);
  EXPECT_NEAR(quarter.min.y, 1, 1e-14);
  EXPECT_NEAR(quarter.max.y, 4, 1e-14);
}

TEST(Box, TransformedEmptyStaysEmptyAndInfiniteStaysInfinite) {
  EXPECT_TRUE(transformBounds({rotation({1, 2, 3}, 1), {4, 5, 6}}, {}).empty());
  const Box slab{{-kInfinity, 0, -1}, {kInfinity, 1, kInfinity}};
  const Box moved = transformBounds({Mat3(2), {1, 1, 1}}, slab);
  EXPECT_EQ(moved.min.x, -kInfinity);
  EXPECT_EQ(moved.max.x, kInfinity);
  EXPECT_NEAR(moved.min.y, 1, 1e-14);
  EXPECT_NEAR(moved.max.y, 3, 1e-14);
  EXPECT_NEAR(moved.min.z, -1, 1e-14);
  EXPECT_EQ(moved.max.z, kInfinity);
}

TEST(Sphere, AroundABoxHoldsItsCorners) {
  RandomBoxes random(2);
  for (int i = 0; i < 50'000; ++i) {
    const Box box = random.box();
    const Sphere sphere = sphereAround(box);
    for (int k = 0; k < 8; ++k) {
      const Vec3 p = corner(box, k);
      const Real x = Real(p.x) - sphere.center.x, y = Real(p.y) - sphere.center.y,
                 z = Real(p.z) - sphere.center.z;
      ASSERT_LE(std::sqrt(x * x + y * y + z * z), Real(sphere.radius));
    }
    // As tight as the centre can be rounded.
    const double size = glm::length(box.extent()) / 2, far = glm::length(sphere.center);
    ASSERT_LE(sphere.radius, size * (1 + 3e-15) + far * 4e-16);
  }
}

TEST(Sphere, AroundTheUnboundedIsUnbounded) {
  EXPECT_EQ(sphereAround({}).radius, 0);
  for (const Box& box : {Box{{-kInfinity, 0, 0}, {kInfinity, 1, 1}}, Box{{0, 0, 0}, {1, kInfinity, 1}}}) {
    const Sphere sphere = sphereAround(box);
    EXPECT_EQ(sphere.radius, kInfinity);
    EXPECT_EQ(sphere.center, sphere.center) << "a centre that is not a number";
  }
}

}  // namespace
}  // namespace luxo
