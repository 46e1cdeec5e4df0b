// SPDX-License-Identifier: Apache-2.0
// The values of a shader's uniforms, as people write them: -P tint=#ff8000, -P pattern=brushed.
#pragma once

#include <string>
#include <vector>

#include "shader_controls.h"
#include "viewer.h"

namespace luxo {

/// A number or formula of each component. `encoded`: colours are codes of sRGB; else they are linear.
/// Error(Usage): the text is no value of the uniform's type. Formulas are not read here.
[[nodiscard]] std::vector<std::string> componentTexts(const UniformControl& uniform, const std::string& text,
                                                      bool encoded);

/// Of what turns a uniform, in a window.
[[nodiscard]] std::vector<std::string> componentTexts(const ParameterControl& control,
                                                      const std::string& text);

/// What its components are called, behind its name: "" of a number, "_r", "_x", "_0" of others.
[[nodiscard]] std::string componentSuffix(const UniformControl& uniform, std::size_t component);

}  // namespace luxo
