// SPDX-License-Identifier: Apache-2.0
// Interval arithmetic on what is not defined everywhere: the square root of -1..4 is 0..2 where there is one.
// (IEEE 1788-2015 calls it natural interval extensions with decorations.)
#pragma once

#include <cstdint>
#include <optional>

#include "math/interval.h"

namespace luxo {

/// Holds what a formula gives at every point of a rectangle at which it is defined, in real numbers and in
/// double alike; as Interval is, where that is bounded.
struct PartialInterval {
  enum class Defined : std::uint8_t {
    Nowhere,    ///< proven: at every point of the rectangle the formula has no finite value
    Somewhere,  ///< it may have none at some points
    Everywhere  ///< proven, where the range is bounded
  };

  Interval range;
  Defined defined = Defined::Everywhere;
  /// No value is between these, both excluded, if the first is the lower one: beside a pole a quotient and a
  /// tangent are far above or far below (W. Kahan's exterior intervals, 1968). Only what moves or stretches
  /// all numbers keeps it.
  Interval gap{0, 0};

  PartialInterval() = default;
  PartialInterval(double number);  ///< NOLINT: a number is one; Nowhere if it is not finite
  PartialInterval(const Interval& all) : range(all) {}  // NOLINT: an interval is one
  PartialInterval(const Interval& some, Defined where);

  /// What of the values is within a distance of 0; nothing if none is.
  [[nodiscard]] std::optional<Interval> within(double distance) const;
};

[[nodiscard]] PartialInterval operator-(const PartialInterval& x);
[[nodiscard]] PartialInterval operator+(const PartialInterval& x, const PartialInterval& y);
[[nodiscard]] PartialInterval operator-(const PartialInterval& x, const PartialInterval& y);
[[nodiscard]] PartialInterval operator*(const PartialInterval& x, const PartialInterval& y);
[[nodiscard]] PartialInterval operator/(const PartialInterval& x, const PartialInterval& y);

[[nodiscard]] PartialInterval integerPower(const PartialInterval& x, int exponent);
[[nodiscard]] PartialInterval pow(const PartialInterval& x, const PartialInterval& y);
[[nodiscard]] PartialInterval sqrt(const PartialInterval& x);
[[nodiscard]] PartialInterval exp(const PartialInterval& x);
[[nodiscard]] PartialInterval log(const PartialInterval& x);
[[nodiscard]] PartialInterval sin(const PartialInterval& x);
[[nodiscard]] PartialInterval cos(const PartialInterval& x);
void sinCos(const PartialInterval& x, PartialInterval& sine, PartialInterval& cosine);
[[nodiscard]] PartialInterval tan(const PartialInterval& x);
[[nodiscard]] PartialInterval sinh(const PartialInterval& x);
[[nodiscard]] PartialInterval cosh(const PartialInterval& x);
[[nodiscard]] PartialInterval tanh(const PartialInterval& x);
[[nodiscard]] PartialInterval asin(const PartialInterval& x);
[[nodiscard]] PartialInterval acos(const PartialInterval& x);
[[nodiscard]] PartialInterval atan(const PartialInterval& x);
[[nodiscard]] PartialInterval atan2(const PartialInterval& y, const PartialInterval& x);
[[nodiscard]] PartialInterval abs(const PartialInterval& x);
[[nodiscard]] PartialInterval min(const PartialInterval& x, const PartialInterval& y);
[[nodiscard]] PartialInterval max(const PartialInterval& x, const PartialInterval& y);
[[nodiscard]] PartialInterval floor(const PartialInterval& x);
[[nodiscard]] PartialInterval sign(const PartialInterval& x);
[[nodiscard]] PartialInterval less(const PartialInterval& x, const PartialInterval& y);
[[nodiscard]] PartialInterval lessEqual(const PartialInterval& x, const PartialInterval& y);
[[nodiscard]] PartialInterval equal(const PartialInterval& x, const PartialInterval& y);
[[nodiscard]] PartialInterval select(const PartialInterval& condition, const PartialInterval& a,
                                     const PartialInterval& b);

}  // namespace luxo
