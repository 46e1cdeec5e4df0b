// SPDX-License-Identifier: Apache-2.0
// The GLSL of formulas in double, run on the device, against the processor: functions against the standard
// library's in 64 bits of precision, surfaces against the tape.
#include "base/error.h"
#include "formula/glsl.h"
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
#include <vector>

namespace luxo {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr std::uint32_t kWidth = 256;
constexpr std::size_t kOutputs = 9, kTargets = 5;

constexpr std::string_view kFragment = R"(#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lib/double_math.glsl"
layout(scalar, set = 0, binding = 0) readonly buffer Points { dvec2 points[]; };
layout(scalar, set = 0, binding = 1) readonly buffer Parameters { double parameters[]; };
layout(location = 0) out uvec4 results[5];  // two doubles each
double parameterAt(uint k) { return parameters[k]; }
#include "formula"
uvec4 bitsOf(double a, double b) { return uvec4(unpackDouble2x32(a), unpackDouble2x32(b)); }
void main() {
  dvec2 p = points[uint(gl_FragCoord.y) * 256 + uint(gl_FragCoord.x)];
  dvec3 a, b, c;
  formula(p.x, p.y, a, b, c);
  results[0] = bitsOf(a.x, a.y);
  results[1] = bitsOf(a.z, b.x);
  results[2] = bitsOf(b.y, b.z);
  results[3] = bitsOf(c.x, c.y);
  results[4] = bitsOf(c.z, 0);
}
)";

/// Runs up to nine expressions on the device, for many points at once.
class FormulaDoubleTest : public test::GpuTest {
 protected:
  using Results = std::vector<std::array<double, kOutputs>>;

  void SetUp() override {
    GpuTest::SetUp();
    if (IsSkipped() || HasFatalFailure()) return;
    if (!context().features().float64) GTEST_SKIP() << "no doubles in shaders";
  }

  Results evaluate(Graph& graph, std::vector<Expr> outputs, const std::vector<Vec2>& points,
                   std::vector<double> parameters = {}) {
    outputs.resize(kOutputs);
    const std::span all(outputs);
    const GlslOutput targets[] = {
        {"a", all.subspan(0, 3)}, {"b", all.subspan(3, 3)}, {"c", all.subspan(6, 3)}};
    std::vector<gpu::ShaderSource> sources(std::begin(kShaderSources), std::end(kShaderSources));
    const std::string glsl = emitGlsl(graph, "formula", targets, GlslNumber::Double);
    sources.push_back({"formula", glsl});
    const auto shader = gpu::ShaderCompiler(std::filesystem::path())
                            .compile({.source = {"test.frag", kFragment}, .includes = sources});
    constexpr VkFormat kFormat = VK_FORMAT_R32G32B32A32_UINT;
    const gpu::DescriptorLayout layout(context(), {{}, {}});
    const gpu::GraphicsPipeline pipeline(context(),
                                         {.name = "formula",
                                          .vertexShader = luxo_test_descriptors_vert,
                                          .fragmentShader = shader.spirv,
                                          .colors = std::vector<gpu::ColorAttachment>(kTargets, {kFormat}),
                                          .setLayouts = {layout}});
    const VkExtent2D extent{kWidth, static_cast<std::uint32_t>((points.size() + kWidth - 1) / kWidth)};
    std::vector<Vec2> padded = points;
    padded.resize(std::size_t{extent.width} * extent.height);
    parameters.push_back(0);  // a buffer is never empty
    const auto bufferOf = [&](const auto& values) {
      const auto bytes = std::as_bytes(std::span(values));
      gpu::Buffer buffer(context(), {.size = bytes.size(), .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT});
      buffer.write(0, bytes);
      return buffer;
    };
    const gpu::Buffer pointBuffer = bufferOf(padded), parameterBuffer = bufferOf(parameters);

    std::vector<gpu::Readback> drawn = gpu::drawWholeTargets(
        context(), pipeline, extent, kFormat, kTargets,
        [&](gpu::FrameRing& frames, VkCommandBuffer commands) {
          pipeline.bindSet(commands, 0, frames.descriptors().write(layout, {pointBuffer, parameterBuffer}));
        });

    Results results(points.size());
    for (std::size_t k = 0; k < kTargets; ++k) {
      const std::span<const std::byte> texels = drawn[k].bytes();
      for (std::size_t i = 0; i < points.size(); ++i) {
        std::array<double, 2> two;
        std::memcpy(two.data(), texels.data() + i * sizeof two, sizeof two);
        results[i][2 * k] = two[0];
        if (2 * k + 1 < kOutputs) results[i][2 * k + 1] = two[1];
      }
    }
    return results;
  }
};

// ---------------------------------------------------------------------------------------------------------
// How wrong each function is.

/// Points between two numbers: evenly, or evenly in the logarithm of their distance from 0.
struct Range {
  double lo = 0, hi = 0;
  bool logarithmic = false;

  [[nodiscard]] double at(double t) const {
    if (!logarithmic) return lo + (hi - lo) * t;
    return std::copysign(std::exp(std::log(std::abs(lo)) * (1 - t) + std::log(std::abs(hi)) * t), lo);
  }
};

struct FunctionCase {
  std::string_view name;
  std::function<Expr(Expr, Expr)> formula;
  std::function<long double(long double, long double)> truth;
  Range u, v;
  double mostUlp;  ///< measured on lavapipe 22.3.6, and half as much again for other devices
};

/// In units of the last place of the true value.
double ulpError(double got, long double truth) {
  const long double unit = std::ldexp(1.0L, std::max(std::ilogb(truth), -1022) - 52);
  return static_cast<double>(std::abs(got - truth) / unit);
}

std::vector<FunctionCase> functionCases() {
  using F = long double (*)(long double);
  const auto one = [](std::string_view name, Expr (*formula)(Expr), F truth, Range range, double mostUlp) {
    return FunctionCase{name,
                        [=](Expr x, Expr) { return formula(x); },
                        [=](long double x, long double) { return truth(x); },
                        range,
                        {},
                        mostUlp};
  };
  const double pi = std::numbers::pi;
  std::vector<FunctionCase> cases{
      one("sqrt", sqrt, std::sqrt, {1e-300, 1e300, true}, 0.8),
      one("exp", exp, std::exp, {-708, 709}, 1.5),
      one("exp near 0", exp, std::exp, {-1, 1}, 1.5),
      one("log", log, std::log, {1e-307, 1e308, true}, 2.5),
      one("log near 1", log, std::log, {0.7, 1.4}, 3),
      one("sin", sin, std::sin, {-pi, pi}, 2),
      one("sin to 1e4", sin, std::sin, {-1e4, 1e4}, 4),
      one("cos", cos, std::cos, {-pi, pi}, 2),
      one("cos to 1e4", cos, std::cos, {-1e4, 1e4}, 4),
      one("tan", tan, std::tan, {-1.57, 1.57}, 4),
      one("tan to 100", tan, std::tan, {-100, 100}, 4),
      one("sinh", sinh, std::sinh, {-710, 710}, 3),
      one("sinh near 0", sinh, std::sinh, {-1.5, 1.5}, 3),
      one("cosh", cosh, std::cosh, {-710, 710}, 3),
      one("tanh", tanh, std::tanh, {-20, 20}, 3),
      one("tanh near 0", tanh, std::tanh, {1e-300, 0.7, true}, 3),
      one("asin", asin, std::asin, {-1, 1}, 3),
      one("asin near 0", asin, std::asin, {1e-300, 0.6, true}, 3),
      one("acos", acos, std::acos, {-1, 1}, 3),
      one("acos near 1", acos, std::acos, {0.999999, 1}, 3),
      one("atan", atan, std::atan, {-10, 10}, 3),
      one("atan far", atan, std::atan, {1e-300, 1e300, true}, 3),
      // As in float: in units of a result that falls from 1 to 0.1.
      one(
          "cardinal sine", [](Expr w) { return cardinal(w, 0); },
          [](long double w) {
            const long double x = std::sqrt(std::abs(w));
            return w < 0 ? std::sinh(x) / x : std::sin(x) / x;
          },
          {-120, 8}, 24),
      one("abs", abs, std::abs, {-10, 10}, 0),
      one("floor", floor, std::floor, {-10, 10}, 0),
      one("floor far", floor, std::floor, {-1e12, 1e12}, 0),
      one(
          "sign", sign, [](long double x) { return x > 0   ? 1.0L
                                                   : x < 0 ? -1.0L
                                                           : 0.0L; }, {-10, 10}, 0),
  };
  const auto two = [&](std::string_view name, Expr (*formula)(Expr, Expr),
                       long double (*truth)(long double, long double), Range u, Range v, double mostUlp) {
    cases.push_back({name, formula, truth, u, v, mostUlp});
  };
  two("atan2", atan2, std::atan2, {-3, 3}, {-3, 3}, 4);
  two("atan2 far", atan2, std::atan2, {1e-200, 1e200, true}, {-1e-200, -1e200, true}, 4);
  two("x^y", pow, std::pow, {1e-50, 1e50, true}, {-6, 6}, 3);
  two("x^y near 1", pow, std::pow, {0.9, 1.1}, {-6000, 6000}, 4);
  two("x^y, x < 0", pow, std::pow, {-4, -0.25}, {3, 3}, 3);
  two(
      "min", min, [](long double x, long double y) { return std::min(x, y); }, {-1, 1}, {-1, 1}, 0);
  two(
      "max", max, [](long double x, long double y) { return std::max(x, y); }, {-1, 1}, {-1, 1}, 0);
  two(
      "x + y", [](Expr x, Expr y) { return x + y; }, [](long double x, long double y) { return x + y; },
      {-1, 1}, {-9, 9}, 0.5);
  two(
      "x - y", [](Expr x, Expr y) { return x - y; }, [](long double x, long double y) { return x - y; },
      {-1, 1}, {-9, 9}, 0.5);
  two(
      "x * y", [](Expr x, Expr y) { return x * y; }, [](long double x, long double y) { return x * y; },
      {-1, 1}, {-9, 9}, 0.5);
  two(
      "x / y", [](Expr x, Expr y) { return x / y; }, [](long double x, long double y) { return x / y; },
      {-1, 1}, {1, 9}, 2.5);
  // At most n - 1 roundings, each half to one unit of the result; a reciprocal adds the 2.5 of a division.
  for (const auto& [name, n, mostUlp] : {std::tuple("x^2", 2, 0.5), std::tuple("x^3", 3, 2.0),
                                         std::tuple("x^-2", -2, 3.5), std::tuple("x^13", 13, 12.0)})
    cases.push_back({name,
                     [n = n](Expr x, Expr) { return pow(x, n); },
                     [n = n](long double x, long double) { return std::pow(x, n); },
                     {-3, -0.1},
                     {},
                     mostUlp});
  return cases;
}

TEST_F(FormulaDoubleTest, FunctionsAreWithinTheirUnits) {
  constexpr std::size_t kPoints = 1u << 16;
  fmt::print("  {:<14} {:>10}   worst at\n", "function", "ulp");
  for (const FunctionCase& c : functionCases()) {
    std::mt19937 random(7);  // NOLINT: the same numbers every time
    std::uniform_real_distribution<double> anywhere(0, 1);
    std::vector<Vec2> points;
    for (std::size_t i = 0; i < kPoints; ++i)
      points.emplace_back(c.u.at(static_cast<double>(i) / (kPoints - 1)), c.v.at(anywhere(random)));
    Graph graph;
    const Results got = evaluate(graph, {c.formula(graph.variable(0), graph.variable(1))}, points);
    double worst = 0;
    Vec2 where(0);
    for (std::size_t i = 0; i < kPoints; ++i) {
      const long double truth = c.truth(points[i].x, points[i].y);
      if (truth == 0 && got[i][0] == 0) continue;
      const double error = ulpError(got[i][0], truth);
      if (error <= worst) continue;
      worst = error;
      where = points[i];
    }
    fmt::print("  {:<14} {:>10.2f}   {:.17g}, {:.17g}\n", c.name, worst, where.x, where.y);
    EXPECT_LE(worst, c.mostUlp) << c.name;
  }
}

TEST_F(FormulaDoubleTest, FunctionsHaveTheSpecialValuesOfC) {
  const double big = 1.7e308;
  const std::vector<double> values{0.0, -0.0,   1,       -1,  0.5,  -0.5,      2,          -2,  3,
                                   -3,  1e-300, -1e-300, big, -big, kInfinity, -kInfinity, kNan};
  std::vector<Vec2> points;
  for (const double x : values)
    for (const double y : values) points.emplace_back(x, y);
  Graph graph;
  const Expr u = graph.variable(0), v = graph.variable(1);
  const auto check = [&](std::string_view name, Expr f, const std::function<double(double, double)>& truth) {
    const Results got = evaluate(graph, {f}, points);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double x = points[i].x, y = points[i].y, wanted = truth(x, y);
      if (std::isnan(wanted))
        EXPECT_TRUE(std::isnan(got[i][0])) << name << " of " << x << ", " << y << " is " << got[i][0];
      else if (!std::isfinite(wanted))
        EXPECT_EQ(got[i][0], wanted) << name << " of " << x << ", " << y;
      else  // devices may flush what is smaller than the smallest normal number
        EXPECT_NEAR(got[i][0], wanted, 1e-15 * std::abs(wanted) + 2.3e-308)
            << name << " of " << x << ", " << y;
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
  unary("floor", floor(u), std::floor);
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
  const Results got = evaluate(graph, {sin(u), cos(u), tan(u)}, {{kInfinity, 0}, {kNan, 0}});
  for (int k = 0; k < 3; ++k) EXPECT_TRUE(std::isnan(got[0][k]) && std::isnan(got[1][k])) << k;
}

// ---------------------------------------------------------------------------------------------------------
// What is emitted.

TEST_F(FormulaDoubleTest, ConstantsAndParametersAreExact) {
  Graph graph;
  const Expr u = graph.variable(0), p = graph.variable(2), q = graph.variable(4);
  for (const double c : {0.1, 1.0 / 3, 9007199254740993.0, 1e-300, -2.5, 1.7976931348623157e308,
                         2.2250738585072014e-308, 123456.789, 1e10, kInfinity, -kInfinity})
    // Not folded away: the sign of u is data.
    EXPECT_EQ(evaluate(graph, {select(u, c, 0)}, {{1, 0}})[0][0], c);
  EXPECT_TRUE(std::isnan(evaluate(graph, {select(u, kNan, 0)}, {{1, 0}})[0][0]));
  for (const double value : {0.1, -1.0 / 3}) {
    const Results got = evaluate(graph, {u * p + q, q}, {{3, 0}}, {value, 99, 0.7});
    EXPECT_NEAR(got[0][0], 3 * value + 0.7, 0x1p-52);  // two roundings of numbers below 2
    EXPECT_EQ(got[0][1], 0.7);
  }
}

/// The largest difference of vectors over their largest length.
struct VectorError {
  double difference = 0, length = 0;

  void add(const Vec3& got, const Vec3& wanted) {
    if (!std::isfinite(glm::dot(wanted, wanted))) return;
    const double off = glm::length(got - wanted);
    difference = off <= difference ? difference : off;  // a NaN counts
    length = std::max(length, glm::length(wanted));
  }
  [[nodiscard]] double relative() const { return difference / std::max(length, 1e-300); }
};

// Some ten roundings of 1.1e-16 where nothing cancels; an angle is rounded by 2^-53 of it, which is 3.5e-15
// at the end of five turns (springs, knots, shells).
TEST_F(FormulaDoubleTest, SurfacesAgreeWithTheTape) {
  constexpr std::size_t kPoints = 2048;
  constexpr double kMaxError = 5e-15;
  fmt::print("  {:<22} {:>10} {:>10} {:>10}   of the largest\n", "surface", "S", "Su", "Sv");
  for (const CatalogueEntry& entry : catalogue()) {
    const Surface surface = makeSurface(entry);
    std::array<VectorError, 3> errors;
    std::set<const SurfaceFunction*> seen;  // patches may share one
    for (const Patch& patch : surface.patches()) {
      if (!seen.insert(patch.function.get()).second) continue;
      std::mt19937 random(11);  // NOLINT: the same numbers every time
      std::uniform_real_distribution<double> anywhere(0, 1);
      std::vector<Vec2> points;
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
      const Results got = evaluate(graph, outputs, points, patch.constants);
      for (std::size_t i = 0; i < kPoints; ++i)
        for (std::size_t k = 0; k < 3; ++k)
          errors[k].add({got[i][3 * k], got[i][3 * k + 1], got[i][3 * k + 2]},
                        {wanted[3 * k][i], wanted[3 * k + 1][i], wanted[3 * k + 2][i]});
    }
    fmt::print("  {:<22} {:>10.1e} {:>10.1e} {:>10.1e}\n", entry.name, errors[0].relative(),
               errors[1].relative(), errors[2].relative());
    for (const VectorError& error : errors) EXPECT_LE(error.relative(), kMaxError) << entry.name;
  }
}

}  // namespace
}  // namespace luxo
