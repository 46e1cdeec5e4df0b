// SPDX-License-Identifier: Apache-2.0
#include "draw/material_errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/diagnostic.h"
#include "base/error.h"
#include "base/glsl_tokens.h"
#include "draw/course_style.h"
#include "scene/shader_text.h"

namespace luxo {
namespace {

constexpr const char* kEntryHint =
    "write one: it gives the colour and the opacity of the point p (shaders/MATERIALS.md)";

[[noreturn]] void refuseAt(const MaterialShader::File& file, SourceRange where, const std::string& why,
                           const std::string& advice) {
  throw Error(ErrorKind::Scene, describe(file.name, file.text, {where, why, advice}));
}

/// Of the innermost one that is left open.
std::optional<SourceRange> unclosedBrace(std::string_view glsl) {
  std::vector<SourceRange> open;
  for (const GlslToken& token : glslTokens(glsl)) {
    if (token.text == "{") open.push_back({token.begin, token.end()});
    if (token.text == "}" && !open.empty()) open.pop_back();
  }
  return open.empty() ? std::nullopt : std::optional(open.back());
}

/// Of the innermost #if, #ifdef or #ifndef that is left open.
std::optional<SourceRange> unclosedCondition(std::string_view glsl) {
  std::vector<SourceRange> open;
  const std::vector<GlslToken> tokens = glslTokens(glsl);
  for (std::size_t i = 0, last = 0; i < tokens.size(); ++i) {
    if (tokens[i].directive == std::exchange(last, tokens[i].directive) || tokens[i].directive == 0) continue;
    const GlslDirective directive = directiveAt(std::span(tokens).subspan(i));
    if (directive.name.starts_with("if")) open.push_back({tokens[i].begin, tokens[i + 1].end()});
    if (directive.name == "endif" && !open.empty()) open.pop_back();
  }
  return open.empty() ? std::nullopt : std::optional(open.back());
}

/// A line of a file that includes another one, told by its number in the shader.
struct Inclusion {
  std::size_t file;
  SourceRange where;
};

/// Files are told apart by their last names.
std::vector<Inclusion> inclusionsIn(const MaterialShader& shader, const MaterialShader::File& by) {
  std::vector<Inclusion> all;
  const std::vector<GlslToken> tokens = glslTokens(by.text);
  for (const GlslDirective& directive : directivesIn(tokens)) {
    if (directive.name != "include" || directive.rest.empty()) continue;
    const GlslToken& quoted = directive.rest.front();
    if (quoted.kind != GlslToken::Kind::Quoted) continue;
    const auto last = std::filesystem::path(quoted.text.substr(1, quoted.text.size() - 2)).filename();
    for (std::size_t i = 0; i < shader.files.size(); ++i)
      if (std::filesystem::path(shader.files[i].name).filename() == last)
        all.push_back({i, {quoted.begin, quoted.end()}});
  }
  return all;
}

/// Error(Scene) where a file includes itself, by way of others or not.
void refuseCycle(const MaterialShader& shader) {
  std::vector<std::vector<Inclusion>> inclusions;
  for (const MaterialShader::File& file : shader.files) inclusions.push_back(inclusionsIn(shader, file));
  for (std::size_t file = 0; file < inclusions.size(); ++file)
    for (const Inclusion& next : inclusions[file]) {
      std::vector<std::size_t> reached{next.file};
      for (std::size_t i = 0; i < reached.size(); ++i) {
        const std::string& name = shader.files[file].name;
        if (reached[i] == file)
          refuseAt(
              shader.files[file], next.where,
              fmt::format(
                  "'{}' includes itself{}", name,
                  next.file == file ? "" : fmt::format(", by way of '{}'", shader.files[next.file].name)),
              "leave it out, or put #ifndef, #define and #endif around what it has");
        for (const Inclusion& one : inclusions[reached[i]])
          if (std::ranges::find(reached, one.file) == reached.end()) reached.push_back(one.file);
      }
    }
}

/// Error(Scene) where the first function that is called so is.
void refuseRecursion(const MaterialShader& shader, const std::string& name) {
  for (const MaterialShader::File& one : shader.files) {
    const std::vector<GlslToken> tokens = glslTokens(one.text);
    const auto found = std::ranges::adjacent_find(tokens, [&](const GlslToken& word, const GlslToken& open) {
      return word.text == name && open.text == "(";
    });
    if (found != tokens.end())
      refuseAt(one, {found->begin, found->end()},
               fmt::format("the function '{}' calls itself, or one that calls it", name),
               "functions of GLSL cannot: repeat with a loop");
  }
}

}  // namespace

void explainRefusal(const MaterialShader& shader, const std::string& entry, bool course,
                    std::string_view said) {
  const std::string& file = shader.files.front().name;
  if (said.find("No function definition") != said.npos && said.find("material(struct-Point") != said.npos)
    throw Error(ErrorKind::Scene, fmt::format("{}: there is no function 'vec4 material(Point p)'", file),
                kEntryHint);
  if (said.find("'main' : function already has a body") != said.npos)
    for (const MaterialShader::File& one : shader.files)
      if (const auto place = placeOfFunction("void", "main", one.text))
        refuseAt(one, *place,
                 "'main' is of a program that has inputs and outputs of its own, which a material is not",
                 "write vec4 material(Point p) { return vec4(1.0, 0.0, 0.0, 1.0); }, which is given the "
                 "point, or a program in the course's style, with gl_FragColor (both: shaders/MATERIALS.md)");
  if (course && said.find("\nlib/course_alone.glsl:") != said.npos)
    throw Error(ErrorKind::Scene, fmt::format("{}: there is no function 'void main()'", entry),
                "a program begins there");
  if (const std::size_t calls = said.find("Recursion detected"); calls != said.npos) {
    const std::size_t begin = std::min(said.find_first_not_of(" \n", said.find('\n', calls)), said.size());
    refuseRecursion(shader, asProgramsSpell(asFilesSpell(said.substr(begin, said.find('(', begin) - begin))));
  }
  if (said.find("Could not process include directive") != said.npos) refuseCycle(shader);
  refuseUnclosed(shader, said);
  // Line by line what is about the first of its own files that has errors, from where one begins to where the
  // next message does: those of files that include it follow from them.
  std::string message, first;
  bool isOwn = false;
  for (std::size_t at = said.find('\n'); at != said.npos;) {
    const std::size_t end = said.find('\n', ++at);
    const std::string_view line = said.substr(at, end == said.npos ? said.npos : end - at);
    if (!line.starts_with(' ')) {
      const auto own = std::ranges::find_if(
          shader.files, [&](const auto& one) { return line.starts_with(one.name + ":"); });
      isOwn = own != shader.files.end() && (first.empty() || first == own->name);
      if (isOwn) first = own->name;
    }
    if (isOwn) message += fmt::format("{}{}", message.empty() ? "" : "\n", line);
    at = end;
  }
  throw Error(ErrorKind::Scene, message.empty() ? fmt::format("{}: {}", file, said) : message);
}

void refuseUnclosed(const MaterialShader& shader, std::string_view said) {
  if (said.find("#endif") != said.npos)
    for (const MaterialShader::File& one : shader.files)
      if (const auto condition = unclosedCondition(one.text))
        refuseAt(one, *condition, "this condition has no '#endif'",
                 "what follows is there only where it is true");
  if (said.find("syntax error") != said.npos || said.find("not allowed in nested scope") != said.npos)
    for (const MaterialShader::File& one : shader.files)
      if (const auto brace = unclosedBrace(one.text))
        refuseAt(one, *brace, "this '{' has no '}'", "what follows is taken for a part of what it begins");
}

// What the language has is in a block without a name.
std::string asProgramsSpell(std::string_view message) {
  constexpr std::string_view kNameless = " in structure 'anon@0'";
  std::string spelled = withoutCourseSpelling(message);
  if (const std::size_t at = spelled.find(kNameless); at != spelled.npos) spelled.erase(at, kNameless.size());
  return spelled;
}

std::string asFilesSpell(std::string_view message) {
  std::string spelled(message);
  for (std::size_t at = spelled.find(kWrappedName); at != spelled.npos; at = spelled.find(kWrappedName, at))
    spelled.erase(at, kWrappedName.size());
  return spelled;
}

}  // namespace luxo
