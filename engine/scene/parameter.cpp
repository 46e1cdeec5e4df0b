// SPDX-License-Identifier: Apache-2.0
#include "scene/parameter.h"

#include <fmt/format.h>

#include <cmath>

#include "base/error.h"

namespace luxo {

void validate(const Parameter& parameter) {
  const auto reject = [&](const std::string& what) {
    throw Error(ErrorKind::Scene, fmt::format("parameter '{}': {}", parameter.name, what));
  };
  if (const auto& range = parameter.range;
      range && !(std::isfinite(range->lo) && std::isfinite(range->hi) && range->lo < range->hi))
    reject(fmt::format("its range from {:.9g} to {:.9g} is empty or not finite", range->lo, range->hi));
  if (const auto& step = parameter.step; step && !(*step > 0 && std::isfinite(*step)))
    reject(fmt::format("its step is {}; it must be above 0", *step));
  if (parameter.value.isConstant()) requireAllowed(parameter, parameter.value.at(0));
}

void requireAllowed(const Parameter& parameter, double value) {
  if (!std::isfinite(value))
    throw Error(ErrorKind::Scene,
                fmt::format("parameter '{}' is {}; it must be finite", parameter.name, value));
  if (parameter.range && !parameter.range->contains(value))
    throw Error(ErrorKind::Scene,
                fmt::format("parameter '{}' is {}, outside its range from {:.9g} to {:.9g}", parameter.name,
                            value, parameter.range->lo, parameter.range->hi));
}

}  // namespace luxo
