// SPDX-License-Identifier: Apache-2.0
#include "base/diagnostic.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/utf8.h"

namespace luxo {
namespace {

constexpr std::size_t kShownBefore = 60;  // characters of the line kept before the place
constexpr std::size_t kShown = 100;       // characters of the line shown at most
constexpr std::string_view kCut = "...";

bool isContinuation(char byte) { return (static_cast<unsigned char>(byte) & 0xc0) == 0x80; }

// Terminals act on control characters and hide or reorder around the invisible ones.
bool isShowable(const Utf8Character& c) {
  const char32_t p = c.point;
  const bool control = (p < 0x20 && p != '\t') || (p >= 0x7f && p < 0xa0);
  const bool invisible = p == 0xad || (p >= 0x200b && p <= 0x200f) || (p >= 0x2028 && p <= 0x202e) ||
                         (p >= 0x2060 && p <= 0x206f) || p == 0xfeff;
  return c.valid && !control && !invisible;
}

// Messages quote what people wrote.
std::string showable(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    const Utf8Character c = decodeUtf8(text, i);
    result += isShowable(c) ? text.substr(i, c.bytes) : "\uFFFD";
    i += c.bytes;
  }
  return result;
}

std::size_t startOfLine(std::string_view text, std::size_t byte) {
  const std::size_t newline = byte == 0 ? std::string_view::npos : text.rfind('\n', byte - 1);
  return newline == std::string_view::npos ? 0 : newline + 1;
}

std::size_t endOfLine(std::string_view text, std::size_t byte) {
  std::size_t end = std::min(text.find('\n', byte), text.size());
  if (end > byte && text[end - 1] == '\r') --end;
  return end;
}

// Back to the start of the character that holds this byte.
std::size_t startOfCharacter(std::string_view text, std::size_t byte) {
  for (std::size_t back = 1; back <= 3 && back <= byte && byte < text.size(); ++back) {
    if (!isContinuation(text[byte])) return byte;
    if (decodeUtf8(text, byte - back).bytes > back) return byte - back;
  }
  return byte;
}

std::size_t charactersIn(std::string_view text) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < text.size(); i += decodeUtf8(text, i).bytes) ++count;
  return count;
}

// The part of a line around a place, and the marks to write under it.
struct Excerpt {
  std::string shown, marks;
};

Excerpt excerpt(std::string_view text, SourceRange where) {
  const std::size_t lineBegin = startOfLine(text, where.begin), lineEnd = endOfLine(text, where.begin);
  std::size_t at = where.begin;
  for (std::size_t back = 0; back < kShownBefore && at > lineBegin; ++back)
    at = startOfCharacter(text, at - 1);

  Excerpt result;
  std::size_t shown = 0;
  const auto show = [&](std::string_view character, bool marked) {
    result.shown += character;
    if (marked)
      result.marks += '^';
    else if (at < where.begin)
      result.marks += character == "\t" ? '\t' : ' ';
    ++shown;
  };
  if (at > lineBegin) {
    result.shown = kCut;
    result.marks.assign(kCut.size(), ' ');
  }
  for (; at < lineEnd && shown < kShown; at += decodeUtf8(text, at).bytes) {
    const Utf8Character c = decodeUtf8(text, at);
    show(isShowable(c) ? text.substr(at, c.bytes) : "\uFFFD", at >= where.begin && at < where.end);
  }
  if (at < lineEnd) result.shown += kCut;
  if (where.end <= where.begin || where.begin >= lineEnd) result.marks += '^';
  return result;
}

// A message, or the beginning of one that quotes too much.
std::string said(const std::string& message) {
  constexpr std::size_t kMaxLength = 2000;
  if (message.size() <= kMaxLength) return showable(message);
  return showable(message.substr(0, startOfCharacter(message, kMaxLength))) + std::string(kCut);
}

}  // namespace

TextPosition positionAt(std::string_view text, std::size_t byte) {
  byte = startOfCharacter(text, std::min(byte, text.size()));
  const std::size_t lineBegin = startOfLine(text, byte);
  const auto newlines = std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(lineBegin), '\n');
  return {static_cast<std::size_t>(newlines) + 1, charactersIn(text.substr(lineBegin, byte - lineBegin)) + 1};
}

std::string describe(std::string_view sourceName, std::string_view text, const Diagnostic& diagnostic) {
  const SourceRange where{startOfCharacter(text, std::min(diagnostic.where.begin, text.size())),
                          diagnostic.where.end};
  const TextPosition position = positionAt(text, where.begin);
  const Excerpt line = excerpt(text, where);
  const std::string number = fmt::format("{}", position.line);
  std::string result =
      fmt::format("{}:{}:{}: {}\n  {} | {}\n  {:{}} | {}", sourceName, position.line, position.column,
                  said(diagnostic.message), number, line.shown, "", number.size(), line.marks);
  if (!diagnostic.hint.empty()) result += fmt::format("\n  help: {}", said(diagnostic.hint));
  return result;
}

}  // namespace luxo
