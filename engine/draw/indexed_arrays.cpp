// SPDX-License-Identifier: Apache-2.0
#include "draw/indexed_arrays.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

namespace luxo {
namespace {

bool isLetter(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

/// Words that a value may follow; others declare what comes after them.
bool leadsToValue(std::string_view word) {
  constexpr std::array<std::string_view, 3> kWords = {"return", "else", "case"};
  return std::ranges::find(kWords, word) != kWords.end();
}

/// Copies a text, of which nothing is compiled yet.
class ElementReader {
 public:
  ElementReader(std::string_view text, std::string_view name, std::size_t dimensions)
      : text_(text), name_(name), dimensions_(dimensions) {}

  std::optional<std::string> read() {
    while (isPossible_ && at_ < text_.size()) step();
    return isPossible_ ? std::optional(std::move(out_)) : std::nullopt;
  }

 private:
  [[nodiscard]] bool isBlankAt(std::size_t at) const {
    return std::isspace(static_cast<unsigned char>(text_[at])) != 0;
  }

  void copyTo(std::size_t end) {
    end = std::min(end, text_.size());
    out_ += text_.substr(at_, end - at_);
    at_ = end;
  }

  void step() {
    const std::string_view rest = text_.substr(at_);
    if (rest.starts_with("//")) return copyTo(text_.find('\n', at_));
    if (rest.starts_with("/*")) {
      const std::size_t end = text_.find("*/", at_ + 2);
      return copyTo(end == text_.npos ? end : end + 2);
    }
    if (isBlankAt(at_)) {
      if (text_[at_] == '\n' && (at_ == 0 || text_[at_ - 1] != '\\')) inDirective_ = false;
      return copyTo(at_ + 1);
    }
    std::size_t size = 1;
    if (isLetter(rest.front()))
      while (size < rest.size() && isLetter(rest[size])) ++size;
    const std::string_view token = rest.substr(0, size);
    if (token == name_ && last_ != ".") return meet();
    count(token.front());
    last_ = token;
    copyTo(at_ + size);
  }

  void count(char c) {
    inDirective_ = inDirective_ || c == '#';
    braces_ += (c == '{') - (c == '}');
    brackets_ += (c == '(' || c == '[') - (c == ')' || c == ']');
  }

  /// The name itself.
  void meet() {
    if (braces_ == 0 && !inDirective_) {
      isPossible_ = brackets_ == 0;  // else an argument of a function has it
      last_ = name_;
      return copyTo(at_ + name_.size());
    }
    const bool isDeclared = (isLetter(last_.empty() ? ' ' : last_.front()) && !leadsToValue(last_) &&
                             !(inDirective_ && brackets_ == 0)) ||
                            last_ == "]" || (last_ == "," && brackets_ == 0);
    if (isDeclared) {
      isPossible_ = false;
      return;
    }
    at_ += name_.size();
    std::string call = fmt::format("luxoAt_{}(", name_);
    for (std::size_t i = 0; i < dimensions_ && isPossible_; ++i)
      call += fmt::format("{}int({})", i > 0 ? ", " : "", index());
    out_ += call + ")";
    last_ = ")";
  }

  /// What is between the brackets that come next.
  std::string index() {
    while (at_ < text_.size() && isBlankAt(at_)) ++at_;
    isPossible_ = at_ < text_.size() && text_[at_] == '[';
    if (!isPossible_) return {};
    std::string outer = std::move(out_);
    out_.clear();
    last_ = "[";
    const int outside = brackets_;
    ++brackets_;
    ++at_;
    while (isPossible_ && at_ < text_.size() && !(text_[at_] == ']' && brackets_ == outside + 1)) step();
    isPossible_ = isPossible_ && at_ < text_.size();
    brackets_ = outside;
    ++at_;
    std::string inside = std::move(out_);
    out_ = std::move(outer);
    return inside;
  }

  std::string_view text_, name_, last_;
  std::size_t dimensions_, at_ = 0;
  std::string out_;
  int braces_ = 0, brackets_ = 0;
  bool inDirective_ = false, isPossible_ = true;
};

}  // namespace

std::optional<std::string> withElementsRead(std::string_view glsl, std::string_view name,
                                            std::size_t dimensions) {
  return ElementReader(glsl, name, dimensions).read();
}

}  // namespace luxo
