// SPDX-License-Identifier: Apache-2.0
// The rules by which Graph::apply simplifies. Every rule only looks at the operands and their operands, and
// every rewritten form is final but for a bounded number of further rules, so the cost is constant.
#include <cmath>
#include <cstdlib>
#include <optional>
#include <utility>

#include "base/assert.h"
#include "formula/expression.h"
#include "formula/operation.h"

namespace luxo {
namespace {

/// Larger integer exponents go to Raise: a power by squaring that long has no correct digits left.
constexpr int kLargestExponent = 1 << 20;

/// A constant that may replace two: merging must not overflow or vanish.
bool usable(double c) { return std::isfinite(c) && std::abs(c) >= std::numeric_limits<double>::min(); }
bool usableSum(double c) { return std::isfinite(c); }

bool commutes(Op op) {
  return op == Op::Add || op == Op::Multiply || op == Op::Min || op == Op::Max || op == Op::Equal;
}

}  // namespace

struct Graph::Simplifier {
  struct Scaled {
    double factor;
    Expr term;
  };
  struct Shifted {
    double offset;
    double sign;
    Expr term;
  };
  struct Raised {
    Expr base;
    int exponent;
  };

  static bool is(const Expr& e, double value) { return e.isConstant() && e.constant_ == value; }
  static bool is(const Expr& e, Op op) { return !e.isConstant() && node(e).op == op; }
  static bool same(const Expr& x, const Expr& y) {
    return !x.isConstant() && !y.isConstant() && x.node_ == y.node_;
  }
  static const ExprNode& node(const Expr& e) { return e.graph_->nodes_[e.node_]; }
  static Expr a(const Expr& e) { return e.graph_->at(node(e).a); }
  static Expr b(const Expr& e) { return e.graph_->at(node(e).b); }
  static Expr c(const Expr& e) { return e.graph_->at(node(e).c); }

  /// e = factor * term.
  static Scaled scaled(const Expr& e) {
    if (is(e, Op::Negate)) return {-1, a(e)};
    if (is(e, Op::Multiply) && a(e).isConstant()) return {a(e).constant_, b(e)};
    return {1, e};
  }
  /// e = offset + sign * term.
  static Shifted shifted(const Expr& e) {
    if (is(e, Op::Add) && a(e).isConstant()) return {a(e).constant_, 1, b(e)};
    if (is(e, Op::Subtract) && a(e).isConstant()) return {a(e).constant_, -1, b(e)};
    return {0, 1, e};
  }
  static Raised raised(const Expr& e) {
    if (is(e, Op::Power)) return {a(e), static_cast<int>(node(e).value)};
    return {e, 1};
  }
  /// The x of e = -x, if that is no dearer than e.
  static std::optional<Expr> negated(const Expr& e) {
    if (e.isConstant()) return e.constant_ < 0 ? std::optional<Expr>(-e.constant_) : std::nullopt;
    const auto [factor, term] = scaled(e);
    return factor < 0 ? std::optional<Expr>(-factor * term) : std::nullopt;
  }
  static bool neverNegative(const Expr& e) {
    return is(e, Op::Abs) || is(e, Op::Sqrt) || is(e, Op::Exp) || is(e, Op::Cosh) ||
           (is(e, Op::Power) && raised(e).exponent % 2 == 0);
  }
  static Expr plus(double offset, double sign, const Expr& term) {
    return sign > 0 ? Expr(offset) + term : Expr(offset) - term;
  }

  using Result = std::optional<Expr>;

  static Result negate(const Expr& x) {
    if (const auto [factor, term] = scaled(x); factor != 1) return -factor * term;
    if (is(x, Op::Subtract)) return b(x) - a(x);
    if (is(x, Op::Add) && a(x).isConstant()) return Expr(-a(x).constant_) - b(x);
    return {};
  }

  /// x + sign * y, where y is no constant unless x is.
  static Result sum(const Expr& x, double sign, const Expr& y) {
    if (is(x, 0)) return sign > 0 ? y : -y;
    if (x.isConstant()) {
      const Shifted s = shifted(y);
      if (const double offset = x.constant_ + sign * s.offset; s.offset != 0 && usableSum(offset))
        return plus(offset, sign * s.sign, s.term);
    } else {
      const Scaled p = scaled(x), q = scaled(y);
      if (const double factor = p.factor + sign * q.factor; same(p.term, q.term) && usableSum(factor))
        return factor * p.term;
      const Shifted s = shifted(x), t = shifted(y);
      if (const double offset = s.offset + sign * t.offset;
          s.offset != 0 && t.offset != 0 && usableSum(offset)) {
        const Expr terms = s.sign > 0 ? (sign * t.sign > 0 ? s.term + t.term : s.term - t.term)
                                      : (sign * t.sign > 0 ? t.term - s.term : -(s.term + t.term));
        return offset + terms;
      }
      if (const auto minusX = negated(x)) return sign > 0 ? y - *minusX : -(*minusX + y);
    }
    if (const auto minusY = negated(y)) return sign > 0 ? x - *minusY : x + *minusY;
    return {};
  }

  static Result add(const Expr& x, const Expr& y) { return y.isConstant() ? sum(y, 1, x) : sum(x, 1, y); }

  static Result subtract(const Expr& x, const Expr& y) {
    if (y.isConstant()) return Expr(-y.constant_) + x;
    return sum(x, -1, y);
  }

  static Result multiplyBy(double factor, const Expr& x) {
    if (factor == 0) return 0;
    if (factor == 1) return x;
    if (factor == -1) return -x;
    if (const auto [inner, term] = scaled(x); inner != 1 && usable(factor * inner))
      return factor * inner * term;
    if (is(x, Op::Divide) && a(x).isConstant() && usable(factor * a(x).constant_))
      return factor * a(x).constant_ / b(x);
    if (is(x, Op::Divide) && b(x).isConstant() && usable(factor / b(x).constant_))
      return factor / b(x).constant_ * a(x);
    return {};
  }

  static Result multiply(const Expr& x, const Expr& y) {
    if (x.isConstant()) return multiplyBy(x.constant_, y);
    if (y.isConstant()) return multiplyBy(y.constant_, x);
    const Scaled p = scaled(x), q = scaled(y);
    if ((p.factor != 1 || q.factor != 1) && usable(p.factor * q.factor))
      return p.factor * q.factor * (p.term * q.term);
    const Raised r = raised(x), s = raised(y);
    // Of one sign only: x * x^-1 is not defined at 0, 1 is.
    if (same(r.base, s.base) && (r.exponent > 0) == (s.exponent > 0))
      return pow(r.base, r.exponent + s.exponent);
    return {};
  }

  static Result divide(const Expr& x, const Expr& y) {
    if (is(x, 0)) return 0;
    if (y.isConstant()) {
      const double divisor = y.constant_;
      if (divisor == 1) return x;
      if (divisor < 0) return -(x / -divisor);
      int power = 0;
      if (usable(divisor) && usable(1 / divisor) && std::frexp(divisor, &power) == 0.5)
        return 1 / divisor * x;  // exact
      const Scaled p = scaled(x);
      if (p.factor == -1) return -(p.term / y);
      if (p.factor != 1 && usable(p.factor / divisor)) return p.factor / divisor * p.term;
      if (is(x, Op::Divide) && b(x).isConstant() && usable(b(x).constant_ * divisor))
        return a(x) / (b(x).constant_ * divisor);
      return {};
    }
    const Scaled q = scaled(y);
    if (x.isConstant()) {
      if (q.factor != 1 && usable(x.constant_ / q.factor)) return x.constant_ / q.factor / q.term;
      return {};
    }
    const Scaled p = scaled(x);
    if ((p.factor != 1 || q.factor != 1) && usable(p.factor / q.factor))
      return p.factor / q.factor * (p.term / q.term);
    if (same(x, y) && (is(x, Op::Exp) || is(x, Op::Cosh))) return 1;  // never 0
    return {};
  }

  static Result power(const Expr& x, int exponent) {
    if (exponent == 0) return 1;
    if (exponent == 1) return x;
    if (exponent == -1) return 1 / x;
    if (std::abs(static_cast<double>(exponent)) > kLargestExponent)
      return apply(Op::Raise, x, static_cast<double>(exponent));
    if (const auto minusX = negated(x))
      return exponent % 2 == 0 ? pow(*minusX, exponent) : -pow(*minusX, exponent);
    if (is(x, Op::Abs) && exponent % 2 == 0) return pow(a(x), exponent);
    if (const Raised r = raised(x);
        r.exponent != 1 && std::abs(1.0 * r.exponent * exponent) <= kLargestExponent)
      return pow(r.base, r.exponent * exponent);
    return {};
  }

  static Result raise(const Expr& x, const Expr& y) {
    if (is(x, 1)) return 1;
    if (is(y, 0.5)) return sqrt(x);
    if (y.isConstant() && std::abs(y.constant_) <= kLargestExponent && std::floor(y.constant_) == y.constant_)
      return pow(x, static_cast<int>(y.constant_));
    return {};
  }

  static Result ofOne(Op op, const Expr& x) {
    switch (op) {
      case Op::Sin:
      case Op::Tan:
      case Op::Sinh:
      case Op::Tanh:
      case Op::Asin:
      case Op::Atan:
      case Op::Sign:
        if (const auto minusX = negated(x)) return -apply(op, *minusX);
        if (op == Op::Sign && is(x, Op::Sign)) return x;
        return {};
      case Op::Cos:
      case Op::Cosh:
      case Op::Abs:
        if (const auto minusX = negated(x)) return apply(op, *minusX);
        if (op == Op::Abs && neverNegative(x)) return x;
        return {};
      case Op::Sqrt:
        if (const Raised r = raised(x); r.exponent > 0 && r.exponent % 2 == 0)
          return abs(pow(r.base, r.exponent / 2));
        return {};
      case Op::Log:
        return is(x, Op::Exp) ? Result(a(x)) : Result();
      case Op::Floor:
        return is(x, Op::Floor) || is(x, Op::Sign) ? Result(x) : Result();
      default:
        return {};
    }
  }

  static Result choose(const Expr& condition, const Expr& x, const Expr& y) {
    if (condition.isConstant()) return condition.constant_ != 0 ? x : y;
    if (same(x, y) || (x.isConstant() && is(y, x.constant_))) return x;
    // not(c) is 1 - c.
    if (is(condition, Op::Subtract) && is(a(condition), 1) && is(b(condition), Op::Equal))
      return select(b(condition), y, x);
    return {};
  }

  static Result simplify(Op op, const Expr& x, const Expr& y, const Expr& z, int exponent) {
    switch (op) {
      case Op::Negate:
        return negate(x);
      case Op::Add:
        return add(x, y);
      case Op::Subtract:
        return subtract(x, y);
      case Op::Multiply:
        return multiply(x, y);
      case Op::Divide:
        return divide(x, y);
      case Op::Power:
        return power(x, exponent);
      case Op::Raise:
        return raise(x, y);
      case Op::Min:
      case Op::Max:
        return same(x, y) ? Result(x) : Result();
      case Op::Less:
        return same(x, y) ? Result(0) : Result();
      case Op::LessEqual:
      case Op::Equal:
        return same(x, y) ? Result(1) : Result();
      case Op::Select:
        return choose(x, y, z);
      default:
        return ofOne(op, x);
    }
  }
};

Expr Graph::apply(Op op, Expr x, Expr y, Expr z, int exponent) {
  const int operands = operandCount(op);
  const bool allConstant =
      x.isConstant() && (operands < 2 || y.isConstant()) && (operands < 3 || z.isConstant());
  // A folded -0 would be a second 0.
  if (allConstant) return 0.0 + operate(op, x.constant_, y.constant_, z.constant_, exponent);
  Graph* graph = !x.isConstant() ? x.graph_ : !y.isConstant() ? y.graph_ : z.graph_;
  for (const Expr& operand : {x, y, z}) LUXO_REQUIRE(operand.isConstant() || operand.graph_ == graph);
  if (const auto simpler = Simplifier::simplify(op, x, y, z, exponent)) return *simpler;

  ExprNode node{.op = op, .a = graph->nodeOf(x)};
  if (operands > 1) node.b = graph->nodeOf(y);
  if (operands > 2) node.c = graph->nodeOf(z);
  if (op == Op::Power || op == Op::Cardinal) node.value = exponent;
  // One order of operands finds more equal nodes: constants first.
  if (commutes(op) && !x.isConstant() && (y.isConstant() || graph->precedes(node.b, node.a)))
    std::swap(node.a, node.b);
  return graph->intern(node);
}

}  // namespace luxo
