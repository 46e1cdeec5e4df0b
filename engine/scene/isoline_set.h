// SPDX-License-Identifier: Apache-2.0
// The isolines of a material, compiled: for the reference in double, and as GLSL.
#pragma once

#include <compare>
#include <cstddef>
#include <memory>
#include <span>
#include <string>

#include "formula/expression.h"
#include "math/mat2.h"
#include "math/vec.h"
#include "scene/isolines.h"

namespace luxo {

/// Immutable and cheap to copy; safe from any thread.
class IsolineSet {
 public:
  IsolineSet() = default;  ///< no lines

  /// One over the other, the last on top: at most kMaxLineFamilies in all. Variables 0 and 1 of the graph
  /// are u and v, 2 + k is parameter k of `parameterCount`; the graph may go. Cost: that of both derivatives
  /// of each field. Throws Error(Scene) for formulas too large for a shader (formula/glsl.h).
  IsolineSet(Graph& graph, std::span<const Isolines> lines, std::size_t parameterCount);

  [[nodiscard]] bool valid() const { return content_ != nullptr; }
  [[nodiscard]] std::size_t parameterCount() const;

  /// A colour, linear RGB, with the lines over it, as a pixel sees it over which u and v move so: in columns,
  /// to the pixel at the right and to that below.
  [[nodiscard]] Vec3 over(const Vec3& color, double u, double v, const Mat2& footprint,
                          std::span<const double> parameters) const;

  /// `vec4 isolinesOver(float u, float v)`: the colour of what of a pixel the lines cover, times that part,
  /// which is last. Whoever includes it has what lib/isolines.glsl asks for.
  [[nodiscard]] const std::string& glsl() const;

  /// By content: equal lines are the same shader, whoever made them.
  friend bool operator==(const IsolineSet& a, const IsolineSet& b) { return (a <=> b) == 0; }
  friend std::strong_ordering operator<=>(const IsolineSet& a, const IsolineSet& b);

 private:
  struct Content;

  std::shared_ptr<const Content> content_;
};

}  // namespace luxo
