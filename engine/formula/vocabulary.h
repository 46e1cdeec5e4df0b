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

[[nodiscard]] std::span<const FormulaFunction> formulaFunctions();
[[nodiscard]] const FormulaFunction* findFunction(std::string_view name);

struct FormulaConstant {
  std::string_view name;
  double value;
};

[[nodiscard]] std::span<const FormulaConstant> formulaConstants();
[[nodiscard]] const FormulaConstant* findConstant(std::string_view name);

/// What to write for a name that other languages have; empty when it is none.
[[nodiscard]] std::string_view adviceFor(std::string_view name);

/// `name` as a product of the names in `values`: "uv" -> "u*v", "2uv" -> "2*u*v". Empty when it is none.
[[nodiscard]] std::string asProduct(std::string_view name, std::span<const std::string> values);

/// `name` as a function beside its argument, "sinu" -> "sin(u)", "vsinu" -> "v*sin(u)"; or, where a bracket
/// follows, behind a factor: "usin" -> "u*sin". Empty when it is neither.
[[nodiscard]] std::string asCall(std::string_view name, std::span<const std::string> values,
                                 bool bracketFollows);

}  // namespace luxo
