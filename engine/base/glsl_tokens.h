// SPDX-License-Identifier: Apache-2.0
// A text of GLSL word by word. Nothing here follows macros or conditions (scene/shader_macros.h).
#pragma once

#include <cctype>
#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

namespace luxo {

struct GlslToken {
  /// A word is a name or a keyword. A text in quotes is one token, where they are on one line.
  enum class Kind { Word, Number, Mark, Quoted };

  Kind kind = Kind::Mark;
  std::string_view text;      ///< of a mark an operator, or one character
  std::size_t begin = 0;      ///< byte
  std::size_t directive = 0;  ///< counts from 1; 0: it is on no directive's line
  bool afterBlank = false;    ///< or after a comment, or nothing

  [[nodiscard]] std::size_t end() const { return begin + text.size(); }
  [[nodiscard]] bool isWord() const { return kind == Kind::Word; }
};

[[nodiscard]] inline bool isGlslLetter(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

/// Of a backslash there that ends a line, how long it is with that end; 0: there is none.
[[nodiscard]] std::size_t continuationAt(std::string_view glsl, std::size_t at);

/// Without blanks and comments. Valid as long as the text. Cost: linear, whatever the text is.
[[nodiscard]] std::vector<GlslToken> glslTokens(std::string_view glsl);

/// Where the comment begins that does not end; npos: there is none.
[[nodiscard]] std::size_t unendedComment(std::string_view glsl);

/// `#define N 3` is "define" and N, 3.
struct GlslDirective {
  std::string_view name;
  std::span<const GlslToken> rest;
};
[[nodiscard]] std::vector<GlslDirective> directivesIn(std::span<const GlslToken> tokens);
std::vector<GlslDirective> directivesIn(std::vector<GlslToken>&& tokens) = delete;
/// The one that the tokens begin with.
[[nodiscard]] GlslDirective directiveAt(std::span<const GlslToken> tokens);

}  // namespace luxo
