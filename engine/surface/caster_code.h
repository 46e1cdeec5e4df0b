// SPDX-License-Identifier: Apache-2.0
// The shader code by which rays from one point find a surface in its cells, all of it at once: of light, that
// it may keep or let through; or of sight, of what is seen through.
#pragma once

#include <span>
#include <vector>

#include "surface/surface.h"
#include "surface/surface_code.h"

namespace luxo {

/// The code that finds the points of all patches of a surface, and the numbers that it reads of each, equally
/// many; or that of its triangles. One search finds all that a ray meets of a surface, as only that tells
/// which meeting is a point's own.
struct CasterCode {
  SurfaceCodePtr code;
  std::vector<std::vector<double>> parameters;
};

/// By their general form, where they have one: surfaces of one name share it.
[[nodiscard]] CasterCode casterCode(SurfaceCodes& codes, const Surface& surface,
                                    std::span<const double> parameters);

}  // namespace luxo
