// SPDX-License-Identifier: Apache-2.0
#include "scene/formula_set.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "formula/variables.h"
#include "scene/surface_names.h"

namespace luxo {

FormulaSet::FormulaSet(const FormulaSetDesc& desc, const SceneVariables& variables) {
  // First with all of the scene's variables: the time, then the parameters.
  std::vector<std::uint32_t> numbers(1 + variables.count());
  for (std::uint32_t i = 0; i < numbers.size(); ++i) numbers[i] = kFirstParameter + i;
  read(desc, variables, numbers);
  if (!ok()) return;
  std::vector<Expr> all = values_;
  all.insert(all.end(), {u_, v_});
  for (const std::uint32_t variable : variablesOf(*graph_, all)) {
    if (variable < kFirstParameter) continue;
    const std::uint32_t which = variable - kFirstParameter;
    if (which >= numbers.size()) {
      readsSurface_ = true;
      continue;
    }
    numbers[which] = static_cast<std::uint32_t>(kFirstParameter + parameters_.size());
    parameters_.push_back(which == 0 ? SceneVariables::time() : variables.parameter(which - 1));
  }
  read(desc, variables, numbers);
  if (readsSurface_ && desc.surface.valid())
    parameters_.insert(parameters_.end(), desc.surface.parameters().begin(), desc.surface.parameters().end());
}

// What is known of the surface are variables first, to see whether they are read.
void FormulaSet::bindSurface(const FormulaSetDesc& desc, Scope& scope, std::uint32_t firstVariable) {
  std::vector<Expr> values;
  if (readsSurface_ && desc.surface.valid())
    values = surfaceValues(*graph_, desc.surface, firstVariable);
  else
    for (std::uint32_t i = 0; i < kSurfaceNames.size(); ++i)
      values.push_back(graph_->variable(firstVariable + i));
  for (std::size_t i = 0; i < values.size(); ++i) scope.bind(std::string(kSurfaceNames[i]), values[i]);
}

void FormulaSet::read(const FormulaSetDesc& desc, const SceneVariables& variables,
                      std::span<const std::uint32_t> numbers) {
  graph_ = std::make_unique<Graph>();
  Scope scope;
  if (desc.onSurface) {
    const std::size_t sceneVariables = readsSurface_ ? parameters_.size() : numbers.size();
    bindSurface(desc, scope, static_cast<std::uint32_t>(kFirstParameter + sceneVariables));
  }
  variables.bind(scope, [&](std::size_t which) { return graph_->variable(numbers[which]); });
  scope.explainAbsence("u", desc.whyNoU.empty() ? "a range cannot depend on it" : desc.whyNoU);
  scope.explainAbsence("v", desc.whyNoV.empty() ? "a range cannot depend on it" : desc.whyNoV);
  u_ = readRange(desc.u, scope, kVariableU, domain_.u);
  v_ = readRange(desc.v, scope, kVariableV, domain_.v);
  if (desc.whyNoU.empty()) scope.bind("u", u_);
  if (desc.whyNoV.empty()) scope.bind("v", v_);
  readLet(desc.let, scope);
  values_.clear();
  for (const Quantity& formula : desc.formulas) values_.push_back(readOne(formula, scope));
}

Expr FormulaSet::readRange(const QuantityPair& range, Scope& scope, std::uint32_t variable,
                           Interval& domain) {
  const std::size_t problemsBefore = problems_.size();
  const Expr lowest = readOne(range[0], scope), highest = readOne(range[1], scope);
  const Expr unit = graph_->variable(variable);
  domain = {0, 1};
  if (problems_.size() > problemsBefore) return unit;
  if (!lowest.isConstant() || !highest.isConstant()) return lowest + (highest - lowest) * unit;
  const double a = lowest.constant(), b = highest.constant();
  if (std::isfinite(a) && std::isfinite(b) && a < b) {
    domain = {a, b};
    return unit;
  }
  std::string message =
      fmt::format("the range from {:.9g} to {:.9g} is {}", a, b, a >= b ? "empty" : "not finite");
  const std::size_t size = range[0].isFormula() ? range[0].formula().size() : 0;
  problems_.push_back(
      {range[0], {{0, size}, std::move(message), a > b ? "write the smaller number first" : ""}, {}});
  return unit;
}

void FormulaSet::readLet(std::span<const LetDesc> let, Scope& scope) {
  std::vector<const LetDesc*> defined;
  for (const LetDesc& entry : let) {
    if (std::optional<Diagnostic> problem = scope.nameProblem(entry.name.text)) {
      problems_.push_back({{}, std::move(*problem), entry.name.place});
    } else if (entry.value.isFormula()) {
      scope.define(entry.name.text, entry.value.formula());
      defined.push_back(&entry);
    } else {
      scope.bind(entry.name.text, entry.value.number());
    }
  }
  for (const LetDesc* entry : defined)
    for (const Diagnostic& diagnostic : scope.definition(entry->name.text).diagnostics)
      problems_.push_back({entry->value, diagnostic, {}});
}

Expr FormulaSet::readOne(const Quantity& quantity, Scope& scope) {
  if (!quantity.isFormula()) return quantity.number();
  const Formula formula = parse(quantity.formula(), scope);
  for (const Diagnostic& diagnostic : formula.diagnostics) problems_.push_back({quantity, diagnostic, {}});
  return formula.value;
}

bool FormulaSet::varies(std::size_t formulas) const {
  const std::vector<std::uint32_t> variables = variablesOf(*graph_, std::span(values_).first(formulas));
  return !variables.empty() && variables.front() < kFirstParameter;
}

void FormulaSet::reportTo(SceneProblems& problems) const {
  for (const Problem& problem : problems_) {
    if (problem.place)
      problems.add(*problem.place, problem.diagnostic.message, problem.diagnostic.hint);
    else
      problems.add(problem.quantity, problem.diagnostic);
  }
}

}  // namespace luxo
