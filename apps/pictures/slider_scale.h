// SPDX-License-Identifier: Apache-2.0
// Between where a slider's handle stands and the value of its parameter.
#pragma once

#include <string>

#include "scene/parameter.h"

namespace luxo {

/// Where a value stands in the parameter's range (required): from 0 to 1.
[[nodiscard]] double sliderPosition(const Parameter& parameter, double value);

/// The value at a position from 0 to 1: a whole number of steps above the lower end or, without a step, a
/// decimal with as few digits as give a thousand values at least. Always in the range.
[[nodiscard]] double sliderValue(const Parameter& parameter, double position);

/// A value as people read it: six digits at most.
[[nodiscard]] std::string sliderText(double value);

}  // namespace luxo
