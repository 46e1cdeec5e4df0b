// SPDX-License-Identifier: Apache-2.0
#include "formula/pieces.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <unordered_map>
#include <utility>

#include "formula/operation.h"
#include "formula/tape.h"

namespace luxo {
namespace {

constexpr double kNarrow = 0x1p-50;       // of the range: a cut is known to this
constexpr double kMargin = 1e-9;          // of a side: how far inside an edge a piece is looked at
constexpr int kMaxEvaluations = 20'000;   // per guard
constexpr std::size_t kMaxChoices = 256;  // looked at one by one, each at the cost of the formula

bool dependsOnlyOn(const Graph& graph, std::uint32_t root, std::uint32_t axis) {
  for (const std::uint32_t i : reachable(graph, {root}))
    if (graph.nodes()[i].op == Op::Variable && graph.nodes()[i].a != axis) return false;
  return true;
}

/// Finds the zeros (or the places of integer value) of a function of one variable.
class ZeroFinder {
 public:
  ZeroFinder(Graph& graph, const Kink& kink, std::uint32_t axis)
      : tape_(graph, std::span(&kink.guard, 1)), atIntegers_(kink.atIntegers), axis_(axis) {}

  /// Nothing when there are too many or they fill an interval.
  std::optional<std::vector<double>> find(const Interval& range) {
    std::vector<Interval> open{range}, narrow;
    for (int evaluations = 0; !open.empty(); ++evaluations) {
      if (evaluations == kMaxEvaluations) return std::nullopt;
      const Interval x = open.back();
      open.pop_back();
      if (!mayCross(x)) continue;
      if (x.width() <= kNarrow * range.width()) {
        // Depth first, from the right: neighbours come one after the other.
        if (!narrow.empty() && narrow.back().lo <= x.hi + kNarrow * range.width())
          narrow.back().lo = x.lo;
        else
          narrow.push_back(x);
        continue;
      }
      open.emplace_back(x.lo, x.mid());
      open.emplace_back(x.mid(), x.hi);
    }
    std::vector<double> zeros;
    for (auto place = narrow.rbegin(); place != narrow.rend(); ++place) zeros.push_back(zeroIn(*place));
    return zeros;
  }

 private:
  [[nodiscard]] Interval bound(const Interval& x) const {
    Interval value;
    tape_.bound(axis_ == 0 ? x : Interval(0), axis_ == 1 ? x : Interval(0), {}, {&value, 1});
    return value;
  }

  [[nodiscard]] bool mayCross(const Interval& x) const {
    const Interval g = bound(x);
    return atIntegers_ ? std::floor(g.lo) != std::floor(g.hi) || g.lo == std::floor(g.lo) : g.contains(0);
  }

  /// The point itself where a double is one, else one beside it: bisection by sign.
  [[nodiscard]] double zeroIn(const Interval& place) const {
    const double target = atIntegers_ ? std::round(at(place.mid())) : 0;
    Interval x = place;
    const double before = at(x.lo) - target;
    if (before == 0) return x.lo;
    for (double middle = x.mid(); x.lo < middle && middle < x.hi; middle = x.mid()) {
      const double there = at(middle) - target;
      if (there == 0) return middle;
      (there > 0) == (before > 0) ? x.lo = middle : x.hi = middle;
    }
    return x.hi;
  }

  [[nodiscard]] double at(double x) const {
    double value = 0;
    tape_.evaluatePoint(axis_ == 0 ? x : 0, axis_ == 1 ? x : 0, {}, {&value, 1});
    return value;
  }

  Tape tape_;
  bool atIntegers_;
  std::uint32_t axis_;
};

/// Rewrites a formula for one rectangle.
class Resolver {
 public:
  Resolver(Graph& graph, const Interval& u, const Interval& v)
      : graph_(graph), u_(inside(u)), v_(inside(v)) {}

  std::vector<Expr> resolve(std::span<const Expr> roots) {
    std::vector<std::uint32_t> indices;
    for (const Expr& root : roots) indices.push_back(graph_.nodeOf(root));
    // Operands come before what is made of them, and have been rewritten when it is.
    std::unordered_map<std::uint32_t, Expr> rewritten;
    for (const std::uint32_t i : reachable(graph_, indices)) {
      const ExprNode node = graph_.nodes()[i];
      const int operands = operandCount(node.op);
      if (operands == 0) {
        rewritten[i] = graph_.at(i);
        continue;
      }
      const Expr a = rewritten[node.a];
      const Expr b = operands > 1 ? rewritten[node.b] : Expr(), c = operands > 2 ? rewritten[node.c] : Expr();
      const auto chosen = choice(node.op, a, b);
      rewritten[i] = chosen ? *chosen : Graph::apply(node.op, a, b, c, static_cast<int>(node.value));
    }
    std::vector<Expr> resolved;
    for (const std::uint32_t i : indices) resolved.push_back(rewritten[i]);
    return resolved;
  }

 private:
  static Interval inside(const Interval& x) {
    return {x.lo + kMargin * x.width(), x.hi - kMargin * x.width()};
  }

  /// What an operation always chooses here.
  std::optional<Expr> choice(Op op, Expr a, Expr b) {
    switch (op) {
      case Op::Abs:
        if (const auto sign = signOf(a)) return *sign >= 0 ? a : -a;
        break;
      case Op::Sign:
        if (const auto sign = signOf(a); sign && *sign != 0) return Expr(*sign);
        break;
      case Op::Floor: {
        const Interval x = bound(a);
        if (std::isfinite(x.lo) && std::floor(x.lo) == std::floor(x.hi)) return Expr(std::floor(x.lo));
        break;
      }
      case Op::Min:
        if (const auto sign = signOf(a - b)) return *sign <= 0 ? a : b;
        break;
      case Op::Max:
        if (const auto sign = signOf(a - b)) return *sign >= 0 ? a : b;
        break;
      case Op::Less:
      case Op::LessEqual:
        if (const auto sign = signOf(a - b); sign && *sign != 0) return Expr(*sign < 0 ? 1 : 0);
        break;
      case Op::Equal:
        if (const auto sign = signOf(a - b); sign && *sign != 0) return Expr(0);
        break;
      default:
        break;
    }
    return std::nullopt;
  }

  /// -1, 0 or 1 if it is the same all over the rectangle.
  std::optional<double> signOf(Expr x) {
    if (x.isConstant()) return number::sign(x.constant());
    const Interval range = bound(x);
    if (range.lo > 0) return 1;
    if (range.hi < 0) return -1;
    return std::nullopt;
  }

  Interval bound(Expr x) {
    if (x.isConstant()) return x.constant();
    if (++choices_ > kMaxChoices) return Interval::everything();
    std::unordered_map<std::uint32_t, Interval> values;
    const std::uint32_t root = graph_.nodeOf(x);
    for (const std::uint32_t i : reachable(graph_, {root})) {
      const ExprNode& node = graph_.nodes()[i];
      if (node.op == Op::Constant)
        values[i] = node.value;
      else if (node.op == Op::Variable)
        values[i] = node.a == 0 ? u_ : node.a == 1 ? v_ : Interval::everything();
      else
        values[i] = operate<Interval>(node.op, values[node.a], values[node.b], values[node.c],
                                      static_cast<int>(node.value));
    }
    return values[root];
  }

  Graph& graph_;
  Interval u_, v_;
  std::size_t choices_ = 0;
};

}  // namespace

std::vector<double> kinkLines(Graph& graph, std::span<const Expr> roots, std::uint32_t axis,
                              const Interval& range) {
  std::vector<double> lines;
  for (const Kink& kink : graph.kinks(roots)) {
    if (!dependsOnlyOn(graph, graph.nodeOf(kink.guard), axis)) continue;
    const auto zeros = ZeroFinder(graph, kink, axis).find(range);
    if (!zeros) return {};
    lines.insert(lines.end(), zeros->begin(), zeros->end());
  }
  std::ranges::sort(lines);
  // One line may come from several guards, and edges are cut already.
  const double close = 4 * kNarrow * range.width();
  std::vector<double> distinct;
  for (const double line : lines)
    if (line - range.lo > close && range.hi - line > close &&
        (distinct.empty() || line - distinct.back() > close))
      distinct.push_back(line);
  return distinct.size() <= kMaxCuts ? distinct : std::vector<double>{};
}

std::vector<Expr> pieceOf(Graph& graph, std::span<const Expr> roots, const Interval& u, const Interval& v) {
  return Resolver(graph, u, v).resolve(roots);
}

}  // namespace luxo
