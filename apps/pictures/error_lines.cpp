// SPDX-License-Identifier: Apache-2.0
#include "error_lines.h"

#include <algorithm>

namespace luxo {
namespace {

/// UTF-8, character by character.
using Line = std::vector<std::string_view>;

Line charactersOf(std::string_view text) {
  Line line;
  for (std::size_t i = 0, end = 0; i < text.size(); i = end) {
    end = i + 1;
    while (end < text.size() && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) ++end;
    line.push_back(text.substr(i, end - i));
  }
  return line;
}

std::string partOf(const Line& line, std::size_t begin, std::size_t end) {
  std::string text;
  for (std::size_t i = begin; i < std::min(end, line.size()); ++i) text += line[i];
  return text;
}

/// "  12 | " and "     | " are margins of quoted lines and of their marks; 0: of none.
std::size_t marginOf(std::string_view line) {
  const std::size_t bar = line.find_first_not_of(" 0123456789");
  return bar != line.npos && bar > 0 && line.substr(bar).starts_with("| ") ? bar + 2 : 0;
}

void addWrapped(const Line& line, std::size_t columns, std::vector<std::string>& lines) {
  std::size_t begin = 0;
  while (line.size() - begin > columns) {
    std::size_t end = begin + columns;
    while (end > begin && line[end] != " ") --end;
    const bool isWord = end == begin;  // longer than a line
    if (isWord) end = begin + columns;
    lines.push_back(partOf(line, begin, end));
    begin = end + (isWord ? 0 : 1);
  }
  lines.push_back(partOf(line, begin, line.size()));
}

}  // namespace

std::vector<std::string> errorLines(std::string_view text, std::size_t columns) {
  constexpr std::string_view kCut = "...";
  std::vector<std::string_view> all;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    all.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  std::vector<std::string> lines;
  std::size_t skipped = 0;  // of what is quoted, so that its marks are seen
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::size_t margin = marginOf(all[i]);
    const Line line = charactersOf(all[i]);
    if (margin == 0 || margin + 2 * kCut.size() >= columns) {
      addWrapped(line, std::max<std::size_t>(columns, 1), lines);
      continue;
    }
    const bool isMarks = all[i].find_first_not_of(" |^") == all[i].npos;
    if (!isMarks) {
      const std::size_t marks =
          i + 1 < all.size() && marginOf(all[i + 1]) == margin ? charactersOf(all[i + 1]).size() : 0;
      skipped = marks + kCut.size() > columns ? marks + 2 * kCut.size() - columns : 0;
    }
    std::string shown = partOf(line, 0, margin);
    if (skipped > 0) shown += isMarks ? std::string(kCut.size(), ' ') : kCut;
    const std::size_t begin = margin + skipped, room = columns - (skipped > 0 ? kCut.size() : 0) - margin;
    const bool isCut = !isMarks && line.size() > begin + room;
    shown += partOf(line, begin, begin + room - (isCut ? kCut.size() : 0));
    lines.push_back(isCut ? shown + std::string(kCut) : shown);
  }
  return lines;
}

}  // namespace luxo
