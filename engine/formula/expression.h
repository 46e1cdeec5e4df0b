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
#include <span>
#include <vector>

namespace luxo {

/// What each does to numbers: formula/operation.h.
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
  Asin,
  Acos,
  Atan,
  Atan2,  ///< a = y, b = x
  Abs,
  Min,
  Max,
  Floor,
  Sign,
  Raise,  ///< real exponent: a^b as std::pow has it
  Less,   ///< the comparisons are 1 or 0
  LessEqual,
  Equal,
  Select,    ///< a != 0 ? b : c
  Cardinal,  ///< of an order: math/cardinal.h
};

/// How many operands an operation reads from the graph: 0 to 3.
[[nodiscard]] constexpr int operandCount(Op op) {
  switch (op) {
    case Op::Constant:
    case Op::Variable:
      return 0;
    case Op::Add:
    case Op::Subtract:
    case Op::Multiply:
    case Op::Divide:
    case Op::Atan2:
    case Op::Min:
    case Op::Max:
    case Op::Raise:
    case Op::Less:
    case Op::LessEqual:
    case Op::Equal:
      return 2;
    case Op::Select:
      return 3;
    default:
      return 1;
  }
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
/// x^y as std::pow has it (a negative x only takes integers). Integer constants y become pow(x, int), 0.5
/// becomes sqrt.
[[nodiscard]] Expr pow(Expr x, Expr y);
[[nodiscard]] inline Expr pow(Expr x, double y) { return pow(x, Expr(y)); }
[[nodiscard]] Expr sqrt(Expr x);
[[nodiscard]] Expr exp(Expr x);
[[nodiscard]] Expr log(Expr x);
/// math/cardinal.h: cardinal(x^2, 0) is sin(x) / x, 1 at 0.
[[nodiscard]] Expr cardinal(Expr w, int order);
[[nodiscard]] Expr sin(Expr x);
[[nodiscard]] Expr cos(Expr x);
[[nodiscard]] Expr tan(Expr x);
[[nodiscard]] Expr asin(Expr x);
[[nodiscard]] Expr acos(Expr x);
[[nodiscard]] Expr atan(Expr x);
[[nodiscard]] Expr atan2(Expr y, Expr x);
[[nodiscard]] Expr sinh(Expr x);
[[nodiscard]] Expr cosh(Expr x);
[[nodiscard]] Expr tanh(Expr x);
[[nodiscard]] Expr abs(Expr x);
[[nodiscard]] Expr min(Expr x, Expr y);
[[nodiscard]] Expr max(Expr x, Expr y);
[[nodiscard]] Expr floor(Expr x);
[[nodiscard]] Expr sign(Expr x);  ///< -1, 0 or 1
[[nodiscard]] Expr less(Expr x, Expr y);
[[nodiscard]] Expr lessEqual(Expr x, Expr y);
[[nodiscard]] Expr equal(Expr x, Expr y);
[[nodiscard]] Expr notEqual(Expr x, Expr y);
/// `a` where the condition is not 0, else `b`. What is not chosen may be anything, undefined included.
[[nodiscard]] Expr select(Expr condition, Expr a, Expr b);

// Built from the above; they mean what they mean in GLSL. mod is floored: it has the sign of y.
[[nodiscard]] Expr mod(Expr x, Expr y);
[[nodiscard]] Expr clamp(Expr x, Expr lowest, Expr highest);
[[nodiscard]] Expr mix(Expr a, Expr b, Expr t);
[[nodiscard]] Expr smoothstep(Expr edge0, Expr edge1, Expr x);

/// A point of space given by three expressions: what a surface formula returns.
using ExprPoint = std::array<Expr, 3>;
[[nodiscard]] inline ExprPoint point(Expr x, Expr y, Expr z) { return {x, y, z}; }

/// One operation. Operands always have smaller indices than the node itself, so index order is evaluation
/// order.
struct ExprNode {
  Op op = Op::Constant;
  std::uint32_t a = 0, b = 0, c = 0;  ///< operands; for Variable, a = which
  double value = 0;                   ///< Constant: its value; Power: its exponent; Cardinal: its order
};

/// Where a formula is not smooth: where `guard` passes through 0 or, for the floor, through any integer.
struct Kink {
  Expr guard;
  bool atIntegers = false;
};

/// Owns the nodes. Not copyable (expressions point into it); not thread-safe while it grows. Nothing here
/// recurses, so no formula is too deep.
class Graph {
 public:
  /// Most nodes of one graph; whatever would add more throws Error(Scene). At most 72 bytes each.
  static constexpr std::size_t kMaxNodes = std::size_t{1} << 22;

  Graph() = default;
  Graph(const Graph&) = delete;
  Graph& operator=(const Graph&) = delete;

  [[nodiscard]] Expr variable(std::uint32_t index);

  /// Exact symbolic derivative with respect to variable `index`; at a kink, that of a piece beside it. Cost:
  /// linear in the nodes `f` needs. Every subexpression is differentiated once, however often it is shared.
  [[nodiscard]] Expr derivative(Expr f, std::uint32_t index);

  /// The guards of everything that makes the roots non-smooth in u and v (variables 0 and 1; the others are
  /// taken as constant): abs, sign, min, max, floor, comparisons, select, the jump of atan2. Each once.
  [[nodiscard]] std::vector<Kink> kinks(std::span<const Expr> roots);

  [[nodiscard]] const std::vector<ExprNode>& nodes() const { return nodes_; }
  /// Whether the node comes before the other one where their order is free: by what they compute, the simpler
  /// one first, and not by which was made first. That is the choice of the compiler of `f(x) * g(y)`.
  [[nodiscard]] bool precedes(std::uint32_t node, std::uint32_t other) const;
  /// Index of the node behind `f`; a constant becomes a node.
  [[nodiscard]] std::uint32_t nodeOf(Expr f);
  /// The expression behind a node; a Constant node is a constant.
  [[nodiscard]] Expr at(std::uint32_t node);

  /// Any operation, simplified: constants are folded and pulled together, neutral elements dropped, equal
  /// forms brought to one. No rule turns an undefined value into a defined one, except 0 * x = 0 and
  /// x - x = 0. `exponent` is for Power, and the
  /// order for Cardinal.
  [[nodiscard]] static Expr apply(Op op, Expr x, Expr y = {}, Expr z = {}, int exponent = 0);

 private:
  struct Simplifier;

  /// The same in every graph; of nodes that compute different things almost surely different.
  struct Rank {
    std::uint32_t height = 0;  ///< the longest way down to a constant or variable
    std::uint64_t content = 0;
  };

  struct Entry {
    std::uint32_t hash = 0;
    std::uint32_t next = 0;  ///< the number after the node's; 0: free
  };

  Expr intern(const ExprNode& node);
  [[nodiscard]] Rank rankOf(const ExprNode& node) const;
  void growTable();

  std::vector<ExprNode> nodes_;
  std::vector<Rank> ranks_;   ///< of the nodes
  std::vector<Entry> table_;  ///< of the nodes by content; open addressing
};

/// Indices of all nodes that `roots` need, ascending: a valid order of evaluation.
[[nodiscard]] std::vector<std::uint32_t> reachable(const Graph& graph,
                                                   const std::vector<std::uint32_t>& roots);

/// The same nodes, each right before it is needed for the first time, operands first: an order that depends
/// on the formulas alone, and not on when their nodes were made.
[[nodiscard]] std::vector<std::uint32_t> inOrderOfNeed(const Graph& graph,
                                                       const std::vector<std::uint32_t>& roots);

}  // namespace luxo
