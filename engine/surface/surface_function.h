// SPDX-License-Identifier: Apache-2.0
// The compiled formula of a surface: position, first and second derivatives, all from one expression graph.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "formula/expression.h"
#include "formula/tape.h"
#include "math/bounds.h"
#include "math/interval.h"

namespace luxo {

/// Of a rectangle of parameters.
struct TangentBounds {
  Box position, middle;  ///< of S everywhere, and in the middle of the rectangle
  Box du, dv;
};

/// Boxes that hold Suu, Suv and Svv all over a rectangle.
struct SecondBounds {
  Box uu, uv, vv;
};

/// Rigorous bounds over a rectangle of parameters, which may reach a millionth beyond the patch's domain.
/// `inputs` are the values of variables 2, 3, ...
struct SurfaceBounder {
  std::function<Box(const Interval& u, const Interval& v, std::span<const double> inputs)> position;
  std::function<TangentBounds(const Interval& u, const Interval& v, std::span<const double> inputs)> tangents;
  /// Of |Suu|, |Suv|, |Svv|.
  std::function<std::array<double, 3>(const Interval& u, const Interval& v, std::span<const double> inputs)>
      second;
  std::function<SecondBounds(const Interval& u, const Interval& v, std::span<const double> inputs)>
      secondBoxes;
};

struct SurfaceFunction {
  Tape position;  ///< S: 3 outputs
  Tape tangents;  ///< S, Su, Sv: 9 outputs
  Tape second;    ///< Suu, Suv, Svv: 9 outputs
  Tape guards;    ///< the formula may be kinked where one of these passes through 0 (Graph::kinks)
  std::vector<bool> guardAtIntegers;  ///< of each guard: or through any integer
  /// For a family of formulas that has tighter bounds than interval arithmetic finds; else empty.
  SurfaceBounder bounder = {};
  /// The variable, if any, that u appears less throughout: the last of the patch's constants, where the patch
  /// begins. Searches in single precision count u from there, so that it has all its digits.
  std::optional<std::uint32_t> originOfU = {};
};

/// Differentiates and compiles. Variables 0 and 1 of the graph are u and v.
[[nodiscard]] std::shared_ptr<const SurfaceFunction> compileSurface(
    Graph& graph, const ExprPoint& position, SurfaceBounder bounder = {},
    std::optional<std::uint32_t> originOfU = {});

}  // namespace luxo
