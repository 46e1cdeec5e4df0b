// SPDX-License-Identifier: Apache-2.0
// A tape over many points: chunk by chunk, one loop per step, all values of a chunk in the first-level cache.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/assert.h"
#include "formula/operation.h"
#include "formula/tape.h"

namespace luxo {
namespace {

/// Where a value lies: one number per point (step 1) or one for all (step 0).
struct Lane {
  const double* values = nullptr;
  std::size_t step = 0;
};

/// Numbers that the registers of a chunk may take: 24 KiB of the usual 32 KiB cache.
constexpr std::size_t kCachedNumbers = 3072;
constexpr std::size_t kShortestChunk = 8, kLongestChunk = 256;

/// Memory beyond this is given back after the call.
constexpr std::size_t kKeptNumbers = std::size_t{1} << 20;

/// Applies `f` to n numbers.
template <class F>
void map(std::size_t n, double* __restrict out, const double* __restrict x, F f) {
  for (std::size_t i = 0; i < n; ++i) out[i] = f(x[i]);
}

/// Applies `f` to n pairs. The shapes are written out so that the compiler vectorises each.
template <class F>
void map(std::size_t n, double* __restrict out, Lane x, Lane y, F f) {
  const double* __restrict xs = x.values;
  const double* __restrict ys = y.values;
  if (x.step == 1 && y.step == 1) {
    for (std::size_t i = 0; i < n; ++i) out[i] = f(xs[i], ys[i]);
  } else if (x.step == 1) {
    const double fixed = ys[0];
    for (std::size_t i = 0; i < n; ++i) out[i] = f(xs[i], fixed);
  } else {
    const double fixed = xs[0];
    for (std::size_t i = 0; i < n; ++i) out[i] = f(fixed, ys[i * y.step]);
  }
}

/// integerPower of n numbers at once. `squares` is n numbers of scratch.
void mapPower(std::size_t n, double* __restrict out, const double* __restrict x, int exponent,
              double* __restrict squares) {
  std::copy_n(x, n, squares);
  std::fill_n(out, n, 1.0);
  for (int rest = std::abs(exponent);;) {
    if (rest & 1)
      for (std::size_t i = 0; i < n; ++i) out[i] *= squares[i];
    if ((rest >>= 1) == 0) break;
    for (std::size_t i = 0; i < n; ++i) squares[i] *= squares[i];
  }
  if (exponent < 0)
    for (std::size_t i = 0; i < n; ++i) out[i] = 1 / out[i];
}

/// One number per point, whatever the lane; `scratch` takes n.
const double* spread(std::size_t n, Lane lane, double* scratch) {
  if (lane.step == 1) return lane.values;
  std::fill_n(scratch, n, lane.values[0]);
  return scratch;
}

void mapSelect(std::size_t n, double* __restrict out, const double* __restrict condition,
               const double* __restrict a, const double* __restrict b) {
  for (std::size_t i = 0; i < n; ++i) out[i] = number::select(condition[i], a[i], b[i]);
}

void mapSinCos(std::size_t n, double* __restrict sines, double* __restrict cosines,
               const double* __restrict x) {
  for (std::size_t i = 0; i < n; ++i) sinCos(x[i], sines[i], cosines[i]);
}

/// `scratch` takes three times n numbers.
void mapOperation(Op op, int exponent, std::size_t n, double* out, Lane x, Lane y, Lane z, double* scratch) {
  switch (op) {
    case Op::Add:
      return map(n, out, x, y, [](double a, double b) { return a + b; });
    case Op::Subtract:
      return map(n, out, x, y, [](double a, double b) { return a - b; });
    case Op::Multiply:
      return map(n, out, x, y, [](double a, double b) { return a * b; });
    case Op::Divide:
      return map(n, out, x, y, [](double a, double b) { return a / b; });
    case Op::Min:
      return map(n, out, x, y, [](double a, double b) { return number::min(a, b); });
    case Op::Max:
      return map(n, out, x, y, [](double a, double b) { return number::max(a, b); });
    case Op::Less:
      return map(n, out, x, y, [](double a, double b) { return number::less(a, b); });
    case Op::LessEqual:
      return map(n, out, x, y, [](double a, double b) { return number::lessEqual(a, b); });
    case Op::Equal:
      return map(n, out, x, y, [](double a, double b) { return number::equal(a, b); });
    default:
      break;
  }
  const double* const xs = spread(n, x, scratch);
  switch (op) {
    case Op::Negate:
      return map(n, out, xs, [](double a) { return -a; });
    case Op::Abs:
      return map(n, out, xs, [](double a) { return std::abs(a); });
    case Op::Sqrt:
      return map(n, out, xs, [](double a) { return std::sqrt(a); });
    case Op::Sign:
      return map(n, out, xs, [](double a) { return number::sign(a); });
    case Op::Power:
      if (exponent == 2) return map(n, out, xs, [](double a) { return a * a; });
      return mapPower(n, out, xs, exponent, scratch + n);
    default:
      break;
  }
  const double* const ys = spread(n, y, scratch + n);
  const double* const zs = spread(n, z, scratch + 2 * n);
  if (op == Op::Select) return mapSelect(n, out, xs, ys, zs);
  for (std::size_t i = 0; i < n; ++i) out[i] = operate(op, xs[i], ys[i], zs[i], exponent);
}

/// Copies a lane to where the caller wants it.
void store(Lane from, std::size_t n, OutputArray to, std::size_t first) {
  double* const out = to.first + first * to.stride;
  if (from.step == 1 && to.stride == 1)
    std::memcpy(out, from.values, n * sizeof(double));
  else
    for (std::size_t i = 0; i < n; ++i) out[i * to.stride] = from.values[i * from.step];
}

std::vector<OutputArray> destinationsOf(std::vector<std::vector<double>>& results) {
  std::vector<OutputArray> destinations;
  for (std::vector<double>& result : results) destinations.push_back({result.data()});
  return destinations;
}

}  // namespace

/// One call: lanes are set up as the values they stand for are computed.
struct Tape::Batch {
  Batch(const Tape& from, std::span<const double> us, std::span<const double> vs, std::size_t rowCount,
        std::span<const double> parameters);
  ~Batch() {
    if (numbers.size() > kKeptNumbers) numbers = {};
    if (lanes.size() > kKeptNumbers) lanes = {};
  }

  void compute(Rate from, Rate to, std::size_t n) const;
  void computeRows(std::size_t rowCount) const;
  void useRow(std::size_t row, std::size_t rowCount) const;
  void storeOutputs(std::size_t n, std::size_t at, std::span<const OutputArray> destinations) const;
  [[nodiscard]] double* registerOf(std::uint32_t value) const {
    return registers + tape.registers_[value] * chunk;
  }
  void setVariable(std::uint32_t which, Lane lane) const {
    for (std::size_t i = 0; i < tape.variables_.size(); ++i)
      if (tape.variables_[i] == which) lanes[tape.constants_.size() + i] = lane;
  }

  static thread_local std::vector<double> numbers;
  static thread_local std::vector<Lane> lanes;  ///< by value

  const Tape& tape;
  std::span<const double> u, v;
  std::size_t chunk;
  double *single, *rows, *registers, *scratch;  ///< parts of `numbers`
};

thread_local std::vector<double> Tape::Batch::numbers;
thread_local std::vector<Lane> Tape::Batch::lanes;

Tape::Batch::Batch(const Tape& from, std::span<const double> us, std::span<const double> vs,
                   std::size_t rowCount, std::span<const double> parameters)
    : tape(from), u(us), v(vs) {
  constexpr std::size_t kScratch = 3;
  const std::size_t registerCount = tape.registerCount_ + kScratch, values = tape.rates_.size();
  chunk = std::clamp(kCachedNumbers / registerCount / kShortestChunk * kShortestChunk, kShortestChunk,
                     kLongestChunk);
  const std::size_t rowNumbers = tape.rowValues_.size() * rowCount;
  const std::size_t needed = registerCount * chunk + values + rowNumbers;
  if (numbers.size() < needed) numbers.resize(needed);
  if (lanes.size() < values) lanes.resize(values);
  registers = numbers.data();
  scratch = registers + tape.registerCount_ * chunk;
  single = scratch + kScratch * chunk;
  rows = single + values;

  const std::size_t constants = tape.constants_.size(), variables = tape.variables_.size();
  for (std::size_t i = 0; i < constants; ++i) lanes[i] = {&tape.constants_[i], 0};
  for (std::size_t i = 0; i < variables; ++i)
    if (tape.variables_[i] >= 2) lanes[constants + i] = {&parameters[tape.variables_[i] - 2], 0};
  for (std::size_t i = constants + variables; i < values; ++i)
    lanes[i] = tape.rates_[i] == Rate::Once ? Lane{single + i, 0}
                                            : Lane{registerOf(static_cast<std::uint32_t>(i)), 1};
  compute(Rate::Once, Rate::Once, 1);
}

void Tape::Batch::compute(Rate from, Rate to, std::size_t n) const {
  const std::uint32_t first = from == Rate::Once ? 0 : tape.phaseEnds_[static_cast<int>(from) - 1];
  for (std::uint32_t s = first; s < tape.phaseEnds_[static_cast<int>(to)]; ++s) {
    const Step& step = tape.steps_[s];
    double* const out = from == Rate::Once ? single + step.result : registerOf(step.result);
    if (step.paired)
      mapSinCos(n, out, from == Rate::Once ? out + 1 : registerOf(step.result + 1), lanes[step.a].values);
    else
      mapOperation(step.op, step.exponent, n, out, lanes[step.a], lanes[step.b], lanes[step.c], scratch);
  }
}

/// Every row's steps, kept for the grid.
void Tape::Batch::computeRows(std::size_t rowCount) const {
  for (std::size_t first = 0; first < rowCount; first += chunk) {
    const std::size_t n = std::min(chunk, rowCount - first);
    setVariable(1, {v.data() + first, 1});
    compute(Rate::PerRow, Rate::PerRow, n);
    for (std::size_t i = 0; i < tape.rowValues_.size(); ++i)
      std::copy_n(registerOf(tape.rowValues_[i]), n, rows + i * rowCount + first);
  }
}

void Tape::Batch::useRow(std::size_t row, std::size_t rowCount) const {
  setVariable(1, {v.data() + row, 0});
  for (std::size_t i = 0; i < tape.rowValues_.size(); ++i)
    lanes[tape.rowValues_[i]] = {rows + i * rowCount + row, 0};
}

void Tape::Batch::storeOutputs(std::size_t n, std::size_t at,
                               std::span<const OutputArray> destinations) const {
  for (std::size_t k = 0; k < destinations.size(); ++k)
    store(lanes[tape.outputs_[k]], n, destinations[k], at);
}

void Tape::evaluate(std::span<const double> u, std::span<const double> v, std::span<const double> parameters,
                    std::span<const OutputArray> destinations) const {
  LUXO_REQUIRE_COMPARE(u.size(), ==, v.size());
  require(parameters, destinations.size());
  const Batch batch(*this, u, v, 0, parameters);
  for (std::size_t first = 0; first < u.size(); first += batch.chunk) {
    const std::size_t n = std::min(batch.chunk, u.size() - first);
    batch.setVariable(0, {u.data() + first, 1});
    batch.setVariable(1, {v.data() + first, 1});
    batch.compute(Rate::PerColumn, Rate::PerPoint, n);
    batch.storeOutputs(n, first, destinations);
  }
}

void Tape::evaluateGrid(std::span<const double> u, std::span<const double> v,
                        std::span<const double> parameters, std::span<const OutputArray> destinations) const {
  require(parameters, destinations.size());
  const Batch batch(*this, u, v, v.size(), parameters);
  batch.computeRows(v.size());
  for (std::size_t first = 0; first < u.size(); first += batch.chunk) {
    const std::size_t n = std::min(batch.chunk, u.size() - first);
    batch.setVariable(0, {u.data() + first, 1});
    batch.compute(Rate::PerColumn, Rate::PerColumn, n);
    for (std::size_t row = 0; row < v.size(); ++row) {
      batch.useRow(row, v.size());
      batch.compute(Rate::PerPoint, Rate::PerPoint, n);
      batch.storeOutputs(n, row * u.size() + first, destinations);
    }
  }
}

std::vector<std::vector<double>> Tape::evaluate(std::span<const double> u, std::span<const double> v,
                                                std::span<const double> parameters) const {
  std::vector<std::vector<double>> results(outputs_.size(), std::vector<double>(u.size()));
  evaluate(u, v, parameters, destinationsOf(results));
  return results;
}

std::vector<std::vector<double>> Tape::evaluateGrid(std::span<const double> u, std::span<const double> v,
                                                    std::span<const double> parameters) const {
  std::vector<std::vector<double>> results(outputs_.size(), std::vector<double>(u.size() * v.size()));
  evaluateGrid(u, v, parameters, destinationsOf(results));
  return results;
}

}  // namespace luxo
