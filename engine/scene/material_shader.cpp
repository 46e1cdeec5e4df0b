// SPDX-License-Identifier: Apache-2.0
#include "scene/material_shader.h"

#include <algorithm>
#include <array>
#include <span>

#include "base/glsl_tokens.h"
#include "scene/shader_text.h"

namespace luxo {
namespace {

bool hasWord(std::string_view text, std::string_view word) {
  return text.find(word) != text.npos && placeOf(word, text);
}

bool declaresUniform(std::string_view text, std::string_view name, std::string_view type) {
  return text.find(name) != text.npos && typesOfUniforms(text)[std::string(name)] == type;
}

}  // namespace

bool MaterialShader::traces() const {
  return std::ranges::any_of(files, [](const File& file) { return hasWord(file.text, "trace"); });
}

bool MaterialShader::movesVertices() const {
  if (vertex == 0) return false;
  constexpr std::array<std::string_view, 5> kTransform = {"=", "ftransform", "(", ")", ";"},
                                            kProduct = {"=", "gl_ModelViewProjectionMatrix", "*", "gl_Vertex",
                                                        ";"};
  return std::ranges::any_of(std::span(files).subspan(vertex), [&](const File& file) {
    const std::vector<GlslToken> tokens = glslTokens(file.text);
    for (std::size_t i = 0; i < tokens.size(); ++i) {
      if (tokens[i].text != "gl_Position") continue;
      const auto rest = std::span(tokens).subspan(i + 1);
      const auto follows = [&](const auto& words) {
        return rest.size() >= words.size() &&
               std::ranges::equal(rest.first(words.size()), words, {}, &GlslToken::text);
      };
      if (tokens[i].directive > 0 || !(follows(kTransform) || follows(kProduct))) return true;
    }
    return false;
  });
}

bool MaterialShader::readsCurvature() const {
  constexpr std::array<std::string_view, 4> kFields = {"K", "H", "k1", "k2"};
  const std::span<const File> own(files.data(), vertex > 0 ? vertex : files.size());
  return std::ranges::any_of(own, [&](const File& file) {
    const std::vector<GlslToken> tokens = glslTokens(file.text);
    return std::ranges::adjacent_find(tokens, [&](const GlslToken& dot, const GlslToken& field) {
             return dot.text == "." && std::ranges::find(kFields, field.text) != kFields.end();
           }) != tokens.end();
  });
}

bool MaterialShader::hasSampler(std::string_view name) const {
  return std::ranges::any_of(files,
                             [&](const File& file) { return declaresUniform(file.text, name, "sampler2D"); });
}

bool MaterialShader::hasBool(std::string_view name) const {
  return std::ranges::any_of(files, [&](const File& file) {
    return std::ranges::any_of(std::array{"bool", "bvec2", "bvec3", "bvec4"},
                               [&](const char* type) { return declaresUniform(file.text, name, type); });
  });
}

bool MaterialShader::hasOpacity() const {
  return saysOpacity() ||
         std::ranges::any_of(files, [](const File& file) { return hasWord(file.text, "discard"); });
}

bool MaterialShader::saysOpacity() const {
  return std::ranges::any_of(files, [](const File& file) {
    if (file.text.find("opacity") == file.text.npos) return false;
    const std::vector<GlslToken> tokens = glslTokens(file.text);
    return std::ranges::any_of(directivesIn(tokens), [](const GlslDirective& directive) {
      return directive.name == "pragma" && directive.rest.size() > 1 && directive.rest[0].text == "luxo" &&
             directive.rest[1].text == "opacity";
    });
  });
}

std::string TextPlace::describe(const std::string& message, const std::string& hint) const {
  if (text) return luxo::describe(name, *text, {where, message, hint});
  return hint.empty() ? message : message + "\n  help: " + hint;
}

}  // namespace luxo
