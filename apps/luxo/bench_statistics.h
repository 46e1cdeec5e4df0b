// SPDX-License-Identifier: Apache-2.0
// The statistics of a benchmark: what is typical of repeated times, and how fast an error falls.
#pragma once

#include <optional>
#include <span>
#include <vector>

namespace luxo {

/// The value that the part `p` (0..1) of the values does not exceed, linear between the two nearest ranks
/// (definition 7 of Hyndman and Fan, 1996). NaN for no values.
[[nodiscard]] double percentile(std::vector<double> values, double p);

/// Of repeated measurements of one quantity: 80 % of them lie from p10 to p90.
struct Typical {
  double median = 0, p10 = 0, p90 = 0;
};

[[nodiscard]] Typical typicalOf(const std::vector<double>& values);

/// What was paid, and how wrong the result is.
struct CostAndError {
  double cost = 0, error = 0;
};

/// The exponent k of the least-squares fit error = c * cost^k, in logarithms. Pairs that are not positive and
/// finite do not count; nothing when fewer than two different costs are left.
[[nodiscard]] std::optional<double> powerOf(std::span<const CostAndError> points);

/// The least cost of those that are at most this wrong; nothing when none is.
[[nodiscard]] std::optional<double> costOfError(std::span<const CostAndError> points, double mostError);

}  // namespace luxo
