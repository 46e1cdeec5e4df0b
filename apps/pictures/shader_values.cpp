// SPDX-License-Identifier: Apache-2.0
#include "shader_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

#include "base/error.h"
#include "base/srgb_curve.h"
#include "base/suggestion.h"
#include "option_values.h"

namespace luxo {
namespace {

using Kind = UniformControl::Kind;

[[noreturn]] void refuse(const UniformControl& uniform, const std::string& text, const std::string& why,
                         const std::string& hint) {
  throw Error(ErrorKind::Usage, fmt::format("'{}={}': {}", uniform.name, text, why), hint);
}

std::vector<std::string> colorTexts(const UniformControl& uniform, const std::string& text, bool encoded) {
  std::vector<std::string> texts;
  const bool isShort = text.size() == 4;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string_view digits =
        std::string_view(text).substr(isShort ? 1 + i : 1 + 2 * i, isShort ? 1 : 2);
    std::uint8_t code = 0;
    const auto [end, failure] = std::from_chars(digits.data(), digits.data() + digits.size(), code, 16);
    if (failure != std::errc() || end != digits.data() + digits.size())
      refuse(uniform, text, "no colour", "write six hexadecimal digits: #8fb4d9");
    const double value = (isShort ? 17 * code : code) / 255.0;
    texts.push_back(fmt::format("{}", encoded ? value : linearFromSrgb(value)));
  }
  return texts;
}

/// At commas that are in no brackets: formulas have some.
std::vector<std::string> splitAtCommas(const std::string& text) {
  std::vector<std::string> parts(1);
  int depth = 0;
  for (const char c : text) {
    depth += (c == '(') - (c == ')');
    if (c == ',' && depth == 0)
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

constexpr double kMaxQuantity = 1e18;  // as of all that scenes say

/// Where the text is a number it is one of that type.
void requireType(const UniformControl& uniform, const std::string& text, const std::string& part) {
  const std::optional<double> number = finiteNumber(part);
  if (!number) return;
  if (std::abs(*number) > kMaxQuantity)
    refuse(uniform, text, fmt::format("numbers are from -{0:g} to {0:g}", kMaxQuantity), {});
  const bool isWhole = *number == std::floor(*number);
  if (uniform.type.starts_with('b') && *number != 0 && *number != 1)
    refuse(uniform, text, fmt::format("it is of type {}", uniform.type), "give true or false");
  if (uniform.type.starts_with('i') && !isWhole)
    refuse(uniform, text, fmt::format("it is of type {}", uniform.type), "give a whole number");
  if (uniform.type.starts_with('u') && (!isWhole || *number < 0))
    refuse(uniform, text, fmt::format("it is of type {}", uniform.type), "give a whole number from 0");
}

}  // namespace

std::vector<std::string> componentTexts(const UniformControl& uniform, const std::string& text,
                                        bool encoded) {
  if (text.starts_with('#') && uniform.type == "vec3" && (text.size() == 7 || text.size() == 4))
    return colorTexts(uniform, text, encoded);
  if (uniform.kind == Kind::Choice) {
    const auto choice = std::ranges::find(uniform.choices, text);
    if (choice != uniform.choices.end()) return {fmt::format("{}", choice - uniform.choices.begin())};
    const std::optional<double> number = finiteNumber(text);
    if (!number || !uniform.range->contains(*number) || *number != std::floor(*number))
      refuse(uniform, text, "there is no such choice",
             didYouMean(text, uniform.choices, fmt::format("there are {}", listed(uniform.choices))));
  }
  std::vector<std::string> parts = splitAtCommas(text);
  if (parts.size() != uniform.numbers)
    refuse(uniform, text,
           fmt::format("it is of type {}: {} number{}, not {}", uniform.type, uniform.numbers,
                       uniform.numbers == 1 ? "" : "s", parts.size()),
           uniform.numbers == 1 ? "" : "separate them by commas: 1,0.5,0");
  for (std::string& part : parts) {
    if (part.empty()) refuse(uniform, text, "a number is missing", {});
    if (uniform.type.starts_with('b') && (part == "true" || part == "false"))
      part = part == "true" ? "1" : "0";
    requireType(uniform, text, part);
  }
  return parts;
}

std::vector<std::string> componentTexts(const ParameterControl& control, const std::string& text) {
  using Turned = ParameterControl::Kind;
  UniformControl uniform{.name = control.label, .type = "float", .kind = UniformControl::Kind::Plain};
  if (control.kind == Turned::Color) uniform.type = "vec3";
  if (control.kind == Turned::Switch) uniform.type = "bool";
  if (control.kind == Turned::Choice) uniform.kind = UniformControl::Kind::Choice;
  uniform.range = control.range;
  uniform.choices = control.choices;
  uniform.numbers = control.parameters.size();
  return componentTexts(uniform, text, control.encoded);
}

std::string componentSuffix(const UniformControl& uniform, std::size_t component) {
  if (uniform.numbers == 1) return {};
  const std::string_view letters = uniform.kind == Kind::Color ? "rgba" : "xyzw";
  const bool isVector = uniform.kind != Kind::None && uniform.numbers <= letters.size();
  return isVector ? fmt::format("_{}", letters[component]) : fmt::format("_{}", component);
}

}  // namespace luxo
