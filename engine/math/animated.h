// SPDX-License-Identifier: Apache-2.0
// A value that is constant or a pure function of absolute time in seconds.
#pragma once

#include <functional>
#include <type_traits>
#include <utility>

namespace luxo {

/// Built from a value or from any callable of time: `Animated<double> a = 3;`, `a = [](double t) { return 2 *
/// t; };`. The callable must be pure: the same time gives the same bits, on any thread.
template <class T>
class Animated {
 public:
  Animated(T constant = T{}) : constant_(std::move(constant)) {}  // NOLINT: a value is an animated value

  template <class F>
  requires(std::is_invocable_r_v<T, const F&, double>) Animated(F function)
      : function_(std::move(function)) {}  // NOLINT: so is a function of time

  [[nodiscard]] T at(double timeSeconds) const { return function_ ? function_(timeSeconds) : constant_; }
  [[nodiscard]] bool isConstant() const { return !function_; }

 private:
  T constant_{};
  std::function<T(double)> function_;
};

}  // namespace luxo
