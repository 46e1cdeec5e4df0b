// SPDX-License-Identifier: Apache-2.0
#include "math/interval.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "math/vec.h"

namespace luxo {
namespace {

using Real =
    long double;  // 64 bits of mantissa: its own rounding is 2^-11 of what the intervals step outward

constexpr double kLargest = std::numeric_limits<double>::max();
constexpr double kSmallest = std::numeric_limits<double>::denorm_min();

/// One operation on intervals and on numbers. A unary one ignores y.
struct Operation {
  std::string name;
  std::function<Interval(Interval, Interval)> onIntervals;
  std::function<Real(Real, Real)> onNumbers;
};

Real integerPower(Real x, int n) {
  Real product = 1;
  for (int i = 0; i < std::abs(n); ++i) product *= x;
  return n < 0 ? 1 / product : product;
}

const std::vector<Operation>& operations() {
  using I = const Interval&;
  static const std::vector<Operation> all = [] {
    std::vector<Operation> list{
        {"negate", [](I x, I) { return -x; }, [](Real x, Real) { return -x; }},
        {"add", [](I x, I y) { return x + y; }, [](Real x, Real y) { return x + y; }},
        {"subtract", [](I x, I y) { return x - y; }, [](Real x, Real y) { return x - y; }},
        {"multiply", [](I x, I y) { return x * y; }, [](Real x, Real y) { return x * y; }},
        {"divide", [](I x, I y) { return x / y; }, [](Real x, Real y) { return x / y; }},
        {"hull", [](I x, I y) { return hull(x, y); }, [](Real x, Real) { return x; }},
        {"square", [](I x, I) { return square(x); }, [](Real x, Real) { return x * x; }},
        {"sqrt", [](I x, I) { return sqrt(x); }, [](Real x, Real) { return std::sqrt(x); }},
        {"exp", [](I x, I) { return exp(x); }, [](Real x, Real) { return std::exp(x); }},
        {"log", [](I x, I) { return log(x); }, [](Real x, Real) { return std::log(x); }},
        {"sin", [](I x, I) { return sin(x); }, [](Real x, Real) { return std::sin(x); }},
        {"cos", [](I x, I) { return cos(x); }, [](Real x, Real) { return std::cos(x); }},
        {"tan", [](I x, I) { return tan(x); }, [](Real x, Real) { return std::tan(x); }},
        {"sinh", [](I x, I) { return sinh(x); }, [](Real x, Real) { return std::sinh(x); }},
        {"cosh", [](I x, I) { return cosh(x); }, [](Real x, Real) { return std::cosh(x); }},
        {"tanh", [](I x, I) { return tanh(x); }, [](Real x, Real) { return std::tanh(x); }},
        {"asin", [](I x, I) { return asin(x); }, [](Real x, Real) { return std::asin(x); }},
        {"acos", [](I x, I) { return acos(x); }, [](Real x, Real) { return std::acos(x); }},
        {"atan", [](I x, I) { return atan(x); }, [](Real x, Real) { return std::atan(x); }},
        {"atan2", [](I x, I y) { return atan2(x, y); }, [](Real x, Real y) { return std::atan2(x, y); }},
        {"abs", [](I x, I) { return abs(x); }, [](Real x, Real) { return std::abs(x); }},
        {"min", [](I x, I y) { return min(x, y); }, [](Real x, Real y) { return std::min(x, y); }},
        {"max", [](I x, I y) { return max(x, y); }, [](Real x, Real y) { return std::max(x, y); }},
        {"floor", [](I x, I) { return floor(x); }, [](Real x, Real) { return std::floor(x); }},
        {"sign", [](I x, I) { return sign(x); }, [](Real x, Real) { return Real((x > 0) - (x < 0)); }},
        {"less", [](I x, I y) { return less(x, y); }, [](Real x, Real y) { return Real(x < y); }},
        {"less or equal", [](I x, I y) { return lessEqual(x, y); },
         [](Real x, Real y) { return Real(x <= y); }},
        {"equal", [](I x, I y) { return equal(x, y); }, [](Real x, Real y) { return Real(x == y); }},
        {"select", [](I x, I y) { return select(x, y, x); }, [](Real x, Real y) { return x != 0 ? y : x; }},
        {"raise", [](I x, I y) { return pow(x, y); }, [](Real x, Real y) { return std::pow(x, y); }},
        {"raise to 2.5", [](I x, I) { return pow(x, 2.5); },
         [](Real x, Real) { return x * x * std::sqrt(x); }},
        {"raise to -0.25", [](I x, I) { return pow(x, -0.25); },
         [](Real x, Real) { return 1 / std::sqrt(std::sqrt(x)); }},
        {"raise to 3", [](I x, I) { return pow(x, 3.0); }, [](Real x, Real) { return x * x * x; }},
        {"raise to -4", [](I x, I) { return pow(x, -4.0); },
         [](Real x, Real) { return 1 / (x * x * x * x); }}};
    for (const int n : {-3, -2, -1, 0, 1, 2, 3, 4, 5, 8, 13})
      list.push_back({"pow " + std::to_string(n), [n](I x, I) { return pow(x, n); },
                      [n](Real x, Real) { return integerPower(x, n); }});
    return list;
  }();
  return all;
}

class RandomIntervals {
 public:
  explicit RandomIntervals(std::uint64_t seed) : engine_(seed) {}

  double between(double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(engine_); }
  int below(int n) { return static_cast<int>(engine_() % static_cast<std::uint64_t>(n)); }

  /// Everyday sizes, both signs, sometimes a small integer (where functions have their zeros and extremes).
  double number() {
    const double sign = below(2) == 0 ? -1 : 1;
    switch (below(4)) {
      case 0:
        return sign * below(4);
      case 1:
        return sign * std::exp(between(-14, 6));
      default:
        return between(-8, 8);
    }
  }
  /// Any finite double: all exponents, subnormals included.
  double anyBits() {
    for (;;) {
      const double x = std::bit_cast<double>(engine_());
      if (std::isfinite(x)) return x;
    }
  }
  Interval interval(double a, double b) { return {std::min(a, b), std::max(a, b)}; }
  /// A point, a narrow or a wide interval.
  Interval interval() {
    const double a = number();
    switch (below(4)) {
      case 0:
        return a;
      case 1:
        return interval(a, a + std::exp(between(-36, 0)));
      default:
        return interval(a, number());
    }
  }
  double pointOf(const Interval& x) {
    switch (below(5)) {
      case 0:
        return x.lo;
      case 1:
        return x.hi;
      default:
        return std::clamp(x.lo + between(0, 1) * (x.hi - x.lo), x.lo, x.hi);
    }
  }

 private:
  std::mt19937_64 engine_;
};

/// Where the operation is not defined, nothing must be claimed.
void expectInside(const Operation& f, const Interval& result, const Interval& x, const Interval& y, double px,
                  double py) {
  const Real exact = f.onNumbers(px, py);
  ASSERT_TRUE((Real(result.lo) <= exact && exact <= Real(result.hi)) || result == Interval::everything())
      << f.name << " of [" << x.lo << ", " << x.hi << "], [" << y.lo << ", " << y.hi << "] at " << px << ", "
      << py << " is " << exact << ", outside [" << result.lo << ", " << result.hi << "]";
}

TEST(Interval, HoldsAMillionResultsOfEveryFunction) {
  RandomIntervals random(1);
  for (const Operation& f : operations()) {
    const int intervals = f.name.starts_with("pow") ? 2'000 : 20'000;  // 11 times
    for (int i = 0; i < intervals; ++i) {
      const bool unit = i % 2 == 0 && (f.name == "asin" || f.name == "acos");
      const bool positive =
          i % 2 == 0 && (f.name == "sqrt" || f.name == "log" || f.name.starts_with("raise"));
      const Interval any = random.interval(), y = random.interval();
      const Interval x = unit ? sin(any) : positive ? abs(any) : any;
      const Interval result = f.onIntervals(x, y);
      for (int k = 0; k < 50; ++k) expectInside(f, result, x, y, random.pointOf(x), random.pointOf(y));
      if (HasFatalFailure()) return;
    }
  }
}

TEST(Interval, ClaimsSomethingWhereverItIsDefined) {
  // Inclusion alone is easy: everything() includes. Off poles and jumps a narrow operand gives a narrow
  // result: the widths below are ten times the slopes at 0.5..1, which are at most 4 for all functions here.
  RandomIntervals random(11);
  for (const Operation& f : operations()) {
    const bool steps = f.name == "floor" || f.name == "less" || f.name == "less or equal" ||
                       f.name == "equal" || f.name == "hull";
    if (f.name.starts_with("pow") || f.name == "raise to -4" || steps) continue;
    for (int i = 0; i < 2'000; ++i) {
      const double a = random.between(0.5, 0.99), b = random.between(0.5, 0.99);
      const double slope = f.name == "asin" || f.name == "acos" ? 1 / std::sqrt(1 - 0.9901 * 0.9901) : 4;
      const Interval result = f.onIntervals({a, a + 1e-4}, {b, b + 1e-4});
      ASSERT_LE(result.width(), 10 * slope * 1e-4) << f.name << " at " << a << ", " << b;
    }
  }
}

TEST(Interval, HoldsEveryResultAtEverySize) {
  // The bounds of the operands are reached, and the exact result may overflow or underflow double; the
  // comparison is in the wider exponent range of Real. Trigonometry and hyperbolics included.
  RandomIntervals random(2);
  for (const Operation& f : operations())
    for (int i = 0; i < 10'000; ++i) {
      const Interval x = random.interval(random.anyBits(), random.anyBits());
      const Interval y = random.interval(random.anyBits(), random.anyBits());
      const Real exact = f.onNumbers(x.lo, y.hi);
      if (std::isinf(exact)) continue;  // overflows even Real
      expectInside(f, f.onIntervals(x, y), x, y, x.lo, y.hi);
      if (HasFatalFailure()) return;
    }
}

TEST(Interval, PointsGiveNarrowResults) {
  // Steps outward: 1 on each side of a correctly rounded result, 4 for the C library; division rounds twice,
  // integer powers once per multiplication. In units of the larger end's distance to its neighbour.
  RandomIntervals random(3);
  for (const Operation& f : operations()) {
    if (f.name == "hull") continue;
    const bool power = f.name.starts_with("pow");
    const double mostSteps = power ? 60 : f.name.starts_with("raise to -4") ? 20 : 9;
    for (int i = 0; i < 5'000; ++i) {
      const bool inUnit = f.name == "asin" || f.name == "acos";
      const double x = inUnit ? random.between(-1, 1) : random.between(0.5, 4), y = random.between(0.5, 4);
      const Interval result = f.onIntervals(x, y);
      ASSERT_TRUE(Real(result.lo) <= f.onNumbers(x, y) && f.onNumbers(x, y) <= Real(result.hi)) << f.name;
      const double step = std::nextafter(result.magnitude(), kInfinity) - result.magnitude();
      // tan and log cross zero or a pole where the step varies; a few smallest steps of 1 are then allowed.
      const double unitStep = std::max(step, f.name == "tan" || f.name == "log" ? 0x1p-52 : 0.0);
      ASSERT_LE(result.width(), mostSteps * unitStep) << f.name << " of " << x << ", " << y;
    }
  }
}

TEST(Interval, WhatIsExactStaysExact) {
  const Interval zero(0), wide(-3, 7);
  for (const Interval& x : {wide, Interval(0.1), zero}) {
    EXPECT_EQ(zero * x, zero);
    EXPECT_EQ(x * zero, zero);
    EXPECT_EQ(x + zero, x);
    EXPECT_EQ(zero + x, x);
    EXPECT_EQ(x - zero, x);
    EXPECT_EQ(zero - x, -x);
  }
  EXPECT_EQ(square(zero), zero);
  EXPECT_EQ(sqrt(zero), zero);
  EXPECT_EQ(pow(zero, 3), zero);
  EXPECT_EQ(pow(zero, 2), zero);
  EXPECT_EQ(pow(zero, 2.5), zero);
  EXPECT_EQ(pow(wide, 0), Interval(1));
  for (const Interval& nothing : {sin(zero), tan(zero), asin(zero), atan(zero), sinh(zero), tanh(zero)})
    EXPECT_EQ(nothing, zero);
  EXPECT_EQ(log(Interval(1)), zero);
  EXPECT_EQ(acos(Interval(1)), zero);
  // Short numbers: neither end moves.
  EXPECT_EQ(Interval(1, 3) + Interval(0.5), Interval(1.5, 3.5));
  EXPECT_EQ(Interval(-1, 3) * Interval(0.5, 2), Interval(-2, 6));
  EXPECT_EQ(Interval(-1, 3) * Interval(-5, 2), Interval(-15, 6));
  EXPECT_EQ(Interval(-6, 3) / Interval(2, 4), Interval(-3, 1.5));
  EXPECT_EQ(square(Interval(-1.5, 1)), Interval(0, 2.25));
  EXPECT_EQ(sqrt(Interval(2.25, 9)), Interval(1.5, 3));
  EXPECT_EQ(pow(Interval(-2, 3), 3), Interval(-8, 27));
  // What keeps the root of 1 - x^2 defined up to the edge.
  EXPECT_EQ(sqrt(Interval(1) - square(Interval(-1, 1))), Interval(0, 1));
  // Long ones: 0.1 + 0.2 and 0.1 * 0.1 and 1 / 3 are no doubles.
  EXPECT_LT((Interval(0.1) + Interval(0.2)).lo, (Interval(0.1) + Interval(0.2)).hi);
  EXPECT_LT((Interval(0.1) * Interval(0.1)).lo, (Interval(0.1) * Interval(0.1)).hi);
  EXPECT_LT((Interval(1) / Interval(3)).lo, (Interval(1) / Interval(3)).hi);
  EXPECT_LT(sqrt(Interval(2)).lo, sqrt(Interval(2)).hi);
}

TEST(Interval, OutsideTheDomainNothingIsClaimed) {
  const Interval everything = Interval::everything();
  for (const Interval& outside :
       {Interval(1) / Interval(-1, 1), Interval(1) / Interval(0), Interval(1) / Interval(0, 2),
        pow(Interval(-1, 2), -2), pow(Interval(-1, 2), 0.5), pow(Interval(-1, 2), Interval(2, 3)),
        pow(Interval(0, 2), -0.5), log(Interval(-2, -1)), log(Interval(-1, 1)), log(Interval(0)),
        sqrt(Interval(-2, -1)), sqrt(Interval(-1, 4)), asin(Interval(-2, 0)), acos(Interval(0.5, 1.5)),
        tan(Interval(1.5, 1.6)), tan(Interval(-1, 4))})
    EXPECT_EQ(outside, everything);
  EXPECT_EQ(log(Interval(0, 1)), Interval(-kInfinity, 0));
}

TEST(Interval, WhatMayBeUndefinedStaysSo) {
  // sqrt(-1) * 0, sin(1 / 0), min(log(-1), 3), ... are not numbers.
  const Interval everything = Interval::everything(), two(2), zero(0);
  for (const Operation& f : operations()) {
    if (f.name.starts_with("less") || f.name == "equal" || f.name == "pow 0") continue;
    EXPECT_EQ(f.onIntervals(everything, two), everything) << f.name;
    const bool binary = f.name == "add" || f.name == "subtract" || f.name == "multiply" ||
                        f.name == "divide" || f.name == "atan2" || f.name == "min" || f.name == "max" ||
                        f.name == "raise";
    if (!binary) continue;
    EXPECT_EQ(f.onIntervals(two, everything), everything) << f.name;
    EXPECT_EQ(f.onIntervals(zero, everything), everything) << f.name;
  }
  // Comparisons with NaN are false, so they are never certainly true.
  EXPECT_EQ(less(everything, two), Interval(0, 1));
  EXPECT_EQ(lessEqual(everything, Interval(kInfinity)), Interval(0, 1));
  EXPECT_EQ(equal(everything, two), Interval(0, 1));
  // What is not chosen does not matter; what may be chosen does.
  EXPECT_EQ(select(1, two, everything), two);
  EXPECT_EQ(select(0, everything, two), two);
  EXPECT_EQ(select(Interval(0, 1), everything, two), everything);
  // Infinity times 0, minus itself, or in a wave, is not a number either.
  const Interval huge(1, kInfinity);
  EXPECT_EQ(huge * Interval(0, 1), everything);
  EXPECT_EQ(huge - huge, everything);
  EXPECT_EQ(huge / huge, everything);
  EXPECT_EQ(sin(huge), everything);
}

TEST(Interval, KnownRanges) {
  const double pi = kPi;
  const auto expectNear = [](const Interval& x, double lo, double hi) {
    EXPECT_NEAR(x.lo, lo, 4e-15 * (1 + std::abs(lo)));
    EXPECT_NEAR(x.hi, hi, 4e-15 * (1 + std::abs(hi)));
  };
  expectNear(asin(Interval(-1, 0.5)), -pi / 2, pi / 6);
  expectNear(acos(Interval(-1, 0.5)), pi / 3, pi);
  expectNear(atan(Interval(-1, kInfinity)), -pi / 4, pi / 2);
  expectNear(atan2(Interval(1, 2), Interval(-1, 1)), pi / 4, 3 * pi / 4);
  expectNear(atan2(Interval(-1, 1), Interval(1, 2)), -pi / 4, pi / 4);
  expectNear(atan2(Interval(-2, -1), Interval(-1, 1)), -3 * pi / 4, -pi / 4);
  expectNear(atan2(Interval(-1, 1), Interval(-2, -1)), -pi, pi);
  EXPECT_EQ(abs(Interval(-3, 2)), Interval(0, 3));
  EXPECT_EQ(abs(Interval(-3, -2)), Interval(2, 3));
  EXPECT_EQ(min(Interval(0, 5), Interval(2, 3)), Interval(0, 3));
  EXPECT_EQ(max(Interval(0, 5), Interval(2, 3)), Interval(2, 5));
  EXPECT_EQ(floor(Interval(-0.5, 2.5)), Interval(-1, 2));
  EXPECT_EQ(sign(Interval(-0.5, 0)), Interval(-1, 0));
  EXPECT_EQ(sign(Interval(0.5, 2)), Interval(1));
  EXPECT_EQ(less(Interval(0, 1), Interval(2, 3)), Interval(1));
  EXPECT_EQ(less(Interval(0, 2), Interval(2, 3)), Interval(0, 1));
  EXPECT_EQ(less(Interval(3, 4), Interval(2, 3)), Interval(0));
  EXPECT_EQ(lessEqual(Interval(0, 2), Interval(2, 3)), Interval(1));
  EXPECT_EQ(lessEqual(Interval(3, 4), Interval(2, 2.5)), Interval(0));
  EXPECT_EQ(equal(Interval(1), Interval(1)), Interval(1));
  EXPECT_EQ(equal(Interval(1), Interval(2)), Interval(0));
  EXPECT_EQ(equal(Interval(1, 2), Interval(1, 2)), Interval(0, 1));
  EXPECT_EQ(select(Interval(0, 1), Interval(1, 2), Interval(5)), Interval(1, 5));
  expectNear(pow(Interval(0.25, 4), 1.5), 0.125, 8);
  expectNear(pow(Interval(0, 4), 0.5), 0, 2);
  expectNear(pow(Interval(0.5, 2), Interval(-1, 2)), 0.25, 4);
  expectNear(pow(Interval(-2, 3), 3.0), -8, 27);
  expectNear(pow(Interval(-3, 2), 2.0), 0, 9);
  expectNear(pow(Interval(-4, -2), -1.0), -0.5, -0.25);
}

TEST(Interval, IsNeverNotANumber) {
  const double ends[] = {-kInfinity, -kLargest, -1e10, -2,       -kSmallest, 0,
                         kSmallest,  0.5,       710,   kLargest, kInfinity};
  for (const Operation& f : operations())
    for (const double a : ends)
      for (const double b : ends)
        for (const double c : ends)
          for (const double d : ends) {
            if (a > b || c > d) continue;
            const Interval result = f.onIntervals({a, b}, {c, d});
            ASSERT_LE(result.lo, result.hi)  // false for NaN
                << f.name << " of [" << a << ", " << b << "], [" << c << ", " << d << "]";
          }
}

TEST(Interval, OverflowIsNotInfinitelyLarge) {
  // e^1000 and 1e616 are finite numbers above every double: the lower end must stop at the largest double.
  const double nearlyLargest = kLargest * (1 - 1e-15);
  EXPECT_GE(exp(Interval(1000)).lo, nearlyLargest);
  for (const Interval& huge :
       {exp(Interval(1000)), Interval(1e308) * Interval(1e308), square(Interval(1e308)),
        pow(Interval(1e200), 3), Interval(1e308) + Interval(1e308), -(Interval(-1e308) * Interval(1e308)),
        -pow(Interval(-1e200), 3)}) {
    EXPECT_TRUE(huge.lo >= nearlyLargest && huge.lo <= kLargest) << huge.lo;
    EXPECT_EQ(huge.hi, kInfinity);
  }
  // ... and so sqrt((1e300)^2) can be 1e300, and 1 / e^1000 is small, not zero.
  EXPECT_TRUE(sqrt(square(Interval(1e300))).contains(1e300));
  EXPECT_GT((Interval(1) / exp(Interval(1000))).hi, 0);
}

TEST(Interval, FunctionsNearTheSmallestNumbers) {
  for (const double x : {kSmallest, 2 * kSmallest, 3 * kSmallest, 5 * kSmallest}) {
    for (const Interval& result : {sin(Interval(x)), tan(Interval(x)), sinh(Interval(x)), tanh(Interval(x)),
                                   sin(Interval(x, 1)), sinh(Interval(x, 1))}) {
      EXPECT_LE(result.lo, x);
      EXPECT_GE(result.lo, -kSmallest * 4);
      EXPECT_GE(result.hi, x);
    }
    EXPECT_LE(sin(Interval(-x)).lo, -x);
    EXPECT_GE(sin(Interval(-x)).hi, -x);
  }
  const Interval last = exp(Interval(std::log(kLargest)));
  EXPECT_LE(last.lo, kLargest);
  EXPECT_GE(last.hi, std::exp(std::log(kLargest)));
}

TEST(Interval, WavesHoldTheirExtremesAtAnyAge) {
  // An interval that straddles an extreme of sine or cosine, anywhere up to 1e9 rad, holds +-1. The hard ones
  // start or end at the neighbour of the extreme.
  RandomIntervals random(4);
  const Real pi = std::acos(Real(-1));
  const auto neighbours = [](Real x) {
    const double nearest = double(x);
    return Real(nearest) <= x ? Interval(nearest, std::nextafter(nearest, kInfinity))
                              : Interval(std::nextafter(nearest, -kInfinity), nearest);
  };
  for (int i = 0; i < 400'000; ++i) {
    const double turns = std::floor(std::exp(random.between(0, std::log(1.5e8))));
    const Interval nearSinePeak = neighbours(2 * pi * Real(turns) + pi / 2),
                   nearCosinePeak = neighbours(2 * pi * Real(turns));
    const double before = random.below(2) * std::exp(random.between(-20, 0));
    const double after = random.below(2) * std::exp(random.between(-20, 0));
    const Interval x(nearSinePeak.lo - before, nearSinePeak.hi + after);
    const Interval y(nearCosinePeak.lo - before, nearCosinePeak.hi + after);
    ASSERT_EQ(sin(x).hi, 1) << turns << " turns, from " << x.lo << " to " << x.hi;
    ASSERT_EQ(sin(-x).lo, -1) << turns << " turns, from " << x.lo << " to " << x.hi;
    ASSERT_EQ(cos(y).hi, 1) << turns << " turns, from " << y.lo << " to " << y.hi;
    ASSERT_EQ(cos(-y).hi, 1) << turns << " turns, from " << y.lo << " to " << y.hi;
  }
}

TEST(Interval, WavesAreTightBetweenExtremes) {
  const Interval rising = sin(Interval(-1, 1));
  EXPECT_NEAR(rising.lo, -std::sin(1.0), 1e-15);
  EXPECT_NEAR(rising.hi, std::sin(1.0), 1e-15);
  EXPECT_EQ(sin(Interval(0, 7)), Interval(-1, 1));
  EXPECT_EQ(cos(Interval(-0.1, 0.1)).hi, 1);
  EXPECT_NEAR(cos(Interval(-0.1, 0.2)).lo, std::cos(0.2), 1e-15);
  EXPECT_EQ(cosh(Interval(-1, 2)).lo, 1);
  EXPECT_EQ(tanh(Interval(-1000, 1000)), Interval(-1, 1));
}

TEST(Interval, PowersKnowTheirSign) {
  // Known ranges of x^2, x^3 and x^5 over [-1, 2]; rounding adds less than 1e-14.
  EXPECT_EQ(pow(Interval(-1, 2), 2).lo, 0);
  EXPECT_NEAR(pow(Interval(-1, 2), 2).hi, 4, 1e-14);
  EXPECT_NEAR(pow(Interval(-1, 2), 3).lo, -1, 1e-14);
  EXPECT_NEAR(pow(Interval(-1, 2), 3).hi, 8, 1e-14);
  EXPECT_NEAR(pow(Interval(-1, 2), 5).lo, -1, 1e-13);
  EXPECT_NEAR(pow(Interval(-2, -1), -1).lo, -1, 1e-14);
  EXPECT_NEAR(pow(Interval(-2, -1), -1).hi, -0.5, 1e-14);
  // The cost grows with the exponent's digits, not with the exponent.
  EXPECT_TRUE(pow(Interval(1), 2'000'000'000).contains(1));
  EXPECT_EQ(pow(Interval(2), 2'000'000'000).hi, kInfinity);
  EXPECT_GT(pow(Interval(2), 2'000'000'000).lo, 0);
}

TEST(Interval, MeasuresItself) {
  EXPECT_EQ(Interval(-3, 2).magnitude(), 3);
  EXPECT_EQ(Interval(-1, 2).magnitude(), 2);
  EXPECT_EQ(Interval(1, 2).mid(), 1.5);
  EXPECT_EQ(Interval(1, 4).width(), 3);
  EXPECT_TRUE(Interval(1, 2).contains(1) && Interval(1, 2).contains(2) && !Interval(1, 2).contains(2.5));
  EXPECT_EQ(hull({1, 2}, {-1, 0}), Interval(-1, 2));
}

}  // namespace
}  // namespace luxo
