// SPDX-License-Identifier: Apache-2.0
// Formulas as text: what people write in scene files and on the command line, read into an expression graph.
//
//     Graph graph;
//     Scope scope;
//     scope.bind("u", graph.variable(0));
//     scope.define("a", "2u + 18deg");
//     Formula f = parse("cos(a)^2 / 2", scope);
//     for (const Diagnostic& d : f.diagnostics) fmt::print("{}\n", describe("formula", text, d));
//
// Grammar, loosest first: one comparison (< <= > >= == !=, 1 when true, else 0), + -, * / and products
// without a sign, unary - +, ^ (right-associative: -2^2 is -4, 2^-1 is 1/2), numbers, names, name(arguments),
// brackets. A number directly before a name or a bracket multiplies, exactly as `*` would there: 1/2u is u/2,
// 2u^2 is 2*(u^2), e^2u is (e^2)*u. `name(` is always a call. An exponent needs digits: 1e3 is 1000, 2e is
// 2*e. Functions: sin cos tan asin acos atan atan2 sinh cosh tanh exp log sqrt abs min max floor sign mod
// clamp mix smoothstep if pow. Constants: pi tau e deg.
#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostic.h"
#include "formula/expression.h"

namespace luxo {

/// Limits, each an error of its own: bytes of one formula; levels of brackets, calls, signs and powers inside
/// each other; errors reported for one formula. Chains of definitions may be of any length.
inline constexpr std::size_t kMaxFormulaBytes = 64 * 1024;
inline constexpr int kMaxFormulaNesting = 256;
inline constexpr std::size_t kMaxFormulaErrors = 10;

/// A formula that was read.
struct Formula {
  Expr value = std::numeric_limits<double>::quiet_NaN();  ///< NaN unless ok
  std::vector<Diagnostic> diagnostics;  ///< of this text alone; a definition it uses reports its own
  bool ok = false;                      ///< nothing is wrong here or in the definitions it uses
};

class FormulaNames;

/// The names a formula may use: values, and definitions in any order. All values belong to one graph.
class Scope {
 public:
  Scope();
  ~Scope();
  Scope(Scope&&) noexcept;
  Scope& operator=(Scope&&) noexcept;

  /// Gives a name a value. A name given twice means the last; names that nameProblem() refuses are never
  /// found.
  void bind(std::string name, Expr value);

  /// Gives a name a formula, read when it is first needed. It may use names that come later.
  void define(std::string name, std::string text);

  /// A name that has no meaning here, with the reason a person gets: "only a surface has u and v".
  void explainAbsence(std::string name, std::string reason);

  /// Why this scope cannot take `name`: not a name, a function's, a constant's, or taken already. The range
  /// is inside `name`.
  [[nodiscard]] std::optional<Diagnostic> nameProblem(std::string_view name) const;

  /// The formula behind a definition of this scope (required). Ask for each once: its errors are reported
  /// nowhere else, whether or not it is used. A circle of definitions is an error of the one that closes it.
  [[nodiscard]] const Formula& definition(std::string_view name);

 private:
  friend Formula parse(std::string_view text, Scope& scope);
  std::unique_ptr<FormulaNames> names_;
};

/// Reads one formula. Never throws for what is written in it. Cost: linear in the text (and in the
/// definitions it is the first to use).
[[nodiscard]] Formula parse(std::string_view text, Scope& scope);

}  // namespace luxo
