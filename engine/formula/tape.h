// SPDX-License-Identifier: Apache-2.0
// A compiled list of expressions: evaluated over batches of doubles, over whole grids, or bounded over a
// rectangle. Variable 0 is u, variable 1 is v; the others are parameters, the same for every point of a call.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "formula/expression.h"
#include "math/interval.h"

namespace luxo {

/// Immutable once built; it copies what it needs, so the graph may go. Safe from any thread.
class Tape {
 public:
  Tape() = default;
  /// Cost: linear in the nodes the outputs need.
  Tape(Graph& graph, std::span<const Expr> outputs);

  [[nodiscard]] std::size_t outputCount() const { return outputs_.size(); }

  /// Output k at every (u[i], v[i]) in result[k][i].
  [[nodiscard]] std::vector<std::vector<double>> evaluate(std::span<const double> u,
                                                          std::span<const double> v,
                                                          std::span<const double> parameters) const;

  /// Output k at every (u[i], v[j]) in result[k][j * u.size() + i]: bit for bit what evaluate() gives there.
  /// What depends on u alone is computed once per column and what depends on v alone once per row, so that a
  /// grid of n x m points of a typical surface takes n + m sines and cosines, not n * m.
  [[nodiscard]] std::vector<std::vector<double>> evaluateGrid(std::span<const double> u,
                                                              std::span<const double> v,
                                                              std::span<const double> parameters) const;

  /// Intervals that hold every output over the rectangle u x v (rigorous: outward rounding). `bounds` takes
  /// one per output.
  void bound(const Interval& u, const Interval& v, std::span<const double> parameters,
             std::span<Interval> bounds) const;

 private:
  /// What a value depends on decides how often it is computed.
  enum class Rate : std::uint8_t { Once, PerColumn, PerRow, PerPoint };

  struct Instruction {
    Op op = Op::Constant;
    Rate rate = Rate::Once;
    std::uint32_t a = 0, b = 0, c = 0;  ///< earlier instructions; for Variable, a = which
    double value = 0;
  };

  std::vector<std::vector<double>> run(std::span<const double> u, std::span<const double> v,
                                       std::span<const double> parameters, bool grid) const;

  std::vector<Instruction> instructions_;
  std::vector<std::uint32_t> outputs_;
};

}  // namespace luxo
