// SPDX-License-Identifier: Apache-2.0
// Texts of lines and words, as OBJ, MTL, and the headers and ASCII forms of PLY and STL are.
#pragma once

#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>

#include "mesh/model_source.h"

namespace luxo {

/// Reads line by line and word by word; its errors name the file and the line. Lines end as those of Unix,
/// Windows or old Macintoshes do; a byte order mark before the first is none of its text.
class TextLines {
 public:
  /// `name` and `text` must outlive it. A backslash at the end of a line continues it, if that is asked for.
  TextLines(std::string_view name, std::string_view text, bool continuations = false)
      : name_(name),
        text_(text),
        continuations_(continuations),
        at_(text.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0) {}

  /// To the next line that has a word; false at the end.
  bool nextLine() {
    for (;;) {
      skipLine();
      if (at_ == text_.size()) return false;
      ++line_;
      inLine_ = true;
      skipBlanks();
      if (!atLineEnd() && text_[at_] != '#') return true;
    }
  }

  /// The next word of the line; empty at its end. A '#' begins a comment.
  std::string_view word() {
    skipBlanks();
    const std::size_t begin = at_;
    while (at_ < text_.size() && !isBlank(text_[at_]) && text_[at_] != '\n' && !continues()) ++at_;
    if (begin < at_ && text_[begin] == '#') {
      while (!atLineEnd()) ++at_;
      return {};
    }
    return text_.substr(begin, at_ - begin);
  }

  /// All that is left of the line, without blanks around it.
  std::string_view rest() {
    skipBlanks();
    const std::size_t begin = at_;
    while (!atLineEnd()) ++at_;
    std::string_view rest = text_.substr(begin, at_ - begin);
    while (!rest.empty() && isBlank(rest.back())) rest.remove_suffix(1);
    return rest;
  }

  /// The next word across lines; empty at the end of the text.
  std::string_view wordAnywhere() {
    if (!inLine_ && !nextLine()) return {};
    for (std::string_view found = word();; found = word()) {
      if (!found.empty()) return found;
      if (!nextLine()) return {};
    }
  }

  /// A finite number up to kMaxCoordinate, or an error.
  double number(std::string_view what) { return numberOf(word(), what); }
  double numberOf(std::string_view word, std::string_view what) const {
    const std::optional<double> value = parsed(word);
    if (!value)
      refuse(word.empty() ? fmt::format("{} is missing", what)
                          : fmt::format("{} is '{}', which is no number", what, shown(word)));
    if (!(std::abs(*value) <= kMaxCoordinate))
      refuse(fmt::format("{} is {}, which is not within {:g}", what, shown(word), kMaxCoordinate));
    return *value;
  }
  /// Of what may be missing.
  double numberOr(double otherwise, std::string_view what) {
    const std::string_view next = word();
    return next.empty() ? otherwise : numberOf(next, what);
  }

  [[nodiscard]] static std::optional<double> parsed(std::string_view word) {
    if (!word.empty() && word.front() == '+') word.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (end != word.data() + word.size() || error == std::errc::invalid_argument) return std::nullopt;
    if (error == std::errc::result_out_of_range) value = std::strtod(std::string(word).c_str(), nullptr);
    return value;
  }

  [[nodiscard]] std::size_t line() const { return line_; }
  [[nodiscard]] std::size_t offset() const { return at_; }
  [[nodiscard]] std::string_view name() const { return name_; }
  [[noreturn]] void refuse(const std::string& why) const { refuseModel(name_, why, line_); }
  /// What a message shows of a word: its beginning, printable.
  [[nodiscard]] static std::string shown(std::string_view word) { return printable(word.substr(0, 40)); }

  /// U+FEFF in UTF-8, which some programs begin texts with.
  static constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";

 private:
  static bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\0'; }
  [[nodiscard]] bool continues() const {
    if (!continuations_ || text_[at_] != '\\') return false;
    const std::string_view after = text_.substr(at_ + 1, 1);
    return after == "\n" || after == "\r";
  }
  /// A carriage return ends a line unless a line feed does after it.
  [[nodiscard]] bool atLineEnd() const {
    return at_ == text_.size() || text_[at_] == '\n' ||
           (text_[at_] == '\r' && !text_.substr(at_ + 1).starts_with('\n'));
  }
  void skipBlanks() {
    for (; !atLineEnd(); ++at_) {
      if (continues()) {
        at_ += text_.substr(at_ + 1).starts_with("\r\n") ? 2 : 1;
        ++line_;
      } else if (!isBlank(text_[at_])) {
        return;
      }
    }
  }
  void skipLine() {
    if (!inLine_) return;
    while (!atLineEnd()) ++at_;
    if (at_ < text_.size()) ++at_;
    inLine_ = false;
  }

  std::string_view name_, text_;
  bool continuations_;
  std::size_t at_, line_ = 0;
  bool inLine_ = false;
};

}  // namespace luxo
