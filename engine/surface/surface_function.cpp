// SPDX-License-Identifier: Apache-2.0
#include "surface/surface_function.h"

#include <utility>

namespace luxo {
namespace {

ExprPoint derivative(Graph& graph, const ExprPoint& p, std::uint32_t variable) {
  return {graph.derivative(p[0], variable), graph.derivative(p[1], variable),
          graph.derivative(p[2], variable)};
}

Tape compile(Graph& graph, std::initializer_list<ExprPoint> points) {
  std::vector<Expr> outputs;
  for (const ExprPoint& p : points) outputs.insert(outputs.end(), p.begin(), p.end());
  return {graph, outputs};
}

}  // namespace

std::shared_ptr<const SurfaceFunction> compileSurface(Graph& graph, const ExprPoint& position,
                                                      SurfaceBounder bounder,
                                                      std::optional<std::uint32_t> originOfU) {
  const ExprPoint du = derivative(graph, position, 0), dv = derivative(graph, position, 1);
  const ExprPoint duu = derivative(graph, du, 0), duv = derivative(graph, du, 1),
                  dvv = derivative(graph, dv, 1);
  std::vector<Expr> guards;
  std::vector<bool> atIntegers;
  for (const Kink& kink : graph.kinks(position)) {
    guards.push_back(kink.guard);
    atIntegers.push_back(kink.atIntegers);
  }
  return std::make_shared<const SurfaceFunction>(
      SurfaceFunction{.position = compile(graph, {position}),
                      .tangents = compile(graph, {position, du, dv}),
                      .second = compile(graph, {duu, duv, dvv}),
                      .guards = Tape(graph, guards),
                      .guardAtIntegers = std::move(atIntegers),
                      .bounder = std::move(bounder),
                      .originOfU = originOfU});
}

}  // namespace luxo
