// SPDX-License-Identifier: Apache-2.0
// A table for people.
#pragma once

#include <string>
#include <vector>

namespace luxo {

/// Rows as long as the head.
struct TextTable {
  std::vector<std::string> head;
  std::vector<std::vector<std::string>> rows;
};

/// In columns of a terminal, numbers to the right.
[[nodiscard]] std::string inColumns(const TextTable& table);

/// As GitHub's tables.
[[nodiscard]] std::string inMarkdown(const TextTable& table);

}  // namespace luxo
