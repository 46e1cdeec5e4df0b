// SPDX-License-Identifier: Apache-2.0
// How high the tree is that a compiler makes of a shader: it follows that by recursion.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

namespace luxo {

/// Of GLSL without directives and macros, token by token. Never less than it is: the operators of an
/// expression count as if each were in the one before, so do statements that are parts of others without
/// braces. Of what stands between `#if` and `#endif`, which may not be there, nothing closes or ends what is
/// around it, and what it leaves open stays so.
class ShaderNesting {
 public:
  /// In brackets, operators and statements, with the token.
  std::size_t heightWith(std::string_view token);
  /// Between `#if`, `#elif`, `#else` and `#endif`.
  void openAlternative();
  void closeAlternative();
  /// Of statements in each other, and of choices (?:, && and ||), which are branches, too.
  [[nodiscard]] std::size_t statements() const { return statements_ + levels_.back().statements; }

 private:
  /// What is between two brackets, or an alternative's, or the whole text.
  struct Level {
    bool isBlock = true, isList = false;  ///< has statements; has what commas separate
    bool isAlternative = false;
    bool hasEnded = false;       ///< a statement, unless `else` is next
    bool isFresh = true;         ///< it has no token of its own yet
    bool goesOn = false;         ///< of an alternative: with a statement of the level around it
    std::size_t statements = 0;  ///< that begin and have not ended
    std::size_t operators = 0;   ///< of the expression
    std::size_t parts = 0;       ///< the height of the highest part of these
    std::size_t highest = 0;     ///< of what has ended

    [[nodiscard]] std::size_t height() const { return statements + operators + parts; }
    void end();
    void add(const Level& alternative);
  };

  void open(std::string_view bracket);
  void close();

  std::vector<Level> levels_{Level{}};
  std::string_view last_;
  std::size_t outside_ = 0, statements_ = 0;  ///< of the levels around the last one
  std::vector<std::size_t> alternatives_;     ///< which of the levels
};

}  // namespace luxo
