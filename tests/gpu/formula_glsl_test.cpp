// SPDX-License-Identifier: Apache-2.0
// The GLSL of formulas, run on the device, against evaluation in double on the processor.
#include "formula/glsl.h"

#include "base/error.h"
#include "formula/tape.h"
#include "gpu/pipeline.h"
#include "gpu/shader_compiler.h"
#include "gpu/whole_target.h"
#include "luxo/shaders/sources.h"
#include "luxo/shaders/test_descriptors_vert.h"
#include "math/vec.h"
#include "support/gpu_fixture.h"
#include "surface/catalogue.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace luxo {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr std::uint32_t kWidth = 256;

// Of whole surfaces, relative to their size: some ten roundings of 6e-8.
constexpr double kMaxSurfaceError = 1e-6;
constexpr double kMaxTangentError = 2e-6;

constexpr std::string_view kFragment = R"(#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lib/formula.glsl"
layout(scalar, set = 0, binding = 0) readonly buffer Points { vec2 points[]; };
layout(scalar, set = 0, binding = 1) readonly buffer Parameters { float parameters[]; };
layout(location = 0) out vec4 result;
float parameterAt(uint k) { return parameters[k]; }
#include "formula"
void main() {
  vec2 p = points[uint(gl_FragCoord.y) * 256 + uint(gl_FragCoord.x)];
  formula(p.x, p.y, result);
}
)";

/// Runs four expressions on the device, for many points at once.
class FormulaGlslTest : public test::GpuTest {
 protected:
  using Results = std::array<std::vector<float>, 4>;

  /// Pads the outputs to four.
  static std::string glslOf(Graph& graph, std::vector<Expr> outputs) {
    outputs.resize(4);
    const GlslOutput output{"result", outputs};
    return emitGlsl(graph, "formula", {&output, 1});
  }

  Results evaluate(const std::string& formula, const std::vector<Vec2f>& points,
                   std::vector<float> parameters = {}) {
    std::vector<gpu::ShaderSource> sources(std::begin(kShaderSources), std::end(kShaderSources));
    sources.push_back({"formula", formula});
    const auto shader = gpu::ShaderCompiler(std::filesystem::path())
                            .compile({.source = {"test.frag", kFragment}, .includes = sources});
    const gpu::DescriptorLayout layout(context(), {{}, {}});
    const gpu::GraphicsPipeline pipeline(context(), {.name = "formula",
                                                     .vertexShader = luxo_test_descriptors_vert,
                                                     .fragmentShader = shader.spirv,
                                                     .colors = {{VK_FORMAT_R32G32B32A32_SFLOAT}},
                                                     .setLayouts = {layout}});
    const VkExtent2D extent{kWidth, static_cast<std::uint32_t>((points.size() + kWidth - 1) / kWidth)};
    std::vector<Vec2f> padded = points;
    padded.resize(std::size_t{extent.width} * extent.height);
    parameters.push_back(0);  // a buffer is never empty
    const auto bufferOf = [&](const auto& values) {
      const auto bytes = std::as_bytes(std::span(values));
      gpu::Buffer buffer(context(), {.size = bytes.size(), .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT});
      buffer.write(0, bytes);
      return buffer;
    };
    const gpu::Buffer pointBuffer = bufferOf(padded), parameterBuffer = bufferOf(parameters);

    gpu::Readback drawn =
        std::move(gpu::drawWholeTargets(context(), pipeline, extent, VK_FORMAT_R32G32B32A32_SFLOAT, 1,
                                        [&](gpu::FrameRing& frames, VkCommandBuffer commands) {
                                          pipeline.bindSet(commands, 0,
                                                           frames.descriptors().write(
                                                               layout, {pointBuffer, parameterBuffer}));
                                        })
                      .front());

    Results results;
    for (std::size_t i = 0; i < points.size(); ++i) {
      Vec4f value;
      std::memcpy(&value, drawn.bytes().data() + i * sizeof value, sizeof value);
      for (int k = 0; k < 4; ++k) results[k].push_back(value[k]);
    }
    return results;
  }

  Results evaluate(Graph& graph, const std::vector<Expr>& outputs, const std::vector<Vec2f>& points,
                   const std::vector<float>& parameters = {}) {
    return evaluate(glslOf(graph, outputs), points, parameters);
  }
};

// ---------------------------------------------------------------------------------------------------------
// How wrong each function is.

/// Points between two numbers: evenly, or evenly in the logarithm of their distance from 0.
struct Range {
  double lo, hi;
  bool logarithmic = false;

  [[nodiscard]] float at(double t) const {
    if (!logarithmic) return static_cast<float>(lo + (hi - lo) * t);
    return static_cast<float>(
        std::copysign(std::exp(std::log(std::abs(lo)) * (1 - t) + std::log(std::abs(hi)) * t), lo));
  }
};

struct FunctionCase {
  std::string_view name;
  std::function<Expr(Expr, Expr)> formula;
  std::function<double(double, double)> truth;
  Range u, v;
  double mostUlp;  ///< measured on lavapipe 22.3.6, and half as much again for other devices
};

/// Errors in units of the last place of the true value; below the smallest normal number, of that one, since
/// devices may flush to zero.
struct Worst {
  double ulp = 0, absolute = 0;
  Vec2f where{0};
  bool classes = true;  ///< infinities and NaN are where they should be

  void add(float got, double truth, const Vec2f& point) {
    const auto rounded = static_cast<float>(truth);
    if (!std::isfinite(rounded) || !std::isfinite(got)) {
      classes = classes && (std::isnan(truth) ? std::isnan(got) : got == rounded);
      return;
    }
    const double unit = std::ldexp(1.0, std::max(std::ilogb(truth), -126) - 23);
    const double error = std::abs(got - truth);
    absolute = std::max(absolute, error);
    if (error / unit > ulp) {
      ulp = error / unit;
      where = point;
    }
  }
};

std::vector<FunctionCase> functionCases() {
  using F = double (*)(double);
  const auto one = [](std::string_view name, Expr (*formula)(Expr), F truth, Range range, double mostUlp) {
    return FunctionCase{name,
                        [=](Expr x, Expr) { return formula(x); },
                        [=](double x, double) { return truth(x); },
                        range,
                        {},
                        mostUlp};
  };
  const double pi = std::numbers::pi;
  std::vector<FunctionCase> cases{
      one("sqrt", sqrt, std::sqrt, {1e-30, 1e30, true}, 0.8),
      one("exp", exp, std::exp, {-87, 88}, 1.5),
      one("exp near 0", exp, std::exp, {-1, 1}, 1.5),
      one("log", log, std::log, {1e-37, 1e38, true}, 2.5),
      one("log near 1", log, std::log, {0.7, 1.4}, 3),
      one("sin", sin, std::sin, {-pi, pi}, 2),
      one("sin to 1e4", sin, std::sin, {-1e4, 1e4}, 4),
      one("cos", cos, std::cos, {-pi, pi}, 2),
      one("cos to 1e4", cos, std::cos, {-1e4, 1e4}, 4),
      one("tan", tan, std::tan, {-1.57, 1.57}, 4),
      one("tan to 100", tan, std::tan, {-100, 100}, 4),
      one("sinh", sinh, std::sinh, {-89, 89}, 3),
      one("sinh near 0", sinh, std::sinh, {-1.5, 1.5}, 3),
      one("cosh", cosh, std::cosh, {-89, 89}, 3),
      one("tanh", tanh, std::tanh, {-10, 10}, 3),
      one("tanh near 0", tanh, std::tanh, {1e-30, 0.7, true}, 3),
      one("asin", asin, std::asin, {-1, 1}, 3),
      one("asin near 0", asin, std::asin, {1e-30, 0.6, true}, 3),
      one("acos", acos, std::acos, {-1, 1}, 3),
      one("acos near 1", acos, std::acos, {0.999, 1}, 3),
      one("atan", atan, std::atan, {-10, 10}, 3),
      one("atan far", atan, std::atan, {1e-30, 1e30, true}, 3),
      // In units of a result that falls from 1 to 0.1 while its terms stay near 1.
      one(
          "cardinal sine", [](Expr w) { return cardinal(w, 0); },
          [](double w) {
            const double x = std::sqrt(std::abs(w));
            return w < 0 ? std::sinh(x) / x : std::sin(x) / x;
          },
          {-60, 8}, 24),
      one("abs", abs, std::abs, {-10, 10}, 0),
      one("floor", floor, std::floor, {-10, 10}, 0),
      one(
          "sign", sign, [](double x) { return x > 0   ? 1.0
                                              : x < 0 ? -1.0
                                                      : 0.0; }, {-10, 10}, 0),
  };
  const auto two = [&](std::string_view name, Expr (*formula)(Expr, Expr), double (*truth)(double, double),
                       Range u, Range v, double mostUlp) {
    cases.push_back({name, formula, truth, u, v, mostUlp});
  };
  two("atan2", atan2, std::atan2, {-3, 3}, {-3, 3}, 4);
  two("atan2 far", atan2, std::atan2, {1e-20, 1e20, true}, {-1e-20, -1e20, true}, 4);
  two("x^y", pow, std::pow, {1e-6, 1e6, true}, {-6, 6}, 3);
  two("x^y near 1", pow, std::pow, {0.9, 1.1}, {-800, 800}, 3);
  two("x^y, x < 0", pow, std::pow, {-4, -0.25}, {3, 3}, 3);
  two(
      "min", min, [](double x, double y) { return std::min(x, y); }, {-1, 1}, {-1, 1}, 0);
  two(
      "max", max, [](double x, double y) { return std::max(x, y); }, {-1, 1}, {-1, 1}, 0);
  two(
      "x + y", [](Expr x, Expr y) { return x + y; }, [](double x, double y) { return x + y; }, {-1, 1},
      {-9, 9}, 0.5);
  two(
      "x - y", [](Expr x, Expr y) { return x - y; }, [](double x, double y) { return x - y; }, {-1, 1},
      {-9, 9}, 0.5);
  two(
      "x * y", [](Expr x, Expr y) { return x * y; }, [](double x, double y) { return x * y; }, {-1, 1},
      {-9, 9}, 0.5);
  two(
      "x / y", [](Expr x, Expr y) { return x / y; }, [](double x, double y) { return x / y; }, {-1, 1},
      {1, 9}, 2.5);
  // At most n - 1 roundings, each half to one unit of the result; a reciprocal adds the 2.5 of a division.
  for (const auto& [name, n, mostUlp] : {std::tuple("x^2", 2, 0.5), std::tuple("x^3", 3, 2.0),
                                         std::tuple("x^-2", -2, 3.5), std::tuple("x^13", 13, 12.0)})
    cases.push_back({name,
                     [n = n](Expr x, Expr) { return pow(x, n); },
                     [n = n](double x, double) { return std::pow(x, n); },
                     {-3, -0.1},
                     {},
                     mostUlp});
  return cases;
}

TEST_F(FormulaGlslTest, FunctionsAreWithinTheirUnits) {
  constexpr std::size_t kPoints = 1u << 17;
  fmt::print("  {:<14} {:>10} {:>12}   worst at\n", "function", "ulp", "absolute");
  for (const FunctionCase& c : functionCases()) {
    std::mt19937 random(7);  // NOLINT: the same numbers every time
    std::uniform_real_distribution<double> anywhere(0, 1);
    std::vector<Vec2f> points;
    for (std::size_t i = 0; i < kPoints; ++i)
      points.emplace_back(c.u.at(static_cast<double>(i) / (kPoints - 1)), c.v.at(anywhere(random)));
    Graph graph;
    const auto got = evaluate(graph, {c.formula(graph.variable(0), graph.variable(1))}, points)[0];
    Worst worst;
    for (std::size_t i = 0; i < kPoints; ++i) worst.add(got[i], c.truth(points[i].x, points[i].y), points[i]);
    fmt::print("  {:<14} {:>10.2f} {:>12.2e}   {:.9g}, {:.9g}\n", c.name, worst.ulp, worst.absolute,
               worst.where.x, worst.where.y);
    // A square root or a quotient of a GPU is not the nearest float: an H100's sqrt is off by 0.94, its atan2
    // by 4.05.
    EXPECT_LE(worst.ulp, c.mostUlp + tolerance(0, 0.2)) << c.name;
    EXPECT_TRUE(worst.classes) << c.name;
  }
}

TEST_F(FormulaGlslTest, FunctionsHaveTheSpecialValuesOfC) {
  // Vulkan promises a quotient of nothing beyond 2^126: GPUs multiply by reciprocals, which are 0 there.
  const double inf = kInfinity, big = tolerance(3e38, 8e37);
  const std::vector<double> values{0.0, -0.0,  1,      -1,  0.5,  -0.5, 2,    -2,  3,
                                   -3,  1e-30, -1e-30, big, -big, inf,  -inf, kNan};
  std::vector<Vec2f> points;
  for (const double x : values)
    for (const double y : values) points.emplace_back(x, y);
  Graph graph;
  const Expr u = graph.variable(0), v = graph.variable(1);
  const auto check = [&](std::string_view name, Expr f, const std::function<double(double, double)>& truth) {
    const auto got = evaluate(graph, {f}, points)[0];
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double x = points[i].x, y = points[i].y, wanted = truth(x, y);
      const auto rounded = static_cast<float>(wanted);
      if (std::isnan(wanted))
        EXPECT_TRUE(std::isnan(got[i])) << name << " of " << x << ", " << y << " is " << got[i];
      // Devices may flush what is smaller than the smallest normal number.
      else if (!std::isfinite(rounded))
        EXPECT_EQ(got[i], rounded) << name << " of " << x << ", " << y;
      else
        EXPECT_NEAR(got[i], wanted, 4e-7 * std::abs(wanted) + 1.2e-38) << name << " of " << x << ", " << y;
    }
  };
  const auto unary = [&](std::string_view name, Expr f, double (*truth)(double)) {
    check(name, f, [=](double x, double) { return truth(x); });
  };
  unary("exp", exp(u), std::exp);
  unary("log", log(u), std::log);
  unary("sqrt", sqrt(u), std::sqrt);
  unary("sinh", sinh(u), std::sinh);
  unary("cosh", cosh(u), std::cosh);
  unary("tanh", tanh(u), std::tanh);
  unary("asin", asin(u), std::asin);
  unary("acos", acos(u), std::acos);
  unary("atan", atan(u), std::atan);
  check("atan2", atan2(u, v), [](double x, double y) { return std::atan2(x, y); });
  check("pow", pow(u, v), [](double x, double y) { return std::pow(x, y); });
  check("divide", u / v, [](double x, double y) { return x / y; });
  check("less", less(u, v), [](double x, double y) { return x < y ? 1.0 : 0.0; });
  check("less or equal", lessEqual(u, v), [](double x, double y) { return x <= y ? 1.0 : 0.0; });
  check("equal", equal(u, v), [](double x, double y) { return x == y ? 1.0 : 0.0; });
  check("select", select(u, v, 7), [](double x, double y) { return x != 0 ? y : 7.0; });
  check("min", min(u, v),
        [](double x, double y) { return std::isnan(x) || std::isnan(y) ? kNan : std::min(x, y); });
  check("max", max(u, v),
        [](double x, double y) { return std::isnan(x) || std::isnan(y) ? kNan : std::max(x, y); });
  for (const Expr f : {sin(u), cos(u), tan(u)}) {
    const auto got = evaluate(graph, {f}, {{static_cast<float>(inf), 0}, {static_cast<float>(kNan), 0}})[0];
    EXPECT_TRUE(std::isnan(got[0]) && std::isnan(got[1]));
  }
}

/// Sine and cosine of an angle given in turns, by `turns` in real numbers.
double worstOf(std::span<const float> sines, std::span<const float> cosines, std::span<const Vec2f> points,
               const std::function<long double(long double, long double)>& turns) {
  double worst = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const long double all = turns(points[i].x, points[i].y);
    const long double angle = 2 * std::numbers::pi_v<long double> * (all - std::round(all));
    worst = std::max({worst, std::abs(sines[i] - static_cast<double>(std::sin(angle))),
                      std::abs(cosines[i] - static_cast<double>(std::cos(angle)))});
  }
  return worst;
}

TEST_F(FormulaGlslTest, TurnsAreNotRoundedAway) {
  Graph graph;
  const Expr u = graph.variable(0), v = graph.variable(1);
  const double turn = 2 * std::numbers::pi;
  std::mt19937 random(5);
  std::uniform_real_distribution<float> number(-100, 100);
  std::vector<Vec2f> points;
  for (int i = 0; i < 4096; ++i) points.emplace_back(number(random), number(random));
  const auto check = [&](const Expr& angle, const std::function<long double(long double, long double)>& turns,
                         double most) {
    const Results got = evaluate(graph, {sin(angle), cos(angle)}, points);
    EXPECT_LE(worstOf(got[0], got[1], points, turns), most);
  };
  // A float's half unit at 1 is 6e-8, and a sine's polynomial and angle add as much each. Of 100 turns in
  // radians a float rounds away 3e-5.
  check(
      turn * u, [](long double x, long double) { return x; }, 2e-7);
  check(
      7 * turn * u, [](long double x, long double) { return 7 * x; }, 2e-7);
  check(
      1.5 * turn * u, [](long double x, long double) { return 1.5L * x; }, 2e-7);
  check(
      -0.25 * turn * u, [](long double x, long double) { return -0.25L * x; }, 2e-7);
  // Half a unit of a sum of less than two turns is another 4e-7.
  check(
      3 * turn * u - 5 * turn * v, [](long double x, long double y) { return 3 * x - 5 * y; }, 6e-7);
  check(
      turn * u + turn / 4, [](long double x, long double) { return x + 0.25L; }, 6e-7);
  check(
      3 * turn * u + turn / 4, [](long double x, long double) { return 3 * x + 0.25L; }, 6e-7);
  check(
      3 * turn * u - 0.4,
      [](long double x, long double) { return 3 * x - 0.4L / (2 * std::numbers::pi_v<long double>); }, 6e-7);
}

// ---------------------------------------------------------------------------------------------------------
// What is emitted.

TEST_F(FormulaGlslTest, ConstantsAreExact) {
  Graph graph;
  const Expr u = graph.variable(0);
  for (const float c :
       {0.1f, 1.0f / 3, 16777217.0f, 1e-30f, -2.5f, 3.40282347e38f, 1.17549435e-38f, 123456.789f, 1e10f}) {
    // Not folded away: the sign of u is data.
    const auto got = evaluate(graph, {select(u, c, 0)}, {{1, 0}})[0][0];
    EXPECT_EQ(got, c);
  }
  EXPECT_EQ(evaluate(graph, {select(u, 1e308, 0)}, {{1, 0}})[0][0], std::numeric_limits<float>::infinity());
  EXPECT_EQ(evaluate(graph, {select(u, -kInfinity, 0)}, {{1, 0}})[0][0],
            -std::numeric_limits<float>::infinity());
  EXPECT_TRUE(std::isnan(evaluate(graph, {select(u, kNan, 0)}, {{1, 0}})[0][0]));
  EXPECT_EQ(evaluate(graph, {Expr(3), u, Expr(-4), -u}, {{1, 0}})[2][0], -4.0f);
}

TEST_F(FormulaGlslTest, ParametersAreInputs) {
  Graph graph;
  const Expr u = graph.variable(0), p = graph.variable(2), q = graph.variable(4);
  const std::vector<Expr> outputs{u * p + q, q};
  const std::string glsl = glslOf(graph, outputs);
  for (const float value : {2.0f, -8.0f}) {
    const auto got = evaluate(glsl, {{3, 0}}, {value, 99, 0.5f});
    EXPECT_EQ(got[0][0], 3 * value + 0.5f);
    EXPECT_EQ(got[1][0], 0.5f);
  }
}

TEST_F(FormulaGlslTest, CompositionsAgreeWithTheTape) {
  Graph graph;
  const Expr u = graph.variable(0), v = graph.variable(1);
  const std::vector<Expr> outputs{mod(floor(8 * u) + floor(8 * v), 2), clamp(3 * u - 1, 0, 1),
                                  smoothstep(0.2, 0.7, v), mix(sin(5 * u), cos(3 * v), u * v)};
  std::mt19937 random(3);  // NOLINT: the same numbers every time
  std::uniform_real_distribution<float> anywhere(-2, 2);
  std::vector<Vec2f> points(4096);
  for (Vec2f& point : points) point = {anywhere(random), anywhere(random)};
  const Results got = evaluate(graph, outputs, points);
  std::vector<double> us, vs;
  for (const Vec2f& p : points) {
    us.push_back(p.x);
    vs.push_back(p.y);
  }
  const auto wanted = Tape(graph, outputs).evaluate(us, vs, {});
  // The checker is exact, as multiples of powers of two are; the others lose a few roundings of numbers up
  // to 10.
  const double most[] = {0, 2e-6, 2e-6, 8e-6};
  for (int k = 0; k < 4; ++k)
    for (std::size_t i = 0; i < points.size(); ++i)
      ASSERT_NEAR(got[k][i], wanted[k][i], most[k]) << k << " at " << points[i].x << ", " << points[i].y;
}

/// The largest of three relative errors of vectors: the largest difference over the largest length.
struct VectorErrors {
  std::array<double, 3> difference{}, length{};

  void add(int which, const Vec3& got, const Vec3& wanted) {
    const bool finite = std::isfinite(glm::dot(wanted, wanted));
    if (!finite) return;
    difference[which] = std::max(difference[which], glm::length(got - wanted));
    length[which] = std::max(length[which], glm::length(wanted));
  }
  [[nodiscard]] double of(int which) const { return difference[which] / std::max(length[which], 1e-30); }
};

TEST_F(FormulaGlslTest, SurfacesAgreeWithTheTape) {
  constexpr std::size_t kPoints = 4096;
  fmt::print("  {:<22} {:>10} {:>10} {:>10}   of the largest\n", "surface", "S", "Su", "Sv");
  for (const CatalogueEntry& entry : catalogue()) {
    const Surface surface = makeSurface(entry);
    VectorErrors errors;
    std::set<const SurfaceFunction*> seen;  // patches may share one
    for (const Patch& patch : surface.patches()) {
      if (!seen.insert(patch.function.get()).second) continue;
      std::mt19937 random(11);  // NOLINT: the same numbers every time
      std::uniform_real_distribution<double> anywhere(0, 1);
      std::vector<Vec2f> points;
      std::vector<double> u, v;
      for (std::size_t i = 0; i < kPoints; ++i) {
        points.emplace_back(patch.domain.u.lo + patch.domain.u.width() * anywhere(random),
                            patch.domain.v.lo + patch.domain.v.width() * anywhere(random));
        u.push_back(points.back().x);
        v.push_back(points.back().y);
      }
      Graph graph;
      const std::vector<Expr> outputs = patch.function->tangents.expressions(graph);
      const auto wanted = patch.function->tangents.evaluate(u, v, patch.constants);
      const std::vector<float> parameters(patch.constants.begin(), patch.constants.end());
      for (int which = 0; which < 3; ++which) {
        const auto first = outputs.begin() + 3 * which;
        const Results got = evaluate(graph, {first, first + 3}, points, parameters);
        for (std::size_t i = 0; i < kPoints; ++i)
          errors.add(which, {got[0][i], got[1][i], got[2][i]},
                     {wanted[3 * which][i], wanted[3 * which + 1][i], wanted[3 * which + 2][i]});
      }
    }
    fmt::print("  {:<22} {:>10.1e} {:>10.1e} {:>10.1e}\n", entry.name, errors.of(0), errors.of(1),
               errors.of(2));
    EXPECT_LE(errors.of(0), kMaxSurfaceError) << entry.name;
    EXPECT_LE(errors.of(1), kMaxTangentError) << entry.name;
    EXPECT_LE(errors.of(2), kMaxTangentError) << entry.name;
  }
}

TEST_F(FormulaGlslTest, SurfaceFunctionsHaveAllDerivatives) {
  Graph graph;
  const Expr u = graph.variable(0), v = graph.variable(1), minor = graph.variable(2);
  const ExprPoint torus =
      point((2 + minor * cos(v)) * cos(u), minor * sin(v), -(2 + minor * cos(v)) * sin(u));
  const std::string glsl = emitSurfaceGlsl(graph, "torus", torus, true) + R"(
void formula(float u, float v, out vec4 result) {
  vec3 d[6];
  torus(u, v, d[0], d[1], d[2], d[3], d[4], d[5]);
  int which = int(parameterAt(1u));
  vec3 chosen = d[0];
  for (int i = 1; i < 6; ++i) chosen = i == which ? d[i] : chosen;
  result = vec4(chosen, 0);
}
)";
  const std::vector<Vec2f> points{{0.3f, 0.7f}, {2, -1}, {-3, 3}, {1.5f, 5.5f}};
  const double r = 0.75;
  for (int which = 0; which < 6; ++which) {
    const Results got = evaluate(glsl, points, {static_cast<float>(r), static_cast<float>(which)});
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double cu = std::cos(points[i].x), su = std::sin(points[i].x), cv = std::cos(points[i].y),
                   sv = std::sin(points[i].y), ring = 2 + r * cv;
      const Vec3 wanted[] = {{ring * cu, r * sv, -ring * su},     {-ring * su, 0, -ring * cu},
                             {-r * sv * cu, r * cv, r * sv * su}, {-ring * cu, 0, ring * su},
                             {r * sv * su, 0, r * sv * cu},       {-r * cv * cu, -r * sv, r * cv * su}};
      for (int k = 0; k < 3; ++k)
        EXPECT_NEAR(got[k][i], wanted[which][k], 2e-6) << which << " at point " << i;
    }
  }
  EXPECT_THAT(
      emitSurfaceGlsl(graph, "torus", torus),
      testing::HasSubstr("void torus(const float u, const float v, out vec3 S, out vec3 Su, out vec3 Sv)"));
}

}  // namespace
}  // namespace luxo
