// SPDX-License-Identifier: Apache-2.0
#include "math/interval.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "math/vec.h"

namespace luxo {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The double `steps` above x, at most infinity; above minus infinity, which only an overflow makes of an
/// upper end, come the finite numbers. Doubles of one sign are ordered as their bit patterns are.
double up(double x, int steps = 1) {
  if (std::isnan(x)) return x;
  constexpr std::int64_t kMagnitude = std::numeric_limits<std::int64_t>::max();
  const auto bits = std::bit_cast<std::int64_t>(x);
  const std::int64_t place = (bits < 0 ? -(bits & kMagnitude) : bits) + steps;  // counted from zero
  if (place < 0) return -std::bit_cast<double>(-place);
  return std::bit_cast<double>(std::min(place, std::bit_cast<std::int64_t>(kInfinity)));
}

double down(double x, int steps = 1) { return -up(-x, steps); }

/// Outward by `steps`; a NaN bound (infinity minus infinity, zero times infinity) says nothing is known.
Interval outward(double lo, double hi, int steps = 1) {
  if (std::isnan(lo) || std::isnan(hi)) return Interval::everything();
  return {down(lo, steps), up(hi, steps)};
}

constexpr int kLibrarySteps = 4;

/// Whether x holds a point `offset + k * period`, k integer; yes when in doubt by rounding. The doubt is 9
/// roundoffs of the largest magnitude involved; fewer than 4 are lost on the way to either comparison.
bool holdsPoint(const Interval& x, double offset, double period) {
  const double doubt = 1e-15 * (x.magnitude() + 8);
  const double k = std::ceil((x.lo - offset - doubt) / period);
  return offset + k * period <= x.hi + doubt;
}

}  // namespace

Interval operator-(const Interval& x) { return {-x.hi, -x.lo}; }

Interval operator+(const Interval& x, const Interval& y) {
  if (x == Interval(0)) return y;  // exact: a derivative that vanishes identically stays exactly zero
  if (y == Interval(0)) return x;
  return outward(x.lo + y.lo, x.hi + y.hi);
}

Interval operator-(const Interval& x, const Interval& y) { return x + -y; }

Interval operator*(const Interval& x, const Interval& y) {
  if (x == Interval(0) || y == Interval(0)) return {};  // exact, and 0 * infinity bounds stay meaningful
  const double a = x.lo * y.lo, b = x.lo * y.hi, c = x.hi * y.lo, d = x.hi * y.hi;
  if (std::isnan(a) || std::isnan(b) || std::isnan(c) || std::isnan(d)) return Interval::everything();
  return outward(std::min({a, b, c, d}), std::max({a, b, c, d}));
}

Interval operator/(const Interval& x, const Interval& y) {
  if (y.contains(0)) return Interval::everything();
  return x * outward(1 / y.hi, 1 / y.lo);
}

Interval hull(const Interval& x, const Interval& y) { return {std::min(x.lo, y.lo), std::max(x.hi, y.hi)}; }

Interval square(const Interval& x) {
  const double a = x.lo * x.lo, b = x.hi * x.hi;
  if (x == Interval(0)) return {};
  const double lowest = x.contains(0) ? 0 : std::min(a, b);
  return {lowest > 0 ? down(lowest) : 0, up(std::max(a, b))};
}

Interval pow(const Interval& x, int exponent) {
  if (exponent == 0) return {1};
  if (exponent < 0) return Interval(1) / pow(x, -exponent);
  // By repeated squaring, rounded as the same power of a number is (formula/operation.h).
  const auto power = [exponent](Interval base) {
    Interval result(1);
    for (int n = exponent; n > 0; n >>= 1, base = square(base))
      if (n & 1) result = result * base;
    return result;
  };
  // An odd power is monotone in x, an even one in |x|.
  if (exponent % 2 != 0) return {power(x.lo).lo, power(x.hi).hi};
  const double least = x.contains(0) ? 0 : std::min(std::abs(x.lo), std::abs(x.hi));
  return {std::max(0.0, power(least).lo), power(x.magnitude()).hi};
}

Interval sqrt(const Interval& x) {
  if (x == Interval(0)) return {};
  if (x.hi < 0 || x.lo < 0) return x.hi < 0 ? Interval::everything() : Interval(0, up(std::sqrt(x.hi)));
  return {std::max(0.0, down(std::sqrt(x.lo))), up(std::sqrt(x.hi))};
}

Interval exp(const Interval& x) {
  const Interval wide = outward(std::exp(x.lo), std::exp(x.hi), kLibrarySteps);
  return {std::max(0.0, wide.lo), wide.hi};
}

Interval log(const Interval& x) {
  if (x.lo <= 0)
    return x.hi > 0 ? Interval(-kInfinity, up(std::log(x.hi), kLibrarySteps)) : Interval::everything();
  return outward(std::log(x.lo), std::log(x.hi), kLibrarySteps);
}

Interval sin(const Interval& x) {
  if (!(x.width() < kTau) || !(x.magnitude() < 1e9)) return {-1, 1};
  const double a = std::sin(x.lo), b = std::sin(x.hi);
  const Interval ends = outward(std::min(a, b), std::max(a, b), kLibrarySteps);
  return {holdsPoint(x, -kPi / 2, kTau) ? -1 : std::max(-1.0, ends.lo),
          holdsPoint(x, kPi / 2, kTau) ? 1 : std::min(1.0, ends.hi)};
}

Interval cos(const Interval& x) {
  if (!(x.width() < kTau) || !(x.magnitude() < 1e9)) return {-1, 1};
  const double a = std::cos(x.lo), b = std::cos(x.hi);
  const Interval ends = outward(std::min(a, b), std::max(a, b), kLibrarySteps);
  return {holdsPoint(x, kPi, kTau) ? -1 : std::max(-1.0, ends.lo),
          holdsPoint(x, 0, kTau) ? 1 : std::min(1.0, ends.hi)};
}

void sinCos(const Interval& x, Interval& sine, Interval& cosine) {
  const Interval s = sin(x), c = cos(x);
  sine = s;
  cosine = c;
}

Interval tan(const Interval& x) {
  if (!(x.width() < kPi) || !(x.magnitude() < 1e9) || holdsPoint(x, kPi / 2, kPi))
    return Interval::everything();
  return outward(std::tan(x.lo), std::tan(x.hi), kLibrarySteps);
}

Interval sinh(const Interval& x) { return outward(std::sinh(x.lo), std::sinh(x.hi), kLibrarySteps); }

Interval cosh(const Interval& x) {
  const double a = std::cosh(x.lo), b = std::cosh(x.hi);
  const Interval ends = outward(std::min(a, b), std::max(a, b), kLibrarySteps);
  return {x.contains(0) ? 1 : std::max(1.0, ends.lo), ends.hi};
}

Interval tanh(const Interval& x) {
  const Interval wide = outward(std::tanh(x.lo), std::tanh(x.hi), kLibrarySteps);
  return {std::max(-1.0, wide.lo), std::min(1.0, wide.hi)};
}

Interval asin(const Interval& x) {
  if (x.lo < -1 || x.hi > 1) return Interval::everything();
  return outward(std::asin(x.lo), std::asin(x.hi), kLibrarySteps);
}

Interval acos(const Interval& x) {
  if (x.lo < -1 || x.hi > 1) return Interval::everything();
  const Interval wide = outward(std::acos(x.hi), std::acos(x.lo), kLibrarySteps);
  return {std::max(0.0, wide.lo), wide.hi};
}

Interval atan(const Interval& x) {
  if (x == Interval::everything()) return x;
  return outward(std::atan(x.lo), std::atan(x.hi), kLibrarySteps);
}

Interval atan2(const Interval& y, const Interval& x) {
  if (y == Interval::everything() || x == Interval::everything()) return Interval::everything();
  // Across the jump every angle is possible; elsewhere the rectangle's extreme directions are two corners.
  if (y.contains(0) && x.lo <= 0) return {down(-kPi), up(kPi)};
  const double corners[] = {std::atan2(y.lo, x.lo), std::atan2(y.lo, x.hi), std::atan2(y.hi, x.lo),
                            std::atan2(y.hi, x.hi)};
  const auto [least, most] = std::minmax_element(corners, corners + 4);
  return outward(*least, *most, kLibrarySteps);
}

Interval abs(const Interval& x) {
  if (x == Interval::everything() || x.lo >= 0) return x;
  return {x.hi <= 0 ? -x.hi : 0, x.magnitude()};
}

Interval min(const Interval& x, const Interval& y) {
  if (x == Interval::everything() || y == Interval::everything()) return Interval::everything();
  return {std::min(x.lo, y.lo), std::min(x.hi, y.hi)};
}

Interval max(const Interval& x, const Interval& y) {
  if (x == Interval::everything() || y == Interval::everything()) return Interval::everything();
  return {std::max(x.lo, y.lo), std::max(x.hi, y.hi)};
}

Interval floor(const Interval& x) { return {std::floor(x.lo), std::floor(x.hi)}; }

Interval sign(const Interval& x) {
  if (x == Interval::everything()) return x;
  const auto signOf = [](double end) { return end > 0 ? 1.0 : end < 0 ? -1.0 : 0.0; };
  return {signOf(x.lo), signOf(x.hi)};
}

Interval pow(const Interval& x, const Interval& y) {
  if (x == Interval::everything() || y == Interval::everything()) return Interval::everything();
  if (x.lo < 0) {
    // Integer powers go on below 0.
    const double exponent = y.lo;
    if (y.lo != y.hi || std::floor(exponent) != exponent) return Interval::everything();
    if (exponent < 0) return Interval(1) / pow(x, Interval(-exponent));
    const Interval size = pow(abs(x), y);
    if (std::fmod(exponent, 2) == 0) return size;
    return x.hi <= 0 ? -size : Interval(-pow(Interval(-x.lo), y).hi, pow(Interval(x.hi), y).hi);
  }
  // Monotone in each operand: the extremes are at the corners.
  const double corners[] = {std::pow(x.lo, y.lo), std::pow(x.lo, y.hi), std::pow(x.hi, y.lo),
                            std::pow(x.hi, y.hi)};
  const auto [least, most] = std::minmax_element(corners, corners + 4);
  const Interval wide = outward(*least, *most, kLibrarySteps);
  return {std::max(0.0, wide.lo), wide.hi};
}

Interval less(const Interval& x, const Interval& y) {
  if (x.hi < y.lo) return {1};
  return x.lo >= y.hi ? Interval(0) : Interval(0, 1);
}

Interval lessEqual(const Interval& x, const Interval& y) {
  if (x.lo > y.hi) return {0};
  const bool defined = x != Interval::everything() && y != Interval::everything();
  return defined && x.hi <= y.lo ? Interval(1) : Interval(0, 1);
}

Interval equal(const Interval& x, const Interval& y) {
  if (x.hi < y.lo || y.hi < x.lo) return {0};
  return x == y && x.lo == x.hi ? Interval(1) : Interval(0, 1);
}

Interval select(const Interval& condition, const Interval& a, const Interval& b) {
  if (!condition.contains(0)) return a;
  return condition == Interval(0) ? b : hull(a, b);
}

}  // namespace luxo
