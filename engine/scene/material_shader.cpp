// SPDX-License-Identifier: Apache-2.0
#include "scene/material_shader.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <regex>
#include <span>

#include "scene/shader_text.h"

namespace luxo {
namespace {

bool hasWord(std::string_view text, std::string_view word) {
  const auto isPart = [&](std::size_t at) {
    return at < text.size() && (std::isalnum(static_cast<unsigned char>(text[at])) != 0 || text[at] == '_');
  };
  if (word.empty()) return false;
  for (std::size_t at = text.find(word); at != text.npos; at = text.find(word, at + 1))
    if ((at == 0 || !isPart(at - 1)) && !isPart(at + word.size())) return true;
  return false;
}

/// Whether a line is `#pragma luxo opacity`. Most texts have few lines that begin like that, or none: fast.
bool hasOpacityPragma(const std::string& text) {
  static const std::regex kPragma(R"(#\s*pragma\s+luxo\s+opacity\b)");
  for (std::size_t at = text.find('#'); at != text.npos; at = text.find('#', at + 1))
    if (std::regex_search(text.begin() + static_cast<std::ptrdiff_t>(at), text.end(), kPragma,
                          std::regex_constants::match_continuous))
      return true;
  return false;
}

/// Of a type that the pattern says.
bool declaresUniform(const std::string& text, std::string_view name, const std::regex& declaration) {
  for (std::sregex_iterator found(text.begin(), text.end(), declaration), end; found != end; ++found) {
    const auto at = static_cast<std::size_t>(found->position() + found->length());
    if (hasWord(std::string_view(text).substr(at, text.find(';', at) - at), name)) return true;
  }
  return false;
}

/// Whether one of the files says so outside of comments. What no comment says either is looked for once.
bool anySays(std::span<const MaterialShader::File> files, const auto& says) {
  return std::ranges::any_of(files, [&](const MaterialShader::File& file) {
    return says(file.text) && says(withoutComments(file.text));
  });
}

}  // namespace

bool MaterialShader::traces() const {
  return anySays(files, [](const std::string& text) { return hasWord(text, "trace"); });
}

bool MaterialShader::readsCurvature() const {
  static const std::regex kField(R"(\.\s*(K|H|k1|k2)\b)");
  const std::span<const File> own(files.data(), vertex > 0 ? vertex : files.size());
  return anySays(own, [](const std::string& text) { return std::regex_search(text, kField); });
}

bool MaterialShader::hasSampler(std::string_view name) const {
  static const std::regex kSampler(R"(\buniform\s+((highp|mediump|lowp)\s+)?sampler2D\b)");
  return anySays(files, [&](const std::string& text) { return declaresUniform(text, name, kSampler); });
}

bool MaterialShader::hasBool(std::string_view name) const {
  static const std::regex kBool(R"(\buniform\s+(bool|bvec[234])\b)");
  return anySays(files, [&](const std::string& text) { return declaresUniform(text, name, kBool); });
}

bool MaterialShader::hasOpacity() const {
  return saysOpacity() || anySays(files, [](const std::string& text) { return hasWord(text, "discard"); });
}

bool MaterialShader::saysOpacity() const { return anySays(files, hasOpacityPragma); }

std::string TextPlace::describe(const std::string& message, const std::string& hint) const {
  if (text) return luxo::describe(name, *text, {where, message, hint});
  return hint.empty() ? message : message + "\n  help: " + hint;
}

}  // namespace luxo
