// SPDX-License-Identifier: Apache-2.0
// The numbers of a scene file as values of a scene: constants, or compiled formulas of the moment.
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "formula/parse.h"
#include "math/animated.h"
#include "math/vec.h"
#include "scene/ranges.h"
#include "scene/scene_problems.h"
#include "scene/scene_variables.h"

namespace luxo {

/// What a number may be, ends included, and in words.
struct Allowed {
  Interval range{std::numeric_limits<double>::lowest(), std::numeric_limits<double>::max()};
  std::string_view words = "finite";
  bool angle = false;  ///< in radians, which messages say
  /// What a formula gives above the range is not refused: snapshots cut it off (scene/ranges.h).
  bool cut = false;

  [[nodiscard]] bool takes(double value) const {
    return range.contains(value) || (cut && value > range.hi && value <= std::numeric_limits<double>::max());
  }
};
inline constexpr Allowed kFinite{};
inline constexpr Allowed kAny{.words = ""};  ///< infinities and NaN included
inline constexpr Allowed kAboveZero{
    {std::numeric_limits<double>::denorm_min(), std::numeric_limits<double>::max()}, "finite and above 0"};
/// What devices compute with in float (scene/ranges.h).
inline constexpr Allowed kPlace{{-kMaxSceneNumber, kMaxSceneNumber}, "finite, from -1e18 to 1e18"};
inline constexpr Allowed kLength{{1 / kMaxSceneNumber, kMaxSceneNumber}, "from 1e-18 to 1e18"};
inline constexpr Allowed kLight{{0, kMaxSceneNumber}, "from 0 to 1e18", false, true};
inline constexpr Allowed kIntensity{{0, kMaxLight}, "from 0 to 1e30", false, true};
inline constexpr Allowed kFraction{{0, 1}, "from 0 to 1"};

class MomentFormulas {
 public:
  MomentFormulas(const SceneVariables& variables, SceneProblems& problems)
      : variables_(variables), problems_(problems) {}

  /// What is wrong becomes a problem, and the result 0. Constants are held against `allowed` here, what moves
  /// when it is asked for: then it throws Error(Scene) that shows the formula.
  [[nodiscard]] Animated<double> number(const Quantity& quantity, const Allowed& allowed = kFinite);
  [[nodiscard]] Animated<Vec3> vector(const Quantity3& quantities, const Allowed& allowed = kFinite);
  /// As number(); what moves is held against `allowed` here, too, as it is with the parameters' initial
  /// values at time 0.
  [[nodiscard]] Animated<double> numberAtStart(const Quantity& quantity, const Allowed& allowed = kFinite);
  /// [A, B] is A * B. An angle that is a number times `t` turns for ever, as spin() does.
  [[nodiscard]] Animated<Rotation> rotation(std::span<const RotationDesc> rotations);

  /// Throws, when it is asked for, where the value that a quantity stands for is not allowed.
  [[nodiscard]] Animated<double> guarded(const Quantity& quantity, const Allowed& allowed,
                                         Animated<double> value) const;
  [[nodiscard]] Animated<Vec3> guarded(const Quantity3& quantities, const Allowed& allowed,
                                       Animated<Vec3> value) const;

  /// A number that is read once: its parameters have their initial values, and it cannot depend on time.
  [[nodiscard]] std::optional<double> once(const Quantity& quantity, const Allowed& allowed = kFinite);
  /// Whether a constant is allowed; if not, that is a problem of the quantity it comes from.
  bool accept(const Quantity& quantity, double value, const Allowed& allowed);
  /// A number that cannot depend on anything.
  [[nodiscard]] std::optional<double> fixed(const Quantity& quantity, const Allowed& allowed = kFinite);

 private:
  struct Names {
    Graph graph;
    Scope scope;
  };

  void prepareNames();
  std::optional<Expr> expression(const Quantity& quantity, const Allowed& allowed);
  /// What is wrong with a value.
  static std::string objection(double value, const Allowed& allowed);
  /// Throws where a moving quantity gives what is not allowed.
  [[nodiscard]] std::function<void(double value, double time)> guard(const Quantity& quantity,
                                                                     const Allowed& allowed) const;
  Animated<double> angle(const Quantity& quantity);
  Animated<Rotation> single(const RotationDesc& rotation);

  const SceneVariables& variables_;
  SceneProblems& problems_;
  std::unique_ptr<Names> names_;
};

}  // namespace luxo
