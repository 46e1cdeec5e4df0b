// SPDX-License-Identifier: Apache-2.0
#include "scene/pattern_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "base/assert.h"
#include "formula/glsl.h"
#include "surface/patch.h"

namespace luxo {
namespace {

/// As LineField has them, in units of the step.
std::array<Expr, 4> fieldOf(Graph& graph, const LineFamily& family) {
  const Expr step = family.step.value_or(1);
  const Expr level = (family.of - family.at) / step;
  return {level, graph.derivative(level, kVariableU), graph.derivative(level, kVariableV),
          abs(family.of / step)};
}

}  // namespace

PatternLines::PatternLines(Graph& graph, const std::array<Expr, 3>& color, std::span<const Isolines> lines) {
  const std::array<Expr, 4> paint{color[0], color[1], color[2], 1};
  std::vector<std::string> names;
  std::vector<std::vector<Expr>> values;
  std::string declared;
  const auto output = [&](const std::string& name, const char* type, auto&& components) {
    names.push_back(name);
    values.emplace_back(std::begin(components), std::end(components));
    declared += fmt::format("  {} {};\n", type, name);
  };
  std::string mixing;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const Isolines& alike = lines[i];
    std::string bare = "1.0";
    std::vector<bool>& repeats = repeats_.emplace_back();
    for (std::size_t k = 0; k < alike.families.size(); ++k) {
      const std::string name = fmt::format("field{}of{}", k, i);
      output(name, "vec4", fieldOf(graph, alike.families[k]));
      repeats.push_back(alike.families[k].step.has_value());
      bare += fmt::format(" * (1.0 - lineCoverage({}, width{}, {}))", name, i, repeats.back());
    }
    output(fmt::format("width{}", i), "float", std::array{alike.width});
    output(fmt::format("line{}", i), "vec4",
           std::array{alike.color[0], alike.color[1], alike.color[2], alike.opacity});
    mixing += fmt::format("  color = underLine(color, line{}, 1.0 - {});\n", i, bare);
  }
  std::vector<GlslOutput> outputs{{"paint", paint}};
  std::vector<Expr> all;
  std::string arguments;
  for (std::size_t i = 0; i < names.size(); ++i) {
    outputs.push_back({names[i], values[i]});
    all.insert(all.end(), values[i].begin(), values[i].end());
    arguments += ", " + names[i];
  }
  tape_ = Tape(graph, all);
  glsl_ = fmt::format(
      "#include \"lib/isolines.glsl\"\n{}"
      "void patternPaint(float u, float v, out vec4 paint) {{\n{}  patternFormulas(u, v, paint{});\n"
      "  vec3 color = vec3(colorOrBlack(paint.r), colorOrBlack(paint.g), colorOrBlack(paint.b));\n{}"
      "  paint.rgb = color;\n}}\n",
      emitGlsl(graph, "patternFormulas", outputs), declared, arguments, mixing);
}

std::vector<LinesOfPixel> PatternLines::at(double u, double v, const Mat2& footprint,
                                           std::span<const double> parameters) const {
  std::vector<double> values(tape_.outputCount());
  tape_.evaluatePoint(u, v, parameters, values);
  std::vector<LinesOfPixel> all;
  auto value = values.cbegin();
  for (const std::vector<bool>& families : repeats_) {
    const auto fields = value;
    value += static_cast<std::ptrdiff_t>(4 * families.size());
    const double width = value[0], opacity = value[4];
    double bare = 1;
    for (std::size_t k = 0; k < families.size(); ++k) {
      const auto f = fields + static_cast<std::ptrdiff_t>(4 * k);
      const LineField field{f[0], {f[1], f[2]}, f[3], families[k]};
      // By columns: what was not finite stays so.
      bare *= 1 - lineCoverage(
                      field, {glm::dot(field.gradient, footprint[0]), glm::dot(field.gradient, footprint[1])},
                      width);
    }
    all.push_back({{value[1], value[2], value[3]}, (1 - bare) * (opacity > 0 ? std::min(opacity, 1.0) : 0)});
    value += 5;
  }
  return all;
}

}  // namespace luxo
