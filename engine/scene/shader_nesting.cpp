// SPDX-License-Identifier: Apache-2.0
#include "scene/shader_nesting.h"

#include <algorithm>
#include <array>

#include "base/glsl_tokens.h"

namespace luxo {
namespace {

/// Whether it begins a statement that another one is a part of.
bool holdsStatement(std::string_view word) {
  constexpr std::array<std::string_view, 6> kWords = {"if", "else", "for", "while", "do", "switch"};
  return std::ranges::find(kWords, word) != kWords.end();
}

/// Whether what follows may not be computed: compilers make branches of these.
bool isChoice(std::string_view mark) { return mark == "?" || mark == "&&" || mark == "||"; }

}  // namespace

void ShaderNesting::Level::end() {
  highest = std::max(highest, height());
  statements = operators = parts = 0;
  hasEnded = false;
}

/// Whether it is there or not.
void ShaderNesting::Level::add(const Level& alternative) {
  highest = std::max(highest, alternative.highest);
  if (alternative.goesOn) {
    statements += alternative.statements;
    operators += alternative.operators;
    parts = std::max({parts, alternative.parts, alternative.highest});
    hasEnded = hasEnded && alternative.hasEnded;
    goesOn = goesOn || isFresh;
  } else {
    statements = std::max(statements, alternative.statements);
    operators = std::max(operators, alternative.operators);
    parts = std::max(parts, alternative.parts);
    hasEnded = alternative.hasEnded;
  }
}

void ShaderNesting::openAlternative() {
  const Level& outer = levels_.back();
  outside_ += outer.statements + outer.operators;
  statements_ += outer.statements;
  alternatives_.push_back(levels_.size());
  levels_.push_back({.isBlock = outer.isBlock,
                     .isList = outer.isList,
                     .isAlternative = true,
                     .hasEnded = true,
                     .goesOn = !outer.hasEnded && outer.height() > 0});
  last_ = {};
}

void ShaderNesting::closeAlternative() {
  if (alternatives_.empty()) return;
  const std::size_t at = alternatives_.back();
  alternatives_.pop_back();
  const Level inner = levels_[at];
  Level& outer = levels_[at - 1];
  const bool isLast = at + 1 == levels_.size();  // or it has brackets that are open still
  outside_ -= outer.statements + outer.operators;
  statements_ -= outer.statements;
  outer.add(inner);
  if (!isLast) {
    outside_ += outer.statements + outer.operators - inner.statements - inner.operators;
    statements_ += outer.statements - inner.statements;
    outer.hasEnded = false;
  }
  levels_.erase(levels_.begin() + static_cast<std::ptrdiff_t>(at));
  last_ = {};
}

void ShaderNesting::open(std::string_view bracket) {
  Level& outer = levels_.back();
  const bool isBlock = bracket == "{";
  const bool isCall =
      last_ == "]" || (!last_.empty() && isGlslLetter(last_.back()) && !holdsStatement(last_));
  const bool isInitialiser = last_ == "=" || (outer.isList && (last_ == "{" || last_ == ","));
  if (bracket == "[") ++outer.operators;  // a[0][1] is an element of a[0]
  outside_ += outer.statements + outer.operators + 1;
  statements_ += outer.statements + (isBlock ? 1 : 0);
  levels_.push_back({.isBlock = isBlock, .isList = isBlock ? isInitialiser : isCall});
}

void ShaderNesting::close() {
  if (levels_.size() == 1 || levels_.back().isAlternative) return;
  Level inner = levels_.back();
  inner.end();
  levels_.pop_back();
  Level& outer = levels_.back();
  outside_ -= outer.statements + outer.operators + 1;
  statements_ -= outer.statements + (inner.isBlock ? 1 : 0);
  outer.parts = std::max(outer.parts, inner.highest + 1);
  outer.hasEnded = inner.isBlock;
}

std::size_t ShaderNesting::heightWith(std::string_view token) {
  Level& level = levels_.back();
  if (level.hasEnded && token != "else") level.end();
  level.hasEnded = false;
  if (level.isFresh && token == "else") level.goesOn = true;
  level.isFresh = false;
  if (token == "(" || token == "[" || token == "{") {
    open(token);
  } else if (token == ")" || token == "]" || token == "}") {
    close();
  } else if (token == ";") {
    level.hasEnded = true;
  } else if (token == "," && level.isList) {
    level.end();
  } else if (holdsStatement(token) || isChoice(token)) {
    if (!(token == "if" && last_ == "else")) ++level.statements;  // one more branch of the same
  } else if (!isGlslLetter(token.front()) && token != ":" && !(token.size() > 1 && token.front() == '.')) {
    ++level.operators;
  }
  last_ = token;
  return outside_ + levels_.back().height();
}

}  // namespace luxo
