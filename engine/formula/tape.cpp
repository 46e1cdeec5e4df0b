// SPDX-License-Identifier: Apache-2.0
#include "formula/tape.h"

#include <algorithm>
#include <cmath>

#include "base/assert.h"
#include "formula/operation.h"
#include "math/bits.h"

namespace luxo {
namespace {

constexpr std::uint32_t kNone = ~std::uint32_t{0};

/// The sine of a cosine's operand and the cosine of a sine's, by node: one reduction of the angle serves
/// both.
std::vector<std::uint32_t> findPartners(const std::vector<ExprNode>& nodes,
                                        const std::vector<std::uint32_t>& order) {
  std::vector<std::uint32_t> sineOf(nodes.size(), kNone), partners(nodes.size(), kNone);
  for (const std::uint32_t n : order)
    if (nodes[n].op == Op::Sin) sineOf[nodes[n].a] = n;
  for (const std::uint32_t n : order) {
    if (nodes[n].op != Op::Cos || sineOf[nodes[n].a] == kNone) continue;
    partners[n] = sineOf[nodes[n].a];
    partners[partners[n]] = n;
  }
  return partners;
}

Interval boundConstant(double x) { return std::isfinite(x) ? Interval(x) : Interval::everything(); }

template <class Number>
Number numberOf(double x) {
  if constexpr (std::is_same_v<Number, Interval>)
    return boundConstant(x);
  else
    return static_cast<Number>(x);
}

}  // namespace

Tape::Tape(Graph& graph, std::span<const Expr> outputs) {
  std::vector<std::uint32_t> roots;
  for (const Expr& output : outputs) roots.push_back(graph.nodeOf(output));
  const std::vector<std::uint32_t> order = reachable(graph, roots);
  const std::vector<ExprNode>& nodes = graph.nodes();

  std::vector<Rate> rateOf(nodes.size(), Rate::Once);
  std::vector<std::uint32_t> valueOf(nodes.size(), kNone);
  const auto addValue = [&](std::uint32_t n) {
    valueOf[n] = static_cast<std::uint32_t>(rates_.size());
    rates_.push_back(rateOf[n]);
  };
  for (const std::uint32_t n : order) {
    if (nodes[n].op != Op::Constant) continue;
    addValue(n);
    constants_.push_back(nodes[n].value);
  }
  for (const std::uint32_t n : order) {
    const ExprNode& node = nodes[n];
    if (node.op == Op::Variable) {
      rateOf[n] = node.a == 0 ? Rate::PerColumn : node.a == 1 ? Rate::PerRow : Rate::Once;
      addValue(n);
      variables_.push_back(node.a);
      continue;
    }
    const std::uint32_t operands[] = {node.a, node.b, node.c};
    for (int i = 0; i < operandCount(node.op); ++i) {
      const Rate own = rateOf[n], other = rateOf[operands[i]];
      rateOf[n] = own == Rate::Once || own == other ? other : other == Rate::Once ? own : Rate::PerPoint;
    }
  }

  const std::vector<std::uint32_t> partners = findPartners(nodes, order);
  for (int rate = 0; rate < kRates; ++rate) {
    for (const std::uint32_t n : order) {
      const ExprNode& node = nodes[n];
      const int operands = operandCount(node.op);
      if (operands == 0 || rateOf[n] != static_cast<Rate>(rate) || valueOf[n] != kNone) continue;
      Step step{.op = node.op, .exponent = static_cast<int>(node.value)};  // of those that have one
      step.a = valueOf[node.a];
      step.b = operands > 1 ? valueOf[node.b] : step.a;
      step.c = operands > 2 ? valueOf[node.c] : step.a;
      if (partners[n] == kNone) {
        addValue(n);
      } else {
        step.op = Op::Sin;
        step.paired = true;
        addValue(node.op == Op::Sin ? n : partners[n]);
        addValue(node.op == Op::Sin ? partners[n] : n);
      }
      step.result = static_cast<std::uint32_t>(rates_.size()) - (step.paired ? 2 : 1);
      steps_.push_back(step);
    }
    phaseEnds_[rate] = static_cast<std::uint32_t>(steps_.size());
  }
  for (const std::uint32_t root : roots) outputs_.push_back(valueOf[root]);
  allocateRegisters();
}

void Tape::allocateRegisters() {
  // A value is needed until its last use. What a later phase uses lives on: that phase runs many times.
  std::vector<std::uint32_t> lastUse(rates_.size(), 0);
  for (std::uint32_t s = 0; s < steps_.size(); ++s) {
    const Step& step = steps_[s];
    for (const std::uint32_t operand : {step.a, step.b, step.c})
      lastUse[operand] = rates_[operand] == rates_[step.result] ? std::max(lastUse[operand], s) : kNone;
  }
  for (const std::uint32_t output : outputs_) lastUse[output] = kNone;

  registers_.assign(rates_.size(), kNone);
  std::vector<std::uint32_t> free;
  const auto take = [&](std::uint32_t value) {
    if (free.empty()) free.push_back(registerCount_++);
    registers_[value] = free.back();
    free.pop_back();
    if (lastUse[value] == kNone && rates_[value] == Rate::PerRow) rowValues_.push_back(value);
  };
  const auto release = [&](std::uint32_t value) {
    if (registers_[value] != kNone) free.push_back(registers_[value]);
  };
  for (std::uint32_t s = phaseEnds_[0]; s < steps_.size(); ++s) {
    const Step& step = steps_[s];
    // Results are written while operands are read: they do not share a register.
    take(step.result);
    if (step.paired) take(step.result + 1);
    const std::uint32_t operands[] = {step.a, step.b, step.c};
    for (int i = 0; i < 3; ++i)
      if (lastUse[operands[i]] == s && std::find(operands, operands + i, operands[i]) == operands + i)
        release(operands[i]);
    for (int i = 0; i <= (step.paired ? 1 : 0); ++i)
      if (lastUse[step.result + i] < s) release(step.result + i);
  }
}

void Tape::require(std::span<const double> parameters, std::size_t outputs) const {
  LUXO_REQUIRE_COMPARE(outputs, ==, outputs_.size());
  for (const std::uint32_t variable : variables_)
    if (variable >= 2) LUXO_REQUIRE_COMPARE(variable - 2, <, parameters.size());
}

/// Runs every step on single numbers; returns all values.
template <class Number>
const Number* Tape::run(const Number& u, const Number& v, std::span<const double> parameters) const {
  static thread_local std::vector<Number> memory;
  if (memory.size() < rates_.size()) memory.resize(rates_.size());
  Number* const values = memory.data();
  Number* next = values;
  for (const double constant : constants_) *next++ = numberOf<Number>(constant);
  for (const std::uint32_t variable : variables_)
    *next++ = variable == 0 ? u : variable == 1 ? v : numberOf<Number>(parameters[variable - 2]);
  for (const Step& step : steps_) {
    if (step.paired)
      sinCos(values[step.a], values[step.result], values[step.result + 1]);
    else
      values[step.result] = operate(step.op, values[step.a], values[step.b], values[step.c], step.exponent);
  }
  return values;
}

void Tape::evaluatePoint(double u, double v, std::span<const double> parameters,
                         std::span<double> values) const {
  require(parameters, values.size());
  const double* const all = run(u, v, parameters);
  for (std::size_t k = 0; k < outputs_.size(); ++k) values[k] = all[outputs_[k]];
}

void Tape::evaluateInSingle(float u, float v, std::span<const double> parameters,
                            std::span<float> values) const {
  require(parameters, values.size());
  const float* const all = run(u, v, parameters);
  for (std::size_t k = 0; k < outputs_.size(); ++k) values[k] = all[outputs_[k]];
}

void Tape::bound(const Interval& u, const Interval& v, std::span<const double> parameters,
                 std::span<Interval> bounds) const {
  require(parameters, bounds.size());
  const Interval* const all = run(u, v, parameters);
  for (std::size_t k = 0; k < outputs_.size(); ++k) bounds[k] = all[outputs_[k]];
}

void Tape::boundWhereDefined(const Interval& u, const Interval& v, std::span<const double> parameters,
                             std::span<PartialInterval> bounds) const {
  require(parameters, bounds.size());
  const PartialInterval* const all = run(PartialInterval(u), PartialInterval(v), parameters);
  for (std::size_t k = 0; k < outputs_.size(); ++k) bounds[k] = all[outputs_[k]];
}

// Rates and registers follow from the rest.
bool operator==(const Tape& a, const Tape& b) {
  return a.steps_ == b.steps_ && a.variables_ == b.variables_ && a.outputs_ == b.outputs_ &&
         std::ranges::equal(a.phaseEnds_, b.phaseEnds_) && sameBits(a.constants_, b.constants_);
}

std::uint64_t Tape::hash() const {
  std::uint64_t hash = mixed(outputs_.size(), constants_);
  for (const std::uint32_t variable : variables_) hash = mixed(hash, variable);
  for (const Step& step : steps_) {
    const std::uint64_t operation = std::uint64_t(step.exponent) << 8 ^ static_cast<std::uint64_t>(step.op);
    hash = mixed(mixed(hash, std::uint64_t{step.a} << 32 | step.b), operation << 32 ^ step.c);
  }
  return hash;
}

std::vector<Expr> Tape::expressions(Graph& graph, const std::map<std::uint32_t, Expr>& known) const {
  std::vector<Expr> values(constants_.begin(), constants_.end());
  for (const std::uint32_t variable : variables_) {
    const auto value = known.find(variable);
    values.push_back(value == known.end() ? graph.variable(variable) : value->second);
  }
  for (const Step& step : steps_) {
    values.push_back(Graph::apply(step.op, values[step.a], values[step.b], values[step.c], step.exponent));
    if (step.paired) values.push_back(cos(values[step.a]));
  }
  std::vector<Expr> outputs;
  for (const std::uint32_t output : outputs_) outputs.push_back(values[output]);
  return outputs;
}

}  // namespace luxo
