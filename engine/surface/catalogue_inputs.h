// SPDX-License-Identifier: Apache-2.0
// What the makers of the catalogue's surfaces read and use: u, v and the arguments as expressions.
#pragma once

#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "formula/expression.h"
#include "surface/catalogue.h"

namespace luxo {

/// The values of an entry's arguments, one number per component, in the table's order.
class CatalogueValues {
 public:
  /// Throws as makeSurface() does.
  CatalogueValues(const CatalogueEntry& entry, std::span<const SurfaceArgument> arguments);

  [[nodiscard]] const CatalogueEntry& entry() const { return *entry_; }
  [[nodiscard]] const std::vector<Animated<double>>& components() const { return components_; }
  /// Component `index` at a moment, checked against its range and, with the others, the requirement. What is
  /// no number at all is passed on: the scene, which knows the node, refuses it.

  [[nodiscard]] double at(std::size_t index, const Moment& moment) const;
  /// Index of an argument's component; the argument must exist.
  [[nodiscard]] std::size_t indexOf(std::string_view argument, std::size_t component) const;

 private:
  void take(const SurfaceArgument& argument);
  void checkRange(std::size_t index, double value, std::optional<double> time = {}) const;
  void checkRequirement(const Moment& moment) const;

  const CatalogueEntry* entry_;
  std::vector<Animated<double>> components_;
};

/// One patch of a surface: where it is, and the numbers its formula reads there.
struct PatchPlace {
  Domain domain;
  std::vector<double> constants = {};
};

/// Of each patch.
using GeneralForms = std::vector<std::shared_ptr<const GeneralForm>>;

class SurfaceInputs {
 public:
  /// `forms` go to the surface's patches.
  SurfaceInputs(std::shared_ptr<const CatalogueValues> values, const Moment& start, GeneralForms forms);
  /// All arguments are variables, and what is made is no surface but its general forms.
  SurfaceInputs(std::shared_ptr<const CatalogueValues> values, GeneralForms& forms);

  [[nodiscard]] Expr u() const { return u_; }
  [[nodiscard]] Expr v() const { return v_; }
  /// 2 pi u
  [[nodiscard]] Expr phi() const { return kTau * u_; }
  /// An argument: a constant, or a variable.
  [[nodiscard]] Expr operator()(std::string_view argument, std::size_t component = 0) const;
  /// Its value; nothing where it moves. What a formula's structure depends on, general forms included.
  [[nodiscard]] std::optional<double> constant(std::string_view argument, std::size_t component = 0) const;
  /// Number `index` of what each patch brings along (PatchPlace::constants).
  [[nodiscard]] Expr patchConstant(std::uint32_t index) const;

  /// The surface of one formula over the unit square.
  [[nodiscard]] Surface surface(const ExprPoint& position, SurfaceTraits traits = {}) const;
  /// The profile, turned once around the Y axis by u.
  [[nodiscard]] Surface revolve(Expr radius, Expr height, SurfaceTraits traits = {}) const;
  /// One formula on several patches.
  [[nodiscard]] Surface patchwork(const ExprPoint& position, const std::vector<PatchPlace>& places) const;
  /// A formula per patch.
  struct PatchFormula {
    ExprPoint position;
    Domain domain;
  };
  [[nodiscard]] Surface patchwork(const std::vector<PatchFormula>& formulas) const;

 private:
  SurfaceInputs(std::shared_ptr<const CatalogueValues> values, const Moment& start, GeneralForms* made);

  /// A formula's patches.
  struct Piece {
    ExprPoint position;
    std::vector<PatchPlace> places;
  };
  /// Finds the topology for the moment the surface starts with, then lets the parameters move.
  [[nodiscard]] Surface assemble(const std::vector<Piece>& pieces, SurfaceTraits traits) const;
  [[nodiscard]] GeneralForms generalForms(const std::vector<Piece>& pieces) const;

  std::shared_ptr<const CatalogueValues> values_;
  Moment start_;
  GeneralForms forms_;
  GeneralForms* made_ = nullptr;
  std::unique_ptr<Graph> graph_;
  Expr u_, v_;
  std::vector<Expr> patchConstants_;
  std::vector<Expr> components_;
};

/// A formula of the literature, whose axis is z, turned upright: (x, y, z) -> (x, z, -y).
[[nodiscard]] inline ExprPoint upright(Expr x, Expr y, Expr z) { return {x, z, -y}; }

// The table, by family.
[[nodiscard]] std::vector<CatalogueEntry> elementarySurfaces();
[[nodiscard]] std::vector<CatalogueEntry> algebraicSurfaces();
[[nodiscard]] std::vector<CatalogueEntry> curvatureSurfaces();
[[nodiscard]] std::vector<CatalogueEntry> oneSidedSurfaces();
[[nodiscard]] std::vector<CatalogueEntry> superquadrics();
[[nodiscard]] std::vector<CatalogueEntry> tubeSurfaces();

// Arguments that many surfaces have.
inline constexpr Interval kLengthRange{1e-12, 1e12};

[[nodiscard]] inline CatalogueArgument length(std::string_view name, double initial, std::string_view meaning,
                                              Interval range = kLengthRange) {
  return {name, meaning, ArgumentKind::Length, {initial}, range};
}
[[nodiscard]] inline CatalogueArgument number(std::string_view name, double initial, std::string_view meaning,
                                              Interval range) {
  return {name, meaning, ArgumentKind::Number, {initial}, range};
}
[[nodiscard]] inline CatalogueArgument angle(std::string_view name, double initial, std::string_view meaning,
                                             Interval range) {
  return {name, meaning, ArgumentKind::Angle, {initial}, range};
}
[[nodiscard]] inline CatalogueArgument count(std::string_view name, double initial, std::string_view meaning,
                                             Interval range) {
  return {name, meaning, ArgumentKind::Count, {initial}, range};
}

}  // namespace luxo
