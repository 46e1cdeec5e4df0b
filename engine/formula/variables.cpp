// SPDX-License-Identifier: Apache-2.0
#include "formula/variables.h"

#include <algorithm>

namespace luxo {

std::vector<std::uint32_t> variablesOf(Graph& graph, std::span<const Expr> expressions) {
  std::vector<std::uint32_t> roots, variables;
  for (const Expr& expression : expressions)
    if (!expression.isConstant()) roots.push_back(graph.nodeOf(expression));
  for (const std::uint32_t node : reachable(graph, roots))
    if (graph.nodes()[node].op == Op::Variable) variables.push_back(graph.nodes()[node].a);
  std::ranges::sort(variables);
  return variables;
}

}  // namespace luxo
