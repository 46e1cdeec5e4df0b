// SPDX-License-Identifier: Apache-2.0
// Points of lights that are no points: how they are spread, against areas in closed form.
#include "math/sampling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace luxo {
namespace {

constexpr std::uint32_t kMany = 4096;
/// Of shares of so many points: a quasirandom sequence in three dimensions has a star discrepancy of some
/// (log n)^2 / n, which is 0.017; what is cut by curves is a few times that.
constexpr double kSpread = 0.03;

/// From everywhere afar the ball looks like an evenly bright disc: of its projection the part within a circle
/// is the circle's area, and so is the part on either side of a line.
TEST(Sampling, ALuminousBallLooksLikeAnEvenDisc) {
  const Vec3 views[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.6, 0, 0.8}, {0.48, -0.6, 0.64}};
  for (const Vec3& view : views) {
    const Vec3 x = glm::normalize(glm::cross(view, Vec3(0.3, 0.5, 0.9))), y = glm::cross(view, x);
    for (const double radius : {0.2, 0.5, 0.7, 0.9, 0.99}) {
      std::uint32_t inside = 0, right = 0;
      for (std::uint32_t k = 0; k < kMany; ++k) {
        const Vec3 p = luminousBallPoint(k, kMany);
        inside += std::hypot(glm::dot(p, x), glm::dot(p, y)) < radius;
        right += glm::dot(p, x) > radius;
      }
      EXPECT_NEAR(static_cast<double>(inside) / kMany, radius * radius, kSpread) << radius;
      const double segment = std::acos(radius) - radius * std::sqrt(1 - radius * radius);
      EXPECT_NEAR(static_cast<double>(right) / kMany, segment / 3.14159265358979, kSpread) << radius;
    }
  }
}

/// Few points are spread, too: their mean is the middle, and none is outside.
TEST(Sampling, FewPointsOfABallAreSpread) {
  for (const std::uint32_t n : {2U, 4U, 16U, 64U}) {
    Vec3 sum(0);
    for (std::uint32_t k = 0; k < n; ++k) {
      sum += luminousBallPoint(k, n);
      EXPECT_LE(glm::length(luminousBallPoint(k, n)), 1 + 1e-12);
    }
    EXPECT_LT(glm::length(sum), 1e-12) << n;
  }
  EXPECT_EQ(luminousBallPoint(0, 1), Vec3(0));
  EXPECT_EQ(capPoint(0, 1, 0.3), Vec3(0, 0, 1));
}

/// Of a cap: heights are even in area (Archimedes), turns even, all points unit and within the angle.
TEST(Sampling, ACapIsCoveredEvenly) {
  for (const double angle : {1e-9, 0.00465, 0.5, 1.5707963267948966}) {
    for (const double part : {0.1, 0.5, 0.8}) {
      const double sine = std::sin(0.5 * part * angle), whole = std::sin(0.5 * angle);
      std::uint32_t inside = 0, ahead = 0;
      for (std::uint32_t k = 0; k < kMany; ++k) {
        const Vec3 p = capPoint(k, kMany, angle);
        ASSERT_NEAR(glm::length(p), 1, 1e-15);
        const double away = std::hypot(p.x, p.y);
        ASSERT_LE(away, std::sin(angle) * (1 + 1e-12));
        inside += away < std::sin(part * angle);
        ahead += p.x > 0;
      }
      EXPECT_NEAR(static_cast<double>(inside) / kMany, sine * sine / (whole * whole), 1e-3) << angle;
      EXPECT_NEAR(static_cast<double>(ahead) / kMany, 0.5, 1e-2) << angle;
    }
  }
}

}  // namespace
}  // namespace luxo
