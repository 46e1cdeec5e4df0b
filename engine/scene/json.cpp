// SPDX-License-Identifier: Apache-2.0
#include "scene/json.h"

#include <array>
#include <charconv>
#include <utility>

#include "base/assert.h"
#include "scene/json_parser.h"

namespace luxo {
namespace {

std::uint32_t hexDigits(std::string_view four) {
  std::uint32_t value = 0;
  std::from_chars(four.data(), four.data() + four.size(), value, 16);
  return value;
}

char meaningOf(char escape) {
  switch (escape) {
    case 'b':
      return '\b';
    case 'f':
      return '\f';
    case 'n':
      return '\n';
    case 'r':
      return '\r';
    case 't':
      return '\t';
    default:
      return escape;
  }
}

/// Appends what `\uXXXX` at the start of `rest` stands for and returns how many bytes it takes: a pair of
/// surrogates is one character, half a pair the replacement character.
std::size_t appendCodePoint(std::string& text, std::string_view rest) {
  constexpr std::uint32_t kReplacement = 0xFFFD;
  const std::uint32_t first = hexDigits(rest.substr(2, 4));
  if (first < 0xD800 || first > 0xDFFF) {
    appendUtf8(text, first);
    return 6;
  }
  if (first <= 0xDBFF && rest.size() >= 12 && rest[6] == '\\' && rest[7] == 'u') {
    const std::uint32_t second = hexDigits(rest.substr(8, 4));
    if (second >= 0xDC00 && second <= 0xDFFF) {
      appendUtf8(text, 0x10000 + ((first - 0xD800) << 10) + (second - 0xDC00));
      return 12;
    }
  }
  appendUtf8(text, kReplacement);
  return 6;
}

}  // namespace

JsonDocument::JsonDocument(std::shared_ptr<const std::string> text) : text_(std::move(text)) {
  JsonParser(*this).run();
}

JsonValue JsonDocument::root() const {
  LUXO_REQUIRE(complete_);
  return {this, 0, static_cast<std::uint32_t>(nodes_.size()), false};
}

std::string JsonDocument::stringOf(const Node& node) const {
  const std::string_view written = std::string_view(*text_).substr(node.begin, node.end - node.begin);
  if (node.bare) return std::string(written);
  const std::string_view inside = written.substr(1, written.size() - 2);
  if (!node.escaped) return std::string(inside);
  std::string text;
  for (std::size_t i = 0; i < inside.size();) {
    if (inside[i] != '\\' || i + 1 == inside.size()) {
      text += inside[i++];
    } else if (inside[i + 1] == 'u' && i + 6 <= inside.size()) {
      i += appendCodePoint(text, inside.substr(i));
    } else {
      text += meaningOf(inside[i + 1]);
      i += 2;
    }
  }
  return text;
}

JsonKind JsonValue::kind() const { return document_->nodes_[index_].kind; }

SourceRange JsonValue::where() const {
  const JsonDocument::Node& node = document_->nodes_[index_];
  return {node.begin, node.end};
}

std::string_view JsonValue::kindName() const {
  constexpr std::array<std::string_view, 7> kNames = {"null",   "false",    "true",     "a number",
                                                      "a text", "an array", "an object"};
  return kNames[static_cast<std::size_t>(kind())];
}

double JsonValue::number() const {
  LUXO_REQUIRE(kind() == JsonKind::Number);
  const JsonDocument::Node& node = document_->nodes_[index_];
  const char* const text = document_->text_->data();
  double value = 0;  // what is too small for a double stays 0
  std::from_chars(text + node.begin, text + node.end, value);
  return value;
}

std::string JsonValue::string() const {
  LUXO_REQUIRE(kind() == JsonKind::String);
  return document_->stringOf(document_->nodes_[index_]);
}

JsonValue JsonValue::first() const {
  const bool object = kind() == JsonKind::Object;
  if (!object && kind() != JsonKind::Array) return {document_, index_, index_, false};
  return {document_, index_ + (object ? 2 : 1), document_->nodes_[index_].next, object};
}

JsonValue JsonValue::next() const {
  return {document_, document_->nodes_[index_].next + (member_ ? 1 : 0), end_, member_};
}

std::string JsonValue::key() const {
  LUXO_REQUIRE(member_);
  return document_->stringOf(document_->nodes_[index_ - 1]);
}

SourceRange JsonValue::keyWhere() const {
  LUXO_REQUIRE(member_);
  const JsonDocument::Node& key = document_->nodes_[index_ - 1];
  return {key.begin, key.end};
}

std::size_t JsonValue::size() const {
  std::size_t count = 0;
  for (JsonValue element = first(); element.exists(); element = element.next()) ++count;
  return count;
}

}  // namespace luxo
