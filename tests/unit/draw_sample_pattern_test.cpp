// SPDX-License-Identifier: Apache-2.0
// Where pictures of many passes sample their pixels, against the areas beyond edges.
#include "draw/accumulation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "math/vec.h"

namespace luxo {
namespace {

/// The part of a unit square around the origin where n . p < distance, n at that angle: the distribution of
/// the sum of two independent uniform numbers, of widths |cos| and |sin|.
double areaBelow(double angle, double distance) {
  const double a = std::abs(std::cos(angle)), b = std::abs(std::sin(angle));
  const double wide = std::max(a, b), narrow = std::min(a, b);
  if (narrow < 1e-9) return std::clamp(distance / wide + 0.5, 0.0, 1.0);
  const auto ramp = [](double x) { return x > 0 ? 0.5 * x * x : 0; };
  const double outer = 0.5 * (wide + narrow), inner = 0.5 * (wide - narrow);
  return (ramp(distance + outer) - ramp(distance + inner) - ramp(distance - inner) + ramp(distance - outer)) /
         (wide * narrow);
}

/// The largest difference between the share of the points below an edge and the area, over many edges.
double discrepancy(const std::vector<Vec2>& points) {
  double worst = 0;
  for (int i = 0; i < 60; ++i) {
    const double angle = kPi * i / 60;
    for (int j = -70; j <= 70; ++j) {
      const double distance = 0.01 * j + 0.0003;
      const auto below = std::ranges::count_if(
          points, [&](const Vec2& p) { return p.x * std::cos(angle) + p.y * std::sin(angle) < distance; });
      const double share = static_cast<double>(below) / static_cast<double>(points.size());
      worst = std::max(worst, std::abs(share - areaBelow(angle, distance)));
    }
  }
  return worst;
}

TEST(SamplePattern, OneSampleIsTheCentre) { EXPECT_EQ(samplePattern(1), std::vector<Vec2>{Vec2(0)}); }

TEST(SamplePattern, IsCentredInThePixel) {
  for (int n = 1; n <= 256; ++n) {
    Vec2 sum(0);
    for (const Vec2& p : samplePattern(n)) {
      sum += p;
      // Half a pixel, and the mean that was taken off.
      EXPECT_LE(std::max(std::abs(p.x), std::abs(p.y)), 0.5 + 0.25 / std::sqrt(n));
    }
    EXPECT_NEAR(glm::length(sum), 0, 1e-12) << n;
  }
}

TEST(SamplePattern, EdgesAreCoveredAsTheirArea) {
  EXPECT_NEAR(areaBelow(0, 0.2), 0.7, 1e-15);
  EXPECT_NEAR(areaBelow(kPi / 4, 0), 0.5, 1e-15);
  EXPECT_NEAR(areaBelow(kPi / 4, -std::sqrt(0.125)), 0.125, 1e-15);  // the triangle half way to the corner
  for (const int n : {1, 2, 3, 4, 5, 6, 8, 12, 16, 31, 64, 100, 200, 256})
    EXPECT_LT(discrepancy(samplePattern(n)), 2 / std::pow(n, 0.75)) << n;
}

TEST(SamplePattern, EveryBeginningIsSpread) {
  const std::vector<Vec2> all = samplePattern(256);
  EXPECT_LT(glm::length(all.front()), 0.01) << "the first is all but in the centre";
  for (const int n : {4, 8, 16, 32, 64, 128})
    EXPECT_LT(discrepancy({all.begin(), all.begin() + n}), 3 / std::pow(n, 0.75)) << n;
}

}  // namespace
}  // namespace luxo
