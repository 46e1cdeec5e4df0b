// SPDX-License-Identifier: Apache-2.0
// A compiled list of expressions: evaluated over batches of doubles, over whole grids, or bounded over a
// rectangle. Variable 0 is u, variable 1 is v; the others are parameters, the same for every point of a call.
//
// Every way of evaluating gives the same bits at the same point. The working memory belongs to the calling
// thread and is kept from call to call.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "formula/expression.h"
#include "math/interval.h"
#include "math/partial_interval.h"

namespace luxo {

/// Where the values of one output go: value i to first[i * stride].
struct OutputArray {
  double* first = nullptr;
  std::size_t stride = 1;
};

/// Immutable once built; it copies what it needs, so the graph may go. Safe from any thread.
class Tape {
 public:
  Tape() = default;
  /// Cost: linear in the nodes the outputs need.
  Tape(Graph& graph, std::span<const Expr> outputs);

  [[nodiscard]] std::size_t outputCount() const { return outputs_.size(); }
  /// Operations of one evaluation at one point.
  [[nodiscard]] std::size_t stepCount() const { return steps_.size(); }

  /// Whether both do the same to the same numbers, step by step, and so give the same bits everywhere. Of a
  /// formula that is written in two ways: no.
  friend bool operator==(const Tape& a, const Tape& b);
  /// The same of equal ones.
  [[nodiscard]] std::uint64_t hash() const;

  /// Output k at every (u[i], v[i]) in result[k][i].
  [[nodiscard]] std::vector<std::vector<double>> evaluate(std::span<const double> u,
                                                          std::span<const double> v,
                                                          std::span<const double> parameters) const;
  /// The same into memory of the caller's choice, one destination per output.
  void evaluate(std::span<const double> u, std::span<const double> v, std::span<const double> parameters,
                std::span<const OutputArray> destinations) const;

  /// Output k at every (u[i], v[j]) in result[k][j * u.size() + i]: bit for bit what evaluate() gives there.
  /// What depends on u alone is computed once per column and what depends on v alone once per row, so that a
  /// grid of n x m points of a typical surface takes n + m sines and cosines, not n * m.
  [[nodiscard]] std::vector<std::vector<double>> evaluateGrid(std::span<const double> u,
                                                              std::span<const double> v,
                                                              std::span<const double> parameters) const;
  void evaluateGrid(std::span<const double> u, std::span<const double> v, std::span<const double> parameters,
                    std::span<const OutputArray> destinations) const;

  /// The outputs at one point; `values` takes one per output. Allocates nothing.
  void evaluatePoint(double u, double v, std::span<const double> parameters, std::span<double> values) const;

  /// The same in single precision, every operation of it: what a shader makes of the formula.
  void evaluateInSingle(float u, float v, std::span<const double> parameters, std::span<float> values) const;

  /// Intervals that hold every output over the rectangle u x v (rigorous: outward rounding). `bounds` takes
  /// one per output. A bounded interval also says that the output is defined all over the rectangle.
  /// Allocates nothing.
  void bound(const Interval& u, const Interval& v, std::span<const double> parameters,
             std::span<Interval> bounds) const;
  /// The same of formulas that are not defined all over the rectangle: intervals that hold what they give
  /// where they are, and whether they are anywhere.
  void boundWhereDefined(const Interval& u, const Interval& v, std::span<const double> parameters,
                         std::span<PartialInterval> bounds) const;

  /// The outputs as expressions again, in any graph: to make something else of a formula that was compiled.
  /// Variables that are known are those values, or expressions of that graph. Cost: linear.
  [[nodiscard]] std::vector<Expr> expressions(Graph& graph,
                                              const std::map<std::uint32_t, Expr>& known = {}) const;

 private:
  /// What a value depends on decides how often it is computed. A formula runs in this order.
  enum class Rate : std::uint8_t { Once, PerColumn, PerRow, PerPoint };
  static constexpr int kRates = 4;

  /// Values are numbered: constants, then variables, then results in order of evaluation.
  struct Step {
    Op op = Op::Constant;
    bool paired = false;  ///< a sine that gives the cosine of its operand as the next value
    int exponent = 0;
    std::uint32_t result = 0;
    std::uint32_t a = 0, b = 0, c = 0;

    friend bool operator==(const Step&, const Step&) = default;
  };
  struct Batch;

  void allocateRegisters();
  template <class Number>
  const Number* run(const Number& u, const Number& v, std::span<const double> parameters) const;
  void require(std::span<const double> parameters, std::size_t outputs) const;

  std::vector<double> constants_;
  std::vector<std::uint32_t> variables_;  ///< which, by value - constants_.size()
  std::vector<Step> steps_;               ///< by rate
  std::uint32_t phaseEnds_[kRates] = {};  ///< in steps_
  std::vector<Rate> rates_;               ///< by value
  std::vector<std::uint32_t> registers_;  ///< by value; of those computed per column, row or point
  std::vector<std::uint32_t> rowValues_;  ///< those per row that outlive the row's steps
  std::vector<std::uint32_t> outputs_;    ///< values
  std::uint32_t registerCount_ = 0;
};

}  // namespace luxo
