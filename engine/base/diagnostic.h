// SPDX-License-Identifier: Apache-2.0
// What is wrong with a text, and where: errors that show the line and point at the place.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace luxo {

/// Bytes [begin, end) of a text. An empty range points at the place before `begin`.
struct SourceRange {
  std::size_t begin = 0, end = 0;

  friend bool operator==(const SourceRange&, const SourceRange&) = default;
};

/// One problem. Messages are lower case, without a full stop; the hint says what to write instead, or is
/// empty.
struct Diagnostic {
  SourceRange where;
  std::string message;
  std::string hint;

  friend bool operator==(const Diagnostic&, const Diagnostic&) = default;
};

/// Both count from 1. A column is one character (a UTF-8 sequence; a tab is one too).
struct TextPosition {
  std::size_t line = 1, column = 1;

  friend bool operator==(const TextPosition&, const TextPosition&) = default;
};

/// Where a byte of a text is; beyond its end counts as the end. Cost: linear in `byte`.
[[nodiscard]] TextPosition positionAt(std::string_view text, std::size_t byte);

/// The problem as people read it, without a newline at the end:
///
///     flag.luxo.json:12:17: unknown name 'uv'
///       12 |   "position": ["uv", "v", "0"]
///          |                 ^^
///       help: did you mean 'u*v'?
///
/// Long lines are cut around the place; bytes that a terminal would act on or that are not UTF-8 are shown as
/// U+FFFD, also in the message and the hint. Cost: linear in the place.
[[nodiscard]] std::string describe(std::string_view sourceName, std::string_view text,
                                   const Diagnostic& diagnostic);

}  // namespace luxo
