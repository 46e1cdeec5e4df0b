// SPDX-License-Identifier: Apache-2.0
#include "reference/polynomial.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/assert.h"
#include "math/rounding.h"

namespace luxo::reference {
namespace {

constexpr int kMaxParts = 400;            // of the line: a touching pair of roots takes fewer than 200
constexpr int kNewtonSteps = 60;          // quadratic from the first few
constexpr double kOffMiddle = 0.4871;     // cuts fall beside the places where symmetric rays have their roots
constexpr int kExpansionSteps = 10;       // roundings of any term on its way through an expansion of degree 4
constexpr double kUnderflow = 0x1p-1000;  // far above what twenty operations that underflow lose
constexpr double kUpward = 1 + 0x1p-48;   // makes up for the rounding of the few operations before it

double least(const Interval& x) { return x.contains(0) ? 0 : std::min(std::abs(x.lo), std::abs(x.hi)); }

void add(RealRoots& roots, const RealRoot& root) {
  roots.roots[static_cast<std::size_t>(roots.count++)] = root;
}

/// numerator / denominator, when that is a root within reach. False: it may be one, or not.
bool addQuotient(RealRoots& roots, const Interval& numerator, const Interval& denominator, bool rising,
                 double reach) {
  if (denominator.contains(0)) return least(numerator) > reach * kUpward * denominator.magnitude();
  add(roots, {numerator / denominator, rising});
  return true;
}

RealRoots linearRoots(const Interval& c0, const Interval& c1, double reach) {
  RealRoots roots;
  roots.decided = addQuotient(roots, -c0, c1, c1.mid() > 0, reach);
  return roots;
}

RealRoots quadraticRoots(const Interval& c0, const Interval& c1, const Interval& c2, double reach) {
  RealRoots roots;
  const Interval discriminant = square(c1) - 4 * (c2 * c0);
  if (discriminant.hi < 0) return roots;
  roots.decided = discriminant.lo > 0;
  if (!roots.decided) return roots;
  // The sum that does not cancel; the other root follows from the product of both.
  const bool risingFirst = c1.mid() < 0;
  const Interval root = sqrt(discriminant);
  const Interval q = 0.5 * (risingFirst ? root - c1 : -(root + c1));
  roots.decided =
      addQuotient(roots, q, c2, risingFirst, reach) && addQuotient(roots, c0, q, !risingFirst, reach);
  if (roots.count == 2 && roots.roots[0].at.lo > roots.roots[1].at.lo)
    std::swap(roots.roots[0], roots.roots[1]);
  return roots;
}

/// Cuts the line until every part has no root, or one that Newton's method in intervals proves.
class Isolation {
 public:
  Isolation(std::span<const Interval> coefficients, double reach)
      : degree_(coefficients.size() - 1), reach_(reach) {
    for (std::size_t i = 0; i <= degree_; ++i) {
      c_[i] = coefficients[i].mid();
      off_[i] = (std::max(coefficients[i].hi - c_[i], c_[i] - coefficients[i].lo) +
                 roundingGamma(kExpansionSteps) * std::abs(c_[i])) *
                    kUpward +
                kUnderflow;
    }
  }

  RealRoots run() {
    std::array<Interval, 128> parts;
    int size = 0;
    parts[static_cast<std::size_t>(size++)] = {-reach_ * kUpward, reach_ * kUpward};
    for (int looked = 0; size > 0 && roots_.decided; ++looked) {
      const Interval part = parts[static_cast<std::size_t>(--size)];
      if (looked == kMaxParts || size + 2 > static_cast<int>(parts.size()) ||
          part.width() < std::numeric_limits<double>::epsilon() * reach_) {
        roots_.decided = false;
      } else if (!settle(part)) {
        const double cut = part.lo + kOffMiddle * part.width();
        parts[static_cast<std::size_t>(size++)] = {cut, part.hi};
        parts[static_cast<std::size_t>(size++)] = {part.lo, cut};  // looked at first
      }
    }
    return roots_;
  }

 private:
  struct Expansion {
    Interval value;  ///< in the middle of a part
    double reach;    ///< what the polynomial changes by from there, at most
    Interval slope;  ///< over the whole part
  };

  /// The Taylor series around the middle, by Horner's scheme. What that rounds away is at most gamma of the
  /// same scheme over absolute values (N. Higham 2002, 5.1), so it joins what the coefficients are off by.
  [[nodiscard]] Expansion expand(const Interval& part) const {
    const double middle = part.mid(), half = std::max(part.hi - middle, middle - part.lo) * kUpward;
    std::array<double, 5> b = c_, off = off_;
    for (std::size_t i = 0; i < degree_; ++i)
      for (std::size_t j = degree_; j-- > i;) {
        b[j] += middle * b[j + 1];
        off[j] += std::abs(middle) * off[j + 1];
      }
    double change = 0, bend = 0, power = 1;  // half^(i - 1)
    for (std::size_t i = 1; i <= degree_; ++i, power *= half) {
      const double magnitude = std::abs(b[i]) + off[i];
      change += magnitude * power * half;
      if (i > 1) bend += static_cast<double>(i) * magnitude * power;
    }
    const double off0 = off[0] * kUpward, off1 = (off[1] + bend) * kUpward;
    return {b[0] + Interval(-off0, off0), change * kUpward, b[1] + Interval(-off1, off1)};
  }

  /// Whether the part has no root, or one that was found.
  bool settle(Interval part) {
    Expansion e = expand(part);
    if (least(e.value) > e.reach) return true;
    if (e.slope.contains(0)) return false;
    bool proven = false;
    for (int step = 0; step < kNewtonSteps; ++step) {
      const Interval next = part.mid() - e.value / e.slope;
      if (next.hi < part.lo || next.lo > part.hi) return true;
      proven |= next.lo > part.lo && next.hi < part.hi;
      const Interval narrower{std::max(part.lo, next.lo), std::min(part.hi, next.hi)};
      const bool stays = narrower.width() > 0.5 * part.width();
      part = narrower;
      if (stays) break;
      e = expand(part);
    }
    if (!proven) return false;
    if (roots_.count == static_cast<int>(roots_.roots.size())) {  // of wider than true coefficients
      roots_.decided = false;
      return true;
    }
    add(roots_, {part, e.slope.lo > 0});
    return true;
  }

  std::array<double, 5> c_{}, off_{};  ///< the coefficients are within off_ of c_
  std::size_t degree_;
  double reach_;
  RealRoots roots_;
};

}  // namespace

RealRoots realRoots(std::span<const Interval> c, double reach) {
  LUXO_REQUIRE(c.size() >= 1 && c.size() <= 5);
  std::size_t size = c.size();
  while (size > 1 && c[size - 1] == Interval(0)) --size;
  switch (size) {
    case 1: {
      RealRoots constant;
      constant.decided = !c[0].contains(0);
      return constant;
    }
    case 2:
      return linearRoots(c[0], c[1], reach);
    case 3:
      return quadraticRoots(c[0], c[1], c[2], reach);
    default:
      return Isolation(c.first(size), reach).run();
  }
}

}  // namespace luxo::reference
