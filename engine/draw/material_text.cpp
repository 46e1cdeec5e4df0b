// SPDX-License-Identifier: Apache-2.0
#include "draw/material_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "base/diagnostic.h"
#include "base/error.h"
#include "base/glsl_tokens.h"
#include "base/suggestion.h"
#include "draw/bounded_loops.h"

namespace luxo {
namespace {

[[noreturn]] void refuseToken(const MaterialShader::File& file, const GlslToken& token,
                              const std::string& why, const std::string& advice) {
  throw Error(ErrorKind::Scene, describe(file.name, file.text, {{token.begin, token.end()}, why, advice}));
}

/// Of those that may be asked for: what they added has long been in the language, or is luxo's own way to
/// include.
bool isPlainExtension(std::string_view name) {
  constexpr std::array<std::string_view, 3> kPlain = {
      "GL_GOOGLE_include_directive", "GL_OES_standard_derivatives", "GL_ARB_shading_language_420pack"};
  return std::ranges::find(kPlain, name) != kPlain.end();
}

/// Behind the parentheses that begin at `at`; where none do, `at`.
std::size_t behindParentheses(std::span<const GlslToken> tokens, std::size_t at) {
  if (at >= tokens.size() || tokens[at].text != "(") return at;
  while (at < tokens.size() && tokens[at].text != ")") ++at;
  return std::min(at + 1, tokens.size());
}

}  // namespace

bool isGivenToMaterials(std::string_view name) {
  static constexpr std::string_view kGiven[] = {
      "material",    "lightCount",   "light",   "ambientLight",    "blinnPhong",
      "colorMap",    "specularMap",  "glowMap", "Point",           "Light",
      "luxoStops",   "luxoRounds",   "Hit",     "trace",           "worldVector",
      "worldNormal", "objectVector", "texture", "luxoPictureSize", "textureGrad"};
  return std::ranges::find(kGiven, name) != std::end(kGiven);
}

bool isFieldOfMaterials(std::string_view name) {
  constexpr std::string_view kFields[] = {
      "position", "object",    "normal",    "viewer",   "tangent",  "bitangent", "Su",     "Sv",
      "uv",       "footprint", "direction", "distance", "radiance", "visible",   "length", "found",
      "inside",   "color",     "number",    "K",        "H",        "k1",        "k2"};
  const auto isOf = [&](std::string_view letters) {
    return name.size() <= 4 && name.find_first_not_of(letters) == name.npos;
  };
  return std::ranges::find(kFields, name) != std::end(kFields) || isOf("xyzw") || isOf("rgba") ||
         isOf("stpq");
}

std::string joinable(std::string_view glsl) {
  std::string text(glsl);
  const std::vector<GlslToken> tokens = glslTokens(glsl);
  const auto isAt = [&](std::size_t i, std::string_view word) {
    return i < tokens.size() && tokens[i].text == word;
  };
  const auto blank = [&](std::size_t from, std::size_t end) {
    for (std::size_t i = tokens[from].begin; i < tokens[end - 1].end(); ++i)
      if (text[i] != '\n') text[i] = ' ';
  };
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    const std::size_t first = i;
    if (isAt(i, "uniform") && isAt(i + 1, "layout")) {
      i = behindParentheses(tokens, i + 2);
      blank(first + 1, i--);
    }
    while (isAt(i, "layout") && isAt(i + 1, "(")) i = behindParentheses(tokens, i + 1);
    if (isAt(first, "layout") && isAt(i, "uniform")) blank(first, i);
  }
  return withBoundedLoops(text);
}

void refuseDirectives(const MaterialShader::File& file) {
  const std::vector<GlslToken> tokens = glslTokens(file.text);
  for (const GlslDirective& directive : directivesIn(tokens)) {
    if (directive.rest.empty()) continue;
    const GlslToken& first = directive.rest.front();
    const std::string_view name = first.text;
    if ((directive.name == "define" || directive.name == "undef") &&
        (isGivenToMaterials(name) || name == "uniform" || name == "sampler2D" || name.starts_with("luxo") ||
         name.starts_with("LUXO")))
      refuseToken(file, first, fmt::format("'{}' is a name of luxo's own, which no macro has", name),
                  "choose another one");
    if (directive.name == "extension" && !isPlainExtension(name) && directive.rest.back().text != "disable")
      refuseToken(file, first,
                  name == "all" ? "'#extension all' asks for what only some devices have"
                                : fmt::format("'#extension {}': only some devices have it", name),
                  "write plain GLSL: leave the line out, and what needs it");
    if (directive.name != "pragma" || name != "luxo" || directive.rest.size() < 2) continue;
    const GlslToken& asked = directive.rest[1];
    const std::vector<std::string> known = {"opacity", "course"};
    if (std::ranges::find(known, asked.text) == known.end())
      refuseToken(file, asked, fmt::format("'#pragma luxo {}' is not known", asked.text),
                  didYouMean(std::string(asked.text), known, fmt::format("there are {}", listed(known))));
  }
}

}  // namespace luxo
