// SPDX-License-Identifier: Apache-2.0
// The rectangles of parameters that a surface is made of, and how their edges are named.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "math/interval.h"
#include "surface/surface_function.h"

namespace luxo {

/// The variables of surfaces' formulas: u, v, then parameters.
inline constexpr std::uint32_t kVariableU = 0, kVariableV = 1, kFirstParameter = 2;

/// A rectangle of the (u,v) plane.
struct Domain {
  Interval u{0, 1}, v{0, 1};

  [[nodiscard]] bool contains(double x, double y) const { return u.contains(x) && v.contains(y); }
  friend bool operator==(const Domain&, const Domain&) = default;
};

/// A named surface's formula with its arguments as variables: one for all of that name, while a patch's own
/// function has constants in their places. Shaders of it are compiled when luxo is built.
struct GeneralForm {
  struct Argument {
    double value = 0;
    std::optional<std::uint32_t> parameter = {};  ///< of the surface, instead of the value
  };

  Tape position;  ///< S: variables 2, 3, ... are the patch's constants, then the arguments
  std::vector<Argument> arguments;

  /// The values of variables 2, 3, ...
  [[nodiscard]] std::vector<double> inputs(std::span<const double> constants,
                                           std::span<const double> parameters) const;
};

/// One rectangle and the function that is used on it. The patches of a surface do not overlap in (u,v), so a
/// point of the plane names a point of the surface. Several patches may share one function: then `constants`
/// tell them apart.
struct Patch {
  std::shared_ptr<const SurfaceFunction> function;
  Domain domain;
  std::vector<double> constants = {};  ///< variables 2, 3, ...; the surface's free parameters follow them
  std::shared_ptr<const GeneralForm> general = {};  ///< null: there is none

  /// What searches in single precision count u from (SurfaceFunction::originOfU).
  [[nodiscard]] double originOfU() const { return function->originOfU ? constants.back() : 0; }
};

/// What a patch's function reads beyond u and v: the patch's constants, then the surface's parameters. A view
/// where there are no constants.
class PatchInputs {
 public:
  PatchInputs(const Patch& patch, std::span<const double> parameters) : values_(parameters) {
    if (patch.constants.empty()) return;
    joined_ = patch.constants;
    joined_.insert(joined_.end(), parameters.begin(), parameters.end());
    values_ = joined_;
  }
  PatchInputs(const PatchInputs&) = delete;
  PatchInputs& operator=(const PatchInputs&) = delete;

  operator std::span<const double>() const { return values_; }  // NOLINT: it is one

 private:
  std::vector<double> joined_;
  std::span<const double> values_;
};

/// The point of a patch as expressions of u and v alone: what else the formula reads has its value. Cost:
/// linear.
[[nodiscard]] std::vector<Expr> expressionsOf(const Patch& patch, std::span<const double> parameters,
                                              Graph& graph);

/// The patches of a formula on a rectangle: cut along the lines of constant u and of constant v on which it
/// is kinked, so that each has a smooth piece of it (formula/pieces.h). One patch for a formula without
/// kinks.
[[nodiscard]] std::vector<Patch> cutAtKinks(Graph& graph, const ExprPoint& position, const Domain& domain);

/// The edges of a rectangle. Along an edge the other parameter runs from 0 (its lower end) to 1.
enum class Side : std::uint8_t { UMin, UMax, VMin, VMax };

inline constexpr Side kSides[] = {Side::UMin, Side::UMax, Side::VMin, Side::VMax};

/// The point of the (u,v) plane at `part`, 0..1, of an edge: 0 and 1 give the corners exactly.
struct EdgePoint {
  double u = 0, v = 0;
};
[[nodiscard]] inline EdgePoint edgePoint(const Domain& domain, Side side, double part) {
  const auto along = [part](const Interval& range) {
    return part == 1 ? range.hi : range.lo + part * range.width();
  };
  switch (side) {
    case Side::UMin:
      return {domain.u.lo, along(domain.v)};
    case Side::UMax:
      return {domain.u.hi, along(domain.v)};
    case Side::VMin:
      return {along(domain.u), domain.v.lo};
    case Side::VMax:
      break;
  }
  return {along(domain.u), domain.v.hi};
}

}  // namespace luxo
