// SPDX-License-Identifier: Apache-2.0
// FLIP against answers worked out by hand from the paper.
#include "image/flip.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"

namespace luxo {
namespace {

Image uniform(int width, int height, float r, float g, float b) {
  Image image(width, height, 3);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const auto p = image.pixel(x, y);
      p[0] = r, p[1] = g, p[2] = b;
    }
  return image;
}

TEST(Flip, EqualPicturesDoNotDiffer) {
  Image image = uniform(40, 30, 0.2F, 0.5F, 0.9F);
  image.pixel(7, 9)[1] = 0;
  const Flip result = flip(image, image);
  EXPECT_EQ(result.max, 0);
  EXPECT_EQ(result.mean, 0);
}

// Uniform colours pass every filter unchanged and have no edges: what is left is the colour distance alone.
TEST(Flip, UniformColorsDifferByTheirRescaledHyab) {
  // Green and blue are the farthest apart.
  EXPECT_NEAR(flip(uniform(24, 24, 0, 1, 0), uniform(24, 24, 0, 0, 1)).mean, 1, 1e-6);
  // Black and white: L* 0 and 100, no chroma. Green is L*a*b* (87.735, -86.183, 83.179) and blue (32.297,
  // 79.188, -107.860), Hunt-adjusted a, b: L times a hundredth: 55.438 + |(-101.187, 107.814)| = 203.30.
  const double largest = std::pow(203.30, 0.7), knee = 0.4 * largest;
  const double d = std::pow(100.0, 0.7);
  const double expected = 0.95 + (d - knee) / (largest - knee) * 0.05;
  EXPECT_NEAR(flip(uniform(24, 24, 0, 0, 0), uniform(24, 24, 1, 1, 1)).mean, expected, 1e-4);
  // Two near greys: linear 0.20 and 0.21 have L* 51.837 and 52.950 (116 cbrt(Y) - 16), below the knee.
  const double step = 116 * (std::cbrt(0.21) - std::cbrt(0.20));
  EXPECT_NEAR(flip(uniform(24, 24, 0.2F, 0.2F, 0.2F), uniform(24, 24, 0.21F, 0.21F, 0.21F)).mean,
              0.95 / knee * std::pow(step, 0.7), 1e-4);
}

TEST(Flip, IsSymmetric) {
  Image a = uniform(32, 32, 0.1F, 0.1F, 0.1F), b = a;
  for (int x = 5; x < 20; ++x) b.pixel(x, 12)[0] = 0.8F;
  EXPECT_DOUBLE_EQ(flip(a, b).mean, flip(b, a).mean);
}

// Beside a step from black to white all positive weights of the edge filter see white and all negative ones
// black: the feature is 1 there, and the exponent of the colour difference 1 - sqrt(1 / sqrt 2).
TEST(Flip, AnEdgeThatIsMissingCounts) {
  const Image plain = uniform(64, 64, 0.5F, 0.5F, 0.5F);
  Image step = uniform(64, 64, 0, 0, 0);
  for (int y = 0; y < 64; ++y)
    for (int x = 32; x < 64; ++x)
      for (float& sample : step.pixel(x, y)) sample = 1;
  const Flip result = flip(plain, step);
  const double atTheEdge = result.map.pixel(32, 32)[0], awayFromIt = result.map.pixel(4, 32)[0];
  // Far from the edge no feature differs: grey against black. L* of 0.5 is 76.069.
  const double largest = std::pow(203.30, 0.7), knee = 0.4 * largest;
  const double d = std::pow(116 * std::cbrt(0.5) - 16, 0.7);
  EXPECT_NEAR(awayFromIt, d < knee ? 0.95 / knee * d : 0.95 + (d - knee) / (largest - knee) * 0.05, 1e-3);
  // At the edge the eye's filter makes both sides nearly grey, so the colour difference is small; the missing
  // edge lifts it: colour^(1 - 0.84).
  EXPECT_GT(atTheEdge, std::pow(0.05, 1 - std::sqrt(1 / std::sqrt(2.0))));
}

// One white pixel on black, by hand, at that pixel. The eye's achromatic filter leaves its centre's weight of
// the light (a grey: no chroma). Edges balance out there; of the second derivative of the feature's Gaussian
// the centre's weight is left along x and along y.
TEST(Flip, APointHasTheFiltersCentralWeights) {
  const Image black = uniform(81, 81, 0, 0, 0);
  Image point = black;
  for (float& sample : point.pixel(40, 40)) sample = 1;
  constexpr double kPerDegree = 67.02064327658226, kPi = 3.14159265358979323846;
  double sensitivity = 0, smooth = 0, negative = 0;
  const int eyeRadius = static_cast<int>(std::ceil(3 * std::sqrt(0.04 / (2 * kPi * kPi)) * kPerDegree));
  for (int k = -eyeRadius; k <= eyeRadius; ++k)
    sensitivity += std::exp(-kPi * kPi * k * k / (kPerDegree * kPerDegree * 0.0047));
  const double deviation = 0.5 * 0.082 * kPerDegree;
  for (int k = -static_cast<int>(std::ceil(3 * deviation)); k <= std::ceil(3 * deviation); ++k) {
    const double x = k / deviation, g = std::exp(-0.5 * x * x);
    smooth += g;
    negative += std::max(1 - x * x, 0.0) * g;
  }
  const double light = 1 / (sensitivity * sensitivity), feature = std::sqrt(2.0) / (negative * smooth);
  const double lightness = light > 216.0 / 24389 ? 116 * std::cbrt(light) - 16 : light * 24389 / 27;
  const double knee = 0.4 * std::pow(203.30, 0.7);
  const double color = 0.95 / knee * std::pow(lightness, 0.7);
  ASSERT_LT(color, 0.95);
  EXPECT_NEAR(flip(black, point).map.pixel(40, 40)[0],
              std::pow(color, 1 - std::sqrt(feature / std::sqrt(2.0))), 1e-4);
}

// The eye averages what is finer than it can resolve: a checkerboard of single pixels at 67 pixels per degree
// is nearly a grey of the same mean light, but at 5 pixels per degree it is plainly seen.
TEST(Flip, FineDetailIsSeenFromNearOnly) {
  const Image grey = uniform(64, 64, 0.5F, 0.5F, 0.5F);
  Image board = grey;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x)
      for (float& sample : board.pixel(x, y)) sample = (x + y) % 2 == 0 ? 0.45F : 0.55F;
  const double far = flip(grey, board).map.pixel(32, 32)[0];
  const double near = flip(grey, board, {.pixelsPerDegree = 5}).map.pixel(32, 32)[0];
  EXPECT_LT(far, 0.02);
  EXPECT_GT(near, 4 * far);
}

TEST(Flip, RefusesPicturesOfDifferentSizes) {
  EXPECT_THROW(static_cast<void>(flip(uniform(8, 8, 0, 0, 0), uniform(8, 9, 0, 0, 0))), Error);
}

}  // namespace
}  // namespace luxo
