// SPDX-License-Identifier: Apache-2.0
#include "formula/removable.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>

namespace luxo {
namespace {

// Beyond these a polynomial is one unknown: what users divide out is far smaller.
constexpr std::size_t kMaxTerms = 48, kMaxFactors = 24;
constexpr int kMaxPower = 12, kMaxDepth = 24;

/// Unknowns, which are nodes, with their exponents.
using Monomial = std::map<std::uint32_t, int>;

/// The lexicographic order of monomials: the larger one has more of the first unknown in which they differ.
/// Multiplication keeps it.
struct Less {
  bool operator()(const Monomial& x, const Monomial& y) const {
    auto a = x.begin(), b = y.begin();
    for (; a != x.end() && b != y.end(); ++a, ++b) {
      if (a->first != b->first) return a->first > b->first;
      if (a->second != b->second) return a->second < b->second;
    }
    return a == x.end() && b != y.end();
  }
};

using Polynomial = std::map<Monomial, double, Less>;

void addTo(Polynomial& sum, const Monomial& monomial, double coefficient) {
  const auto [term, isNew] = sum.try_emplace(monomial, coefficient);
  if (!isNew) term->second += coefficient;
  if (term->second == 0) sum.erase(term);
}

Monomial product(Monomial x, const Monomial& y) {
  for (const auto& [unknown, exponent] : y) x[unknown] += exponent;
  return x;
}

std::optional<Monomial> quotient(Monomial x, const Monomial& y) {
  for (const auto& [unknown, exponent] : y) {
    const auto own = x.find(unknown);
    if (own == x.end() || own->second < exponent) return {};
    if ((own->second -= exponent) == 0) x.erase(own);
  }
  return x;
}

Monomial commonPart(const Monomial& x, const Monomial& y) {
  Monomial common;
  for (const auto& [unknown, exponent] : x)
    if (const auto other = y.find(unknown); other != y.end())
      common[unknown] = std::min(exponent, other->second);
  return common;
}

Polynomial sum(Polynomial x, const Polynomial& y, double sign = 1) {
  for (const auto& [monomial, coefficient] : y) addTo(x, monomial, sign * coefficient);
  return x;
}

Polynomial product(const Polynomial& x, const Polynomial& y) {
  Polynomial result;
  for (const auto& [m, a] : x)
    for (const auto& [n, b] : y) addTo(result, product(m, n), a * b);
  return result;
}

/// Long division; nothing unless it comes out even, coefficients and all.
std::optional<Polynomial> quotient(Polynomial x, const Polynomial& y) {
  Polynomial result;
  const auto& [leading, coefficient] = *y.rbegin();
  while (!x.empty()) {
    const auto factor = quotient(x.rbegin()->first, leading);
    const double times = x.rbegin()->second / coefficient;
    if (!factor || !std::isfinite(times) || times * coefficient != x.rbegin()->second ||
        result.size() == kMaxTerms)
      return {};
    addTo(result, *factor, times);
    for (const auto& [monomial, c] : y) addTo(x, product(*factor, monomial), -times * c);
  }
  return result;
}

/// Which functions show their factors: as few as need to, so that formulas stay what they are.
enum class Shown { None, Zeros, Ones };

class Continuation {
 public:
  Continuation(Graph& graph, std::size_t nodes) : graph_(graph), continued_(nodes) {}

  void visit(std::uint32_t index) {
    const ExprNode node = graph_.nodes()[index];
    const auto of = [&](std::uint32_t operand) {
      return graph_.nodes()[operand].op == Op::Constant ? graph_.at(operand) : continued_[operand];
    };
    const int operands = operandCount(node.op);
    Expr self = graph_.at(index);
    if (operands > 0 &&
        (differs(node.a) || (operands > 1 && differs(node.b)) || (operands > 2 && differs(node.c))))
      self = Graph::apply(node.op, of(node.a), operands > 1 ? of(node.b) : Expr(),
                          operands > 2 ? of(node.c) : Expr(), static_cast<int>(node.value));
    const bool isQuotient =
        node.op == Op::Divide || node.op == Op::Multiply || (node.op == Op::Power && node.value < 0);
    continued_[index] = isQuotient && !self.isConstant() ? dividedOut(self) : self;
  }

  [[nodiscard]] Expr at(std::uint32_t index) const { return continued_[index]; }

 private:
  struct Factor {
    Expr whole;
    int times = 1;
    std::optional<Polynomial> rest;  ///< of it, once something was divided out
  };

  [[nodiscard]] bool differs(std::uint32_t operand) {
    if (graph_.nodes()[operand].op == Op::Constant) return false;
    const Expr now = continued_[operand];
    return now.isConstant() || graph_.nodeOf(now) != operand;
  }

  /// e as factor * product of `above` / product of `below`; false where there are too many.
  bool collect(const Expr& e, std::vector<Factor>& above, std::vector<Factor>& below, double& factor) {
    std::vector<std::pair<Expr, int>> open{{e, 1}};
    while (!open.empty()) {
      const auto [x, power] = open.back();
      open.pop_back();
      if (x.isConstant()) {
        factor *= std::pow(x.constant(), power);
        continue;
      }
      const ExprNode node = graph_.nodes()[graph_.nodeOf(x)];
      if (node.op == Op::Negate) {
        if (power % 2 != 0) factor = -factor;
        open.emplace_back(graph_.at(node.a), power);
      } else if (node.op == Op::Multiply || node.op == Op::Divide) {
        open.emplace_back(graph_.at(node.a), power);
        open.emplace_back(graph_.at(node.b), node.op == Op::Divide ? -power : power);
      } else if (node.op == Op::Power && std::abs(node.value * power) <= kMaxPower) {
        open.emplace_back(graph_.at(node.a), power * static_cast<int>(node.value));
      } else {
        (power > 0 ? above : below).push_back({x, std::abs(power)});
      }
      if (above.size() + below.size() + open.size() > kMaxFactors) return false;
    }
    return std::isfinite(factor) && factor != 0;
  }

  Expr dividedOut(const Expr& e) {
    std::vector<Factor> above, below;
    double factor = 1;
    if (!collect(e, above, below, factor) || above.empty() || below.empty()) return e;
    splitSums(below);
    bool changed = false;
    for (Factor& divisor : below)
      while (divisor.times > 0 && divideOut(divisor.whole, above)) {
        --divisor.times;
        changed = true;
      }
    if (!changed) return e;
    Expr result = factor;
    for (const Factor& f : above) result = result * (f.rest ? expressionOf(*f.rest) : pow(f.whole, f.times));
    for (const Factor& f : below)
      if (f.times > 0) result = result / pow(f.whole, f.times);
    return result;
  }

  /// u^2 + u v is u times a sum.
  void splitSums(std::vector<Factor>& factors) {
    const std::size_t count = factors.size();
    for (std::size_t i = 0; i < count; ++i) {
      const Polynomial p = polynomialOf(factors[i].whole, Shown::None);
      if (p.size() < 2) continue;
      Monomial common = p.begin()->first;
      for (const auto& [monomial, coefficient] : p) common = commonPart(common, monomial);
      if (common.empty()) continue;
      factors[i].whole = expressionOf(*quotient(p, {{common, 1.0}}));
      for (const auto& [unknown, exponent] : common)
        factors.push_back({graph_.at(unknown), exponent * factors[i].times});
    }
  }

  /// Out of one of the factors, or else of all of them together.
  bool divideOut(const Expr& divisor, std::vector<Factor>& above) {
    for (const Shown shown : {Shown::None, Shown::Zeros, Shown::Ones}) {
      const Polynomial below = polynomialOf(divisor, Shown::None);
      if (below.empty() || below.rbegin()->first.empty()) return false;  // 0, or another constant
      for (Factor& f : above)
        if (const auto rest = quotient(powerOf(f, shown), below)) {
          f.rest = *rest;
          return true;
        }
      Polynomial all{{{}, 1.0}};
      for (const Factor& f : above) {
        all = product(all, powerOf(f, shown));
        if (all.size() > kMaxTerms) break;
      }
      if (const auto rest = quotient(all, below); rest && all.size() <= kMaxTerms) {
        above = {{1, 1, *rest}};
        return true;
      }
    }
    return false;
  }

  Polynomial powerOf(const Factor& f, Shown shown) {
    if (f.rest) return *f.rest;
    const Polynomial one = polynomialOf(f.whole, shown);
    Polynomial all{{{}, 1.0}};
    for (int k = 0; k < f.times; ++k) {
      all = product(all, one);
      if (all.size() > kMaxTerms) return unknown(pow(f.whole, f.times));
    }
    return all;
  }

  Polynomial unknown(const Expr& e) {
    if (e.isConstant() && std::isfinite(e.constant())) return constant(e.constant());
    return {{Monomial{{graph_.nodeOf(e), 1}}, 1.0}};
  }
  static Polynomial constant(double c) { return c == 0 ? Polynomial() : Polynomial{{{}, c}}; }

  const Polynomial& polynomialOf(const Expr& e, Shown shown, int depth = 0) {
    const std::pair key{graph_.nodeOf(e), shown};
    const auto known = polynomials_.find(key);
    if (known != polynomials_.end()) return known->second;
    return polynomials_.emplace(key, polynomialAnew(e, shown, depth)).first->second;
  }

  Polynomial polynomialAnew(const Expr& e, Shown shown, int depth) {
    if (e.isConstant() || depth == kMaxDepth) return unknown(e);
    const ExprNode node = graph_.nodes()[graph_.nodeOf(e)];
    const auto of = [&](std::uint32_t operand) -> const Polynomial& {
      return polynomialOf(graph_.at(operand), shown, depth + 1);
    };
    Polynomial result;
    switch (node.op) {
      case Op::Negate:
        return sum({}, of(node.a), -1);
      case Op::Add:
        result = sum(of(node.a), of(node.b));
        break;
      case Op::Subtract:
        result = sum(of(node.a), of(node.b), -1);
        break;
      case Op::Multiply:
        result = product(of(node.a), of(node.b));
        break;
      case Op::Power: {
        if (node.value < 0 || node.value > kMaxPower) return unknown(e);
        const Polynomial base = of(node.a);
        result = constant(1);
        for (int k = 0; k < node.value && result.size() <= kMaxTerms; ++k) result = product(result, base);
        break;
      }
      default:
        if (const auto function = functionOf(node, shown, depth)) return *function;
        return unknown(e);
    }
    return result.size() <= kMaxTerms ? result : unknown(e);
  }

  /// A function with its factor shown.
  std::optional<Polynomial> functionOf(const ExprNode& node, Shown shown, int depth) {
    const bool isZero = node.op == Op::Sin || node.op == Op::Sinh || node.op == Op::Tan;
    const bool isOne = node.op == Op::Cos || node.op == Op::Cosh || node.op == Op::Exp;
    if (!(isZero && shown != Shown::None) && !(isOne && shown == Shown::Ones)) return {};
    const Expr x = graph_.at(node.a);
    const Polynomial a = polynomialOf(x, Shown::None, depth + 1);
    const Expr square = squareOf(x);
    const bool turning = node.op == Op::Sin || node.op == Op::Cos || node.op == Op::Tan;
    const double sign = turning ? 1 : -1;
    if (isZero) {
      const Polynomial found = product(a, unknown(cardinal(sign * square, 0)));
      return node.op == Op::Tan ? product(found, unknown(1 / cos(x))) : found;
    }
    const Polynomial half = unknown(cardinal(0.25 * sign * square, 0));
    if (node.op == Op::Exp) return sum(constant(1), product(a, product(unknown(exp(0.5 * x)), half)));
    const Polynomial chord = product(a, half);
    return sum(constant(1), product(chord, chord), -0.5 * sign);
  }

  /// x^2, and without the roots in x where what is under them is never negative.
  Expr squareOf(const Expr& x) {
    const Polynomial p = polynomialOf(x, Shown::None);
    if (p.size() != 1) return pow(x, 2);
    const auto& [monomial, coefficient] = *p.begin();
    Expr result = coefficient * coefficient;
    for (const auto& [index, exponent] : monomial) {
      const ExprNode node = graph_.nodes()[index];
      const bool root = node.op == Op::Sqrt && neverNegative(graph_.at(node.a));
      result = result * (root ? pow(graph_.at(node.a), exponent) : pow(graph_.at(index), 2 * exponent));
    }
    return result;
  }

  bool neverNegative(const Expr& e, int depth = 0) {
    if (e.isConstant()) return e.constant() >= 0;
    if (depth == kMaxDepth) return false;
    const ExprNode node = graph_.nodes()[graph_.nodeOf(e)];
    switch (node.op) {
      case Op::Power:
        return static_cast<int>(node.value) % 2 == 0;
      case Op::Abs:
      case Op::Sqrt:
      case Op::Exp:
      case Op::Cosh:
        return true;
      case Op::Add:
      case Op::Multiply:
      case Op::Divide:
        return neverNegative(graph_.at(node.a), depth + 1) && neverNegative(graph_.at(node.b), depth + 1);
      default:
        return false;
    }
  }

  Expr expressionOf(const Polynomial& p) {
    Expr result = 0;
    for (const auto& [monomial, coefficient] : p) {
      Expr term = coefficient;
      for (const auto& [unknown, exponent] : monomial) term = term * pow(graph_.at(unknown), exponent);
      result = result + term;
    }
    return result;
  }

  Graph& graph_;
  std::vector<Expr> continued_;                                        ///< by node
  std::map<std::pair<std::uint32_t, Shown>, Polynomial> polynomials_;  ///< by node
};

}  // namespace

std::vector<Expr> continued(Graph& graph, std::span<const Expr> roots) {
  std::vector<std::uint32_t> indices;
  for (const Expr& root : roots) indices.push_back(graph.nodeOf(root));
  Continuation continuation(graph, graph.nodes().size());
  for (const std::uint32_t index : reachable(graph, indices)) continuation.visit(index);
  std::vector<Expr> results;
  for (const std::uint32_t index : indices) results.push_back(continuation.at(index));
  return results;
}

}  // namespace luxo
