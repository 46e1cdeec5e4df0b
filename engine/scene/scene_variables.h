// SPDX-License-Identifier: Apache-2.0
// What the formulas of a scene file may read: its parameters and the time. In come the parameters as they
// are written, in any order; out go those of a scene, each after what it needs.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "formula/parse.h"
#include "formula/tape.h"
#include "scene/scene.h"
#include "scene/scene_builder.h"
#include "scene/scene_problems.h"

namespace luxo {

/// Values of parameters, by ParameterId.
using ParameterValues = std::shared_ptr<const std::vector<double>>;

/// Formulas of a moment, compiled. Variable 0 is the time, 2 + k is parameter k.
class MomentTape {
 public:
  static constexpr std::uint32_t kTime = 0, kFirstParameter = 2;

  /// `initial` answers at a moment without parameters: how a surface hangs together is asked at one.
  MomentTape(Graph& graph, std::span<const Expr> outputs, ParameterValues initial);

  /// Safe from any thread.
  void evaluate(const Moment& moment, std::span<double> results) const;
  [[nodiscard]] DependsOn dependsOn() const { return dependsOn_; }

 private:
  Tape tape_;
  std::size_t parametersRead_ = 0;  ///< those with a smaller id than this
  DependsOn dependsOn_ = DependsOn::Parameters;
  ParameterValues initial_;
};

/// A formula of the moment as a value. Required: not a constant.
[[nodiscard]] Animated<double> animated(Graph& graph, Expr formula, ParameterValues initial);

class SceneVariables {
 public:
  /// Adds the file's parameters to the scene. Those in a circle are 0. Throws Error(Usage) for a bad
  /// override.
  SceneVariables(const SceneFile& file, std::span<const ParameterOverride> overrides, SceneProblems& problems,
                 Scene& scene);

  [[nodiscard]] std::size_t count() const { return names_.size(); }
  /// The values at time 0, as the file has them.
  [[nodiscard]] const ParameterValues& initial() const { return initial_; }

  /// Gives `t` the expression value(0), and the parameter `id` value(1 + id).
  template <class Value>
  void bind(Scope& scope, const Value& value) const {
    scope.bind("t", value(std::size_t{0}));
    for (std::size_t id = 0; id < names_.size(); ++id) scope.bind(names_[id], value(1 + id));
  }
  /// A parameter's own value, or the time's, as a function of the moment.
  [[nodiscard]] Animated<double> parameter(std::uint32_t id) const;
  [[nodiscard]] static Animated<double> time();

 private:
  std::vector<std::string> names_;  ///< by ParameterId
  ParameterValues initial_;
};

}  // namespace luxo
