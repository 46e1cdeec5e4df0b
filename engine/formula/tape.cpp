// SPDX-License-Identifier: Apache-2.0
#include "formula/tape.h"

#include <algorithm>

#include "base/assert.h"
#include "formula/operation.h"

namespace luxo {
namespace {

/// Where an instruction's values lie: one per point (step 1) or one for all (step 0).
struct Lane {
  const double* values = nullptr;
  std::size_t step = 0;
};

/// Applies `f` to n points. The three shapes are written out so that the compiler vectorises each.
template <class F>
void mapBinary(std::size_t n, double* out, Lane x, Lane y, F f) {
  if (x.step == 1 && y.step == 1) {
    for (std::size_t i = 0; i < n; ++i) out[i] = f(x.values[i], y.values[i]);
  } else if (x.step == 1) {
    for (std::size_t i = 0; i < n; ++i) out[i] = f(x.values[i], y.values[0]);
  } else {
    for (std::size_t i = 0; i < n; ++i) out[i] = f(x.values[0], y.values[i * y.step]);
  }
}

void mapOperation(Op op, int exponent, std::size_t n, double* out, Lane x, Lane y, Lane z) {
  switch (op) {
    case Op::Add:
      return mapBinary(n, out, x, y, [](double a, double b) { return a + b; });
    case Op::Subtract:
      return mapBinary(n, out, x, y, [](double a, double b) { return a - b; });
    case Op::Multiply:
      return mapBinary(n, out, x, y, [](double a, double b) { return a * b; });
    case Op::Divide:
      return mapBinary(n, out, x, y, [](double a, double b) { return a / b; });
    case Op::Negate:
      for (std::size_t i = 0; i < n; ++i) out[i] = -x.values[i * x.step];
      return;
    default:
      for (std::size_t i = 0; i < n; ++i)
        out[i] = operate(op, x.values[i * x.step], y.values[i * y.step], z.values[i * z.step], exponent);
  }
}

/// Points evaluated together: enough to amortise the dispatch, few enough that all registers stay in the
/// cache.
constexpr std::size_t kChunk = 256;

}  // namespace

Tape::Tape(Graph& graph, std::span<const Expr> outputs) {
  std::vector<std::uint32_t> roots;
  for (const Expr& output : outputs) roots.push_back(graph.nodeOf(output));
  const std::vector<std::uint32_t> order = reachable(graph, roots);

  std::vector<std::uint32_t> instructionOf(graph.nodes().size());
  for (const std::uint32_t n : order) {
    const ExprNode& node = graph.nodes()[n];
    Instruction instruction{.op = node.op, .a = node.a, .b = node.b, .value = node.value};
    if (node.op == Op::Variable) {
      instruction.rate = node.a == 0 ? Rate::PerColumn : node.a == 1 ? Rate::PerRow : Rate::Once;
    } else if (operandCount(node.op) > 0) {
      instruction.a = instructionOf[node.a];
      instruction.b = operandCount(node.op) > 1 ? instructionOf[node.b] : instruction.a;
      instruction.c = operandCount(node.op) > 2 ? instructionOf[node.c] : instruction.a;
      for (const std::uint32_t operand : {instruction.a, instruction.b, instruction.c}) {
        const Rate own = instruction.rate, other = instructions_[operand].rate;
        instruction.rate = own == Rate::Once                     ? other
                           : other == Rate::Once || own == other ? own
                                                                 : Rate::PerPoint;
      }
    }
    instructionOf[n] = static_cast<std::uint32_t>(instructions_.size());
    instructions_.push_back(instruction);
  }
  for (const std::uint32_t root : roots) outputs_.push_back(instructionOf[root]);
}

std::vector<std::vector<double>> Tape::evaluate(std::span<const double> u, std::span<const double> v,
                                                std::span<const double> parameters) const {
  LUXO_REQUIRE_COMPARE(u.size(), ==, v.size());
  return run(u, v, parameters, false);
}

std::vector<std::vector<double>> Tape::evaluateGrid(std::span<const double> u, std::span<const double> v,
                                                    std::span<const double> parameters) const {
  return run(u, v, parameters, true);
}

std::vector<std::vector<double>> Tape::run(std::span<const double> u, std::span<const double> v,
                                           std::span<const double> parameters, bool grid) const {
  // A batch of scattered points is a single row in which every varying value is computed per point.
  const std::size_t columns = u.size(), rows = grid ? v.size() : 1;
  const auto rateOf = [&](const Instruction& i) {
    return grid || i.rate == Rate::Once ? i.rate : Rate::PerPoint;
  };

  std::vector<std::vector<double>> storage(instructions_.size());
  std::vector<Lane> lanes(instructions_.size());
  const auto compute = [&](std::uint32_t k, std::size_t n) {
    const Instruction& i = instructions_[k];
    mapOperation(i.op, static_cast<int>(i.value), n, storage[k].data(), lanes[i.a], lanes[i.b], lanes[i.c]);
  };

  // Everything that does not change from point to point within a row comes first.
  for (std::uint32_t k = 0; k < instructions_.size(); ++k) {
    const Instruction& i = instructions_[k];
    const Rate rate = rateOf(i);
    if (i.op == Op::Constant) {
      lanes[k] = {&instructions_[k].value, 0};
    } else if (i.op == Op::Variable && i.a >= 2) {
      LUXO_REQUIRE_COMPARE(i.a - 2, <, parameters.size());
      lanes[k] = {&parameters[i.a - 2], 0};
    } else if (i.op == Op::Variable) {
      lanes[k] = {i.a == 0 ? u.data() : v.data(), 1};
    } else if (rate == Rate::PerPoint) {
      storage[k].resize(std::min(columns, kChunk));
      lanes[k] = {storage[k].data(), 1};
    } else {
      const std::size_t n = rate == Rate::Once ? 1 : rate == Rate::PerColumn ? columns : rows;
      storage[k].resize(n);
      compute(k, n);
      lanes[k] = {storage[k].data(), rate == Rate::Once ? 0u : 1u};
    }
  }

  std::vector<std::vector<double>> results(outputs_.size(), std::vector<double>(columns * rows));
  const std::vector<Lane> whole = lanes;
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t first = 0; first < columns; first += kChunk) {
      const std::size_t n = std::min(kChunk, columns - first);
      for (std::uint32_t k = 0; k < instructions_.size(); ++k) {
        const Instruction& i = instructions_[k];
        if (rateOf(i) == Rate::PerPoint && i.op != Op::Variable) {
          compute(k, n);
        } else if (i.rate == Rate::PerRow && grid) {
          lanes[k] = {whole[k].values + row, 0};
        } else if (i.rate != Rate::Once) {
          lanes[k].values = whole[k].values + first;
        }
      }
      for (std::size_t output = 0; output < outputs_.size(); ++output) {
        const Lane lane = lanes[outputs_[output]];
        double* out = results[output].data() + row * columns + first;
        for (std::size_t i = 0; i < n; ++i) out[i] = lane.values[i * lane.step];
      }
    }
  }
  return results;
}

void Tape::bound(const Interval& u, const Interval& v, std::span<const double> parameters,
                 std::span<Interval> bounds) const {
  LUXO_REQUIRE_COMPARE(bounds.size(), ==, outputs_.size());
  // Bounds are asked for by the thousand: the registers are kept from call to call.
  static thread_local std::vector<Interval> values;
  values.resize(instructions_.size());
  for (std::size_t k = 0; k < instructions_.size(); ++k) {
    const Instruction& i = instructions_[k];
    if (i.op == Op::Constant) {
      values[k] = i.value;
    } else if (i.op == Op::Variable) {
      if (i.a >= 2) LUXO_REQUIRE_COMPARE(i.a - 2, <, parameters.size());
      values[k] = i.a == 0 ? u : i.a == 1 ? v : Interval(parameters[i.a - 2]);
    } else if (i.op == Op::Multiply && i.a == i.b) {
      values[k] = square(values[i.a]);  // both factors are the same number, not two of the same range
    } else {
      values[k] = operate(i.op, values[i.a], values[i.b], values[i.c], static_cast<int>(i.value));
    }
  }
  for (std::size_t k = 0; k < outputs_.size(); ++k) bounds[k] = values[outputs_[k]];
}

}  // namespace luxo
