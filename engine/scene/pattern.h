// SPDX-License-Identifier: Apache-2.0
// A colour that varies over a surface: three formulas of u, v and parameters, evaluated in every pixel; with
// a fourth, how opaque the surface is there.
//
//     Material checkered{.diffusePattern = pattern([](auto u, auto v) {
//       const Expr square = mod(floor(8 * u) + floor(8 * v), 2);
//       return point(square, square, 1);
//     })};
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <tuple>

#include "formula/expression.h"
#include "math/vec.h"
#include "surface/patch.h"

namespace luxo {

/// Immutable and cheap to copy; safe from any thread. u and v are the surface's own.
class Pattern {
 public:
  Pattern() = default;  ///< no pattern

  /// `color` is linear RGB. Variables 0 and 1 of the graph are u and v, 2 + k is parameter k of
  /// `parameterCount`; the graph may go. Cost: linear in the nodes of the graph. Throws Error(Scene) for a
  /// formula too large for a shader (formula/glsl.h).
  Pattern(Graph& graph, const std::array<Expr, 3>& color, std::size_t parameterCount);
  /// `paint`: the color, and the opacity.
  Pattern(Graph& graph, const std::array<Expr, 4>& paint, std::size_t parameterCount);

  [[nodiscard]] bool valid() const { return content_ != nullptr; }
  [[nodiscard]] std::size_t parameterCount() const;

  /// Linear RGB. A component that is not a positive finite number is 0: a formula without a value is black;
  /// one above kMaxSceneNumber (scene/ranges.h) is that.
  [[nodiscard]] Vec3 colorAt(double u, double v, std::span<const double> parameters = {}) const;

  /// Whether it says how opaque a surface is.
  [[nodiscard]] bool hasOpacity() const;
  /// From 0 to 1, cut off there; a formula without a value is 0, as nothing is seen of it. 1 of a pattern
  /// that does not say.
  [[nodiscard]] double opacityAt(double u, double v, std::span<const double> parameters = {}) const;

  /// Rectangle around the points of a 65 x 65 grid over the domain at which the colour has no value, or one
  /// above kMaxSceneNumber, or the opacity has none: where colorAt() and opacityAt() show something else.
  /// Nothing if there is none. Cost: one interval evaluation, or 4,225 evaluations where that proves nothing.
  [[nodiscard]] std::optional<Domain> whereCut(const Domain& domain,
                                               std::span<const double> parameters) const;

  /// `void patternPaint(float u, float v, out vec4 paint)`, the opacity last (formula/glsl.h).
  [[nodiscard]] const std::string& glsl() const;

  /// By content: equal patterns are the same shader, whoever made them.
  friend bool operator==(const Pattern& a, const Pattern& b) { return (a <=> b) == 0; }
  friend std::strong_ordering operator<=>(const Pattern& a, const Pattern& b);

 private:
  struct Content;
  explicit Pattern(Content content);

  std::shared_ptr<const Content> content_;
};

/// The pattern of a generic function `(auto u, auto v, auto... parameters) -> point(r, g, b)`, as
/// surface(...) takes them; the values of its parameters belong to the material.
template <std::size_t kParameters = 0, class Formula>
[[nodiscard]] Pattern pattern(const Formula& formula) {
  Graph graph;
  const Expr u = graph.variable(0), v = graph.variable(1);
  std::array<Expr, kParameters> parameters;
  for (std::size_t k = 0; k < kParameters; ++k)
    parameters[k] = graph.variable(static_cast<std::uint32_t>(2 + k));
  const ExprPoint color = std::apply([&](auto... p) { return formula(u, v, p...); }, parameters);
  return {graph, color, kParameters};
}

}  // namespace luxo
