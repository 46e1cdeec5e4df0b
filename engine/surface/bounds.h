// SPDX-License-Identifier: Apache-2.0
// Proven bounds of a surface, by interval evaluation on rectangles.
#pragma once

#include <limits>
#include <span>

#include "surface/surface.h"

namespace luxo {

/// Box that holds S over a cell of a patch wherever the formula has a value; empty where it is proven to have
/// none, infinite where nothing could be proven. Where it is not bounded, what has a coordinate above
/// `farthest` does not count. `inputs` as in PatchInputs. Cost: one interval evaluation, or two.
[[nodiscard]] Box boundPosition(const SurfaceFunction& function, const Domain& cell,
                                std::span<const double> inputs,
                                double farthest = std::numeric_limits<double>::infinity());

/// Box that holds S over the domain: the hull of the boxes of cells x cells rectangles.
[[nodiscard]] Box boundPosition(const SurfaceFunction& function, const Domain& domain,
                                std::span<const double> inputs, int cells);

/// Whether the formula is proven to have a value all over a cell. Cost: one interval evaluation.
[[nodiscard]] bool definedAllOver(const SurfaceFunction& function, const Domain& cell,
                                  std::span<const double> inputs);

/// Bounds of |Suu|, |Suv|, |Svv| over a cell. Cost: one interval evaluation.
[[nodiscard]] PartialBounds boundSecond(const SurfaceFunction& function, const Domain& cell,
                                        std::span<const double> inputs);

/// Boxes that hold these derivatives all over a cell; infinite where nothing is proven. Cost: the same.
[[nodiscard]] SecondBounds boundSecondBoxes(const SurfaceFunction& function, const Domain& cell,
                                            std::span<const double> inputs);

/// Whether the formula may be kinked or jump inside the cell. A kink along the cell's edge, which both sides
/// reach with the same value, does not count; a jump there does.
[[nodiscard]] bool mayBeKinked(const SurfaceFunction& function, const Domain& cell,
                               std::span<const double> inputs);

/// Suprema of |Suu|, |Suv|, |Svv| over the domain: never below the true ones; the rectangle with the worst
/// bound is split until the bound is within 10 % of a value that is really taken, or `rectangles` were
/// looked at. A second derivative that is unbounded on the domain gives infinity, and so does a kink.
[[nodiscard]] PartialBounds boundPartials(const SurfaceFunction& function, const Domain& domain,
                                          std::span<const double> inputs, int rectangles);

}  // namespace luxo
