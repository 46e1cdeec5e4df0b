// SPDX-License-Identifier: Apache-2.0
#include "scene/json_writer.h"

#include <fmt/format.h>

#include <cmath>

#include "base/assert.h"

namespace luxo {
namespace {

constexpr std::size_t kIndent = 2;

std::string quoted(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      result += {'\\', c};
    else if (static_cast<unsigned char>(c) < 0x20)
      result += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    else
      result += c;
  }
  return result + '"';
}

}  // namespace

JsonText JsonText::number(double value) {
  LUXO_REQUIRE(std::isfinite(value));
  JsonText json(Kind::Scalar);
  json.scalar_ = fmt::format("{}", value);
  json.flatLength_ = json.scalar_.size();
  return json;
}

JsonText JsonText::string(std::string_view text) {
  JsonText json(Kind::Scalar);
  json.scalar_ = quoted(text);
  json.flatLength_ = json.scalar_.size();
  return json;
}

JsonText JsonText::boolean(bool value) {
  JsonText json(Kind::Scalar);
  json.scalar_ = value ? "true" : "false";
  json.flatLength_ = json.scalar_.size();
  return json;
}

JsonText JsonText::array() {
  JsonText json(Kind::Array);
  json.flatLength_ = 2;  // []
  return json;
}

JsonText JsonText::object() {
  JsonText json(Kind::Object);
  json.flatLength_ = 2;  // {}
  return json;
}

void JsonText::add(JsonText element) {
  LUXO_REQUIRE(kind_ == Kind::Array);
  flatLength_ += element.flatLength_ + (elements_.empty() ? 0 : 2);
  elements_.push_back(std::move(element));
}

void JsonText::add(std::string_view name, JsonText member) {
  LUXO_REQUIRE(kind_ == Kind::Object);
  names_.push_back(quoted(name));
  // A separator, or the spaces inside the braces; a colon and a space.
  flatLength_ += names_.back().size() + member.flatLength_ + 4;
  elements_.push_back(std::move(member));
}

void JsonText::writeFlat(std::string& text) const {
  if (kind_ == Kind::Scalar) {
    text += scalar_;
    return;
  }
  const bool object = kind_ == Kind::Object, empty = elements_.empty();
  text += object ? '{' : '[';
  if (object && !empty) text += ' ';
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    if (i > 0) text += ", ";
    if (object) text += names_[i] + ": ";
    elements_[i].writeFlat(text);
  }
  if (object && !empty) text += ' ';
  text += object ? '}' : ']';
}

// Recursive: as deep as the value.
void JsonText::write(std::string& text, std::size_t indent, std::size_t before) const {
  // A line also holds what comes before the value, and the comma behind it.
  if (kind_ == Kind::Scalar || elements_.empty() || before + flatLength_ + 1 <= kLineLength)
    return writeFlat(text);
  const bool object = kind_ == Kind::Object;
  const std::string inside(indent + kIndent, ' ');
  text += object ? "{\n" : "[\n";
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    text += inside;
    if (object) text += names_[i] + ": ";
    elements_[i].write(text, indent + kIndent, inside.size() + (object ? names_[i].size() + 2 : 0));
    text += i + 1 < elements_.size() ? ",\n" : "\n";
  }
  text += std::string(indent, ' ') + (object ? '}' : ']');
}

std::string JsonText::text() const {
  std::string text;
  write(text, 0, 0);
  return text;
}

}  // namespace luxo
