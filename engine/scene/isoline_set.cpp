// SPDX-License-Identifier: Apache-2.0
#include "scene/isoline_set.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <vector>

#include "base/assert.h"
#include "formula/glsl.h"
#include "formula/tape.h"
#include "scene/ranges.h"
#include "surface/patch.h"

namespace luxo {

struct IsolineSet::Content {
  std::size_t parameterCount = 0;
  std::vector<std::vector<bool>> repeats = {};  ///< of each of the lines that look alike, of its families
  std::string glsl = {};
  Tape tape = {};
};

namespace {

/// As LineField has them, in units of the step.
std::array<Expr, 4> fieldOf(Graph& graph, const LineFamily& family) {
  const Expr step = family.step.value_or(1);
  const Expr level = (family.of - family.at) / step;
  return {level, graph.derivative(level, kVariableU), graph.derivative(level, kVariableV),
          abs(family.of / step)};
}

}  // namespace

IsolineSet::IsolineSet(Graph& graph, std::span<const Isolines> lines, std::size_t parameterCount) {
  if (lines.empty()) return;
  Content content{.parameterCount = parameterCount};
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
    std::vector<bool>& repeats = content.repeats.emplace_back();
    for (std::size_t k = 0; k < alike.families.size(); ++k) {
      const std::string name = fmt::format("field{}of{}", k, i);
      output(name, "vec4", fieldOf(graph, alike.families[k]));
      repeats.push_back(alike.families[k].step.has_value());
      bare += fmt::format(" * (1.0 - lineCoverage({}, width{}, {}))", name, i, repeats.back());
    }
    output(fmt::format("width{}", i), "float", std::array{alike.width});
    output(fmt::format("line{}", i), "vec4",
           std::array{alike.color[0], alike.color[1], alike.color[2], alike.opacity});
    mixing += fmt::format("  lines = underLine(lines, line{}, 1.0 - {});\n", i, bare);
  }
  std::vector<GlslOutput> outputs;
  std::vector<Expr> all;
  std::string arguments;
  for (std::size_t i = 0; i < names.size(); ++i) {
    outputs.push_back({names[i], values[i]});
    all.insert(all.end(), values[i].begin(), values[i].end());
    arguments += ", " + names[i];
  }
  content.tape = Tape(graph, all);
  content.glsl = fmt::format(
      "{}vec4 isolinesOver(float u, float v) {{\n{}  isolineFormulas(u, v{});\n  vec4 lines = vec4(0);\n{}"
      "  return lines;\n}}\n",
      emitGlsl(graph, "isolineFormulas", outputs), declared, arguments, mixing);
  content_ = std::make_shared<const Content>(std::move(content));
}

std::size_t IsolineSet::parameterCount() const { return valid() ? content_->parameterCount : 0; }

Vec3 IsolineSet::over(const Vec3& color, double u, double v, const Mat2& footprint,
                      std::span<const double> parameters) const {
  LUXO_REQUIRE(valid() && parameters.size() == content_->parameterCount);
  std::vector<double> values(content_->tape.outputCount());
  content_->tape.evaluatePoint(u, v, parameters, values);
  Vec3 shown = color;
  auto value = values.cbegin();
  for (const std::vector<bool>& families : content_->repeats) {
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
    shown = glm::mix(shown, colorOrBlack({value[1], value[2], value[3]}),
                     (1 - bare) * (opacity > 0 ? std::min(opacity, 1.0) : 0));
    value += 5;
  }
  return shown;
}

const std::string& IsolineSet::glsl() const {
  LUXO_REQUIRE(valid());
  return content_->glsl;
}

std::strong_ordering operator<=>(const IsolineSet& a, const IsolineSet& b) {
  if (a.content_ == b.content_) return std::strong_ordering::equal;
  if (!a.valid() || !b.valid()) return a.valid() <=> b.valid();
  if (const auto order = a.content_->parameterCount <=> b.content_->parameterCount; order != 0) return order;
  return a.content_->glsl <=> b.content_->glsl;
}

}  // namespace luxo
