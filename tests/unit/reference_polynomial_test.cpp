// SPDX-License-Identifier: Apache-2.0
// Roots of polynomials that were multiplied out from them.
#include "reference/polynomial.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace luxo::reference {
namespace {

/// lead * (x - r0)(x - r1)..., rounding enclosed.
std::vector<Interval> product(double lead, const std::vector<double>& roots) {
  std::vector<Interval> c{Interval(lead)};
  for (const double root : roots) {
    c.insert(c.begin(), Interval(0));
    for (std::size_t i = 0; i + 1 < c.size(); ++i) c[i] = c[i] - root * c[i + 1];
  }
  return c;
}

TEST(ReferencePolynomial, FindsEveryRootOfKnownProducts) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(-3, 3);
  for (int degree = 1; degree <= 4; ++degree)
    for (int trial = 0; trial < 500; ++trial) {
      std::vector<double> truth;
      for (int i = 0; i < degree; ++i) truth.push_back(place(random));
      std::ranges::sort(truth);
      const double lead = trial % 2 == 0 ? 0.7 : -1.3;
      const RealRoots roots = realRoots(product(lead, truth), 3);
      ASSERT_TRUE(roots.decided) << degree << ' ' << trial;
      ASSERT_EQ(roots.count, degree);
      for (int i = 0; i < degree; ++i) {
        const RealRoot& root = roots.roots[static_cast<std::size_t>(i)];
        EXPECT_TRUE(root.at.contains(truth[static_cast<std::size_t>(i)]));
        EXPECT_LT(root.at.width(), 1e-7);  // what nearby roots make of 1e-15 in the coefficients
        // To the right of the last root the sign is that of `lead`.
        EXPECT_EQ(root.rising, ((degree - i) % 2 == 1) == (lead > 0));
      }
    }
}

// (x^2 + 1)(x - a)(x - b), and with no real root at all.
TEST(ReferencePolynomial, LeavesOutComplexRoots) {
  const double a = -0.3, b = 1.1;
  const RealRoots two = realRoots(std::vector<Interval>{a * b, -(a + b), 1 + a * b, -(a + b), 1}, 2);
  ASSERT_TRUE(two.decided);
  ASSERT_EQ(two.count, 2);
  EXPECT_NEAR(two.roots[0].at.mid(), a, 1e-14);
  EXPECT_NEAR(two.roots[1].at.mid(), b, 1e-14);
  const RealRoots none = realRoots(std::vector<Interval>{1, 0, 2, 0, 1}, 2);
  EXPECT_TRUE(none.decided);
  EXPECT_EQ(none.count, 0);
  EXPECT_EQ(realRoots(std::vector<Interval>{1, 0, 1}, 2).count, 0);
}

// A double root is not decided; 1e-5 to one side there are two, to the other none.
TEST(ReferencePolynomial, SaysWhenRootsTouch) {
  for (const bool quartic : {false, true}) {
    const auto touching = [&](double gap) {  // ((x - 0.37)^2 - gap) (x^2 + 2, for the quartic)
      const Interval q = square(Interval(0.37)) - gap;
      if (!quartic) return realRoots(std::vector<Interval>{q, -0.74, 1}, 1);
      return realRoots(std::vector<Interval>{2 * q, -1.48, q + 2, -0.74, 1}, 1);
    };
    EXPECT_FALSE(touching(0).decided);
    EXPECT_EQ(touching(1e-10).count, 2);
    EXPECT_TRUE(touching(-1e-10).decided);
    EXPECT_EQ(touching(-1e-10).count, 0);
  }
}

// A leading coefficient that is 0 within rounding: the one root stays, the other is far away.
TEST(ReferencePolynomial, AlmostLinear) {
  const RealRoots roots = realRoots(std::vector<Interval>{-1, 2, {-1e-17, 1e-17}}, 10);
  ASSERT_TRUE(roots.decided);
  ASSERT_EQ(roots.count, 1);
  EXPECT_NEAR(roots.roots[0].at.mid(), 0.5, 1e-15);
  EXPECT_FALSE(realRoots(std::vector<Interval>{{-1, 1}, {-1, 1}}, 10).decided);
}

}  // namespace
}  // namespace luxo::reference
