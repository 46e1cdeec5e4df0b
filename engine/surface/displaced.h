// SPDX-License-Identifier: Apache-2.0
// A surface moved along its own normal, as a formula of its own: S + d N, whose derivatives, normals,
// topology and bounds are found from that formula as those of any other.
//
//     Surface bumpy = displacedBy(torus(2, 0.5),
//                                 [](auto u, auto v) { return 0.05 * sin(5 * kTau * u) * cos(3 * kTau * v);
//                                 });
#pragma once

#include <array>
#include <cstdint>
#include <tuple>
#include <vector>

#include "formula/tape.h"
#include "surface/surface.h"

namespace luxo {

/// How far each point is moved: metres, along the surface's outward unit normal (Surface::normal()).
struct Displacement {
  Tape height;  ///< one output; its variables 2, 3, ... are the parameters
  std::vector<Animated<double>> parameters = {};
};

/// The surface through the moved points, on the same (u, v), cut where the displacement is kinked. Seams stay
/// joined, and what is closed stays so, only where the displacement is the same on both sides. The topology
/// is that of the moment `start`. At edges where Su x Sv is 0, as at poles, what is 0 there
/// is divided out, and the normal is its limit. Error(Scene): that is not found, as where fractional powers
/// are; of triangles, which have no formula.
[[nodiscard]] Surface displaced(const Surface& surface, const Displacement& displacement,
                                const Moment& start = {});

/// By a generic function `(auto u, auto v, auto... parameters)`; the arguments after it give its free
/// variables their values, constant or functions of time.
template <class Height, class... Parameters>
[[nodiscard]] Surface displacedBy(const Surface& surface, const Height& height, Parameters... parameters) {
  Graph graph;
  const Expr u = graph.variable(kVariableU), v = graph.variable(kVariableV);
  std::uint32_t next = kFirstParameter;
  const std::array<Expr, sizeof...(Parameters)> free{
      (static_cast<void>(parameters), graph.variable(next++))...};
  const Expr moved = std::apply([&](auto... p) { return height(u, v, p...); }, free);
  return displaced(surface, Displacement{Tape(graph, std::array{moved}), {Animated<double>(parameters)...}});
}

}  // namespace luxo
