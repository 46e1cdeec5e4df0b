// SPDX-License-Identifier: Apache-2.0
#include "scene/shader_text.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace luxo {
namespace {

using Tokens = std::span<const GlslToken>;

bool isPrecision(std::string_view word) { return word == "highp" || word == "mediump" || word == "lowp"; }

int turnOf(const GlslToken& token) {
  constexpr std::string_view kOpen = "([{", kClose = ")]}";
  if (token.text.size() != 1) return 0;
  return kOpen.find(token.text) != kOpen.npos ? 1 : kClose.find(token.text) != kClose.npos ? -1 : 0;
}

bool isAt(Tokens tokens, std::size_t at, std::string_view text) {
  return at < tokens.size() && tokens[at].text == text;
}

/// Behind what is in brackets, one pair after the other, where they begin at `at`.
std::size_t behindBrackets(Tokens tokens, std::size_t at, std::string_view open) {
  while (isAt(tokens, at, open)) {
    int depth = 0;
    do depth += turnOf(tokens[at++]);
    while (depth > 0 && at < tokens.size());
  }
  return at;
}

/// Where one name of a declaration ends with what is said of it: at a comma or semicolon of its own.
std::size_t endOfDeclarator(Tokens tokens, std::size_t at) {
  for (int depth = 0; at < tokens.size(); ++at) {
    if (depth == 0 && (tokens[at].text == "," || tokens[at].text == ";")) break;
    depth += turnOf(tokens[at]);
    if (depth < 0) break;
  }
  return at;
}

/// Of `TYPE a, b[2] = .., c;` the type, where there is one, and its names go to `take`. Gives how long it is.
template <class Take>
std::size_t takeDeclared(Tokens tokens, const Take& take) {
  std::size_t type = 0;
  if (isAt(tokens, type, "layout")) type = behindBrackets(tokens, type + 1, "(");
  if (type < tokens.size() && isPrecision(tokens[type].text)) ++type;
  std::size_t at = behindBrackets(tokens, type + 1, "[");
  while (at < tokens.size() && tokens[at].isWord()) {
    take(tokens[type], tokens[at]);
    at = endOfDeclarator(tokens, at);
    if (!isAt(tokens, at, ",")) break;
    ++at;
  }
  return std::min(at, tokens.size());
}

/// What is behind each `keyword`, on its line if that is a directive's, and in no parentheses.
template <class Take>
void forEachDeclared(Tokens tokens, std::string_view keyword, const Take& take) {
  int parentheses = 0;
  for (std::size_t i = 0, end = 0; i < tokens.size();) {
    if (i >= end) {
      parentheses = 0;
      end = i;
      while (end < tokens.size() && tokens[end].directive == tokens[i].directive) ++end;
    }
    const std::string_view text = tokens[i++].text;
    if (text == "(") ++parentheses;
    if (text == ")" && parentheses > 0) --parentheses;  // of a call that a directive stands in
    if (text == keyword && parentheses == 0) i += takeDeclared(tokens.subspan(i, end - i), take);
  }
}

}  // namespace

std::string withoutComments(std::string_view glsl) {
  std::string text(glsl.size(), ' ');
  for (std::size_t at = glsl.find('\n'); at != glsl.npos; at = glsl.find('\n', at + 1)) text[at] = '\n';
  for (const GlslToken& token : glslTokens(glsl)) text.replace(token.begin, token.text.size(), token.text);
  return text;
}

std::vector<GlslToken> outsideOfFunctions(std::string_view glsl) {
  std::vector<GlslToken> outside = glslTokens(glsl);
  int depth = 0;
  std::erase_if(outside, [&](const GlslToken& token) {
    depth -= token.text == "}" ? 1 : 0;
    const bool isInside = depth > 0;
    depth += token.text == "{" ? 1 : 0;
    return isInside;
  });
  return outside;
}

std::optional<SourceRange> placeOf(std::string_view word, std::string_view glsl) {
  for (const GlslToken& token : glslTokens(glsl))
    if (token.isWord() && token.text == word) return SourceRange{token.begin, token.end()};
  return std::nullopt;
}

std::optional<SourceRange> placeOfFunction(std::string_view type, std::string_view name,
                                           std::string_view glsl) {
  const std::vector<GlslToken> tokens = glslTokens(glsl);
  for (std::size_t i = 1; i + 1 < tokens.size(); ++i)
    if (tokens[i - 1].text == type && tokens[i].text == name && tokens[i + 1].text == "(")
      return SourceRange{tokens[i].begin, tokens[i].end()};
  return std::nullopt;
}

std::optional<SourceRange> placeOfList(std::size_t elements, std::string_view glsl) {
  struct List {
    SourceRange where;
    std::size_t commas = 0;
  };
  std::vector<List> open;
  for (const GlslToken& token : glslTokens(glsl)) {
    if (turnOf(token) > 0) open.push_back({{token.begin, token.end()}});
    if (open.empty()) continue;
    if (turnOf(token) < 0) open.pop_back();
    if (token.text == "," && ++open.back().commas == elements) return open.back().where;
  }
  return std::nullopt;
}

std::vector<std::string> constantsOf(std::span<const GlslToken> tokens) {
  std::vector<std::string> names;
  forEachDeclared(tokens, "const",
                  [&](const GlslToken&, const GlslToken& name) { names.emplace_back(name.text); });
  return names;
}

TextByName typesOfUniforms(std::string_view glsl) {
  TextByName types;
  const std::vector<GlslToken> tokens = glslTokens(glsl);
  forEachDeclared(tokens, "uniform",
                  [&](const GlslToken& type, const GlslToken& name) { types.emplace(name.text, type.text); });
  return types;
}

TextByName initialisersIn(std::string_view glsl) {
  TextByName initialisers;
  const std::vector<GlslToken> all = outsideOfFunctions(glsl);
  const Tokens tokens = all;
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    if (!tokens[i].isWord()) continue;
    const std::size_t equals = behindBrackets(tokens, i + 1, "[");
    if (!isAt(tokens, equals, "=")) continue;
    std::string text;
    const std::size_t end = endOfDeclarator(tokens, equals + 1);
    for (const GlslToken& token : tokens.subspan(equals + 1, end - equals - 1))
      text.append(token.afterBlank && !text.empty() ? " " : "").append(token.text);
    initialisers.emplace(tokens[i].text, std::move(text));
    i = end;
  }
  return initialisers;
}

}  // namespace luxo
