// SPDX-License-Identifier: Apache-2.0
// JSON as text that people like to read and to compare: what fits on a line stays on it, the rest has a line
// for each element.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace luxo {

/// A value on its way to a text.
class JsonText {
 public:
  static constexpr std::size_t kLineLength = 110;

  [[nodiscard]] static JsonText number(double value);  ///< the shortest that reads back; required: finite
  [[nodiscard]] static JsonText string(std::string_view text);
  [[nodiscard]] static JsonText boolean(bool value);
  [[nodiscard]] static JsonText array();
  [[nodiscard]] static JsonText object();

  void add(JsonText element);                        ///< to an array
  void add(std::string_view name, JsonText member);  ///< to an object

  [[nodiscard]] std::size_t size() const { return elements_.size(); }  ///< of an array or object

  /// Cost: linear in the text.
  [[nodiscard]] std::string text() const;

 private:
  enum class Kind : std::uint8_t { Scalar, Array, Object };

  explicit JsonText(Kind kind) : kind_(kind) {}
  void write(std::string& text, std::size_t indent, std::size_t before) const;
  void writeFlat(std::string& text) const;

  Kind kind_;
  std::string scalar_;              ///< as it is written
  std::vector<std::string> names_;  ///< of an object's members, as they are written
  std::vector<JsonText> elements_;
  std::size_t flatLength_ = 0;  ///< on one line
};

}  // namespace luxo
