// SPDX-License-Identifier: Apache-2.0
// What a text of GLSL says where nobody has to compile it for that. All that is found is outside of comments.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostic.h"
#include "base/glsl_tokens.h"

namespace luxo {

/// The text with spaces for its comments: all that is left stands where it stood.
[[nodiscard]] std::string withoutComments(std::string_view glsl);

/// The words outside of functions and structures: what is declared for all of the text.
[[nodiscard]] std::vector<GlslToken> outsideOfFunctions(std::string_view glsl);

/// Where the name or keyword stands first.
[[nodiscard]] std::optional<SourceRange> placeOf(std::string_view word, std::string_view glsl);

/// Where the first function of that type and name has its name.
[[nodiscard]] std::optional<SourceRange> placeOfFunction(std::string_view type, std::string_view name,
                                                         std::string_view glsl);

/// Where the first list of more elements than that begins, in brackets of any kind and separated by commas.
[[nodiscard]] std::optional<SourceRange> placeOfList(std::size_t elements, std::string_view glsl);

/// Names of constants, whose declarations may name several; parameters that are const are none.
[[nodiscard]] std::vector<std::string> constantsOf(std::span<const GlslToken> tokens);

using TextByName = std::map<std::string, std::string, std::less<>>;
/// "sampler2D" of `uniform sampler2D oak, ash;` by both names.
[[nodiscard]] TextByName typesOfUniforms(std::string_view glsl);
/// Of variables outside of functions what their declarations say that they are.
[[nodiscard]] TextByName initialisersIn(std::string_view glsl);

}  // namespace luxo
