// SPDX-License-Identifier: Apache-2.0
// A number of a scene that people turn: a slider in the viewer, -P on the command line.
#pragma once

#include <optional>
#include <string>

#include "math/animated.h"
#include "math/interval.h"

namespace luxo {

/// Everything animated may read it (math/animated.h, Moment). Its own value may be a function of time and of
/// the parameters added before it.
struct Parameter {
  std::string name = "parameter";  ///< unique in its scene
  std::string label = {};          ///< what people read; the name unless given
  Animated<double> value = 0.0;
  std::optional<Interval> range = std::nullopt;  ///< a value outside is an error; with it there is a slider
  std::optional<double> step = std::nullopt;     ///< of the slider, above 0

  [[nodiscard]] const std::string& labelOrName() const { return label.empty() ? name : label; }
};

/// Throws Error(Scene) naming the parameter and the value: an empty or infinite range, a step that is not
/// above 0, a constant value that requireAllowed() refuses.
void validate(const Parameter& parameter);

/// Throws Error(Scene) naming the parameter and its range: a value that is not finite or lies outside.
void requireAllowed(const Parameter& parameter, double value);

}  // namespace luxo
