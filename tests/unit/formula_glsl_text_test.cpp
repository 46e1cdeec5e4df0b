// SPDX-License-Identifier: Apache-2.0
// The text of shader code, and tapes turned back into expressions. What the code computes: tests/gpu.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/error.h"
#include "formula/glsl.h"
#include "formula/tape.h"

namespace luxo {
namespace {

std::string textOf(Graph& graph, const std::vector<Expr>& outputs, GlslNumber number = GlslNumber::Float) {
  const GlslOutput output{"result", outputs};
  return emitGlsl(graph, "f", {&output, 1}, number);
}

std::size_t countOf(std::string_view part, std::string_view text) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST(GlslText, IsAFunctionWithOneStatementAnOperation) {
  Graph graph;
  const Expr u = graph.variable(0), v = graph.variable(1), speed = graph.variable(3);
  EXPECT_EQ(textOf(graph, {sin(u + speed) / v}),
            "void f(const float u, const float v, out float result) {\n"
            "  float t0 = parameterAt(1u);\n"
            "  float t1 = u + t0;\n"
            "  vec2 t2 = formulaSinCos(t1);\n"
            "  float t3 = t2.x / v;\n"
            "  result = float(t3);\n"
            "}\n");
  EXPECT_EQ(textOf(graph, {u, Expr(-2.5), v, Expr(1)}),
            "void f(const float u, const float v, out vec4 result) {\n"
            "  result = vec4(u, (-2.5), v, 1.0);\n"
            "}\n");
}

TEST(GlslText, AnglesInTurnsAreNeverRadians) {
  Graph graph;
  const Expr u = graph.variable(0), v = graph.variable(1);
  const double turn = 2 * std::numbers::pi;
  EXPECT_EQ(textOf(graph, {sin(turn * u), cos(3 * turn * v), sin(turn * u - 0.5 * turn * v + turn / 4)}),
            "void f(const float u, const float v, out vec3 result) {\n"
            "  vec2 t0 = formulaSinCosTurns(u);\n"
            "  float t1 = formulaTurns(v, 3.0);\n"
            "  vec2 t2 = formulaSinCosTurns(t1);\n"
            "  float t3 = formulaTurns(u, 1.0);\n"
            "  float t4 = formulaTurns(v, 0.5);\n"
            "  float t5 = t3 - t4;\n"
            "  float t6 = 0.25 + t5;\n"
            "  vec2 t7 = formulaSinCosTurns(t6);\n"
            "  result = vec3(t0.x, t2.y, t7.x);\n"
            "}\n");
  for (const Expr& other : {sin(6.28 * u), sin(turn * u + v), sin(turn / 3 * u)})
    EXPECT_EQ(countOf("Turns(", textOf(graph, {other})), 0u);
  // Beside turns any constant is a number of them.
  EXPECT_EQ(countOf("formulaSinCosTurns(", textOf(graph, {sin(3 * turn * u - 0.4)})), 1u);
  EXPECT_EQ(countOf("Turns(", textOf(graph, {sin(turn * u)}, GlslNumber::Double)), 0u);
  // A sum that shares its parts has as many terms as a tree of them.
  Expr sum = turn * u;
  for (int i = 0; i < 200; ++i) sum = sum + (sum - turn * v);
  EXPECT_EQ(countOf("SinCosTurns(", textOf(graph, {sin(sum)})), 0u);
}

TEST(GlslText, OfDoublesHasNoFloat) {
  Graph graph;
  const Expr u = graph.variable(0), v = graph.variable(1), speed = graph.variable(3);
  const Expr inverse = pow(v, -1);
  EXPECT_EQ(textOf(graph, {select(less(u, speed), inverse, 0.1), Expr(2)}, GlslNumber::Double),
            "void f(const double u, const double v, out dvec2 result) {\n"
            "  double t0 = parameterAt(1u);\n"
            "  double t1 = double(u < t0);\n"
            "  double t2 = 1.0lf / v;\n"
            "  double t3 = t1 != 0.0lf ? t2 : 0.10000000000000001lf;\n"
            "  result = dvec2(t3, 2.0lf);\n"
            "}\n");
}

TEST(GlslText, ComputesSharedPartsOnce) {
  Graph graph;
  const Expr u = graph.variable(0), v = graph.variable(1);
  const Expr shared = exp(u * v);
  EXPECT_EQ(countOf("formulaExp(", textOf(graph, {shared + u, shared - v, shared * shared})), 1u);
  const ExprPoint torus = point((2 + cos(v)) * cos(u), sin(v), (2 + cos(v)) * sin(u));
  const std::string text = emitSurfaceGlsl(graph, "torus", torus, true);
  EXPECT_EQ(countOf("formulaSinCos(", text), 2u) << text;
}

TEST(GlslText, DoesNotDependOnWhatElseTheGraphHolds) {
  const auto formula = [](Graph& graph) {
    return min(graph.variable(0) * graph.variable(1), graph.variable(2)) + 3 * graph.variable(0);
  };
  Graph alone, crowded;
  const Expr other = atan2(crowded.variable(7), exp(crowded.variable(9)));
  static_cast<void>(crowded.nodeOf(other));
  EXPECT_EQ(textOf(alone, {formula(alone)}), textOf(crowded, {formula(crowded)}));
}

// Compilers evaluate the operands of x * y in an order of their own.
TEST(GlslText, DoesNotDependOnWhichPartIsMadeFirst) {
  const auto formula = [](Graph& graph, bool forward) {
    const auto made = [&](auto first, auto second) {
      std::optional<Expr> x, y;
      if (!forward) y = second();
      x = first();
      if (forward) y = second();
      return std::pair(*x, *y);
    };
    const auto [u, v] = made([&] { return graph.variable(0); }, [&] { return graph.variable(1); });
    const auto [a, b] = made([u = u] { return sin(3 * u); }, [v = v] { return 2 + cos(v); });
    const auto [c, d] =
        made([u = u, v = v] { return exp(u * v); }, [u = u, v = v] { return atan2(v, u + v); });
    const auto [e, f] = made([a = a, b = b] { return a * b; }, [c = c, d = d] { return min(c, d); });
    const auto [g, h] = made([e = e, f = f] { return e + f; }, [c = c, b = b] { return equal(b, c) * b; });
    return emitSurfaceGlsl(graph, "f", point(g, h, a * d), true);
  };
  Graph forward, backward;
  EXPECT_EQ(formula(forward, true), formula(backward, false));
}

TEST(GlslText, HasNoLiteralThatGlslLacks) {
  Graph graph;
  const Expr u = graph.variable(0);
  for (const double c :
       {std::numeric_limits<double>::infinity(), -1e308, std::numeric_limits<double>::quiet_NaN()}) {
    const std::string text = textOf(graph, {select(u, c, 1)});
    EXPECT_EQ(countOf("inf", text) + countOf("nan", text), 0u) << text;
    EXPECT_EQ(countOf("uintBitsToFloat(0x", text), 1u) << text;
  }
  for (const double c : {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    const std::string text = textOf(graph, {select(u, c, 1)}, GlslNumber::Double);
    EXPECT_EQ(countOf("inf", text) + countOf("nan", text), 0u) << text;
    EXPECT_EQ(countOf("packDouble2x32(uvec2(0u, 0x7ff", text), 1u) << text;
  }
}

TEST(GlslText, RefusesFormulasTooLargeForADevice) {
  Graph graph;
  Expr f = graph.variable(0);
  while (graph.nodes().size() < kMaxGlslOperations - 10) f = sin(f + graph.variable(1));
  EXPECT_NO_THROW(static_cast<void>(textOf(graph, {f})));
  for (int i = 0; i < 10; ++i) f = sin(f + graph.variable(1));
  try {
    static_cast<void>(textOf(graph, {f}));
    ADD_FAILURE() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::Scene);
    EXPECT_NE(std::string(error.what()).find("20000"), std::string::npos) << error.what();
  }
}

TEST(TapeExpressions, GiveTheTapeBack) {
  Graph graph;
  const Expr u = graph.variable(0), v = graph.variable(1), p = graph.variable(2);
  const std::array outputs{sin(u) * cos(u) + cos(v), pow(u + p, 3) / max(v, p),
                           select(less(u, v), exp(u), abs(v)), Expr(4), u};
  const Tape tape(graph, outputs);
  Graph other;
  const Tape again(other, tape.expressions(other));
  const std::vector<double> us{0.1, 0.7, -1.3}, vs{2.1, -0.2, 0.4}, parameters{1.5};
  EXPECT_EQ(tape.evaluate(us, vs, parameters), again.evaluate(us, vs, parameters));
}

}  // namespace
}  // namespace luxo
