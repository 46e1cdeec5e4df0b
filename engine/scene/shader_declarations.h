// SPDX-License-Identifier: Apache-2.0
// What a shader declares that a compiler's time and room grow with, faster than the text does.
#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

namespace luxo {

/// Of GLSL without directives and macros, token by token.
class ShaderDeclarations {
 public:
  void take(std::string_view token);
  /// Between `#if`, `#elif`, `#else` and `#endif`, which may not be there: braces do not close what is around
  /// it.
  void openAlternative();
  /// False: a structure begins or ends in it that does not in the text around it.
  [[nodiscard]] bool closeAlternative();
  /// Of the structure that is being declared, so far: one for itself, and all of those in it.
  [[nodiscard]] std::size_t members() const { return members_; }
  /// Pairs of functions, the first of which calls the second.
  [[nodiscard]] std::size_t calls() const { return calls_.size(); }

 private:
  void takeOfStructure(std::string_view token);
  void takeOfFunction(std::string_view token);
  /// Its number; 0: none is being declared.
  [[nodiscard]] std::size_t openStructure() const;

  std::map<std::string_view, std::size_t> structures_;
  std::string_view structure_, last_, before_;
  std::size_t declared_ = 0, function_ = 0;  ///< structures so far; functions
  std::size_t depth_ = 0, declaredAt_ = 0;   ///< of braces
  std::size_t members_ = 0, each_ = 1;       ///< what each name of the declaration adds
  std::set<std::string_view> functions_;
  std::set<std::pair<std::size_t, std::string_view>> calls_;
  struct Alternative {
    std::size_t depth = 0, structure = 0, each = 0;  ///< where it begins
  };
  std::vector<Alternative> alternatives_;
};

}  // namespace luxo
