// SPDX-License-Identifier: Apache-2.0
// Formulas as shader code: GLSL functions that compute expressions, shared subexpressions once, in float or
// in double.
//
// The code calls what shaders/lib/formula.glsl defines, in double lib/double_math.glsl, so a shader includes
// that first and says where it has parameters from:
//
//     #include "lib/formula.glsl"
//     float parameterAt(uint k) { return parameters[k]; }
//     ... what emitGlsl() returned ...
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "formula/expression.h"

namespace luxo {

/// What the code computes with: every argument, parameter and constant is one of these.
enum class GlslNumber { Float, Double };

/// One `out` argument of a GLSL function: a number, or a vector of 2 to 4 expressions.
struct GlslOutput {
  std::string_view name;
  std::span<const Expr> components;
};

/// Operations in one GLSL function; a formula that needs more is an error. A driver compiles far longer than
/// it would take to evaluate such a formula on the processor.
inline constexpr std::size_t kMaxGlslOperations = 20'000;

/// How many instructions the code of these outputs is for a driver, whose time is proportional to it: an
/// operation counts as what shaders/lib makes of it. Cost: linear in the nodes of the graph.
[[nodiscard]] std::size_t glslInstructions(Graph& graph, std::span<const GlslOutput> outputs,
                                           GlslNumber number);

/// `void name(const float u, const float v, out ... )`, or of doubles, ending in a newline. Variable 0 is u,
/// variable 1 is v, variable 2 + k is parameterAt(k). Constants are rounded to the number; where the graph
/// has an infinity or a NaN, so has the code. The text depends on the expressions and the order they were
/// made in, not on what else their graph holds. Cost: linear in the nodes of the graph. Throws Error(Scene)
/// beyond kMaxGlslOperations.
[[nodiscard]] std::string emitGlsl(Graph& graph, std::string_view name, std::span<const GlslOutput> outputs,
                                   GlslNumber number = GlslNumber::Float);

/// The positions and derivatives of a surface: `void name(float u, float v, out vec3 S, out vec3 Su,
/// out vec3 Sv)`, with `out vec3 Suu, out vec3 Suv, out vec3 Svv` after these when asked for; or of doubles.
[[nodiscard]] std::string emitSurfaceGlsl(Graph& graph, std::string_view name, const ExprPoint& position,
                                          bool secondDerivatives = false,
                                          GlslNumber number = GlslNumber::Float);

/// Of emitSurfaceGlsl() without second derivatives.
[[nodiscard]] std::size_t surfaceGlslInstructions(Graph& graph, const ExprPoint& position, GlslNumber number);

}  // namespace luxo
