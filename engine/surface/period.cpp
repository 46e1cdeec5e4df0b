// SPDX-License-Identifier: Apache-2.0
#include "surface/period.h"

#include "formula/degree.h"

namespace luxo {

bool hasPeriod(const Patch& patch, std::span<const double> parameters, bool alongU) {
  Graph graph;
  const std::vector<Expr> position = expressionsOf(patch, parameters, graph);
  return isPeriodic(graph, position, alongU ? 0 : 1, (alongU ? patch.domain.u : patch.domain.v).width());
}

}  // namespace luxo
