// SPDX-License-Identifier: Apache-2.0
#include "scene/shader_declarations.h"

#include <algorithm>

#include "base/glsl_tokens.h"

namespace luxo {
namespace {

/// Whether a name behind it is declared there.
bool isType(std::string_view word) {
  return !word.empty() && isGlslLetter(word.front()) && word != "return" && word != "else" && word != "do" &&
         word != "case";
}

}  // namespace

void ShaderDeclarations::take(std::string_view token) {
  if (token == "{") ++depth_;
  if (token == "}" && depth_ > (alternatives_.empty() ? 0 : alternatives_.back().depth)) --depth_;
  takeOfStructure(token);
  takeOfFunction(token);
  before_ = last_;
  last_ = token;
}

void ShaderDeclarations::openAlternative() { alternatives_.push_back({depth_, openStructure(), each_}); }

bool ShaderDeclarations::closeAlternative() {
  if (alternatives_.empty()) return true;
  const Alternative begin = alternatives_.back();
  alternatives_.pop_back();
  each_ = std::max(each_, begin.each);
  return openStructure() == begin.structure;
}

std::size_t ShaderDeclarations::openStructure() const {
  return last_ == "struct" ? declared_ + 1 : structure_.empty() ? 0 : declared_;
}

void ShaderDeclarations::takeOfStructure(std::string_view token) {
  if (last_ == "struct") {
    ++declared_;
    structure_ = token;  // `{` of one without a name
    declaredAt_ = token == "{" ? depth_ - 1 : depth_;
    members_ = each_ = 1;
  } else if (structure_.empty()) {
    return;
  } else if (depth_ == declaredAt_) {  // it has ended, or is only named
    if (token == "}" && structure_ != "{")
      structures_[structure_] = std::max(structures_[structure_], members_);
    structure_ = {};
    members_ = 0;
  } else if (token == "," || token == ";") {
    members_ += each_;
    if (token == ";") each_ = 1;
  } else if (const auto known = structures_.find(token); known != structures_.end()) {
    each_ = known->second;
  }
}

void ShaderDeclarations::takeOfFunction(std::string_view token) {
  if (token != "(" || last_.empty() || !isGlslLetter(last_.front())) return;
  if (depth_ == 0 || isType(before_)) {
    ++function_;  // others may have the name, for other arguments or under other conditions
    functions_.insert(last_);
  } else if (functions_.contains(last_)) {
    calls_.emplace(function_, last_);
  }
}

}  // namespace luxo
