// SPDX-License-Identifier: Apache-2.0
// JSON with positions: what people write in scene files, read so that every mistake can be shown in its line.
//
// JSON (RFC 8259) plus comments from `//` to the end of the line. A byte order mark is skipped. Values are 16
// bytes each and refer to the text: strings without escapes and numbers are read where they stand.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostic.h"

namespace luxo {

/// Limits, each an error of its own: bytes of one text, and values inside each other.
inline constexpr std::size_t kMaxJsonBytes = std::size_t{1} << 30;
inline constexpr std::size_t kMaxJsonDepth = 512;
inline constexpr std::size_t kMaxJsonErrors = 20;

enum class JsonKind : std::uint8_t { Null, False, True, Number, String, Array, Object };

class JsonDocument;

/// A value of a document, which must outlive it.
class JsonValue {
 public:
  JsonValue() = default;  ///< does not exist

  [[nodiscard]] JsonKind kind() const;
  /// Where it is written, quotes and brackets included.
  [[nodiscard]] SourceRange where() const;
  /// "a number", "an object", ...: for messages.
  [[nodiscard]] std::string_view kindName() const;

  [[nodiscard]] bool isBoolean() const { return kind() == JsonKind::True || kind() == JsonKind::False; }

  /// The nearest double. Required: a number.
  [[nodiscard]] double number() const;
  /// With escapes resolved. Required: a string.
  [[nodiscard]] std::string string() const;

  /// Elements of an array, or members of an object, in order: `for (auto e = v.first(); e.exists(); e =
  /// e.next())`. A member is its value; key() and keyWhere() belong to it.
  [[nodiscard]] JsonValue first() const;
  [[nodiscard]] JsonValue next() const;
  [[nodiscard]] bool exists() const { return index_ < end_; }
  /// Required: a member of an object.
  [[nodiscard]] std::string key() const;
  [[nodiscard]] SourceRange keyWhere() const;
  /// Elements or members; 0 for anything else. Linear.
  [[nodiscard]] std::size_t size() const;

 private:
  friend class JsonDocument;
  JsonValue(const JsonDocument* document, std::uint32_t index, std::uint32_t end, bool member)
      : document_(document), index_(index), end_(end), member_(member) {}

  const JsonDocument* document_ = nullptr;
  std::uint32_t index_ = 0, end_ = 0;  ///< of its node; of the first node after its container
  bool member_ = false;                ///< the node before it is its key
};

/// A text and the values in it.
class JsonDocument {
 public:
  /// Never throws for what is written in the text. Slips with one meaning (a comma missing or too many,
  /// single quotes, a name without quotes, a key twice) are errors but do not end the reading; the first
  /// other error does. Cost: linear in the text, without recursion; at most 16 bytes for each value, key
  /// included.
  explicit JsonDocument(std::shared_ptr<const std::string> text);

  [[nodiscard]] const std::vector<Diagnostic>& diagnostics() const { return diagnostics_; }
  /// Whether the text was read to its end, so that root() is what its author meant.
  [[nodiscard]] bool complete() const { return complete_; }
  /// Required: complete().
  [[nodiscard]] JsonValue root() const;

  [[nodiscard]] const std::string& text() const { return *text_; }

 private:
  friend class JsonValue;
  friend class JsonParser;

  struct Node {
    std::uint32_t begin = 0, end = 0;  ///< bytes of the text
    std::uint32_t next = 0;            ///< the node after this one and all inside it
    JsonKind kind = JsonKind::Null;
    bool escaped = false;  ///< a string with escapes
    bool bare = false;     ///< a name without quotes
  };

  [[nodiscard]] std::string stringOf(const Node& node) const;

  std::shared_ptr<const std::string> text_;
  std::vector<Node> nodes_;  ///< in the order of the text; an object holds key, value, key, value, ...
  std::vector<Diagnostic> diagnostics_;
  bool complete_ = false;
};

}  // namespace luxo
