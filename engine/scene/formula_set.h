// SPDX-License-Identifier: Apache-2.0
// The formulas of one surface or pattern, in a graph of their own. Of the scene's variables they get those
// that they read, so that only these make the surface change.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "formula/parse.h"
#include "scene/scene_problems.h"
#include "scene/scene_variables.h"
#include "surface/patch.h"
#include "surface/surface.h"

namespace luxo {

/// What to read.
struct FormulaSetDesc {
  std::vector<Quantity> formulas;
  std::span<const LetDesc> let = {};
  QuantityPair u{0, 1}, v{0, 1};
  std::string whyNoU = {}, whyNoV = {};  ///< not empty: the formulas cannot use it, and why
  /// Whether they may use the names of scene/surface_names.h that no parameter has, and of which surface. Of
  /// none they are read, and have no values.
  bool onSurface = false;
  Surface surface = {};
};

class FormulaSet {
 public:
  /// Cost: each formula is parsed twice, once to see what it reads.
  FormulaSet(const FormulaSetDesc& desc, const SceneVariables& variables);

  /// Whether everything could be read.
  [[nodiscard]] bool ok() const { return problems_.empty(); }
  void reportTo(SceneProblems& problems) const;

  [[nodiscard]] Graph& graph() const { return *graph_; }
  [[nodiscard]] const std::vector<Expr>& values() const { return values_; }
  /// What the names stand for.
  [[nodiscard]] Expr u() const { return u_; }
  [[nodiscard]] Expr v() const { return v_; }
  /// Ranges as they are written; 0..1 where one moves: then `u` in the formulas stands for all of
  /// lowest + (highest - lowest) * variable 0.
  [[nodiscard]] const Domain& domain() const { return domain_; }
  /// The values of variables 2, 3, ... of the graph.
  [[nodiscard]] const std::vector<Animated<double>>& parameters() const { return parameters_; }
  /// Whether one of the first so many formulas reads u or v.
  [[nodiscard]] bool varies(std::size_t formulas) const;
  /// Whether one uses a name of scene/surface_names.h.
  [[nodiscard]] bool readsSurface() const { return readsSurface_; }

 private:
  struct Problem {
    Quantity quantity;
    Diagnostic diagnostic;
    std::optional<FilePlace> place;  ///< instead of the quantity's
  };

  /// Reads everything into a new graph in which the scene's variables have these numbers.
  void read(const FormulaSetDesc& desc, const SceneVariables& variables,
            std::span<const std::uint32_t> numbers);
  void bindSurface(const FormulaSetDesc& desc, Scope& scope, std::uint32_t firstVariable);
  Expr readRange(const QuantityPair& range, Scope& scope, std::uint32_t variable, Interval& domain);
  void readLet(std::span<const LetDesc> let, Scope& scope);
  Expr readOne(const Quantity& quantity, Scope& scope);

  std::unique_ptr<Graph> graph_;
  std::vector<Expr> values_;
  Expr u_, v_;
  Domain domain_;
  std::vector<Animated<double>> parameters_;
  std::vector<Problem> problems_;
  bool readsSurface_ = false;
};

}  // namespace luxo
