// SPDX-License-Identifier: Apache-2.0
#include "scene/scene_variables.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "base/suggestion.h"
#include "formula/variables.h"
#include "scene/moment_formulas.h"
#include "scene/parameter_order.h"

namespace luxo {
namespace {

/// An override as messages show it.
std::string shown(const ParameterOverride& o) {
  return o.value.isFormula() ? fmt::format("-P {}={}", o.name, o.value.formula())
                             : fmt::format("-P {}={}", o.name, o.value.number());
}

[[noreturn]] void rejectFormula(const ParameterOverride& o, const Formula& formula) {
  std::string message = fmt::format("cannot read the value of parameter '{}'", o.name);
  for (const Diagnostic& diagnostic : formula.diagnostics)
    message += fmt::format("\n{}", describe(fmt::format("-P {}", o.name), o.value.formula(), diagnostic));
  throw Error(ErrorKind::Usage, message);
}

/// The file's parameters with the values they are to have.
std::vector<ParameterDesc> overridden(const SceneFile& file, std::span<const ParameterOverride> overrides) {
  std::vector<ParameterDesc> parameters = file.parameters;
  std::vector<std::string> names;
  for (const ParameterDesc& parameter : parameters) names.push_back(parameter.name.text);
  for (const ParameterOverride& o : overrides) {
    const auto found = std::ranges::find(names, o.name);
    if (found == names.end())
      throw Error(ErrorKind::Usage, fmt::format("'{}': the scene has no parameter '{}'", shown(o), o.name),
                  names.empty()
                      ? "the scene has no parameters"
                      : didYouMean(o.name, names, fmt::format("its parameters are {}", listed(names))));
    parameters[static_cast<std::size_t>(found - names.begin())].value = o.value;
  }
  return parameters;
}

std::optional<Interval> rangeOf(const QuantityPair& range, MomentFormulas& limits, SceneProblems& problems) {
  const std::optional<double> lowest = limits.fixed(range[0]), highest = limits.fixed(range[1]);
  if (!lowest || !highest) return std::nullopt;
  if (*lowest < *highest) return Interval{*lowest, *highest};
  problems.add(range[0].place(), fmt::format("the range from {:.9g} to {:.9g} is empty", *lowest, *highest),
               "write the smaller number first");
  return std::nullopt;
}

}  // namespace

MomentTape::MomentTape(Graph& graph, std::span<const Expr> outputs, ParameterValues initial)
    : tape_(graph, outputs), initial_(std::move(initial)) {
  for (const std::uint32_t variable : variablesOf(graph, outputs)) {
    if (variable >= kFirstParameter) parametersRead_ = variable - kFirstParameter + 1;
    if (variable == kTime) dependsOn_ = DependsOn::Both;
  }
}

void MomentTape::evaluate(const Moment& moment, std::span<double> results) const {
  const bool known = moment.parameters.size() >= parametersRead_;
  tape_.evaluatePoint(moment.time, 0, known ? moment.parameters : std::span(*initial_), results);
}

Animated<double> animated(Graph& graph, Expr formula, ParameterValues initial) {
  const auto tape = std::make_shared<const MomentTape>(graph, std::span(&formula, 1), std::move(initial));
  return {[tape](const Moment& moment) {
            double value = 0;
            tape->evaluate(moment, {&value, 1});
            return value;
          },
          tape->dependsOn()};
}

Animated<double> SceneVariables::time() {
  return [](const Moment& moment) { return moment.time; };
}

Animated<double> SceneVariables::parameter(std::uint32_t id) const {
  return {[id, initial = initial_](const Moment& moment) {
            return id < moment.parameters.size() ? moment.parameters[id] : (*initial)[id];
          },
          DependsOn::Parameters};
}

SceneVariables::SceneVariables(const SceneFile& file, std::span<const ParameterOverride> overrides,
                               SceneProblems& problems, Scene& scene) {
  const std::vector<ParameterDesc> parameters = overridden(file, overrides);
  const auto overrideOf = [&](const ParameterDesc& parameter) -> const ParameterOverride* {
    const auto found = std::ranges::find(overrides.rbegin(), overrides.rend(), parameter.name.text,
                                         &ParameterOverride::name);
    return found == overrides.rend() ? nullptr : &*found;
  };
  std::vector<bool> wrong(parameters.size());
  const auto reject = [&](std::size_t k, const Formula& formula) {
    wrong[k] = true;
    if (const ParameterOverride* o = overrideOf(parameters[k])) rejectFormula(*o, formula);
    for (const Diagnostic& diagnostic : formula.diagnostics) problems.add(parameters[k].value, diagnostic);
  };
  // Of a circle that an override closes the file knows nothing.
  const auto rejectCircle = [&](std::span<const std::size_t> members, const std::string& message,
                                const std::string& hint) {
    for (const std::size_t k : members)
      if (const ParameterOverride* o = overrideOf(parameters[k]))
        throw Error(ErrorKind::Usage, fmt::format("'{}': {}", shown(*o), message), hint);
    problems.add(parameters[members.front()].value.place(), message, hint);
  };
  const std::vector<std::size_t> order = parameterOrder(parameters, problems, reject, rejectCircle);
  for (const std::size_t k : order) names_.push_back(parameters[k].name.text);

  const auto initial = std::make_shared<std::vector<double>>(names_.size());
  initial_ = initial;
  SceneProblems reported(file.source);  // again: the formulas of values have been reported
  MomentFormulas values(*this, reported), limits(*this, problems);
  for (std::size_t id = 0; id < order.size(); ++id) {
    const ParameterDesc& desc = parameters[order[id]];
    Parameter parameter{
        .name = desc.name.text, .label = desc.label, .value = values.number(desc.value, kAny)};
    (*initial)[id] = parameter.value.at({0, std::span(*initial).first(id)});
    if (desc.range) parameter.range = rangeOf(*desc.range, limits, problems);
    if (desc.step) parameter.step = limits.fixed(*desc.step, kAboveZero);
    if (wrong[order[id]]) continue;
    try {
      requireAllowed(parameter, (*initial)[id]);
      scene.add(parameter);
    } catch (const Error& error) {
      if (const ParameterOverride* o = overrideOf(desc))
        throw Error(ErrorKind::Usage, fmt::format("'{}': {}", shown(*o), error.what()), error.hint());
      problems.add(desc.value.place(), error.what(), error.hint());
    }
  }
}

}  // namespace luxo
