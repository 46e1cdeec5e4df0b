// SPDX-License-Identifier: Apache-2.0
#include "scene/json_parser.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cstring>
#include <system_error>
#include <unordered_map>
#include <utility>

namespace luxo {
namespace {

constexpr std::string_view kTextInQuotes = "texts and formulas are written in double quotes: \"2*t\"";

bool isDigit(char c) { return c >= '0' && c <= '9'; }
bool isWordStart(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '$'; }
bool isWordPart(char c) { return isWordStart(c) || isDigit(c) || c == '-' || c == '.'; }

/// The length of the valid sequence that starts here, or 0 (Unicode 15, table 3-7).
std::size_t sequenceLength(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t i) {
    return at + i < text.size() ? static_cast<unsigned char>(text[at + i]) : 0u;
  };
  const auto continues = [&](std::size_t i) { return (byte(i) & 0xC0u) == 0x80u; };
  const unsigned first = byte(0), second = byte(1);
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first <= 0xDF) return continues(1) ? 2 : 0;
  if (first >= 0xE0 && first <= 0xEF) {
    if (!continues(1) || !continues(2)) return 0;
    const bool overlong = first == 0xE0 && second < 0xA0, surrogate = first == 0xED && second > 0x9F;
    return overlong || surrogate ? 0 : 3;
  }
  if (first >= 0xF0 && first <= 0xF4) {
    if (!continues(1) || !continues(2) || !continues(3)) return 0;
    const bool overlong = first == 0xF0 && second < 0x90, beyond = first == 0xF4 && second > 0x8F;
    return overlong || beyond ? 0 : 4;
  }
  return 0;
}

/// Whether a number that does not fit a double is too large rather than too small: its digits are shifted by
/// far more than the length of its text could hide.
bool tooLarge(std::string_view number) {
  const std::size_t e = number.find_first_of("eE");
  const std::string_view digits = number.substr(0, e);
  const std::size_t first = digits.find_first_of("123456789");
  const std::size_t point = std::min(digits.find('.'), digits.size());
  double exponent = static_cast<double>(point) - static_cast<double>(first);
  if (e != std::string_view::npos) {
    const bool negative = number[e + 1] == '-';
    double written = 0;  // of any length: infinity will do
    for (const char c : number.substr(e + 1))
      if (isDigit(c)) written = 10 * written + (c - '0');
    exponent += negative ? -written : written;
  }
  return exponent > 0;
}

}  // namespace

std::size_t validUtf8(std::string_view text) {
  std::size_t at = 0;
  while (at < text.size()) {
    std::uint64_t eight = 0;
    if (at + sizeof eight <= text.size()) std::memcpy(&eight, text.data() + at, sizeof eight);
    if (at + sizeof eight <= text.size() && (eight & 0x8080808080808080u) == 0) {
      at += sizeof eight;
      continue;
    }
    const std::size_t length = sequenceLength(text, at);
    if (length == 0) return at;
    at += length;
  }
  return text.size();
}

void appendUtf8(std::string& text, std::uint32_t c) {
  const auto add = [&](std::uint32_t byte) { text.push_back(static_cast<char>(byte)); };
  if (c < 0x80) return add(c);
  if (c < 0x800) {
    add(0xC0 | c >> 6);
  } else {
    if (c < 0x10000) {
      add(0xE0 | c >> 12);
    } else {
      add(0xF0 | c >> 18);
      add(0x80 | (c >> 12 & 0x3F));
    }
    add(0x80 | (c >> 6 & 0x3F));
  }
  add(0x80 | (c & 0x3F));
}

void JsonParser::run() {
  if (!checkText() || !skipSpace() || !readValue()) return;
  while (!open_.empty())
    if (!readNext()) return;
  if (!skipSpace()) return;
  if (!atEnd()) {
    fail("the end of the file");
    return;
  }
  document_.complete_ = true;
}

bool JsonParser::report(std::size_t begin, std::size_t end, std::string message, std::string hint) {
  document_.diagnostics_.push_back({{begin, end}, std::move(message), std::move(hint)});
  return document_.diagnostics_.size() < kMaxJsonErrors;
}

bool JsonParser::fail(std::string_view expected, std::string hint) {
  // What does not belong into an array or object tells that it was to be closed before.
  const bool unclosed =
      !open_.empty() && (atEnd() || std::string_view(":]}").find(peek()) != std::string_view::npos);
  if (hint.empty() && unclosed)
    hint = fmt::format("the {} was opened at {}", inObject() ? "'{'" : "'['",
                       place(document_.nodes_[open_.back().node].begin));
  if (atEnd()) {
    report(text_.size(), text_.size(), fmt::format("expected {}, but the file ends here", expected),
           std::move(hint));
    return false;
  }
  const auto byte = static_cast<unsigned char>(peek());
  const std::size_t length = sequenceLength(text_, at_);
  const std::string found = byte < 0x20 || byte == 0x7F ? fmt::format("the byte 0x{:02X}", byte)
                                                        : fmt::format("'{}'", text_.substr(at_, length));
  if (found == "'\u201C'" || found == "'\u201D'" || found == "'\u2018'" || found == "'\u2019'")
    hint = "use straight double quotes: \"";
  report(at_, at_ + length, fmt::format("expected {}, found {}", expected, found), std::move(hint));
  return false;
}

std::string JsonParser::place(std::size_t byte) const {
  const TextPosition position = positionAt(text_, byte);
  return fmt::format("line {}, column {}", position.line, position.column);
}

void JsonParser::push(JsonKind kind, std::size_t begin, std::size_t end) {
  auto& nodes = document_.nodes_;
  nodes.push_back({.begin = static_cast<std::uint32_t>(begin),
                   .end = static_cast<std::uint32_t>(end),
                   .next = static_cast<std::uint32_t>(nodes.size() + 1),
                   .kind = kind});
}

bool JsonParser::checkText() {
  const auto reject = [&](std::size_t at, std::string message, std::string hint) {
    report(at, at, std::move(message), std::move(hint));
    return false;
  };
  if (text_.size() > kMaxJsonBytes)
    return reject(0, fmt::format("the text has {} bytes; at most {} are read", text_.size(), kMaxJsonBytes),
                  "");
  if (text_.starts_with("\xFF\xFE") || text_.starts_with("\xFE\xFF"))
    return reject(0, "the file is UTF-16", "save it as UTF-8");
  const std::size_t bad = validUtf8(text_);
  if (bad < text_.size())
    return reject(bad, fmt::format("the byte 0x{:02X} is not UTF-8", static_cast<unsigned char>(text_[bad])),
                  "save the file as UTF-8 text");
  if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;
  if (text_.find_first_not_of(" \t\r\n", at_) == std::string_view::npos)
    return reject(0, "the file is empty", "the smallest scene is { \"luxo\": 1 }");
  return true;
}

bool JsonParser::skipSpace() {
  for (;; ++at_) {
    const char c = peek();
    if (!atEnd() && (c == ' ' || c == '\t' || c == '\n' || c == '\r')) continue;
    if (c == '/' && peek(1) == '*') {
      const std::size_t end = std::min(text_.find("*/", at_ + 2), text_.size() - 2) + 2;
      if (!report(at_, at_ + 2, "comments between /* and */ are not read",
                  "start every line of the comment with //"))
        return false;
      at_ = end - 1;
      continue;
    }
    if (c == '#' && !report(at_, at_ + 1, "a comment does not start with '#'", "comments start with //"))
      return false;
    if (c != '#' && !(c == '/' && peek(1) == '/')) return true;
    at_ = std::min(text_.find('\n', at_), text_.size());
    if (atEnd()) return true;
  }
}

bool JsonParser::readValue() {
  const char c = peek();
  switch (c) {
    case '{':
      return open(JsonKind::Object);
    case '[':
      return open(JsonKind::Array);
    case '"':
    case '\'':
      return readString(c);
    default:
      if (isDigit(c) || c == '-' || c == '+' || c == '.') return readNumber();
      if (isWordStart(c)) return readWord();
      return fail("a value", std::string(c == '(' ? kTextInQuotes : ""));
  }
}

bool JsonParser::open(JsonKind kind) {
  if (open_.size() >= kMaxJsonDepth) {
    report(at_, at_ + 1, fmt::format("values are nested more than {} deep", kMaxJsonDepth));
    return false;
  }
  open_.push_back({static_cast<std::uint32_t>(document_.nodes_.size())});
  push(kind, at_, at_ + 1);
  ++at_;
  return true;
}

bool JsonParser::close() {
  Node& node = document_.nodes_[open_.back().node];
  ++at_;
  node.end = static_cast<std::uint32_t>(at_);
  node.next = static_cast<std::uint32_t>(document_.nodes_.size());
  const std::uint32_t index = open_.back().node;
  open_.pop_back();
  return node.kind == JsonKind::Array || checkKeys(index);
}

bool JsonParser::readNext() {
  if (!skipSpace()) return false;
  const char closing = inObject() ? '}' : ']';
  if (peek() == closing) return close();
  if (!open_.back().empty) {
    if (!readSeparator()) return false;
    if (peek() == closing) return close();
  }
  open_.back().empty = false;
  return inObject() ? readKey() && readColon() && readValue() : readValue();
}

bool JsonParser::readSeparator() {
  const char c = peek();
  const bool startsNext = c == '"' || c == '\'' || c == '{' || c == '[' || isDigit(c) || isWordStart(c);
  const Node& last = document_.nodes_.back();
  const bool afterNumber = last.kind == JsonKind::Number && last.end == at_;
  if (c != ',' && (!startsNext || afterNumber)) {
    const bool formula =
        last.kind == JsonKind::Number && (afterNumber || std::strchr("+-*/^(", c)) && !atEnd();
    return fail(inObject() ? "',' or '}'" : "',' or ']'", std::string(formula ? kTextInQuotes : ""));
  }
  const std::size_t comma = at_;
  if (c != ',') {
    const std::size_t end = text_.find_last_not_of(" \t\r\n", at_ - 1) + 1;
    return report(end, end, "a comma is missing between this and what comes before", "put a ',' here");
  }
  ++at_;
  if (!skipSpace()) return false;
  while (peek() == ',') {
    if (!report(at_, at_ + 1, "one comma too many", "remove it")) return false;
    ++at_;
    if (!skipSpace()) return false;
  }
  if (peek() == (inObject() ? '}' : ']'))
    return report(comma, comma + 1, "a comma after the last value", "remove it");
  return true;
}

bool JsonParser::readKey() {
  if (peek() == '"' || peek() == '\'') return readString(peek());
  if (!isWordStart(peek()))
    return fail("a name in double quotes", peek() == ']' ? "a '{' is closed by '}'" : "");
  const std::size_t begin = at_;
  at_ = wordEnd();
  push(JsonKind::String, begin, at_);
  document_.nodes_.back().bare = true;
  const std::string_view name = text_.substr(begin, at_ - begin);
  return report(begin, at_, "names are written in double quotes", fmt::format("write \"{}\"", name));
}

bool JsonParser::readColon() {
  if (!skipSpace()) return false;
  if (peek() == '=') {
    if (!report(at_, at_ + 1, "expected ':', found '='", "between a name and its value stands ':'"))
      return false;
  } else if (peek() != ':') {
    return fail("':'", "between a name and its value stands ':'");
  }
  ++at_;
  return skipSpace();
}

bool JsonParser::readString(char quote) {
  const std::size_t begin = at_++;
  bool escaped = false;
  for (;; ++at_) {
    const char c = peek();
    if (atEnd() || c == '\n' || c == '\r') {
      report(begin, std::min(at_, text_.size()), "this text has no closing quote", "close it with \"");
      return false;
    }
    if (c == quote) break;
    if (c == '\\') {
      escaped = true;
      if (!readEscape()) return false;
    } else if (static_cast<unsigned char>(c) < 0x20) {
      if (!report(at_, at_ + 1, fmt::format("the byte 0x{:02X} inside a text", static_cast<unsigned>(c)),
                  fmt::format("write \\u{:04x}", static_cast<unsigned>(c))))
        return false;
    }
  }
  ++at_;
  push(JsonKind::String, begin, at_);
  document_.nodes_.back().escaped = escaped;
  return quote == '"' || report(begin, at_, "texts are written in double quotes",
                                fmt::format("write \"{}\"", text_.substr(begin + 1, at_ - begin - 2)));
}

/// Leaves at_ on the escape's last byte.
bool JsonParser::readEscape() {
  const std::size_t begin = at_++;
  if (peek() == 'u') {
    const auto isHex = [&](std::size_t i) { return std::isxdigit(static_cast<unsigned char>(peek(i))) != 0; };
    if (isHex(1) && isHex(2) && isHex(3) && isHex(4)) {
      at_ += 4;
      return true;
    }
    at_ = begin;
    return report(begin, begin + 2, "four hexadecimal digits must follow \\u", "");
  }
  if (!atEnd() && peek() != '\0' && std::strchr("\"\\/bfnrt", peek())) return true;
  at_ = begin;
  return report(begin, begin + 1, "a '\\' in a text must be written twice", "write \\\\");
}

std::size_t JsonParser::digitsEnd(std::size_t at) const {
  while (at < text_.size() && isDigit(text_[at])) ++at;
  return at;
}

bool JsonParser::readNumber() {
  const std::size_t begin = at_;
  const auto slip = [&](std::string message, std::string hint) {
    return report(begin, at_, std::move(message), std::move(hint));
  };
  if (peek() == '-' || peek() == '+') ++at_;
  const std::size_t whole = at_;
  at_ = digitsEnd(at_);
  const std::size_t point = at_;
  if (peek() == '.') at_ = digitsEnd(at_ + 1);
  if (at_ == whole || (at_ == whole + 1 && text_[whole] == '.')) {
    at_ = whole;
    return fail("a digit", "");
  }
  const std::size_t digits = at_;
  if (peek() == 'e' || peek() == 'E') {
    const std::size_t sign = peek(1) == '-' || peek(1) == '+' ? 2 : 1;
    if (digitsEnd(at_ + sign) == at_ + sign)
      return fail("',' or the end of the number", "an exponent needs digits: 1e3");
    at_ = digitsEnd(at_ + sign);
  }
  const std::size_t first = text_[begin] == '+' ? whole : begin;
  push(JsonKind::Number, first, at_);
  const std::string_view number = text_.substr(first, at_ - first);
  double value = 0;
  if (std::from_chars(number.data(), number.data() + number.size(), value).ec ==
          std::errc::result_out_of_range &&
      tooLarge(number) && !slip("this number is too large", "the largest number is about 1.797e308"))
    return false;
  if (text_[begin] == '+') return slip("a number does not start with '+'", "remove the '+'");
  if (point == whole) return slip("a digit is missing before the point", fmt::format("write 0{}", number));
  if (digits == point + 1) return slip("a digit is missing after the point", "write 1.0 or 1");
  if (text_[whole] == '0' && point > whole + 1)
    return slip("a number does not start with extra zeros", "remove them");
  return true;
}

std::size_t JsonParser::wordEnd() const {
  std::size_t end = at_;
  while (end < text_.size() && isWordPart(text_[end])) ++end;
  return end;
}

bool JsonParser::readWord() {
  const std::size_t begin = at_;
  at_ = wordEnd();
  const std::string_view word = text_.substr(begin, at_ - begin);
  const auto is = [&](std::initializer_list<std::string_view> words) {
    return std::ranges::find(words, word) != words.end();
  };
  if (is({"true", "True", "TRUE"})) {
    push(JsonKind::True, begin, at_);
    return word == "true" || report(begin, at_, "unknown word", "write true");
  }
  if (is({"false", "False", "FALSE"})) {
    push(JsonKind::False, begin, at_);
    return word == "false" || report(begin, at_, "unknown word", "write false");
  }
  if (is({"null", "None", "undefined"})) {
    push(JsonKind::Null, begin, at_);
    return word == "null" || report(begin, at_, "unknown word", "leave the key out");
  }
  if (is({"NaN", "nan", "Infinity", "inf", "Inf"})) {
    push(JsonKind::Number, begin, begin);  // reads as 0
    return report(begin, at_, fmt::format("{} is not a number here", word), "numbers are finite");
  }
  const std::size_t end = std::min(text_.find_first_of(",]}\r\n", begin), text_.size());
  at_ = std::max(at_, text_.find_last_not_of(" \t", end - 1) + 1);
  push(JsonKind::String, begin, at_);
  document_.nodes_.back().bare = true;
  return report(begin, at_, "a text without quotes", std::string(kTextInQuotes));
}

bool JsonParser::checkKeys(std::uint32_t object) {
  constexpr std::size_t kFew = 16;  // compared pairwise: no allocation for the common object
  const std::vector<Node>& nodes = document_.nodes_;
  const auto twice = [&](std::uint32_t first, std::uint32_t again) {
    return report(nodes[again].begin, nodes[again].end,
                  fmt::format("the name \"{}\" is given twice", document_.stringOf(nodes[again])),
                  fmt::format("the first one is at {}", place(nodes[first].begin)));
  };
  const auto plain = [&](std::uint32_t key) {
    return text_.substr(nodes[key].begin + 1, nodes[key].end - nodes[key].begin - 2);
  };
  std::array<std::uint32_t, kFew> few{};
  std::size_t count = 0;
  bool simple = true;
  for (std::uint32_t key = object + 1; key < nodes[object].next && simple; key = nodes[key + 1].next) {
    simple = count < kFew && !nodes[key].escaped && !nodes[key].bare;
    if (simple) few[count++] = key;
  }
  for (std::size_t i = 1; i < count && simple; ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (plain(few[i]) == plain(few[j])) {
        if (!twice(few[j], few[i])) return false;
        break;
      }
  if (simple) return true;

  std::unordered_map<std::string, std::uint32_t> seen;
  for (std::uint32_t key = object + 1; key < nodes[object].next; key = nodes[key + 1].next) {
    const auto [place, fresh] = seen.emplace(document_.stringOf(nodes[key]), key);
    if (!fresh && !twice(place->second, key)) return false;
  }
  return true;
}

}  // namespace luxo
