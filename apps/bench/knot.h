// SPDX-License-Identifier: Apache-2.0
// A knotted tube of a million triangles.
#pragma once

#include "mesh/triangle_mesh.h"

namespace luxo::bench {

inline constexpr std::uint32_t kKnotTriangles = 1'000'000;

/// Closed, about 7 m wide, with unit normals; fronts are outside.
[[nodiscard]] MeshArrays knot();

}  // namespace luxo::bench
