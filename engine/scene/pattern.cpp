// SPDX-License-Identifier: Apache-2.0
#include "scene/pattern.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/assert.h"
#include "formula/glsl.h"
#include "formula/tape.h"
#include "scene/ranges.h"

namespace luxo {

struct Pattern::Content {
  std::size_t parameterCount;
  std::string glsl;
  Tape color;
};

namespace {

std::string emit(Graph& graph, const ExprPoint& color) {
  const GlslOutput output{"color", color};
  return emitGlsl(graph, "patternColor", {&output, 1});
}

}  // namespace

Pattern::Pattern(Graph& graph, const ExprPoint& color, std::size_t parameterCount)
    : content_(
          std::make_shared<const Content>(Content{parameterCount, emit(graph, color), Tape(graph, color)})) {}

std::size_t Pattern::parameterCount() const { return valid() ? content_->parameterCount : 0; }

Vec3 Pattern::colorAt(double u, double v, std::span<const double> parameters) const {
  LUXO_REQUIRE(valid() && parameters.size() == content_->parameterCount);
  const auto value = content_->color.evaluate({&u, 1}, {&v, 1}, parameters);
  const auto orBlack = [](double c) { return c > 0 && std::isfinite(c) ? std::min(c, kMaxSceneNumber) : 0; };
  return {orBlack(value[0][0]), orBlack(value[1][0]), orBlack(value[2][0])};
}

const std::string& Pattern::glsl() const {
  LUXO_REQUIRE(valid());
  return content_->glsl;
}

std::strong_ordering operator<=>(const Pattern& a, const Pattern& b) {
  if (a.content_ == b.content_) return std::strong_ordering::equal;
  if (!a.valid() || !b.valid()) return a.valid() <=> b.valid();
  if (const auto order = a.content_->parameterCount <=> b.content_->parameterCount; order != 0) return order;
  return a.content_->glsl <=> b.content_->glsl;
}

}  // namespace luxo
