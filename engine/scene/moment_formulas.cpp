// SPDX-License-Identifier: Apache-2.0
#include "scene/moment_formulas.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/error.h"

namespace luxo {
namespace {

/// Compiling looks at all of a graph: a graph for every formula would bind every parameter each time, one for
/// all would make many formulas quadratic.
constexpr std::size_t kLargeGraph = 4096;

constexpr std::string_view kOnlySurfaces = "only surfaces, diffuse colours and opacities have u and v";

/// The rate of a formula that says rate * t: so written, it turns exactly for ever.
std::optional<double> rateOf(Graph& graph, Expr angle) {
  if (angle.isConstant()) return std::nullopt;
  const auto isTime = [&](const ExprNode& node) {
    return node.op == Op::Variable && node.a == MomentTape::kTime;
  };
  const ExprNode& node = graph.nodes()[graph.nodeOf(angle)];
  if (isTime(node)) return 1;
  if (node.op == Op::Negate && isTime(graph.nodes()[node.a])) return -1;
  if (node.op != Op::Multiply) return std::nullopt;
  const ExprNode &a = graph.nodes()[node.a], &b = graph.nodes()[node.b];
  if (a.op == Op::Constant && isTime(b)) return a.value;
  if (b.op == Op::Constant && isTime(a)) return b.value;
  return std::nullopt;
}

/// a * b, by quaternions.
Rotation product(const Rotation& a, const Rotation& b) {
  const double cosA = std::cos(0.5 * a.angle), cosB = std::cos(0.5 * b.angle);
  const Vec3 va = std::sin(0.5 * a.angle) * unit(a.axis), vb = std::sin(0.5 * b.angle) * unit(b.axis);
  const double w = cosA * cosB - glm::dot(va, vb);
  const Vec3 v = cosA * vb + cosB * va + glm::cross(va, vb);
  if (v == Vec3(0)) return {};
  return {v, 2 * std::atan2(glm::length(v), w)};
}

}  // namespace

void MomentFormulas::prepareNames() {
  if (names_ && names_->graph.nodes().size() <= kLargeGraph + 2 * variables_.count()) return;
  names_ = std::make_unique<Names>();
  variables_.bind(names_->scope, [&](std::size_t which) {
    return names_->graph.variable(
        which == 0 ? MomentTape::kTime : static_cast<std::uint32_t>(MomentTape::kFirstParameter + which - 1));
  });
  for (const char* name : {"u", "v"}) names_->scope.explainAbsence(name, std::string(kOnlySurfaces));
}

bool MomentFormulas::accept(const Quantity& quantity, double value, const Allowed& allowed) {
  if (allowed.words.empty() || allowed.range.contains(value)) return true;
  const bool degrees =
      allowed.angle && !quantity.isFormula() && value > 0 && allowed.range.contains(radians(value));
  problems_.add(quantity, {{0, quantity.isFormula() ? quantity.formula().size() : 0},
                           "this is " + objection(value, allowed),
                           degrees ? fmt::format("write \"{}deg\"", value) : std::string()});
  return false;
}

std::string MomentFormulas::objection(double value, const Allowed& allowed) {
  const std::string shown = std::isnan(value) ? "not a number"
                            : allowed.angle   ? fmt::format("{} radians", value)
                                              : fmt::format("{}", value);
  return fmt::format("{}; it must be {}", shown, allowed.words);
}

std::function<void(double, double)> MomentFormulas::guard(const Quantity& quantity,
                                                          const Allowed& allowed) const {
  return [quantity, allowed, source = problems_.source()](double value, double time) {
    if (allowed.takes(value)) return;
    const std::string message = fmt::format("at time {} this is {}", time, objection(value, allowed));
    const SourceRange whole{0, quantity.formula().size()};
    throw Error(ErrorKind::Scene,
                source.text ? describe(source.name, *source.text, {rangeIn(quantity, whole), message, {}})
                            : describe("formula", quantity.formula(), {whole, message, {}}));
  };
}

Animated<double> MomentFormulas::guarded(const Quantity& quantity, const Allowed& allowed,
                                         Animated<double> value) const {
  if (allowed.words.empty()) return value;
  const DependsOn dependsOn = value.movesWithTime() ? DependsOn::Both : DependsOn::Parameters;
  return {[value = std::move(value), check = guard(quantity, allowed)](const Moment& moment) {
            const double now = value.at(moment);
            check(now, moment.time);
            return now;
          },
          dependsOn};
}

Animated<Vec3> MomentFormulas::guarded(const Quantity3& quantities, const Allowed& allowed,
                                       Animated<Vec3> value) const {
  const DependsOn dependsOn = value.movesWithTime() ? DependsOn::Both : DependsOn::Parameters;
  std::array<std::function<void(double, double)>, 3> checks;
  for (std::size_t i = 0; i < 3; ++i) checks[i] = guard(quantities[i], allowed);
  return {[value = std::move(value), checks = std::move(checks)](const Moment& moment) {
            const Vec3 now = value.at(moment);
            for (int i = 0; i < 3; ++i) checks[static_cast<std::size_t>(i)](now[i], moment.time);
            return now;
          },
          dependsOn};
}

std::optional<Expr> MomentFormulas::expression(const Quantity& quantity, const Allowed& allowed) {
  Expr value = quantity.number();
  if (quantity.isFormula()) {
    Formula formula = parse(quantity.formula(), names_->scope);
    for (Diagnostic& diagnostic : formula.diagnostics) problems_.add(quantity, std::move(diagnostic));
    if (!formula.ok) return std::nullopt;
    value = formula.value;
  }
  if (value.isConstant() && !accept(quantity, value.constant(), allowed)) return std::nullopt;
  return value;
}

Animated<double> MomentFormulas::number(const Quantity& quantity, const Allowed& allowed) {
  if (quantity.isFormula()) prepareNames();
  const Expr value = expression(quantity, allowed).value_or(0);
  if (value.isConstant()) return value.constant();
  return guarded(quantity, allowed, animated(names_->graph, value, variables_.initial()));
}

Animated<Vec3> MomentFormulas::vector(const Quantity3& quantities, const Allowed& allowed) {
  if (std::ranges::any_of(quantities, &Quantity::isFormula)) prepareNames();
  std::array<Expr, 3> values;
  for (std::size_t i = 0; i < 3; ++i) values[i] = expression(quantities[i], allowed).value_or(0);
  if (std::ranges::all_of(values, &Expr::isConstant))
    return Vec3(values[0].constant(), values[1].constant(), values[2].constant());
  const auto tape = std::make_shared<const MomentTape>(names_->graph, values, variables_.initial());
  return guarded(quantities, allowed,
                 {[tape](const Moment& moment) {
                    std::array<double, 3> v{};
                    tape->evaluate(moment, v);
                    return Vec3(v[0], v[1], v[2]);
                  },
                  tape->dependsOn()});
}

Animated<double> MomentFormulas::numberAtStart(const Quantity& quantity, const Allowed& allowed) {
  const Animated<double> value = number(quantity, kAny);
  const double now = value.at({0, *variables_.initial()});
  if (!value.isConstant() && !allowed.takes(now)) {
    problems_.add(quantity,
                  {{0, quantity.formula().size()}, "at time 0 this is " + objection(now, allowed), {}});
    return 0.0;
  }
  if (value.isConstant()) return accept(quantity, now, allowed) ? now : 0.0;
  return guarded(quantity, allowed, value);
}

Animated<double> MomentFormulas::angle(const Quantity& quantity) {
  if (quantity.isFormula()) prepareNames();
  const Expr value = expression(quantity, kFinite).value_or(0);
  if (value.isConstant()) return value.constant();
  if (const std::optional<double> rate = rateOf(names_->graph, value))
    return [rate = *rate](double time) { return angleAt(rate, time); };
  return guarded(quantity, kFinite, animated(names_->graph, value, variables_.initial()));
}

Animated<Rotation> MomentFormulas::single(const RotationDesc& desc) {
  Animated<Vec3> axis = vector(desc.axis);
  Animated<double> turn = angle(desc.angle);
  if (axis.isConstant() && turn.isConstant()) {
    const Rotation rotation{axis.at(0), turn.at(0)};
    if (rotation.axis == Vec3(0) && rotation.angle != 0)
      problems_.add(desc.place, "a rotation about a zero axis", "give an axis that is not zero");
    return rotation;
  }
  const DependsOn dependsOn =
      axis.movesWithTime() || turn.movesWithTime() ? DependsOn::Both : DependsOn::Parameters;
  return {[axis = std::move(axis), turn = std::move(turn)](const Moment& moment) {
            return Rotation{axis.at(moment), turn.at(moment)};
          },
          dependsOn};
}

Animated<Rotation> MomentFormulas::rotation(std::span<const RotationDesc> rotations) {
  if (rotations.empty()) return Rotation{};
  Animated<Rotation> whole = single(rotations[0]);
  for (const RotationDesc& desc : rotations.subspan(1)) {
    Animated<Rotation> next = single(desc);
    if (whole.isConstant() && next.isConstant()) {
      whole = product(whole.at(0), next.at(0));
      continue;
    }
    const DependsOn dependsOn =
        whole.movesWithTime() || next.movesWithTime() ? DependsOn::Both : DependsOn::Parameters;
    whole = {[a = std::move(whole), b = std::move(next)](const Moment& moment) {
               return product(a.at(moment), b.at(moment));
             },
             dependsOn};
  }
  return whole;
}

std::optional<double> MomentFormulas::once(const Quantity& quantity, const Allowed& allowed) {
  if (quantity.isFormula()) prepareNames();
  const std::optional<Expr> value = expression(quantity, allowed);
  if (!value || value->isConstant()) return value ? std::optional(value->constant()) : std::nullopt;
  const Animated<double> moving = animated(names_->graph, *value, variables_.initial());
  if (moving.movesWithTime()) {
    problems_.add(quantity, {{0, quantity.formula().size()}, "this is read once: it cannot depend on t", {}});
    return std::nullopt;
  }
  const double now = moving.at(0);
  return accept(quantity, now, allowed) ? std::optional(now) : std::nullopt;
}

std::optional<double> MomentFormulas::fixed(const Quantity& quantity, const Allowed& allowed) {
  if (quantity.isFormula()) prepareNames();
  const std::optional<Expr> value = expression(quantity, allowed);
  if (!value) return std::nullopt;
  if (value->isConstant()) return value->constant();
  problems_.add(quantity, {{0, quantity.formula().size()}, "this cannot depend on t or on parameters", {}});
  return std::nullopt;
}

}  // namespace luxo
