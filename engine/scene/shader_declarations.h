// SPDX-License-Identifier: Apache-2.0
// What a shader declares that a compiler's time and room grow with, faster than the text does.
#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <string_view>
#include <utility>

namespace luxo {

/// Of GLSL without directives and macros, token by token.
class ShaderDeclarations {
 public:
  void take(std::string_view token);
  /// Of the structure that is being declared, so far: one for itself, and all of those in it.
  [[nodiscard]] std::size_t members() const { return members_; }
  /// Pairs of functions, the first of which calls the second.
  [[nodiscard]] std::size_t calls() const { return calls_.size(); }

 private:
  void takeOfStructure(std::string_view token);
  void takeOfFunction(std::string_view token);

  std::map<std::string_view, std::size_t> structures_;
  std::string_view structure_, function_, last_;
  std::size_t depth_ = 0, declaredAt_ = 0;  ///< of braces
  std::size_t members_ = 0, each_ = 1;      ///< what each name of the declaration adds
  std::set<std::string_view> functions_;
  std::set<std::pair<std::string_view, std::string_view>> calls_;
};

}  // namespace luxo
