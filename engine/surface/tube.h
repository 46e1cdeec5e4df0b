// SPDX-License-Identifier: Apache-2.0
// A tube around a curve, as one formula with exact derivatives.
#pragma once

#include <utility>
#include <vector>

#include "formula/expression.h"
#include "math/interval.h"
#include "surface/surface.h"

namespace luxo {

/// S = C(u) + r (cos(2 pi v) n - sin(2 pi v) b), v in [0, 1], with n = unit(d x C'), b = unit(C') x n. Su x
/// Sv points outward.
///
/// The frame (n, b) has no twist about the fixed direction d: n is always perpendicular to it. The frame of
/// least twist would be an integral along the curve, which is no formula and does not close up around a
/// closed curve; this one depends on the tangent alone, so a curve that closes smoothly gives a tube that
/// does. d is the direction of the axes and of some evenly spread ones that stays farthest from the curve's
/// tangents: for a plane curve, the plane's normal. It is chosen for the parameters' values at time 0.
///
/// `curve` may use variable 0 (u) and parameters (variables 2, 3, ...), `radius` v (variable 1) as well; all
/// of `graph`. Throws Error(Scene) where the curve has no direction (C' = 0 or no number), naming u, and when
/// its tangents come near every direction.
[[nodiscard]] Surface tube(Graph& graph, const ExprPoint& curve, Expr radius, const Interval& u,
                           std::vector<Animated<double>> parameters = {},
                           SurfaceTraits traits = {.name = "tube"});

/// For C++: the curve as a generic function `(auto u) -> point(x, y, z)`, the radius as `(auto u, auto v)`.
template <class Curve, class Radius>
[[nodiscard]] Surface tube(const Curve& curve, const Radius& radius, const Interval& u,
                           SurfaceTraits traits = {.name = "tube"}) {
  Graph graph;
  const Expr s = graph.variable(0), t = graph.variable(1);
  return tube(graph, curve(s), radius(s, t), u, {}, std::move(traits));
}

}  // namespace luxo
