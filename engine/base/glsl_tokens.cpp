// SPDX-License-Identifier: Apache-2.0
#include "base/glsl_tokens.h"

#include <algorithm>
#include <array>

namespace luxo {
namespace {

using namespace std::string_view_literals;

constexpr std::array kLongMarks = {"<<="sv, ">>="sv, "##"sv, "&&"sv, "||"sv, "^^"sv, "=="sv, "!="sv,
                                   "<="sv,  ">="sv,  "<<"sv, ">>"sv, "++"sv, "--"sv, "+="sv, "-="sv,
                                   "*="sv,  "/="sv,  "%="sv, "&="sv, "|="sv, "^="sv};

constexpr std::string_view kSeconds = "<>#&|^=+-";  // of these

bool isLineEnd(char c) { return c == '\n' || c == '\r'; }

class Scanner {
 public:
  explicit Scanner(std::string_view text) : text_(text) {}

  [[nodiscard]] std::size_t unended() const { return unended_; }

  std::vector<GlslToken> tokens() {
    std::vector<GlslToken> all;
    while (skipBlank()) {
      GlslToken token{.begin = at_, .afterBlank = afterBlank_};
      if (text_[at_] == '#' && beginsLine_) {
        ++directives_;
        inDirective_ = true;
      }
      if (inDirective_) token.directive = directives_;
      token.kind = kindHere();
      at_ = endOf(token.kind);
      token.text = text_.substr(token.begin, at_ - token.begin);
      afterBlank_ = beginsLine_ = false;
      all.push_back(token);
    }
    return all;
  }

 private:
  [[nodiscard]] char at(std::size_t i) const { return i < text_.size() ? text_[i] : '\0'; }
  [[nodiscard]] bool isDigitAt(std::size_t i) const {
    return std::isdigit(static_cast<unsigned char>(at(i))) != 0;
  }
  /// To what is next; false where nothing is.
  bool skipBlank() {
    while (at_ < text_.size()) {
      const std::string_view next = text_.substr(at_, 2);
      if (const std::size_t joined = continuationAt(text_, at_)) {
        at_ += joined;
      } else if (next == "//") {
        while (at_ < text_.size() && !isLineEnd(text_[at_]))
          at_ += std::max<std::size_t>(1, continuationAt(text_, at_));
      } else if (next == "/*") {
        const std::size_t end = text_.find("*/", at_ + 2);
        if (end == text_.npos) unended_ = at_;
        at_ = end == text_.npos ? text_.size() : end + 2;
      } else if (std::isspace(static_cast<unsigned char>(text_[at_])) != 0) {
        if (isLineEnd(text_[at_])) {
          beginsLine_ = true;
          inDirective_ = false;
        }
        ++at_;
      } else {
        return true;
      }
      afterBlank_ = true;
    }
    return false;
  }

  [[nodiscard]] GlslToken::Kind kindHere() const {
    if (isDigitAt(at_) || (text_[at_] == '.' && isDigitAt(at_ + 1))) return GlslToken::Kind::Number;
    if (isGlslLetter(text_[at_])) return GlslToken::Kind::Word;
    if (text_[at_] == '"' && at(text_.find_first_of("\"\r\n", at_ + 1)) == '"')
      return GlslToken::Kind::Quoted;
    return GlslToken::Kind::Mark;
  }

  [[nodiscard]] std::size_t behindDigits(std::size_t i) const {
    while (isDigitAt(i)) ++i;
    return i;
  }

  [[nodiscard]] std::size_t endOf(GlslToken::Kind kind) const {
    std::size_t end = at_ + 1;
    switch (kind) {
      case GlslToken::Kind::Word:
        while (isGlslLetter(at(end))) ++end;
        return end;
      case GlslToken::Kind::Number: {
        // No longer than the language has it: what follows it is a name, which may be a macro's.
        constexpr std::string_view kSuffixes = "uUlLfFhHsS";
        if (at(at_) == '0' && (at(end) == 'x' || at(end) == 'X')) {
          ++end;
          while (std::isxdigit(static_cast<unsigned char>(at(end))) != 0) ++end;
        } else {
          end = behindDigits(at_);
          if (at(end) == '.') end = behindDigits(end + 1);
          if (at(end) == 'e' || at(end) == 'E') {
            const std::size_t digits = end + (at(end + 1) == '+' || at(end + 1) == '-' ? 2 : 1);
            if (isDigitAt(digits)) end = behindDigits(digits);
          }
        }
        while (at(end) != '\0' && kSuffixes.find(at(end)) != kSuffixes.npos) ++end;
        return end;
      }
      case GlslToken::Kind::Quoted:
        return text_.find('"', end) + 1;
      case GlslToken::Kind::Mark:
        break;
    }
    if (kSeconds.find(at(end)) == kSeconds.npos) return end;
    const std::string_view rest = text_.substr(at_);
    const auto* const found =
        std::ranges::find_if(kLongMarks, [&](std::string_view mark) { return rest.starts_with(mark); });
    return found == kLongMarks.end() ? end : at_ + found->size();
  }

  std::string_view text_;
  std::size_t at_ = 0, directives_ = 0, unended_ = std::string_view::npos;
  bool inDirective_ = false, beginsLine_ = true, afterBlank_ = true;
};

}  // namespace

std::size_t continuationAt(std::string_view glsl, std::size_t at) {
  const std::string_view rest = glsl.substr(std::min(at, glsl.size()), 3);
  if (rest.size() < 2 || rest[0] != '\\' || !isLineEnd(rest[1])) return 0;
  return rest.ends_with("\r\n") ? 3 : 2;
}

std::vector<GlslToken> glslTokens(std::string_view glsl) { return Scanner(glsl).tokens(); }

std::size_t unendedComment(std::string_view glsl) {
  Scanner scanner(glsl);
  static_cast<void>(scanner.tokens());
  return scanner.unended();
}

GlslDirective directiveAt(std::span<const GlslToken> tokens) {
  std::size_t size = 1;
  while (size < tokens.size() && tokens[size].directive == tokens.front().directive) ++size;
  if (size == 1) return {};
  return {tokens[1].text, tokens.subspan(2, size - 2)};
}

std::vector<GlslDirective> directivesIn(std::span<const GlslToken> tokens) {
  std::vector<GlslDirective> all;
  for (std::size_t i = 0; i < tokens.size(); ++i)
    if (tokens[i].directive > all.size()) all.push_back(directiveAt(tokens.subspan(i)));
  return all;
}

}  // namespace luxo
