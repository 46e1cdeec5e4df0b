// SPDX-License-Identifier: Apache-2.0
// The cardinal sine of a root, of all orders: values, bounds, derivatives.
#include "math/cardinal.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace luxo {
namespace {

/// The power series in quadruple precision: the terms grow to e^sqrt|w|, which is 1e13 at most here, and 33
/// digits are kept.
double truth(double w, int order) {
  __extension__ using Precise = __float128;
  Precise term = 1, sum = 0;
  for (int n = 1; n <= order; ++n) term /= 2 * n + 1;
  for (int k = 1; k < 200; ++k) {
    sum += term;
    term *= -Precise(w) / (2 * k * (2 * order + 2 * k + 1));
  }
  return static_cast<double>(sum);
}

TEST(Cardinal, IsRightToItsLastDigits) {
  for (int order = 0; order <= 6; ++order)
    for (int i = -3000; i <= 9000; ++i) {
      const double w = 0.1 * i + 0.01, exact = truth(w, order);
      const double allowed = 1e-13 * (w > 0 ? cardinalAtZero(order) : exact);
      ASSERT_NEAR(cardinal(w, order), exact, allowed) << w << " order " << order;
    }
  EXPECT_EQ(cardinal(0.0, 0), 1);
  EXPECT_EQ(cardinal(0.0, 2), 1 / 15.0);
  EXPECT_TRUE(std::isnan(cardinal(std::nan(""), 0)));
}

TEST(Cardinal, BoundsHoldWhatIsInThem) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> part(0, 1);
  for (int i = 0; i < 40'000; ++i) {
    const int order = i % 7;
    const double lo = -40 + 600 * std::pow(part(random), 2), width = std::exp(10 * part(random) - 6);
    const Interval w(lo, lo + width), bounds = cardinal(w, order);
    double least = INFINITY, most = -INFINITY;
    for (int k = 0; k <= 40; ++k) {
      const double value = cardinal(lo + width * k / 40, order);
      ASSERT_TRUE(bounds.contains(value)) << order << ": " << lo << " + " << width;
      least = std::min(least, value);
      most = std::max(most, value);
    }
    // To 20 the range itself; beyond, what the steepest slope of all makes of the width.
    const double atZero = cardinalAtZero(order);
    const double sharp = w.hi < 20 ? (most - least) * (1 + 1e-9) : 1.01 * width * cardinalAtZero(order + 1);
    if (w.hi >= 20 && lo < 0) continue;
    EXPECT_LE(bounds.width(), std::min(sharp, 2 * std::max(atZero, most)) + 4e-13 * std::max(atZero, most))
        << order << ": " << lo << " + " << width;
  }
}

}  // namespace
}  // namespace luxo
