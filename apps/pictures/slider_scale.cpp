// SPDX-License-Identifier: Apache-2.0
#include "slider_scale.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/assert.h"

namespace luxo {
namespace {

constexpr double kFewestValues = 1000;
// A step that meets the upper end may miss it by rounding.
constexpr double kStepSlack = 1e-9;

/// Where powers of ten are exact, a quotient of two whole numbers is the nearest double of the decimal.
double roundToDecimal(double value, double unit) {
  const double exponent = std::floor(std::log10(unit));
  const double power = std::pow(10, std::abs(exponent));
  return exponent < 0 ? std::round(value * power) / power : std::round(value / power) * power;
}

}  // namespace

double sliderPosition(const Parameter& parameter, double value) {
  LUXO_REQUIRE(parameter.range.has_value());
  const auto& [lo, hi] = *parameter.range;
  return std::clamp((value - lo) / (hi - lo), 0.0, 1.0);
}

double sliderValue(const Parameter& parameter, double position) {
  LUXO_REQUIRE(parameter.range.has_value());
  const auto& [lo, hi] = *parameter.range;
  const double wanted = lo + position * (hi - lo);
  if (!parameter.step) return std::clamp(roundToDecimal(wanted, (hi - lo) / kFewestValues), lo, hi);
  const double step = *parameter.step;
  const double most = std::floor((hi - lo) / step + kStepSlack);
  return std::clamp(lo + std::min(std::round((wanted - lo) / step), most) * step, lo, hi);
}

std::string sliderText(double value) { return fmt::format("{:.6g}", value); }

}  // namespace luxo
