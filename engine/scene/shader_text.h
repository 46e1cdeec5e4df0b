// SPDX-License-Identifier: Apache-2.0
// What a text of GLSL says where nobody has to compile it for that.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace luxo {

/// The text with spaces for its comments: all that is left stands where it stood.
[[nodiscard]] std::string withoutComments(const std::string& glsl);

/// The text outside of functions, without comments: what is declared for all of it.
[[nodiscard]] std::string outsideOfFunctions(std::string_view glsl);

/// Names of constants, whose declarations may name several; parameters that are const are none.
[[nodiscard]] std::vector<std::string> constantsOf(std::string_view glsl);

}  // namespace luxo
