// SPDX-License-Identifier: Apache-2.0
#include "scene/scene_members.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>

#include "base/assert.h"
#include "base/srgb_curve.h"
#include "base/suggestion.h"

namespace luxo {
namespace {

/// The number of these digits, all of them.
std::optional<int> hexNumber(std::string_view digits) {
  int code = 0;
  const char* const end = digits.data() + digits.size();
  if (std::from_chars(digits.data(), end, code, 16).ptr != end || digits.starts_with('-'))
    return std::nullopt;
  return code;
}

/// The linear components of "#rrggbb" or "#rgb".
std::optional<std::array<double, 3>> hexColor(std::string_view text) {
  const std::string_view digits = text.substr(1);
  if (digits.size() != 6 && digits.size() != 3) return std::nullopt;
  const std::size_t length = digits.size() / 3;
  std::array<double, 3> color{};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::optional<int> code = hexNumber(digits.substr(i * length, length));
    if (!code) return std::nullopt;
    color[i] = linearFromSrgb((length == 1 ? 17 * *code : *code) / 255.0);
  }
  return color;
}

/// "1280x720" and "0, 1, 0" as the arrays they mean; empty for another text.
std::vector<double> numbersIn(std::string_view text) {
  constexpr std::string_view kBetween = " ,;x[]()";
  std::vector<double> numbers;
  for (std::size_t at = 0; (at = text.find_first_not_of(kBetween, at)) != std::string_view::npos;) {
    const std::string_view word = text.substr(at, text.find_first_of(kBetween, at) - at);
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), numbers.emplace_back());
    if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(numbers.back())) return {};
    at += word.size();
  }
  return numbers;
}

/// "y" and "-y" as the axes they mean; empty for another text.
std::vector<double> axisIn(std::string_view text) {
  const bool negative = text.starts_with('-');
  if (negative) text.remove_prefix(1);
  const std::size_t axis = text.size() == 1 ? std::string_view("xyz").find(text[0]) : std::string_view::npos;
  if (axis == std::string_view::npos) return {};
  std::vector<double> direction(3, 0.0);
  direction[axis] = negative ? -1 : 1;
  return direction;
}

/// What to write for an array that stands in a text.
std::string arrayHint(std::string_view text, std::size_t count) {
  for (const std::vector<double>& numbers : {numbersIn(text), axisIn(text)})
    if (numbers.size() == count) return fmt::format("write [{}]", fmt::join(numbers, ", "));
  return {};
}

}  // namespace

std::vector<std::string> strings(std::span<const std::string_view> names) {
  return {names.begin(), names.end()};
}

SceneMembers::SceneMembers(const JsonValue& object, const SceneKeys& kind, SceneProblems& problems,
                           std::span<const std::string> more)
    : kind_(kind) {
  static_assert(
      std::ranges::all_of(keys::kAll, [](const SceneKeys& k) { return k.keys.size() <= kMaxKeys; }));
  if (object.kind() != JsonKind::Object) {
    problems.add(object.where(),
                 fmt::format("expected {}: an object, found {}", kind.what, object.kindName()));
    complete_ = false;
    return;
  }
  for (JsonValue member = object.first(); member.exists(); member = member.next()) {
    const std::string key = member.key();
    const auto known = std::ranges::find(kind.keys, key);
    if (known != kind.keys.end()) {
      values_[static_cast<std::size_t>(known - kind.keys.begin())] = member;
    } else if (!key.starts_with("x-") && std::ranges::find(more, key) == more.end()) {
      if (problems.full()) {
        problems.add(member.keyWhere(), {});  // counted only: no time for suggestions
        continue;
      }
      std::vector<std::string> names = strings(kind.keys);
      names.insert(names.end(), more.begin(), more.end());
      problems.add(member.keyWhere(), fmt::format("unknown key \"{}\" in {}", key, kind.what),
                   didYouMean(key, names, fmt::format("the keys are {}", listed(names))));
    }
  }
  for (std::size_t i = 0; i < kind.required; ++i) {
    if (values_[i].exists()) continue;
    complete_ = false;
    const std::size_t begin = object.where().begin;
    problems.add(SourceRange{begin, begin + 1}, fmt::format("{} needs \"{}\"", kind.what, kind.keys[i]),
                 std::string(kind.whenMissing));
  }
}

JsonValue SceneMembers::operator[](std::string_view name) const {
  const auto known = std::ranges::find(kind_.keys, name);
  LUXO_REQUIRE(known != kind_.keys.end());
  return values_[static_cast<std::size_t>(known - kind_.keys.begin())];
}

bool SceneValues::reject(const JsonValue& value, std::string_view expected, std::string hint) {
  problems_.add(value.where(), fmt::format("expected {}, found {}", expected, value.kindName()),
                std::move(hint));
  return false;
}

bool SceneValues::read(const JsonValue& value, Quantity& target) {
  if (!value.exists()) return true;
  if (value.kind() == JsonKind::Number) {
    target = Quantity(value.number(), placeOf(value.where()));
  } else if (value.kind() == JsonKind::String) {
    target = Quantity(value.string(), placeOf(value.where()));
  } else {
    return reject(value, "a number or a formula");
  }
  return true;
}

bool SceneValues::readArray(const JsonValue& value, std::span<Quantity> target) {
  if (!value.exists()) return true;
  if (value.kind() != JsonKind::Array)
    return reject(
        value, fmt::format("an array of {} numbers", target.size()),
        value.kind() == JsonKind::String ? arrayHint(value.string(), target.size()) : std::string());
  if (const std::size_t count = value.size(); count != target.size()) {
    problems_.add(value.where(), fmt::format("expected {} numbers, found {}", target.size(), count));
    return false;
  }
  bool good = true;
  std::size_t i = 0;
  for (JsonValue element = value.first(); element.exists(); element = element.next())
    good = read(element, target[i++]) && good;
  return good;
}

bool SceneValues::read(const JsonValue& value, bool& target) {
  if (!value.exists()) return true;
  if (!value.isBoolean()) return reject(value, "true or false");
  target = value.kind() == JsonKind::True;
  return true;
}

bool SceneValues::read(const JsonValue& value, std::string& target) {
  if (!value.exists()) return true;
  if (value.kind() != JsonKind::String) return reject(value, "a text");
  target = value.string();
  return true;
}

bool SceneValues::read(const JsonValue& value, FileName& target) {
  if (!value.exists()) return true;
  if (value.kind() != JsonKind::String) return reject(value, "a name");
  target = FileName(value.string(), placeOf(value.where()));
  if (!target.empty()) return true;
  problems_.add(value.where(), "a name is empty");
  return false;
}

bool SceneValues::readColor(const JsonValue& value, Quantity3& target) {
  if (!value.exists()) return true;
  const FilePlace place = placeOf(value.where());
  if (value.kind() == JsonKind::Array) return readArray(value, target);
  if (value.kind() == JsonKind::String && value.string().starts_with('#')) {
    const auto color = hexColor(value.string());
    if (!color) {
      problems_.add(value.where(), fmt::format("'{}' is not a colour", value.string()),
                    "write six hexadecimal digits: \"#8fb4d9\"");
      return false;
    }
    for (std::size_t i = 0; i < 3; ++i) target[i] = Quantity((*color)[i], place);
    return true;
  }
  if (value.kind() != JsonKind::Number && value.kind() != JsonKind::String)
    return reject(value, "a colour", R"(write [r, g, b], one number, or "#rrggbb")");
  Quantity gray;
  read(value, gray);
  target = repeated(gray);
  return true;
}

bool SceneValues::readColor(const JsonValue& value, Quantity3& target, Quantity& opacity) {
  constexpr std::size_t kWithOpacity = 9, kWithout = 7;
  if (value.kind() != JsonKind::String || !value.string().starts_with('#') ||
      value.string().size() != kWithOpacity)
    return readColor(value, target);
  const std::string text = value.string();
  const std::string_view all = text;
  const auto color = hexColor(all.substr(0, kWithout));
  const auto part = hexNumber(all.substr(kWithout));
  if (!color || !part) {
    problems_.add(value.where(), fmt::format("'{}' is not a colour", text),
                  "write eight hexadecimal digits, the last two for the opacity: \"#00000080\"");
    return false;
  }
  const FilePlace place = placeOf(value.where());
  for (std::size_t i = 0; i < 3; ++i) target[i] = Quantity((*color)[i], place);
  opacity = Quantity(*part / 255.0, place);
  return true;
}

bool SceneValues::read(const JsonValue& value, std::vector<LetDesc>& target) {
  if (!value.exists()) return true;
  if (value.kind() != JsonKind::Object) return reject(value, "an object of names and formulas");
  bool good = true;
  for (JsonValue member = value.first(); member.exists(); member = member.next()) {
    if (member.key().starts_with("x-")) continue;
    LetDesc& entry = target.emplace_back();
    entry.name = FileName(member.key(), placeOf(member.keyWhere()));
    good = read(member, entry.value) && good;
  }
  return good;
}

std::optional<std::size_t> SceneValues::wordIndex(const JsonValue& value,
                                                  std::span<const std::string_view> names) {
  if (!value.exists()) return std::nullopt;
  const std::vector<std::string> known = strings(names);
  if (value.kind() != JsonKind::String) {
    reject(value, "a word", fmt::format("one of {}", listed(known)));
    return std::nullopt;
  }
  const std::string word = value.string();
  const auto found = std::ranges::find(names, word);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  problems_.add(value.where(), fmt::format("unknown word '{}'", word),
                didYouMean(word, known, fmt::format("one of {}", listed(known))));
  return std::nullopt;
}

}  // namespace luxo
