// SPDX-License-Identifier: Apache-2.0
#include "stability/dual.h"

#include "formula/operation.h"

namespace luxo {

DualFormula::DualFormula(Graph& graph, const std::vector<Expr>& outputs) {
  std::vector<std::uint32_t> roots;
  for (const Expr& output : outputs) roots.push_back(graph.nodeOf(output));
  const std::vector<std::uint32_t> needed = reachable(graph, roots);
  std::vector<std::uint32_t> numbers(graph.nodes().size());
  for (const std::uint32_t node : needed) {
    numbers[node] = static_cast<std::uint32_t>(nodes_.size());
    ExprNode copy = graph.nodes()[node];
    const int operands = operandCount(copy.op);
    if (operands > 0) copy.a = numbers[copy.a];
    if (operands > 1) copy.b = numbers[copy.b];
    if (operands > 2) copy.c = numbers[copy.c];
    nodes_.push_back(copy);
  }
  for (const std::uint32_t root : roots) outputs_.push_back(numbers[root]);
}

std::vector<Dual> DualFormula::at(double u, double v, const std::vector<double>& inputs) const {
  const auto variable = [&](std::uint32_t which) {
    if (which == 0) return Dual(u, 1, 0);
    if (which == 1) return Dual(v, 0, 1);
    return Dual(inputs[which - 2]);
  };
  thread_local std::vector<Dual> values;
  values.clear();
  for (const ExprNode& node : nodes_) {
    if (node.op == Op::Constant)
      values.emplace_back(node.value);
    else if (node.op == Op::Variable)
      values.push_back(variable(node.a));
    else {
      const auto operand = [&](int index, std::uint32_t which) {
        return operandCount(node.op) > index ? values[which] : Dual();
      };
      values.push_back(operate<Dual>(node.op, operand(0, node.a), operand(1, node.b), operand(2, node.c),
                                     static_cast<int>(node.value)));
    }
  }
  std::vector<Dual> results;
  for (const std::uint32_t output : outputs_) results.push_back(values[output]);
  return results;
}

}  // namespace luxo
