// SPDX-License-Identifier: Apache-2.0
// The compiled formula of a surface: position, first and second derivatives, all from one expression graph.
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "formula/expression.h"
#include "formula/tape.h"

namespace luxo {

struct SurfaceFunction {
  Tape position;  ///< S: 3 outputs
  Tape tangents;  ///< S, Su, Sv: 9 outputs
  Tape twist;     ///< Suv, Su, Sv: 9 outputs
  Tape second;    ///< Suu, Suv, Svv: 9 outputs
};

/// Differentiates and compiles. Variables 0 and 1 of the graph are u and v.
[[nodiscard]] std::shared_ptr<const SurfaceFunction> compileSurface(Graph& graph, const ExprPoint& position);

}  // namespace luxo
