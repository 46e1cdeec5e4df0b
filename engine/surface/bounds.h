// SPDX-License-Identifier: Apache-2.0
// Proven bounds of a surface over its domain, by interval evaluation on adaptively split rectangles.
#pragma once

#include <span>

#include "surface/surface.h"

namespace luxo {

/// Box that holds S over the domain. Cost: 256 interval evaluations.
[[nodiscard]] Box boundPosition(const SurfaceFunction& function, const Domain& domain,
                                std::span<const double> parameters);

/// Suprema of |Suu|, |Suv|, |Svv| over the domain: never below the true ones; the rectangle with the worst
/// bound is split until the bound is within 10 % of a value that is really taken, or 512 rectangles were
/// looked at. A second derivative that is unbounded on the domain gives infinity.
[[nodiscard]] PartialBounds boundPartials(const SurfaceFunction& function, const Domain& domain,
                                          std::span<const double> parameters);

}  // namespace luxo
