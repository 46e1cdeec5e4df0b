// SPDX-License-Identifier: Apache-2.0
// A small deterministic fuzzer for every build: the same seed is the same inputs.
#pragma once

#include <algorithm>
#include <cctype>
#include <random>
#include <span>
#include <string>
#include <string_view>

namespace luxo {

class Mutator {
 public:
  /// `corpus` and `words` must outlive it.
  Mutator(std::span<const std::string> corpus, std::span<const std::string_view> words, std::uint64_t seed)
      : corpus_(corpus), words_(words), random_(seed) {}

  /// An entry of the corpus after one to four random edits.
  [[nodiscard]] std::string next() {
    std::string text = corpus_[below(corpus_.size())];
    for (std::size_t edits = 1 + below(4); edits > 0; --edits) edit(text);
    return text;
  }

 private:
  // Not std::uniform_int_distribution, which differs between libraries. The tiny bias does no harm.
  std::size_t below(std::size_t count) { return count == 0 ? 0 : random_() % count; }

  static bool isWord(char c) { return c == '"' || c == '.' || std::isalnum(static_cast<unsigned char>(c)); }

  // A whole word for another keeps the structure around it, and so gets deeper.
  void replaceWord(std::string& text, std::size_t at) {
    std::size_t begin = at, end = at;
    while (begin > 0 && isWord(text[begin - 1])) --begin;
    while (end < text.size() && isWord(text[end])) ++end;
    text.replace(begin, end - begin, words_[below(words_.size())]);
  }

  void edit(std::string& text) {
    const std::size_t at = below(text.size() + 1),
                      length = below(std::min<std::size_t>(text.size() - at, 12) + 1);
    switch (below(10)) {
      case 0:
        if (at < text.size()) text[at] = static_cast<char>(random_());
        break;
      case 1:
        text.erase(at, length);
        break;
      case 2:
        text.insert(at, words_[below(words_.size())]);
        break;
      case 3:
        text.replace(at, length, words_[below(words_.size())]);
        break;
      case 4:
        text.insert(below(text.size() + 1), text.substr(at, length));
        break;
      case 5:
        text.resize(at);
        break;
      case 6:
      case 7:
      case 8:
        replaceWord(text, at);
        break;
      default: {
        const std::string& other = corpus_[below(corpus_.size())];
        const std::size_t from = below(other.size() + 1);
        text.replace(at, length, other, from, below(40));
      }
    }
  }

  std::span<const std::string> corpus_;
  std::span<const std::string_view> words_;
  std::mt19937_64 random_;
};

}  // namespace luxo
