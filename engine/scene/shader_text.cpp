// SPDX-License-Identifier: Apache-2.0
#include "scene/shader_text.h"

#include <algorithm>
#include <cstddef>
#include <regex>

namespace luxo {

std::string withoutComments(const std::string& glsl) {
  std::string text = glsl;
  const auto blank = [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      if (text[i] != '\n') text[i] = ' ';
  };
  for (std::size_t i = text.find('/'); i != text.npos; i = text.find('/', i + 1)) {
    if (i + 1 >= text.size() || (text[i + 1] != '/' && text[i + 1] != '*')) continue;
    const bool isLine = text[i + 1] == '/';
    std::size_t end = isLine ? text.find('\n', i) : text.find("*/", i + 2);
    end = end == text.npos ? text.size() : isLine ? end : end + 2;
    blank(i, end);
    i = end - 1;
  }
  return text;
}

std::string outsideOfFunctions(std::string_view glsl) {
  std::string outside;
  int depth = 0;
  for (std::size_t i = 0; i < glsl.size(); ++i) {
    if (glsl.substr(i, 2) == "//") {
      i = std::min(glsl.find('\n', i), glsl.size());
    } else if (glsl.substr(i, 2) == "/*") {
      i = std::min(glsl.find("*/", i + 2), glsl.size() - 2) + 1;
      continue;
    }
    if (i >= glsl.size()) break;
    depth -= glsl[i] == '}';
    if (depth == 0) outside += glsl[i];
    depth += glsl[i] == '{';
  }
  return outside;
}

std::vector<std::string> constantsOf(std::string_view glsl) {
  static const std::regex kConstant(
      R"(\bconst\s+(?!in\b)(?:(?:highp|mediump|lowp)\s+)?\w+(?:\s*\[[^\]]*\])?\s+(\w[^;{]*))");
  static const std::regex kDeclarator(R"(^\s*(\w+))");
  std::vector<std::string> names;
  const std::string text = std::regex_replace(std::string(glsl), std::regex(R"(//[^\n]*|/\*[^]*?\*/)"), " ");
  for (std::sregex_iterator found(text.begin(), text.end(), kConstant), end; found != end; ++found) {
    const std::string declared = (*found)[1].str();
    int depth = 0;
    std::size_t begin = 0;
    for (std::size_t i = 0; i <= declared.size() && depth >= 0; ++i) {
      const char c = i < declared.size() ? declared[i] : ',';
      depth += (c == '(' || c == '[') - (c == ')' || c == ']');
      if (c != ',' || depth != 0) continue;
      const std::string declarator = declared.substr(begin, i - begin);
      begin = i + 1;
      if (std::smatch name; std::regex_search(declarator, name, kDeclarator)) names.push_back(name[1].str());
    }
  }
  return names;
}

}  // namespace luxo
