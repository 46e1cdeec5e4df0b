// SPDX-License-Identifier: Apache-2.0
#include "draw/bounded_loops.h"

#include <cstddef>
#include <span>
#include <vector>

#include "base/glsl_tokens.h"

namespace luxo {
namespace {

constexpr std::string_view kAsks = " LUXO_ASKS ";

/// Of each `(` the index of its `)`; 0 of the others, and where there is none.
std::vector<std::size_t> closings(std::span<const GlslToken> tokens) {
  std::vector<std::size_t> ends(tokens.size()), open;
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    if (tokens[i].text == "(") open.push_back(i);
    if (tokens[i].text != ")" || open.empty()) continue;
    ends[open.back()] = i;
    open.pop_back();
  }
  return ends;
}

}  // namespace

std::string withBoundedLoops(std::string_view glsl) {
  const std::vector<GlslToken> tokens = glslTokens(glsl);
  const std::vector<std::size_t> ends = closings(tokens);
  std::string bounded;
  std::size_t copied = 0;
  const auto copyTo = [&](std::size_t end) {
    bounded += glsl.substr(copied, end - copied);
    copied = end;
  };
  const auto ask = [&](const GlslToken& behind) {
    copyTo(behind.end());
    bounded += kAsks;
  };
  int depth = 0;          // of braces
  std::vector<int> open;  // of each `do` the depth that it stands in
  std::string_view before;
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    const GlslToken& token = tokens[i];
    depth += token.text == "{" ? 1 : token.text == "}" ? -1 : 0;
    if (token.text == "do") {
      open.push_back(depth);
      ask(token);
    } else if (token.text == "while" && !open.empty() && open.back() == depth &&
               (before == "}" || before == ";")) {
      open.pop_back();  // what a `do` repeats is over, in braces of the same depth or with a semicolon
    } else if (token.text == "for" || token.text == "while") {
      if (const std::size_t end = i + 1 < tokens.size() ? ends[i + 1] : 0) {
        i = end;
        ask(tokens[i]);
      }
    } else if (token.text == "#" && token.directive > 0) {
      const GlslDirective directive = directiveAt(std::span(tokens).subspan(i));
      if (directive.name == "version") {
        copyTo(token.begin);
        copied = (directive.rest.empty() ? tokens[i + 1] : directive.rest.back()).end();
        bounded.append(copied - token.begin, ' ');
      }
    }
    before = tokens[i].text;
  }
  copyTo(glsl.size());
  return bounded;
}

}  // namespace luxo
