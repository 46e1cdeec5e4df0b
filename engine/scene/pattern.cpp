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
  bool hasOpacity;
  std::string glsl;
  Tape paint;
};

namespace {

std::string emit(Graph& graph, const std::array<Expr, 4>& paint) {
  const GlslOutput output{"paint", paint};
  return emitGlsl(graph, "patternPaint", {&output, 1});
}

}  // namespace

Pattern::Pattern(Graph& graph, const std::array<Expr, 3>& color, std::size_t parameterCount)
    : content_(std::make_shared<const Content>(Content{
          parameterCount, false, emit(graph, {color[0], color[1], color[2], 1}), Tape(graph, color)})) {}

Pattern::Pattern(Graph& graph, const std::array<Expr, 4>& paint, std::size_t parameterCount)
    : content_(std::make_shared<const Content>(
          Content{parameterCount, true, emit(graph, paint), Tape(graph, paint)})) {}

std::size_t Pattern::parameterCount() const { return valid() ? content_->parameterCount : 0; }

bool Pattern::hasOpacity() const { return valid() && content_->hasOpacity; }

Vec3 Pattern::colorAt(double u, double v, std::span<const double> parameters) const {
  LUXO_REQUIRE(valid() && parameters.size() == content_->parameterCount);
  const auto value = content_->paint.evaluate({&u, 1}, {&v, 1}, parameters);
  const auto orBlack = [](double c) { return c > 0 && std::isfinite(c) ? std::min(c, kMaxSceneNumber) : 0; };
  return {orBlack(value[0][0]), orBlack(value[1][0]), orBlack(value[2][0])};
}

double Pattern::opacityAt(double u, double v, std::span<const double> parameters) const {
  LUXO_REQUIRE(valid() && parameters.size() == content_->parameterCount);
  if (!hasOpacity()) return 1;
  const double opacity = content_->paint.evaluate({&u, 1}, {&v, 1}, parameters)[3][0];
  return opacity > 0 ? std::min(opacity, 1.0) : 0;
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
