// SPDX-License-Identifier: Apache-2.0
// Everything that is wrong with one scene file, reported at once.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "base/diagnostic.h"
#include "scene/scene_file.h"

namespace luxo {

/// How many errors of one file are shown; the others are counted.
inline constexpr std::size_t kMaxShownProblems = 20;

[[nodiscard]] inline SourceRange rangeOf(FilePlace place) { return {place.begin, place.end}; }
[[nodiscard]] inline FilePlace placeOf(SourceRange range) {
  return {static_cast<std::uint32_t>(range.begin), static_cast<std::uint32_t>(range.end)};
}

class SceneProblems {
 public:
  explicit SceneProblems(SceneSource source) : source_(std::move(source)) {}

  /// One of the last few is not repeated, where there is a file.
  void add(SourceRange where, std::string message, std::string hint = {});
  void add(FilePlace place, std::string message, std::string hint = {}) {
    add(rangeOf(place), std::move(message), std::move(hint));
  }
  /// A problem of a quantity's formula, its range relative to the formula: one formula may stand for three
  /// numbers.
  void add(const Quantity& quantity, Diagnostic diagnostic);

  [[nodiscard]] const SceneSource& source() const { return source_; }
  [[nodiscard]] bool any() const { return count_ > 0; }
  [[nodiscard]] std::size_t count() const { return count_; }
  /// Whether more will only be counted.
  [[nodiscard]] bool full() const;
  /// As people read them, in the order of the file.
  [[nodiscard]] std::string text() const;
  /// Throws Error(Scene) with text() if there is any.
  void raise() const;

 private:
  struct Problem {
    Diagnostic diagnostic;
    std::string formula;  ///< what the diagnostic is about where there is no file
  };

  [[nodiscard]] bool isRecent(const Diagnostic& diagnostic) const;

  SceneSource source_;
  std::vector<Problem> problems_;  ///< the first few thousand
  std::size_t count_ = 0;
};

/// Where a part of a quantity's formula stands in the file: exact, unless the text has escapes.
[[nodiscard]] SourceRange rangeIn(const Quantity& quantity, SourceRange part);

}  // namespace luxo
