// SPDX-License-Identifier: Apache-2.0
#include "scene/material_shader.h"

#include <algorithm>
#include <cctype>
#include <regex>

namespace luxo {
namespace {

bool hasWord(std::string_view text, std::string_view word) {
  const auto isPart = [&](std::size_t at) {
    return at < text.size() && (std::isalnum(static_cast<unsigned char>(text[at])) != 0 || text[at] == '_');
  };
  for (std::size_t at = text.find(word); at != text.npos; at = text.find(word, at + 1))
    if ((at == 0 || !isPart(at - 1)) && !isPart(at + word.size())) return true;
  return false;
}

/// Whether a line of a text is that, whatever spaces there are, comments behind it apart.
bool hasPragma(std::string_view text, const std::regex& pragma) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    if (std::regex_search(text.begin() + at, text.begin() + end, pragma,
                          std::regex_constants::match_continuous))
      return true;
    at = end + 1;
  }
  return false;
}

}  // namespace

bool MaterialShader::traces() const {
  return std::ranges::any_of(files, [](const File& file) { return hasWord(file.text, "trace"); });
}

bool MaterialShader::readsCurvature() const {
  static const std::regex kField(R"(\.\s*(K|H|k1|k2)\b)");
  return std::ranges::any_of(files, [](const File& file) { return std::regex_search(file.text, kField); });
}

bool MaterialShader::hasSampler(const std::string& name) const {
  const std::regex declared(R"(\buniform\s+sampler2D\s[^;]*\b)" + name + "\\b");
  return std::ranges::any_of(files, [&](const File& file) { return std::regex_search(file.text, declared); });
}

bool MaterialShader::hasOpacity() const {
  static const std::regex kPragma(R"(\s*#\s*pragma\s+luxo\s+opacity\s*($|//|/\*))");
  return std::ranges::any_of(files, [](const File& file) { return hasPragma(file.text, kPragma); });
}

std::string TextPlace::describe(const std::string& message, const std::string& hint) const {
  if (text) return luxo::describe(name, *text, {where, message, hint});
  return hint.empty() ? message : message + "\n  help: " + hint;
}

}  // namespace luxo
