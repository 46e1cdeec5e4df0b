// SPDX-License-Identifier: Apache-2.0
#include "shader_controls.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <map>
#include <string_view>

#include "base/diagnostic.h"
#include "base/error.h"
#include "base/suggestion.h"
#include "draw/course_style.h"
#include "option_values.h"
#include "scene/shader_text.h"

namespace luxo {
namespace {

using Kind = UniformControl::Kind;

constexpr std::string_view kBlank = " \t\r";
constexpr double kMaxSliderSteps = 1e6;
// What parameters are: numbers of scenes; and of these the whole numbers that floats count to.
constexpr double kMaxFloatNumber = 1e18, kMaxWholeNumber = 16777216;

bool isWordLetter(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(kBlank);
  if (begin == text.npos) return text.substr(text.size());  // where it ends
  return text.substr(begin, text.find_last_not_of(kBlank) - begin + 1);
}

/// Takes the word that the text begins with, after blanks.
std::string_view takeWord(std::string_view& text) {
  text.remove_prefix(std::min(text.find_first_not_of(kBlank), text.size()));
  const auto end = std::ranges::find_if_not(text, isWordLetter);
  const std::string_view word = text.substr(0, static_cast<std::size_t>(end - text.begin()));
  text.remove_prefix(word.size());
  return word;
}

/// At commas that are in no brackets.
std::vector<std::string_view> splitAtCommas(std::string_view text) {
  std::vector<std::string_view> parts;
  int depth = 0;
  std::size_t begin = 0;
  for (std::size_t i = 0; i <= text.size(); ++i) {
    const char c = i < text.size() ? text[i] : ',';
    depth += (c == '(' || c == '[') - (c == ')' || c == ']');
    if (i < text.size() && (c != ',' || depth != 0)) continue;
    parts.push_back(text.substr(begin, i - begin));
    begin = i + 1;
  }
  return parts;
}

/// A word behind an @, and what follows it.
struct Tag {
  std::string_view word, rest;
};

/// A uniform as one line of a file declares it.
struct Declaration {
  const MaterialShader::File* file = nullptr;
  std::string_view initialiser = {};  ///< without the =; empty: none
  std::optional<Tag> tag = {};

  [[nodiscard]] SourceRange whereIs(std::string_view part) const {
    const auto begin = static_cast<std::size_t>(part.data() - file->text.data());
    return {begin, begin + part.size()};
  }
  [[nodiscard]] std::string told(std::string_view part, const std::string& message,
                                 const std::string& hint) const {
    return describe(file->name, file->text, {whereIs(part), message, hint});
  }
  [[noreturn]] void refuse(std::string_view part, const std::string& message, const std::string& hint) const {
    throw Error(ErrorKind::Scene, told(part, message, hint));
  }
};
using Declarations = std::map<std::string, Declaration, std::less<>>;

std::optional<Tag> tagIn(std::string_view comment) {
  const std::size_t at = comment.find('@');
  if (at == comment.npos) return std::nullopt;
  std::string_view rest = comment.substr(at + 1);
  const std::string_view word =
      rest.empty() || !isWordLetter(rest.front()) ? rest.substr(0, 0) : takeWord(rest);
  return word.empty() ? std::nullopt : std::optional(Tag{word, trimmed(rest)});
}

/// Of `uniform TYPE NAME = INITIALISER, ...`, without its first word.
void addDeclared(std::string_view statement, Declaration declaration, Declarations& all) {
  constexpr std::array<std::string_view, 3> kPrecisions = {"highp", "mediump", "lowp"};
  std::string_view type = takeWord(statement);
  if (std::ranges::find(kPrecisions, type) != kPrecisions.end()) type = takeWord(statement);
  for (std::string_view declarator : splitAtCommas(statement)) {
    const std::string_view name = takeWord(declarator);
    const std::size_t equals = declarator.find('=');
    declaration.initialiser =
        equals == declarator.npos ? std::string_view() : trimmed(declarator.substr(equals + 1));
    if (name.empty()) continue;
    // Two programs may declare it: what one of them says holds.
    const auto [known, isNew] = all.try_emplace(std::string(name), declaration);
    if (!isNew && known->second.initialiser.empty()) known->second = declaration;
  }
}

/// `line` is a part of the file's text, and `code` the same part without comments.
void addDeclared(const MaterialShader::File& file, std::string_view line, std::string_view code,
                 Declarations& all) {
  constexpr std::string_view kUniform = "uniform";
  for (std::size_t at = code.find(kUniform), end = 0; at != code.npos; at = code.find(kUniform, end)) {
    const std::size_t begin = at + kUniform.size();
    const bool isWord = (at == 0 || !isWordLetter(code[at - 1])) && begin < code.size() &&
                        kBlank.find(code[begin]) != kBlank.npos;
    end = isWord ? code.find(';', begin) : begin;
    if (end == code.npos) return;
    if (!isWord) continue;
    const std::size_t comment = line.find("//", code.find_last_of(';'));
    addDeclared(line.substr(begin, end - begin),
                {.file = &file, .tag = comment == line.npos ? std::nullopt : tagIn(line.substr(comment))},
                all);
  }
}

Declarations declarationsOf(const MaterialShader& shader) {
  Declarations all;
  for (const MaterialShader::File& file : shader.files) {
    const std::string code = withoutComments(file.text);
    for (std::size_t begin = 0; begin < code.size();) {
      const std::size_t end = std::min(code.find('\n', begin), code.size());
      addDeclared(file, std::string_view(file.text).substr(begin, end - begin),
                  std::string_view(code).substr(begin, end - begin), all);
      begin = end + 1;
    }
  }
  return all;
}

/// A literal of GLSL.
std::optional<double> literal(std::string_view text) {
  if (text == "true") return 1;
  if (text == "false") return 0;
  while (!text.empty() && std::string_view("fFuU").find(text.back()) != std::string_view::npos &&
         text.find("0x") == text.npos)
    text.remove_suffix(1);
  text = trimmed(text);
  if (text.starts_with('+')) text.remove_prefix(1);
  return finiteNumber(text);
}

/// So many numbers; none where the text is something else than literals.
std::vector<double> numbersIn(std::string_view initialiser, const std::string& type, std::size_t count) {
  std::string_view inside = initialiser;
  if (inside.ends_with(')') && takeWord(inside) == type && trimmed(inside).starts_with('(')) {
    inside = trimmed(inside);
    inside = inside.substr(1, inside.size() - 2);
  } else {
    inside = initialiser;
    if (count > 1) return {};
  }
  std::vector<double> numbers;
  for (const std::string_view part : splitAtCommas(inside)) {
    const std::optional<double> number = literal(trimmed(part));
    if (!number) return {};
    numbers.push_back(*number);
  }
  if (numbers.size() == 1) numbers.resize(count, numbers.front());
  return numbers.size() == count ? numbers : std::vector<double>{};
}

/// How many numbers a type has, and what they are: 'f', 'i', 'u', 'b' of float, int, uint, bool.
struct TypeShape {
  std::size_t rows = 1, columns = 1;
  char scalar = 'f';
};

TypeShape shapeOf(const std::string& type) {
  if (type.starts_with("mat")) {
    const auto columns = static_cast<std::size_t>(type[3] - '0');
    return {type.size() > 5 ? static_cast<std::size_t>(type[5] - '0') : columns, columns, 'f'};
  }
  const std::size_t vec = type.find("vec");
  if (vec == type.npos) return {.scalar = type.front()};
  return {static_cast<std::size_t>(type.back() - '0'), 1, vec == 0 ? 'f' : type.front()};
}

void readSlider(const Declaration& from, const TypeShape& shape, UniformControl& control) {
  const Tag& tag = *from.tag;
  const std::string hint = "as in // @slider 0.1 2.2, or // @slider 0.1 2.2 10 for ten steps";
  if (shape.columns > 1 || shape.scalar == 'b')
    from.refuse(tag.word, fmt::format("'{}' is of type {}, which has no slider", control.name, control.type),
                "sliders are of float, int, uint and their vectors");
  std::vector<double> numbers;
  for (std::string_view rest = tag.rest; !rest.empty(); rest = trimmed(rest)) {
    const std::string_view part = rest.substr(0, rest.find_first_of(" \t,"));
    const std::optional<double> number = finiteNumber(part);
    if (!number) from.refuse(part, fmt::format("'{}' is no number", part), hint);
    numbers.push_back(*number);
    rest.remove_prefix(std::min(part.size() + 1, rest.size()));
  }
  if (numbers.size() != 2 && numbers.size() != 3)
    from.refuse(tag.word, fmt::format("a slider has 2 or 3 numbers, not {}", numbers.size()), hint);
  if (!(numbers[0] < numbers[1]))
    from.refuse(tag.rest, fmt::format("the slider from {} to {} is empty", numbers[0], numbers[1]),
                "write the smaller number first");
  control.kind = Kind::Slider;
  control.range = Interval{numbers[0], numbers[1]};
  if (shape.scalar != 'f') control.step = 1;
  if (numbers.size() < 3) return;
  if (numbers[2] != std::floor(numbers[2]) || numbers[2] < 1 || numbers[2] > kMaxSliderSteps)
    from.refuse(tag.rest, fmt::format("{} is no number of steps", numbers[2]), hint);
  control.step = (numbers[1] - numbers[0]) / numbers[2];
  if (shape.scalar != 'f' && *control.step != std::floor(*control.step))
    from.refuse(tag.rest, fmt::format("steps of {} lead between whole numbers", *control.step),
                fmt::format("'{}' is of type {}; leave out the third number", control.name, control.type));
}

void readColor(const Declaration& from, UniformControl& control) {
  if (control.type != "vec3")
    from.refuse(from.tag->word,
                fmt::format("'{}' is of type {}, and a colour of vec3", control.name, control.type), {});
  control.kind = Kind::Color;
}

void readSelect(const Declaration& from, UniformControl& control) {
  const std::string hint = "as in // @select plain|brushed|knurled";
  if (control.type != "int" && control.type != "uint")
    from.refuse(from.tag->word,
                fmt::format("'{}' is of type {}, and a choice of int or uint", control.name, control.type),
                "its value is the choice's number, from 0");
  for (std::string_view rest = from.tag->rest;;) {
    const std::size_t bar = rest.find('|');
    const std::string choice(trimmed(rest.substr(0, bar)));
    if (choice.empty()) from.refuse(from.tag->rest, "a choice has no name", hint);
    if (std::ranges::find(control.choices, choice) != control.choices.end())
      from.refuse(from.tag->rest, fmt::format("there are two choices '{}'", choice), hint);
    control.choices.push_back(choice);
    if (bar == rest.npos) break;
    rest.remove_prefix(bar + 1);
  }
  if (control.choices.size() < 2) from.refuse(from.tag->rest, "there is one choice only", hint);
  control.kind = Kind::Choice;
  control.range = Interval{0, static_cast<double>(control.choices.size() - 1)};
  control.step = 1;
}

void readTag(const Declaration& from, const TypeShape& shape, UniformControl& control,
             std::vector<std::string>* warnings) {
  static const std::vector<std::string> kTags = {"slider", "color", "select"};
  const std::string word(from.tag->word);
  const auto known = std::ranges::find(kTags, word);
  if (known == kTags.end()) {
    if (warnings)
      warnings->push_back(from.told(from.tag->word, fmt::format("'@{}' is not known", word),
                                    didYouMean(word, kTags, fmt::format("there are {}", listed(kTags)))));
    return;
  }
  if (control.kind == Kind::None && !control.initial.empty())
    from.refuse(from.tag->word,
                fmt::format("'{}' is an array or a matrix, which people do not turn", control.name),
                "leave the comment out");
  if (word == "slider") readSlider(from, shape, control);
  if (word == "color") readColor(from, control);
  if (word == "select") readSelect(from, control);
  if (control.initial.empty())
    from.refuse(from.initialiser.empty() ? from.tag->word : from.initialiser,
                fmt::format("the initial value of '{}' is not made of numbers alone", control.name),
                "what is turned begins at numbers, as in 0.5 or vec3(0.5, 0.4, 0.1)");
  if (from.initialiser.empty() && control.range) std::ranges::fill(control.initial, control.range->lo);
  for (const double number : control.initial)
    if (control.range && !control.range->contains(number))
      from.refuse(
          from.initialiser,
          fmt::format("the initial value {} is not in {}..{}", number, control.range->lo, control.range->hi),
          "let it be in what the comment allows");
}

}  // namespace

std::vector<UniformControl> uniformControls(const MaterialShader& shader,
                                            std::span<const gpu::ShaderVariable> uniforms,
                                            std::vector<std::string>* warnings) {
  const Declarations declarations = declarationsOf(shader);
  const bool isProgram = inCourseStyle(shader);
  std::vector<UniformControl> controls;
  for (const gpu::ShaderVariable& uniform : uniforms) {
    const TypeShape shape = shapeOf(uniform.type);
    UniformControl& control =
        controls.emplace_back(UniformControl{.name = uniform.name,
                                             .type = uniform.type,
                                             .active = uniform.active,
                                             .numbers = shape.rows * shape.columns * uniform.elements()});
    const auto declared = declarations.find(uniform.name);
    if (declared == declarations.end()) continue;
    const Declaration& from = declared->second;
    if (uniform.type.starts_with("sampler") && !isProgram) continue;  // textures have names of a scene's
    if (uniform.type.starts_with("sampler")) {
      control.kind = Kind::Choice;
      control.initial = {0};
      control.choices = {"map", "specular_map", "glow_map"};
      control.range = Interval{0, 2};
      control.step = 1;
      continue;
    }
    const auto isParameter = [&](double number) {
      return std::abs(number) <= (shape.scalar == 'f' ? kMaxFloatNumber : kMaxWholeNumber);
    };
    const bool isTurned = shape.columns == 1 && uniform.array.empty();
    control.initial = from.initialiser.empty() ? std::vector<double>(shape.rows, 0.0)
                                               : numbersIn(from.initialiser, uniform.type, shape.rows);
    if (!from.tag && !std::ranges::all_of(control.initial, isParameter)) control.initial.clear();
    if (isTurned && !control.initial.empty()) {
      control.kind = shape.scalar == 'b' ? Kind::Switch : Kind::Plain;
      if (shape.scalar == 'b') control.range = Interval{0, 1};
      if (shape.scalar != 'f') control.step = 1;
    } else if (!isTurned) {
      control.initial = {0};
    }
    if (from.tag) readTag(from, shape, control, warnings);
    if (control.kind == Kind::None) control.initial.clear();
  }
  return controls;
}

}  // namespace luxo
