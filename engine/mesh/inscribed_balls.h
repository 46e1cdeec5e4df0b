// SPDX-License-Identifier: Apache-2.0
// Balls inside of the solid that a mesh bounds: whoever looks at it from outside sees nothing behind one.
//
// Each touches the mesh somewhere from within, and is the largest that does: a ball that touches it there
// shrinks until nothing else of the mesh is in it (Ma, Bae, Choi, 3D medial axis point approximation using
// nearest neighbors and the normal field, 2012).
#pragma once

#include <vector>

#include "math/bounds.h"
#include "mesh/triangle_mesh.h"

namespace luxo {

/// Object space; no point of the mesh is in one, and the mesh goes around all of them. At most 256, of those
/// large enough to hide something, at points all over the mesh that no other ball comes close to. Required:
/// boundsSolid(mesh). In parallel; the balls do not depend on the number of threads. Cost, of a million
/// triangles: about a millisecond on one core for each place that is looked at, a few for each ball.
[[nodiscard]] std::vector<Sphere> inscribedBalls(const TriangleMesh& mesh);

}  // namespace luxo
