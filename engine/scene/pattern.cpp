// SPDX-License-Identifier: Apache-2.0
#include "scene/pattern.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
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

Pattern::Pattern(Content content) : content_(std::make_shared<const Content>(std::move(content))) {}

Pattern::Pattern(Graph& graph, const std::array<Expr, 3>& color, std::size_t parameterCount)
    : Pattern(Content{parameterCount, false, emit(graph, {color[0], color[1], color[2], 1}),
                      Tape(graph, color)}) {}

Pattern::Pattern(Graph& graph, const std::array<Expr, 4>& paint, std::size_t parameterCount)
    : Pattern(Content{parameterCount, true, emit(graph, paint), Tape(graph, paint)}) {}

std::size_t Pattern::parameterCount() const { return valid() ? content_->parameterCount : 0; }

bool Pattern::hasOpacity() const { return valid() && content_->hasOpacity; }

Vec3 Pattern::colorAt(double u, double v, std::span<const double> parameters) const {
  LUXO_REQUIRE(valid() && parameters.size() == content_->parameterCount);
  const auto value = content_->paint.evaluate({&u, 1}, {&v, 1}, parameters);
  return colorOrBlack({value[0][0], value[1][0], value[2][0]});
}

double Pattern::opacityAt(double u, double v, std::span<const double> parameters) const {
  LUXO_REQUIRE(valid() && parameters.size() == content_->parameterCount);
  if (!hasOpacity()) return 1;
  const double opacity = content_->paint.evaluate({&u, 1}, {&v, 1}, parameters)[3][0];
  return opacity > 0 ? std::min(opacity, 1.0) : 0;
}

std::optional<Domain> Pattern::whereCut(const Domain& domain, std::span<const double> parameters) const {
  LUXO_REQUIRE(valid() && parameters.size() == content_->parameterCount);
  std::array<Interval, 4> bounds;
  const std::size_t outputs = hasOpacity() ? 4 : 3;
  content_->paint.bound(domain.u, domain.v, parameters, std::span(bounds).first(outputs));
  if (std::ranges::all_of(bounds,
                          [](const Interval& b) { return b.lo > -kInfinity && b.hi <= kMaxSceneNumber; }))
    return {};
  constexpr int kCells = 64;
  std::vector<double> us, vs;
  for (int k = 0; k <= kCells; ++k) {
    us.push_back(domain.u.lo + domain.u.width() * k / kCells);
    vs.push_back(domain.v.lo + domain.v.width() * k / kCells);
  }
  const auto values = content_->paint.evaluateGrid(us, vs, parameters);
  std::optional<Domain> cut;
  for (std::size_t i = 0; i < values[0].size(); ++i) {
    const auto isCut = [i](const std::vector<double>& value) {
      return !(value[i] <= kMaxSceneNumber && value[i] > -kInfinity);
    };
    if (std::ranges::none_of(values, isCut)) continue;
    const double u = us[i % us.size()], v = vs[i / us.size()];
    cut = cut ? Domain{hull(cut->u, u), hull(cut->v, v)} : Domain{u, v};
  }
  return cut;
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
