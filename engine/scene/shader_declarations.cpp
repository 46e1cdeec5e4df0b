// SPDX-License-Identifier: Apache-2.0
#include "scene/shader_declarations.h"

#include <algorithm>

#include "scene/glsl_tokens.h"

namespace luxo {

void ShaderDeclarations::take(std::string_view token) {
  if (token == "{") ++depth_;
  if (token == "}" && depth_ > 0) --depth_;
  takeOfStructure(token);
  takeOfFunction(token);
  last_ = token;
}

void ShaderDeclarations::takeOfStructure(std::string_view token) {
  if (last_ == "struct") {
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
  if (depth_ == 0) {
    function_ = last_;
    functions_.insert(last_);
  } else if (functions_.contains(last_)) {
    calls_.emplace(function_, last_);
  }
}

}  // namespace luxo
