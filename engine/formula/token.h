// SPDX-License-Identifier: Apache-2.0
// The words of a formula.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "base/diagnostic.h"

namespace luxo {

enum class TokenKind : std::uint8_t {
  Number,
  Name,
  Plus,
  Minus,
  Times,
  Divide,
  Power,
  Open,
  Close,
  Comma,
  Less,
  LessEqual,
  Greater,
  GreaterEqual,
  Equal,
  NotEqual,
  Bad,  ///< nothing of a formula, reported already
  End,
};

struct Token {
  TokenKind kind = TokenKind::End;
  SourceRange where;
  std::string_view text;
  double number = 0;
};

/// The tokens of a text, the last one End. What is written differently elsewhere (** × π [ && ...) is
/// reported with what to write here, and read as that where it can be. Stops when `diagnostics` holds
/// kMaxFormulaErrors. The tokens refer to `text`.
[[nodiscard]] std::vector<Token> tokenize(std::string_view text, std::vector<Diagnostic>& diagnostics);

/// `text`, or its beginning and "..." when it is long: for messages.
[[nodiscard]] std::string shortened(std::string_view text);

}  // namespace luxo
