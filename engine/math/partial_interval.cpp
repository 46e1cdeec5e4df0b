// SPDX-License-Identifier: Apache-2.0
#include "math/partial_interval.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "math/vec.h"

namespace luxo {
namespace {

using Defined = PartialInterval::Defined;

const PartialInterval kNothing(Interval::everything(), Defined::Nowhere);

/// Of an operation that is defined for all numbers.
PartialInterval total(const Interval& range, const PartialInterval& x, const PartialInterval& y = {}) {
  return {range, std::min(x.defined, y.defined)};
}

/// Of an operation that is defined from `lo` to `hi`, `whole` or not: what is outside has no value.
template <class Operation>
PartialInterval within(const PartialInterval& x, double lo, double hi, const Operation& operation) {
  if (x.defined == Defined::Nowhere || x.range.hi < lo || x.range.lo > hi) return kNothing;
  if (x.range.lo >= lo && x.range.hi <= hi) return {operation(x.range), x.defined};
  return {operation(Interval(std::max(x.range.lo, lo), std::min(x.range.hi, hi))), Defined::Somewhere};
}

/// An undefined operand compares as false.
PartialInterval compared(const Interval& result, const PartialInterval& x, const PartialInterval& y) {
  const Defined defined = std::min(x.defined, y.defined);
  if (defined == Defined::Nowhere) return {Interval(0)};
  return {defined == Defined::Everywhere ? result : hull(result, Interval(0))};
}

bool hasGap(const PartialInterval& x) { return x.gap.lo < x.gap.hi; }

PartialInterval withGap(PartialInterval x, const Interval& gap) {
  if (x.defined != Defined::Nowhere && gap.lo < gap.hi) x.gap = gap;
  return x;
}

bool isInteger(const Interval& x) { return x.lo == x.hi && std::floor(x.lo) == x.lo; }

}  // namespace

PartialInterval::PartialInterval(double number)
    : PartialInterval(Interval(number), std::isfinite(number) ? Defined::Everywhere : Defined::Nowhere) {}

PartialInterval::PartialInterval(const Interval& some, Defined where)
    : range(where == Defined::Nowhere ? Interval::everything() : some), defined(where) {}

std::optional<Interval> PartialInterval::within(double distance) const {
  Interval near(std::max(range.lo, -distance), std::min(range.hi, distance));
  if (hasGap(*this)) {
    if (near.hi > gap.lo && near.hi < gap.hi) near.hi = gap.lo;
    if (near.lo > gap.lo && near.lo < gap.hi) near.lo = gap.hi;
  }
  if (defined == Defined::Nowhere || near.lo > near.hi) return std::nullopt;
  return near;
}

PartialInterval operator-(const PartialInterval& x) { return withGap(total(-x.range, x), -x.gap); }

PartialInterval operator+(const PartialInterval& x, const PartialInterval& y) {
  PartialInterval sum = total(x.range + y.range, x, y);
  if (hasGap(y)) return hasGap(x) ? sum : y + x;
  return hasGap(x) ? withGap(sum, {(x.gap.lo + y.range).hi, (x.gap.hi + y.range).lo}) : sum;
}

PartialInterval operator-(const PartialInterval& x, const PartialInterval& y) {
  return hasGap(x) || hasGap(y) ? x + -y : total(x.range - y.range, x, y);
}

PartialInterval operator*(const PartialInterval& x, const PartialInterval& y) {
  if (hasGap(y) && !hasGap(x)) return y * x;
  PartialInterval product = total(x.range * y.range, x, y);
  if (!hasGap(x) || y.range.contains(0)) return product;
  if (y.range.hi < 0) return -x * -y;
  return withGap(product, {(x.gap.lo * y.range).hi, (x.gap.hi * y.range).lo});
}

PartialInterval operator/(const PartialInterval& x, const PartialInterval& y) {
  if (y.range == Interval(0)) return kNothing;
  const Defined both = std::min(x.defined, y.defined);
  if (!y.range.contains(0)) {
    if (hasGap(x)) return x * PartialInterval(Interval(1) / y.range, y.defined);
    return {x.range / y.range, both};
  }
  const PartialInterval anything(Interval::everything(), std::min(both, Defined::Somewhere));
  if (anything.defined == Defined::Nowhere || x.range.contains(0)) return anything;
  if (x.range.hi < 0) return -x / -y;
  // Of a positive number: what is left of the pole is below the one, what is right of it above the other.
  const auto least = [&](double end) {
    return std::isfinite(end) ? Interval(x.range.lo) / Interval(end) : Interval(0);
  };
  const double below = y.range.lo < 0 ? least(y.range.lo).hi : -kInfinity;
  const double above = y.range.hi > 0 ? least(y.range.hi).lo : kInfinity;
  if (below == -kInfinity) return {Interval(above, kInfinity), anything.defined};
  if (above == kInfinity) return {Interval(-kInfinity, below), anything.defined};
  return withGap(anything, {below, above});
}

PartialInterval integerPower(const PartialInterval& x, int exponent) {
  if (exponent < 0) return PartialInterval(1) / integerPower(x, -exponent);
  return total(pow(x.range, exponent), x);
}

PartialInterval pow(const PartialInterval& x, const PartialInterval& y) {
  const Defined both = std::min(x.defined, y.defined);
  if (both == Defined::Nowhere) return kNothing;
  const Interval& base = x.range;
  const bool hasPole = y.range.lo < 0 && base.contains(0);
  if (base.lo >= 0 || isInteger(y.range)) return {pow(base, y.range), hasPole ? Defined::Somewhere : both};
  // Below 0 only integer powers go on, of which there may be some, of either sign.
  const bool goesOn = std::floor(y.range.hi) >= y.range.lo;
  if (!goesOn)
    return base.hi < 0 ? kNothing : PartialInterval(pow(Interval(0, base.hi), y.range), Defined::Somewhere);
  const double largest = pow(Interval(std::max(0.0, -base.hi), -base.lo), y.range).hi;
  const Interval below(-largest, largest);
  return {base.hi < 0 ? below : hull(below, pow(Interval(0, base.hi), y.range)), Defined::Somewhere};
}

PartialInterval sqrt(const PartialInterval& x) {
  return within(x, 0, kInfinity, [](const Interval& r) { return sqrt(r); });
}

PartialInterval log(const PartialInterval& x) {
  if (x.range.hi <= 0) return kNothing;
  const PartialInterval result = within(x, 0, kInfinity, [](const Interval& r) { return log(r); });
  return {result.range, x.range.lo > 0 ? result.defined : std::min(result.defined, Defined::Somewhere)};
}

PartialInterval asin(const PartialInterval& x) {
  return within(x, -1, 1, [](const Interval& r) { return asin(r); });
}
PartialInterval acos(const PartialInterval& x) {
  return within(x, -1, 1, [](const Interval& r) { return acos(r); });
}

PartialInterval exp(const PartialInterval& x) { return total(exp(x.range), x); }
PartialInterval sin(const PartialInterval& x) { return total(sin(x.range), x); }
PartialInterval cos(const PartialInterval& x) { return total(cos(x.range), x); }
void sinCos(const PartialInterval& x, PartialInterval& sine, PartialInterval& cosine) {
  const PartialInterval angle = x;  // x may be one of the results
  sine = sin(angle);
  cosine = cos(angle);
}
PartialInterval tan(const PartialInterval& x) {
  const PartialInterval result = total(tan(x.range), x);
  // It rises from pole to pole: across a single one it falls.
  if (std::isfinite(result.range.magnitude()) || !(x.range.width() < kPi)) return result;
  return withGap(result, {tan(Interval(x.range.hi)).hi, tan(Interval(x.range.lo)).lo});
}
PartialInterval sinh(const PartialInterval& x) { return total(sinh(x.range), x); }
PartialInterval cosh(const PartialInterval& x) { return total(cosh(x.range), x); }
PartialInterval tanh(const PartialInterval& x) { return total(tanh(x.range), x); }
PartialInterval atan(const PartialInterval& x) { return total(atan(x.range), x); }
PartialInterval atan2(const PartialInterval& y, const PartialInterval& x) {
  return total(atan2(y.range, x.range), x, y);
}
PartialInterval abs(const PartialInterval& x) { return total(abs(x.range), x); }
PartialInterval min(const PartialInterval& x, const PartialInterval& y) {
  return total(min(x.range, y.range), x, y);
}
PartialInterval max(const PartialInterval& x, const PartialInterval& y) {
  return total(max(x.range, y.range), x, y);
}
PartialInterval floor(const PartialInterval& x) { return total(floor(x.range), x); }
PartialInterval sign(const PartialInterval& x) { return total(sign(x.range), x); }

PartialInterval less(const PartialInterval& x, const PartialInterval& y) {
  return compared(less(x.range, y.range), x, y);
}
PartialInterval lessEqual(const PartialInterval& x, const PartialInterval& y) {
  return compared(lessEqual(x.range, y.range), x, y);
}
PartialInterval equal(const PartialInterval& x, const PartialInterval& y) {
  return compared(equal(x.range, y.range), x, y);
}

PartialInterval select(const PartialInterval& condition, const PartialInterval& a, const PartialInterval& b) {
  if (condition.defined == Defined::Everywhere) {
    if (!condition.range.contains(0)) return a;
    if (condition.range == Interval(0)) return b;
  }
  if (a.defined == b.defined) return {hull(a.range, b.range), a.defined};
  if (a.defined == Defined::Nowhere) return {b.range, Defined::Somewhere};
  if (b.defined == Defined::Nowhere) return {a.range, Defined::Somewhere};
  return {hull(a.range, b.range), Defined::Somewhere};
}

}  // namespace luxo
