// SPDX-License-Identifier: Apache-2.0
#include "scene/parameter_order.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "formula/variables.h"
#include "scene/scene_variables.h"

namespace luxo {
namespace {

constexpr std::uint32_t kFirst = 3;  // variable of the first parameter, after u, v and t

/// A walk from each parameter to what it needs, depth first.
class Ordering {
 public:
  Ordering(std::span<const ParameterDesc> parameters, std::vector<std::vector<std::uint32_t>> needs,
           const RejectCircle& reject)
      : parameters_(parameters), needs_(std::move(needs)), reject_(reject), states_(needs_.size()) {}

  void visit(std::uint32_t parameter) {
    if (states_[parameter] != State::New) return;
    enter(parameter);
    while (!path_.empty()) {
      Step& step = path_.back();
      if (step.next == needs_[step.parameter].size()) {
        states_[step.parameter] = State::Done;
        order_.push_back(step.parameter);
        path_.pop_back();
        continue;
      }
      const std::uint32_t needed = needs_[step.parameter][step.next++];
      if (states_[needed] == State::Open) reportCircle(needed);
      if (states_[needed] == State::New) enter(needed);
    }
  }

  [[nodiscard]] std::vector<std::size_t> order() const { return order_; }

 private:
  enum class State : std::uint8_t { New, Open, Done };
  struct Step {
    std::uint32_t parameter;
    std::size_t next = 0;
  };

  void enter(std::uint32_t parameter) {
    states_[parameter] = State::Open;
    path_.push_back({parameter});
  }

  void reportCircle(std::uint32_t back) {
    constexpr std::size_t kShown = 8;
    const auto first = std::ranges::find(path_, back, &Step::parameter);
    const auto length = static_cast<std::size_t>(path_.end() - first);
    std::string circle;
    for (auto step = first; step != path_.end() && step - first < std::ptrdiff_t{kShown}; ++step)
      circle += parameters_[step->parameter].name.text + " -> ";
    if (length > kShown) circle += fmt::format("({} more) -> ", length - kShown);
    std::vector<std::size_t> members;
    for (auto step = first; step != path_.end(); ++step) members.push_back(step->parameter);
    reject_(members,
            fmt::format("parameters need each other in a circle: {}{}", circle, parameters_[back].name.text),
            "give one of them a value without the others");
  }

  std::span<const ParameterDesc> parameters_;
  std::vector<std::vector<std::uint32_t>> needs_;
  const RejectCircle& reject_;
  std::vector<State> states_;
  std::vector<Step> path_;
  std::vector<std::size_t> order_;
};

}  // namespace

std::vector<std::size_t> parameterOrder(std::span<const ParameterDesc> parameters, SceneProblems& problems,
                                        const std::function<void(std::size_t, const Formula&)>& reject,
                                        const RejectCircle& rejectCircle) {
  Graph graph;
  Scope scope;
  scope.bind("u", graph.variable(0));
  scope.bind("v", graph.variable(1));
  scope.bind("t", graph.variable(2));
  std::vector<bool> named(parameters.size());
  for (std::uint32_t k = 0; k < parameters.size(); ++k) {
    const FileName& name = parameters[k].name;
    const std::optional<Diagnostic> problem = scope.nameProblem(name.text);
    named[k] = !problem;
    if (problem)
      problems.add(name.place, problem->message, problem->hint);
    else
      scope.bind(name.text, graph.variable(kFirst + k));
  }
  const std::string onlySurfaces = "u and v are a surface's; a parameter has none";
  scope.explainAbsence("u", onlySurfaces);
  scope.explainAbsence("v", onlySurfaces);

  std::vector<std::vector<std::uint32_t>> needs(parameters.size());
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    if (!named[k] || !parameters[k].value.isFormula()) continue;
    const Formula formula = parse(parameters[k].value.formula(), scope);
    if (!formula.ok) {
      reject(k, formula);
      continue;
    }
    for (const std::uint32_t variable : variablesOf(graph, std::span(&formula.value, 1)))
      if (variable >= kFirst) needs[k].push_back(variable - kFirst);
  }
  Ordering ordering(parameters, std::move(needs), rejectCircle);
  for (std::uint32_t k = 0; k < parameters.size(); ++k)
    if (named[k]) ordering.visit(k);
  return ordering.order();
}

}  // namespace luxo
