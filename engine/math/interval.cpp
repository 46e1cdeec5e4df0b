// SPDX-License-Identifier: Apache-2.0
#include "math/interval.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "math/vec.h"

namespace luxo {
namespace {

constexpr double kUnderflows = 0x1p-960;  // products below may lose digits
constexpr double kLarge = 1e300;

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

/// The next doubles, of finite numbers other than 0.
double above(double x) {
  const auto bits = std::bit_cast<std::int64_t>(x);
  return std::bit_cast<double>(bits + ((bits >> 63) | 1));
}
double below(double x) { return -above(-x); }

/// A correctly rounded result.
struct Rounded {
  double value;
  bool exact;

  [[nodiscard]] double lower() const { return exact ? value : down(value); }
  [[nodiscard]] double upper() const { return exact ? value : up(value); }
};

/// Knuth's TwoSum: the error of a sum is a double (Knuth, TAOCP 2, 4.2.2). NaN where a sum overflows.
Rounded add(double a, double b) {
  const double sum = a + b, part = sum - a;
  return {sum, (a - (sum - part)) + (b - part) == 0};
}

/// Places from a number's first binary digit to its last, at most 53; 0 counts as one.
int digits(double x) {
  constexpr std::uint64_t kOne = std::uint64_t{1} << 52;
  return 53 - std::countr_zero((std::bit_cast<std::uint64_t>(x) & (kOne - 1)) | kOne);
}

/// Whether a product is exact for its factors are short, and it neither overflows nor loses digits.
bool isExact(double a, double b, double product) {
  const double size = std::abs(product);
  return digits(a) + digits(b) <= 53 && size > kUnderflows && size < kInfinity;
}

Rounded multiply(double a, double b) {
  const double product = a * b;
  return {product, a == 0 || b == 0 || isExact(a, b, product)};
}

Rounded divide(double a, double b) {
  const double quotient = a / b;
  return {quotient, a == 0 || (quotient * b == a && isExact(quotient, b, a))};
}

Rounded root(double x) {
  const double r = std::sqrt(x);
  return {r, x == 0 || (r * r == x && isExact(r, r, x))};
}

bool unknown(const Interval& x) { return x.lo == -kInfinity && x.hi == kInfinity; }
bool unknown(const Interval& x, const Interval& y) { return unknown(x) || unknown(y); }
bool bounded(const Interval& x) { return x.lo > -kInfinity && x.hi < kInfinity; }

constexpr int kLibrarySteps = 4;

/// Around results of the C library, which have the sign of the exact result; a 0 is exact.
Interval aroundLibrary(double lo, double hi) {
  const double least = lo > 0    ? std::max(0.0, down(lo, kLibrarySteps))
                       : lo == 0 ? 0
                                 : down(lo, kLibrarySteps);
  const double most = hi < 0 ? std::min(0.0, up(hi, kLibrarySteps)) : hi == 0 ? 0 : up(hi, kLibrarySteps);
  return {least, most};
}

/// Around results that are positive; a 0 has underflowed.
Interval aroundPositive(double lo, double hi) {
  return {std::max(0.0, down(lo, kLibrarySteps)), up(hi, kLibrarySteps)};
}

/// Whether x holds a point `offset + k * period`, k integer; yes when in doubt by rounding. The doubt is 9
/// roundoffs of the largest magnitude involved; fewer than 4 are lost on the way to either comparison.
bool holdsPoint(const Interval& x, double offset, double period) {
  const double doubt = 1e-15 * (x.magnitude() + 8);
  const double k = std::ceil((x.lo - offset - doubt) / period);
  return offset + k * period <= x.hi + doubt;
}

/// Whether the angles are few and small enough to tell a wave's extremes from them.
bool isPartOfTurn(const Interval& x) { return x.width() < kTau && x.magnitude() < 1e9; }

/// A wave that is `a` and `b` at the ends of x and has its largest value, 1, at `peak`.
Interval wave(const Interval& x, double a, double b, double peak) {
  const Interval ends = aroundLibrary(std::min(a, b), std::max(a, b));
  return {holdsPoint(x, peak - kPi, kTau) ? -1 : std::max(-1.0, ends.lo),
          holdsPoint(x, peak, kTau) ? 1 : std::min(1.0, ends.hi)};
}

/// Of an angle so wild that nothing is known but that it is finite, if it is.
Interval anyWave(const Interval& x) { return bounded(x) ? Interval(-1, 1) : Interval::everything(); }

}  // namespace

Interval operator-(const Interval& x) { return {-x.hi, -x.lo}; }

Interval operator+(const Interval& x, const Interval& y) {
  const double least = x.lo + y.lo, most = x.hi + y.hi;
  if (std::abs(x.lo) < kLarge && std::abs(x.hi) < kLarge && std::abs(y.lo) < kLarge &&
      std::abs(y.hi) < kLarge) {
    // Knuth's TwoSum: the error of a sum is a double (TAOCP 2, 4.2.2), and 0 is never in error.
    const double partLo = least - x.lo, partHi = most - x.hi;
    const double lost = (x.lo - (least - partLo)) + (y.lo - partLo);
    const double gained = (x.hi - (most - partHi)) + (y.hi - partHi);
    return {lost < 0 ? below(least) : least, gained > 0 ? above(most) : most};
  }
  const Rounded lo = add(x.lo, y.lo), hi = add(x.hi, y.hi);
  if (std::isnan(lo.value) || std::isnan(hi.value)) return Interval::everything();
  return {lo.lower(), hi.upper()};
}

Interval operator-(const Interval& x, const Interval& y) { return x + -y; }

Interval operator*(const Interval& x, const Interval& y) {
  const double ll = x.lo * y.lo, lh = x.lo * y.hi, hl = x.hi * y.lo, hh = x.hi * y.hi;
  const double lo = std::min(std::min(ll, lh), std::min(hl, hh));
  const double hi = std::max(std::max(ll, lh), std::max(hl, hh));
  // The usual case, without a branch: signs are hard to foresee. Infinite operands make the first sum
  // infinite or NaN.
  if ((x.hi - x.lo) + (y.hi - y.lo) < kLarge && lo > -kLarge && hi < kLarge && std::abs(lo) > kUnderflows &&
      std::abs(hi) > kUnderflows) {
    const int xLo = digits(x.lo), xHi = digits(x.hi), yLo = digits(y.lo), yHi = digits(y.hi);
    // Whether some product that is the end was rounded.
    const auto rounded = [&](double end) {
      return ((ll == end) & (xLo + yLo > 53)) | ((lh == end) & (xLo + yHi > 53)) |
             ((hl == end) & (xHi + yLo > 53)) | ((hh == end) & (xHi + yHi > 53));
    };
    return {rounded(lo) ? below(lo) : lo, rounded(hi) ? above(hi) : hi};
  }
  // Somewhere 0 times infinity, or anything at all.
  if ((!bounded(x) && y.contains(0)) || (!bounded(y) && x.contains(0)) || unknown(x, y))
    return Interval::everything();
  if (x.hi <= 0 && x.lo < 0) return -(-x * y);
  if (y.hi <= 0 && y.lo < 0) return -(x * -y);
  // Now both reach above 0, or are 0.
  if (x.lo >= 0 && y.lo >= 0) return {multiply(x.lo, y.lo).lower(), multiply(x.hi, y.hi).upper()};
  if (x.lo >= 0) return {multiply(x.hi, y.lo).lower(), multiply(x.hi, y.hi).upper()};
  if (y.lo >= 0) return {multiply(x.lo, y.hi).lower(), multiply(x.hi, y.hi).upper()};
  return {std::min(multiply(x.lo, y.hi).lower(), multiply(x.hi, y.lo).lower()),
          std::max(multiply(x.lo, y.lo).upper(), multiply(x.hi, y.hi).upper())};
}

Interval operator/(const Interval& x, const Interval& y) {
  if (unknown(x, y) || y.contains(0) || (!bounded(x) && !bounded(y))) return Interval::everything();
  if (y.hi < 0) return -x / -y;
  return {divide(x.lo, x.lo >= 0 ? y.hi : y.lo).lower(), divide(x.hi, x.hi >= 0 ? y.lo : y.hi).upper()};
}

Interval hull(const Interval& x, const Interval& y) { return {std::min(x.lo, y.lo), std::max(x.hi, y.hi)}; }

Interval square(const Interval& x) {
  if (unknown(x)) return x;
  const double least = x.contains(0) ? 0 : std::min(std::abs(x.lo), std::abs(x.hi)), most = x.magnitude();
  return {multiply(least, least).lower(), multiply(most, most).upper()};
}

Interval pow(const Interval& x, int exponent) {
  if (exponent == 0) return {1};
  if (exponent == 2) return square(x);
  if (exponent < 0) return Interval(1) / pow(x, -exponent);
  if (unknown(x)) return x;
  // By repeated squaring, rounded as the same power of a number is (formula/operation.h).
  const auto power = [exponent](Interval base) {
    Interval result = exponent & 1 ? base : Interval(1);
    for (int n = exponent >> 1; n > 0; n >>= 1) {
      base = square(base);
      if (n & 1) result = result * base;
    }
    return result;
  };
  // An odd power is monotone in x, an even one in |x|.
  if (exponent % 2 != 0) return {power(x.lo).lo, power(x.hi).hi};
  const double least = x.contains(0) ? 0 : std::min(std::abs(x.lo), std::abs(x.hi));
  return {std::max(0.0, power(least).lo), power(x.magnitude()).hi};
}

Interval pow(const Interval& x, const Interval& y) {
  if (unknown(x, y)) return Interval::everything();
  if (x.lo < 0) {  // only integer powers go on below 0
    const double exponent = y.lo;
    if (y.lo != y.hi || std::floor(exponent) != exponent) return Interval::everything();
    if (exponent < 0) return Interval(1) / pow(x, Interval(-exponent));
    const Interval size = pow(abs(x), y);
    if (std::fmod(exponent, 2) == 0) return size;
    return {-pow(Interval(-x.lo), y).hi, x.hi < 0 ? -pow(Interval(-x.hi), y).lo : pow(Interval(x.hi), y).hi};
  }
  if (x.lo == 0 && y.lo < 0) return Interval::everything();
  // Monotone in each operand: the extremes are at the corners.
  const double corners[] = {std::pow(x.lo, y.lo), std::pow(x.lo, y.hi), std::pow(x.hi, y.lo),
                            std::pow(x.hi, y.hi)};
  const auto [least, most] = std::minmax_element(corners, corners + 4);
  // 0^y is exactly 0.
  return {std::max(0.0, down(*least, kLibrarySteps)), x.hi == 0 && y.lo > 0 ? 0 : up(*most, kLibrarySteps)};
}

Interval sqrt(const Interval& x) {
  if (x.lo < 0) return Interval::everything();
  return {root(x.lo).lower(), root(x.hi).upper()};
}

Interval exp(const Interval& x) {
  if (unknown(x)) return x;
  return aroundPositive(std::exp(x.lo), std::exp(x.hi));
}

Interval log(const Interval& x) {
  if (x.lo < 0 || x.hi == 0) return Interval::everything();
  return {x.lo == 0 ? -kInfinity : aroundLibrary(std::log(x.lo), 0).lo, aroundLibrary(0, std::log(x.hi)).hi};
}

Interval sin(const Interval& x) {
  if (!isPartOfTurn(x)) return anyWave(x);
  return wave(x, std::sin(x.lo), std::sin(x.hi), kPi / 2);
}

Interval cos(const Interval& x) {
  if (!isPartOfTurn(x)) return anyWave(x);
  return wave(x, std::cos(x.lo), std::cos(x.hi), 0);
}

void sinCos(const Interval& x, Interval& sine, Interval& cosine) {
  if (!isPartOfTurn(x)) {
    sine = cosine = anyWave(x);
    return;
  }
  // Sine and cosine of one angle together cost little more than one.
  const double s = std::sin(x.lo), c = std::cos(x.lo), t = std::sin(x.hi), d = std::cos(x.hi);
  const Interval angle = x;  // x may be one of the results
  sine = wave(angle, s, t, kPi / 2);
  cosine = wave(angle, c, d, 0);
}

Interval tan(const Interval& x) {
  if (!(x.width() < kPi) || !(x.magnitude() < 1e9) || holdsPoint(x, kPi / 2, kPi))
    return Interval::everything();
  return aroundLibrary(std::tan(x.lo), std::tan(x.hi));
}

Interval asin(const Interval& x) {
  if (x.lo < -1 || x.hi > 1) return Interval::everything();
  return aroundLibrary(std::asin(x.lo), std::asin(x.hi));
}

Interval acos(const Interval& x) {
  if (x.lo < -1 || x.hi > 1) return Interval::everything();
  return aroundLibrary(std::acos(x.hi), std::acos(x.lo));
}

Interval atan(const Interval& x) {
  if (unknown(x)) return x;
  return aroundLibrary(std::atan(x.lo), std::atan(x.hi));
}

Interval atan2(const Interval& y, const Interval& x) {
  if (unknown(x, y)) return Interval::everything();
  // Across the jump every angle is possible; elsewhere the extreme directions are two corners.
  if (y.contains(0) && x.lo <= 0) return {down(-kPi), up(kPi)};
  const double corners[] = {std::atan2(y.lo, x.lo), std::atan2(y.lo, x.hi), std::atan2(y.hi, x.lo),
                            std::atan2(y.hi, x.hi)};
  const auto [least, most] = std::minmax_element(corners, corners + 4);
  const Interval wide = aroundLibrary(*least, *most);
  // An angle of 0 has underflowed unless y is 0.
  return {wide.lo == 0 && y.lo < 0 ? down(0) : wide.lo, wide.hi == 0 && y.hi > 0 ? up(0) : wide.hi};
}

Interval sinh(const Interval& x) {
  if (unknown(x)) return x;
  return aroundLibrary(std::sinh(x.lo), std::sinh(x.hi));
}

Interval cosh(const Interval& x) {
  if (unknown(x)) return x;
  const double a = std::cosh(x.lo), b = std::cosh(x.hi);
  const Interval ends = aroundPositive(std::min(a, b), std::max(a, b));
  return {x.contains(0) ? 1 : std::max(1.0, ends.lo), ends.hi};
}

Interval tanh(const Interval& x) {
  if (unknown(x)) return x;
  const Interval wide = aroundLibrary(std::tanh(x.lo), std::tanh(x.hi));
  return {std::max(-1.0, wide.lo), std::min(1.0, wide.hi)};
}

Interval abs(const Interval& x) {
  if (unknown(x) || x.lo >= 0) return x;
  return {x.hi <= 0 ? -x.hi : 0, x.magnitude()};
}

Interval min(const Interval& x, const Interval& y) {
  if (unknown(x, y)) return Interval::everything();
  return {std::min(x.lo, y.lo), std::min(x.hi, y.hi)};
}

Interval max(const Interval& x, const Interval& y) {
  if (unknown(x, y)) return Interval::everything();
  return {std::max(x.lo, y.lo), std::max(x.hi, y.hi)};
}

Interval floor(const Interval& x) { return {std::floor(x.lo), std::floor(x.hi)}; }

Interval sign(const Interval& x) {
  if (unknown(x)) return x;
  const auto signOf = [](double end) { return end > 0 ? 1.0 : end < 0 ? -1.0 : 0.0; };
  return {signOf(x.lo), signOf(x.hi)};
}

// An undefined operand compares as false.

Interval less(const Interval& x, const Interval& y) {
  if (x.hi < y.lo) return {1};
  return x.lo >= y.hi ? Interval(0) : Interval(0, 1);
}

Interval lessEqual(const Interval& x, const Interval& y) {
  if (x.lo > y.hi) return {0};
  return x.hi <= y.lo && !unknown(x, y) ? Interval(1) : Interval(0, 1);
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
