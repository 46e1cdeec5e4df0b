// SPDX-License-Identifier: Apache-2.0
#include "draw/course_style.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <span>
#include <vector>

#include "base/diagnostic.h"
#include "base/error.h"
#include "base/glsl_tokens.h"

#include <fmt/format.h>

namespace luxo {
namespace {

using Names = std::set<std::string_view>;

// What the language had, and has given up, or takes for itself today: the latter are names of programs' own.
const Names& respelledWords() {
  static const Names kWords = {"main",       "varying",   "attribute",     "sampler1D",     "sampler2D",
                               "texture1D",  "texture2D", "texture1DProj", "texture2DProj", "ftransform",
                               "sample",     "patch",     "buffer",        "shared",        "precise",
                               "active",     "common",    "partition",     "filter",        "resource",
                               "subroutine", "discard"};
  return kWords;
}

// Names of today's language that begin so are left to it.
bool isRespelled(std::string_view word) {
  static const Names kOfToday = {"gl_VertexIndex", "gl_InstanceIndex", "gl_FragDepth"};
  return word.starts_with("gl_") ? !kOfToday.contains(word) : respelledWords().contains(word);
}

/// Words that only such programs have.
bool isTelling(std::string_view word) {
  static const Names kTelling = {"varying",
                                 "attribute",
                                 "ftransform",
                                 "gl_FragColor",
                                 "gl_FragData",
                                 "gl_FrontColor",
                                 "gl_BackColor",
                                 "gl_Vertex",
                                 "gl_Normal",
                                 "gl_Color",
                                 "gl_TexCoord",
                                 "gl_ModelViewMatrix",
                                 "gl_ModelViewProjectionMatrix",
                                 "gl_ProjectionMatrix",
                                 "gl_NormalMatrix",
                                 "gl_LightSource",
                                 "gl_FrontMaterial",
                                 "gl_LightModel"};
  return kTelling.contains(word) || word.starts_with("gl_MultiTexCoord");
}

bool saysSo(std::span<const GlslToken> tokens) {
  return std::ranges::any_of(directivesIn(tokens), [](const GlslDirective& directive) {
    return directive.name == "pragma" && directive.rest.size() > 1 && directive.rest[0].text == "luxo" &&
           directive.rest[1].text == "course";
  });
}

struct Foreign {
  std::string_view word, why, advice;
};

constexpr Foreign kForeign[] = {
    {"gl_FragDepth", "a point has the depth that it has: it is found before it is lit", "leave it out"},
    {"gl_FragData", "a program writes one colour", "write gl_FragColor"},
    {"gl_Fog", "a scene has no fog", "give its numbers as uniforms of your own"},
    {"texture3D", "a material's maps are images", "compute the colour from a varying, as marble.frag does"},
    {"sampler3D", "a material's maps are images", "compute the colour from a varying, as marble.frag does"},
    {"textureCube", "a material's maps are images", "compute the colour from the direction"},
    {"samplerCube", "a material's maps are images", "compute the colour from the direction"},
    {"shadow1D", "lights know their shadows: gl_LightSource is as bright as it is visible", "leave it out"},
    {"shadow2D", "lights know their shadows: gl_LightSource is as bright as it is visible", "leave it out"},
    {"sampler1DShadow", "lights know their shadows: gl_LightSource is as bright as it is visible",
     "leave it out"},
    {"sampler2DShadow", "lights know their shadows: gl_LightSource is as bright as it is visible",
     "leave it out"},
    {"sampler2DRect", "maps are read in u and v from 0 to 1", "write sampler2D, and texture2D"},
    {"texture2DLod", "maps are filtered over the pixel", "write texture2D"},
    {"texture2DProjLod", "maps are filtered over the pixel", "write texture2DProj"},
    {"EmitVertex", "there are no geometry programs: surfaces are formulas", "change the surface's formula"},
    {"EndPrimitive", "there are no geometry programs: surfaces are formulas", "change the surface's formula"},
    {"gl_PositionIn", "there are no geometry programs: surfaces are formulas",
     "change the surface's formula"},
    {"gl_VerticesIn", "there are no geometry programs: surfaces are formulas",
     "change the surface's formula"}};

[[noreturn]] void refuse(const MaterialShader::File& file, const GlslToken& token, std::string_view why,
                         std::string_view advice) {
  throw Error(
      ErrorKind::Scene,
      describe(file.name, file.text,
               {{token.begin, token.end()}, fmt::format("'{}': {}", token.text, why), std::string(advice)}));
}

}  // namespace

bool inCourseStyle(const MaterialShader& shader) {
  bool telling = false, hasMain = false, hasMaterial = false;
  for (const MaterialShader::File& file : shader.files) {
    const std::vector<GlslToken> tokens = glslTokens(file.text);
    if (saysSo(tokens)) return true;
    std::string_view before;
    for (const GlslToken& token : tokens) {
      telling = telling || isTelling(token.text);
      hasMain = hasMain || (before == "void" && token.text == "main");
      hasMaterial = hasMaterial || (before == "vec4" && token.text == "material");
      before = token.text;
    }
  }
  return telling && hasMain && !hasMaterial;
}

std::string withCourseSpelling(std::string_view glsl) {
  std::string spelled(glsl);
  for (const GlslToken& token : glslTokens(glsl))
    if (token.isWord() && isRespelled(token.text))
      spelled[token.begin + 1] =
          static_cast<char>(std::toupper(static_cast<unsigned char>(spelled[token.begin + 1])));
  return spelled;
}

std::string withoutCourseSpelling(std::string_view text) {
  std::string plain(text);
  for (std::size_t at = 0; at < plain.size();) {
    std::size_t end = at;
    while (end < plain.size() && isGlslLetter(plain[end])) ++end;
    if (end > at + 1 && std::isupper(static_cast<unsigned char>(plain[at + 1])) != 0) {
      std::string word = plain.substr(at, end - at);
      word[1] = static_cast<char>(std::tolower(static_cast<unsigned char>(word[1])));
      if (isRespelled(word)) plain[at + 1] = word[1];
    }
    at = std::max(end, at + 1);
  }
  return plain;
}

std::string renamed(std::string_view glsl, const std::set<std::string, std::less<>>& names,
                    std::string_view prefix) {
  std::string text;
  std::size_t copied = 0;
  std::string_view before, last;                   // the last two tokens
  int braces = 0, brackets = 0, ofStructure = -1;  // where its members are
  const std::vector<GlslToken> tokens = glslTokens(glsl);
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    const GlslToken& token = tokens[i];
    const std::string_view next = i + 1 < tokens.size() ? tokens[i + 1].text : "";
    if (token.text == "{") {
      if (before == "struct" || last == "struct") ofStructure = braces;
      ++braces;
    } else if (token.text == "}") {
      if (--braces == ofStructure) ofStructure = -1;
    } else if (token.text == "[" || token.text == "]") {
      brackets += token.text == "[" ? 1 : -1;
    } else if (token.isWord() && last != "." && names.contains(token.text)) {
      const bool isMember = ofStructure >= 0 && brackets == 0 && (next == ";" || next == "," || next == "[");
      if (!isMember) {
        text += glsl.substr(copied, token.begin - copied);
        text += prefix;
        copied = token.begin;
      }
    }
    before = last;
    last = token.text;
  }
  return text += glsl.substr(copied);
}

void refuseForeign(const MaterialShader::File& file) {
  std::size_t start = file.text.find_first_not_of(" \t\r\n");
  if (start != file.text.npos && file.text.compare(start, 2, "!!") == 0)
    refuse(file,
           {.text = std::string_view(file.text).substr(start, file.text.find_first_of("\r\n", start) - start),
            .begin = start},
           "this is an assembly program", "write it in GLSL, with void main()");
  std::string_view before;
  for (const GlslToken& token : glslTokens(file.text)) {
    const auto* const foreign = std::ranges::find(kForeign, token.text, &Foreign::word);
    if (foreign != std::end(kForeign) && before != ".") refuse(file, token, foreign->why, foreign->advice);
    before = token.text;
  }
}

}  // namespace luxo
