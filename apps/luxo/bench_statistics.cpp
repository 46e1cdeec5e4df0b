// SPDX-License-Identifier: Apache-2.0
#include "bench_statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace luxo {

double percentile(std::vector<double> values, double p) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::sort(values.begin(), values.end());
  const double rank = p * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(rank);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return std::lerp(values[below], values[above], rank - static_cast<double>(below));
}

Typical typicalOf(const std::vector<double>& values) {
  return {percentile(values, 0.5), percentile(values, 0.1), percentile(values, 0.9)};
}

std::optional<double> powerOf(std::span<const CostAndError> points) {
  const auto usable = [](double x) { return x > 0 && std::isfinite(x); };
  std::vector<CostAndError> logs;
  for (const CostAndError& p : points)
    if (usable(p.cost) && usable(p.error)) logs.push_back({std::log(p.cost), std::log(p.error)});
  CostAndError mean;
  for (const CostAndError& p : logs) {
    mean.cost += p.cost / static_cast<double>(logs.size());
    mean.error += p.error / static_cast<double>(logs.size());
  }
  double square = 0, product = 0;
  for (const CostAndError& p : logs) {
    square += (p.cost - mean.cost) * (p.cost - mean.cost);
    product += (p.cost - mean.cost) * (p.error - mean.error);
  }
  // Equal costs may differ from their mean by a rounding.
  if (square < 1e-20) return std::nullopt;
  return product / square;
}

std::optional<double> costOfError(std::span<const CostAndError> points, double mostError) {
  std::optional<double> least;
  for (const CostAndError& p : points)
    if (p.error <= mostError && (!least || p.cost < *least)) least = p.cost;
  return least;
}

}  // namespace luxo
