// SPDX-License-Identifier: Apache-2.0
// Expression graphs: formulas of u, v and parameters, written with C++ operators and differentiated exactly.
// In come operators on Expr; out goes a graph in which equal subexpressions are one node (hash-consing),
// ready to be compiled (formula/tape.h).
//
//     Graph graph;
//     Expr u = graph.variable(0), v = graph.variable(1);
//     Expr f = (2 + cos(v)) * sin(u);
//     Expr fu = graph.derivative(f, 0);   // (2 + cos v) cos u
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace luxo {

enum class Op : std::uint8_t {
  Constant,
  Variable,
  Negate,
  Add,
  Subtract,
  Multiply,
  Divide,
  Power,  ///< integer exponent
  Sqrt,
  Exp,
  Log,
  Sin,
  Cos,
  Tan,
  Sinh,
  Cosh,
  Tanh,
};

/// How many operands an operation reads from the graph: 0, 1 or 2.
[[nodiscard]] constexpr int operandCount(Op op) {
  if (op == Op::Constant || op == Op::Variable) return 0;
  return op == Op::Add || op == Op::Subtract || op == Op::Multiply || op == Op::Divide ? 2 : 1;
}

class Graph;

/// A constant, or a node of a graph. Cheap to copy; must not outlive its graph. Operands of one operation
/// must belong to the same graph (asserted).
class Expr {
 public:
  Expr(double constant = 0) : constant_(constant) {}  // NOLINT: numbers are expressions

  [[nodiscard]] bool isConstant() const { return graph_ == nullptr; }
  [[nodiscard]] double constant() const { return constant_; }

 private:
  friend class Graph;
  Expr(Graph* graph, std::uint32_t node) : graph_(graph), node_(node) {}

  double constant_ = 0;
  Graph* graph_ = nullptr;
  std::uint32_t node_ = 0;
};

[[nodiscard]] Expr operator-(Expr x);
[[nodiscard]] Expr operator+(Expr x, Expr y);
[[nodiscard]] Expr operator-(Expr x, Expr y);
[[nodiscard]] Expr operator*(Expr x, Expr y);
[[nodiscard]] Expr operator/(Expr x, Expr y);
[[nodiscard]] Expr pow(Expr x, int exponent);
[[nodiscard]] Expr sqrt(Expr x);
[[nodiscard]] Expr exp(Expr x);
[[nodiscard]] Expr log(Expr x);
[[nodiscard]] Expr sin(Expr x);
[[nodiscard]] Expr cos(Expr x);
[[nodiscard]] Expr tan(Expr x);
[[nodiscard]] Expr sinh(Expr x);
[[nodiscard]] Expr cosh(Expr x);
[[nodiscard]] Expr tanh(Expr x);

/// A point of space given by three expressions: what a surface formula returns.
using ExprPoint = std::array<Expr, 3>;
[[nodiscard]] inline ExprPoint point(Expr x, Expr y, Expr z) { return {x, y, z}; }

/// One operation. Operands always have smaller indices than the node itself, so index order is evaluation
/// order.
struct ExprNode {
  Op op = Op::Constant;
  std::uint32_t a = 0, b = 0;  ///< operands; for Variable, a = which
  double value = 0;            ///< Constant: its value; Power: its exponent

  friend bool operator==(const ExprNode&, const ExprNode&) = default;
};

/// Owns the nodes. Not copyable (expressions point into it); not thread-safe while it grows.
class Graph {
 public:
  Graph() = default;
  Graph(const Graph&) = delete;
  Graph& operator=(const Graph&) = delete;

  [[nodiscard]] Expr variable(std::uint32_t index);

  /// Exact symbolic derivative with respect to variable `index`. Cost: linear in the nodes `f` needs; no
  /// recursion, so no formula is too deep. Every subexpression is differentiated once, however often it is
  /// shared.
  [[nodiscard]] Expr derivative(Expr f, std::uint32_t index);

  [[nodiscard]] const std::vector<ExprNode>& nodes() const { return nodes_; }
  /// Index of the node behind `f`; a constant becomes a node.
  [[nodiscard]] std::uint32_t nodeOf(Expr f);

  /// Combines operands, folding constants and dropping neutral elements (0 + x, 1 * x, 0 * x, --x).
  [[nodiscard]] static Expr apply(Op op, Expr x, Expr y = {}, int exponent = 0);

 private:
  struct NodeHash {
    std::size_t operator()(const ExprNode& node) const noexcept;
  };

  Expr intern(const ExprNode& node);

  std::vector<ExprNode> nodes_;
  std::unordered_map<ExprNode, std::uint32_t, NodeHash> index_;
};

/// Indices of all nodes that `roots` need, ascending: a valid order of evaluation.
[[nodiscard]] std::vector<std::uint32_t> reachable(const Graph& graph,
                                                   const std::vector<std::uint32_t>& roots);

}  // namespace luxo
