// SPDX-License-Identifier: Apache-2.0
// A value that is constant or a pure function of the moment: absolute time in seconds and a scene's
// parameters.
#pragma once

#include <functional>
#include <span>
#include <type_traits>
#include <utility>

namespace luxo {

/// Absolute time and the values of a scene's parameters at that time, by ParameterId. A view: the values are
/// the caller's. A bare number is a moment of a scene without parameters.
struct Moment {
  double time = 0;  ///< seconds
  std::span<const double> parameters = {};

  constexpr Moment(double timeSeconds = 0, std::span<const double> values = {})  // NOLINT: see above
      : time(timeSeconds), parameters(values) {}
};

/// What a function of the moment reads.
enum class DependsOn { Time, Parameters, Both };

/// Built from a value or from a callable of time or of the moment: `Animated<double> a = 3;`,
/// `a = [](double t) { return 2 * t; };`, `a = [](const Moment& m) { return m.parameters[0]; };`. The
/// callable must be pure: the same moment gives the same bits, on any thread.
template <class T>
class Animated {
 public:
  Animated(T constant = T{}) : constant_(std::move(constant)) {}  // NOLINT: a value is an animated value

  /// A callable that reads only parameters may say so: then it stands still when time passes.
  template <class F>
  requires(std::is_invocable_r_v<T, const F&, const Moment&>)
      Animated(F function, DependsOn dependsOn = DependsOn::Both)  // NOLINT: so is a function of the moment
      : function_(std::move(function)), movesWithTime_(dependsOn != DependsOn::Parameters) {}

  template <class F>
  requires(std::is_invocable_r_v<T, const F&, double> && !std::is_invocable_v<const F&, const Moment&>)
      Animated(F function)  // NOLINT: so is a function of time
      : function_([f = std::move(function)](const Moment& moment) -> T { return f(moment.time); }),
        movesWithTime_(true) {}

  [[nodiscard]] T at(const Moment& moment) const { return function_ ? function_(moment) : constant_; }
  [[nodiscard]] bool isConstant() const { return !function_; }
  /// Whether it may change when only time passes and every parameter keeps its value.
  [[nodiscard]] bool movesWithTime() const { return movesWithTime_; }

 private:
  T constant_{};
  std::function<T(const Moment&)> function_;
  bool movesWithTime_ = false;
};

}  // namespace luxo
