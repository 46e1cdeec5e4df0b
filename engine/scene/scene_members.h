// SPDX-License-Identifier: Apache-2.0
// Reading single values of a scene file: every wrong type, unknown key and missing key becomes a problem,
// and what cannot be read keeps its default, so that one pass finds everything.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scene/json.h"
#include "scene/scene_file.h"
#include "scene/scene_keys.h"
#include "scene/scene_problems.h"

namespace luxo {

/// The members of one object, by the names of its kind.
class SceneMembers {
 public:
  /// Reports a value that is not an object, unknown keys, with `more` known ones, and required keys that are
  /// missing. Keys that start with `x-` are free.
  SceneMembers(const JsonValue& object, const SceneKeys& kind, SceneProblems& problems,
               std::span<const std::string> more = {});

  /// Whether it is an object with all required keys.
  [[nodiscard]] bool complete() const { return complete_; }
  /// The member of that name, if it exists. Required: a name of the kind.
  [[nodiscard]] JsonValue operator[](std::string_view name) const;

 private:
  static constexpr std::size_t kMaxKeys = 20;

  const SceneKeys& kind_;
  std::array<JsonValue, kMaxKeys> values_{};
  bool complete_ = true;
};

class SceneValues {
 public:
  explicit SceneValues(SceneProblems& problems) : problems_(problems) {}

  // Each leaves its target alone for a value that does not exist or is wrong; the latter is reported and
  // returns false.
  bool read(const JsonValue& value, Quantity& target);
  bool read(const JsonValue& value, QuantityPair& target) { return readArray(value, target); }
  bool read(const JsonValue& value, Quantity3& target) { return readArray(value, target); }
  bool read(const JsonValue& value, bool& target);
  bool read(const JsonValue& value, std::string& target);
  bool read(const JsonValue& value, FileName& target);
  template <class T>
  bool read(const JsonValue& value, std::optional<T>& target) {
    if (!value.exists()) return true;
    return read(value, target.emplace());
  }
  /// [r, g, b], one number for all three, or "#rrggbb".
  bool readColor(const JsonValue& value, Quantity3& target);
  /// The same, or "#rrggbbaa", whose last byte is the opacity.
  bool readColor(const JsonValue& value, Quantity3& target, Quantity& opacity);
  /// An object of names and formulas.
  bool read(const JsonValue& value, std::vector<LetDesc>& target);
  /// As many numbers as `target` has.
  bool readArray(const JsonValue& value, std::span<Quantity> target);
  /// One of the names; the enumeration counts as they do.
  template <class Enum>
  bool readWord(const JsonValue& value, std::span<const std::string_view> names, Enum& target) {
    const std::optional<std::size_t> index = wordIndex(value, names);
    if (index) target = static_cast<Enum>(*index);
    return index || !value.exists();
  }

  /// "expected a number or a formula, found an object"
  bool reject(const JsonValue& value, std::string_view expected, std::string hint = {});

 private:
  std::optional<std::size_t> wordIndex(const JsonValue& value, std::span<const std::string_view> names);

  SceneProblems& problems_;
};

[[nodiscard]] std::vector<std::string> strings(std::span<const std::string_view> names);

}  // namespace luxo
