// SPDX-License-Identifier: Apache-2.0
// Inside of Scope (formula/parse.h): what its names stand for.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "formula/parse.h"
#include "formula/token.h"

namespace luxo {

class FormulaNames {
 public:
  enum class Meaning : std::uint8_t { Value, Definition, Absent };
  enum class Progress : std::uint8_t { Unread, Reading, Read };

  struct Entry {
    Meaning meaning = Meaning::Value;
    Progress progress = Progress::Unread;  ///< of a Definition
    Expr value;
    std::string text;  ///< a Definition's, or the reason of an absence
    Formula formula;   ///< of a Definition that is Read
  };

  void set(std::string name, Entry entry) { entries_.insert_or_assign(std::move(name), std::move(entry)); }

  /// Null when nobody gave this name.
  [[nodiscard]] const Entry* find(std::string_view name) const;

  /// Reads all definitions that `tokens` need. No recursion: chains may be of any length.
  void readDefinitions(const std::vector<Token>& tokens);

  /// All names that have a value, those of the constants too, sorted.
  [[nodiscard]] std::vector<std::string> values() const;

 private:
  struct Hash : std::hash<std::string_view> {
    using is_transparent = void;
  };
  struct Reading;

  [[nodiscard]] Entry* findUnread(const Token& token);

  std::unordered_map<std::string, Entry, Hash, std::equal_to<>> entries_;
};

/// Reads a formula whose definitions have been read. `diagnostics` holds what is known to be wrong with it.
[[nodiscard]] Formula readFormula(std::string_view text, const std::vector<Token>& tokens,
                                  std::vector<Diagnostic> diagnostics, const FormulaNames& names);

}  // namespace luxo
