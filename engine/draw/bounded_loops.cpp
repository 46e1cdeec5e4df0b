// SPDX-License-Identifier: Apache-2.0
#include "draw/bounded_loops.h"

#include <cctype>
#include <cstddef>
#include <vector>

namespace luxo {
namespace {

constexpr std::string_view kAsks = " if (luxoStops()) break; else ";

bool isWordPart(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

/// Copies a text word by word.
class LoopBounder {
 public:
  explicit LoopBounder(std::string_view text) : text_(text) {}

  std::string bounded() {
    while (at_ < text_.size()) {
      const std::size_t begin = at_;
      step();
      const std::string_view token = text_.substr(begin, at_ - begin);
      if (token == "do" || token == "for" || token == "while") {
        loop(token);
      } else if (!isBlank(token)) {
        last_ = token;
      }
    }
    return std::move(out_);
  }

 private:
  static bool isBlank(std::string_view token) {
    return std::isspace(static_cast<unsigned char>(token.front())) || token.starts_with("//") ||
           token.starts_with("/*");
  }

  /// Copies one word, comment, blank or character.
  void step() {
    const std::size_t begin = at_;
    if (isWordPart(text_[at_])) {
      while (at_ < text_.size() && isWordPart(text_[at_])) ++at_;
    } else if (text_.substr(at_).starts_with("//")) {
      while (at_ < text_.size() && text_[at_] != '\n')
        at_ += text_[at_] == '\\' && at_ + 1 < text_.size() ? 2 : 1;
    } else if (text_.substr(at_).starts_with("/*")) {
      const std::size_t end = text_.find("*/", at_ + 2);
      at_ = end == text_.npos ? text_.size() : end + 2;
    } else if (isVersion()) {
      at_ = std::min(text_.find('\n', at_), text_.size());
      out_.append(at_ - begin, ' ');
      return;
    } else {
      if (text_[at_] == '{') ++depth_;
      if (text_[at_] == '}') --depth_;
      ++at_;
    }
    out_ += text_.substr(begin, at_ - begin);
  }

  [[nodiscard]] bool isVersion() const {
    if (text_[at_] != '#') return false;
    const std::size_t word = text_.find_first_not_of(" \t", at_ + 1);
    return word != text_.npos && text_.substr(word).starts_with("version");
  }

  void loop(std::string_view word) {
    const std::string_view before = last_;
    last_ = word;
    if (word == "do") {
      open_.push_back(depth_);
      out_ += kAsks;
      return;
    }
    // Of a `do`: what it repeats is over, in braces of the same depth or with a semicolon.
    if (word == "while" && !open_.empty() && open_.back() == depth_ && (before == "}" || before == ";")) {
      open_.pop_back();
      return;
    }
    while (at_ < text_.size() && isBlank(text_.substr(at_, 2))) step();
    if (at_ >= text_.size() || text_[at_] != '(') return;
    int parentheses = 0;
    do {
      parentheses += text_[at_] == '(' ? 1 : text_[at_] == ')' ? -1 : 0;
      step();
    } while (parentheses > 0 && at_ < text_.size());
    if (parentheses == 0) out_ += kAsks;
    last_ = ")";
  }

  std::string_view text_, last_;
  std::string out_;
  std::size_t at_ = 0;
  int depth_ = 0;
  std::vector<int> open_;  ///< of each `do` the depth of braces that it stands in
};

}  // namespace

std::string withBoundedLoops(std::string_view glsl) { return LoopBounder(glsl).bounded(); }

}  // namespace luxo
