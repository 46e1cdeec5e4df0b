// SPDX-License-Identifier: Apache-2.0
// The reading of JSON text into the values of a document (scene/json.h).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "scene/json.h"

namespace luxo {

class JsonParser {
 public:
  explicit JsonParser(JsonDocument& document) : document_(document), text_(*document.text_) {}

  void run();

 private:
  using Node = JsonDocument::Node;

  struct Open {
    std::uint32_t node;
    bool empty = true;
  };

  /// Whether reading may go on: each of these reports what is wrong.
  bool checkText();
  bool readValue();
  bool readNext();
  bool readSeparator();
  bool readKey();
  bool readColon();
  bool readString(char quote);
  bool readEscape();
  bool readNumber();
  bool readWord();
  bool open(JsonKind kind);
  bool close();
  bool skipSpace();
  bool checkKeys(std::uint32_t object);

  bool report(std::size_t begin, std::size_t end, std::string message, std::string hint = {});
  bool fail(std::string_view expected, std::string hint = {});
  void push(JsonKind kind, std::size_t begin, std::size_t end);
  std::size_t wordEnd() const;
  std::size_t digitsEnd(std::size_t at) const;
  std::string place(std::size_t byte) const;
  [[nodiscard]] char peek(std::size_t ahead = 0) const {
    return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0';
  }
  [[nodiscard]] bool atEnd() const { return at_ >= text_.size(); }
  [[nodiscard]] bool inObject() const { return document_.nodes_[open_.back().node].kind == JsonKind::Object; }

  JsonDocument& document_;
  std::string_view text_;
  std::size_t at_ = 0;
  std::vector<Open> open_;  ///< the containers around what is read
};

/// Where a text stops being UTF-8, or its size.
[[nodiscard]] std::size_t validUtf8(std::string_view text);

/// Appends a character as UTF-8.
void appendUtf8(std::string& text, std::uint32_t codePoint);

}  // namespace luxo
