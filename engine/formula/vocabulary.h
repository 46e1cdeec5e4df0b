// SPDX-License-Identifier: Apache-2.0
// What every formula knows: functions and constants; and what to say about the names it does not know.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "formula/expression.h"

namespace luxo {

struct FormulaFunction {
  std::string_view name;
  std::string_view signature;  ///< "clamp(x, low, high)"
  std::size_t arguments;       ///< exactly, or at least when `more`
  bool more;
  Expr (*build)(std::span<const Expr>);
};

[[nodiscard]] const FormulaFunction* findFunction(std::string_view name);

struct FormulaConstant {
  std::string_view name;
  double value;
};

[[nodiscard]] std::span<const FormulaConstant> formulaConstants();
[[nodiscard]] const FormulaConstant* findConstant(std::string_view name);

/// What was probably meant by a name that nobody knows, where `values` are those that have one: "uv" -> did
/// you mean 'u*v'? "sinu" -> 'sin(u)', "ln" -> 'log', "sped" -> 'speed'. Empty when there is nothing to say.
[[nodiscard]] std::string hintForValue(std::string_view name, const std::vector<std::string>& values);

/// The same before a bracket: "vsin" -> 'v*sin(', "arcsin" -> 'asin'.
[[nodiscard]] std::string hintForFunction(std::string_view name, const std::vector<std::string>& values);

}  // namespace luxo
