// SPDX-License-Identifier: Apache-2.0
// Whether triangles bound a solid, so that whoever looks at it from outside sees fronts only.
//
// A mesh whose edges all join two triangles that go along it opposite ways falls into closed surfaces, which
// hang together along edges. If no two triangles of such a surface meet in more than the corners and edges
// that they share, it parts space in two (Jordan, Brouwer; where it touches itself in single points it may be
// taken apart there), and if the volume that it bounds is positive, the inner part is behind all of its
// triangles. So a ray that begins outside meets a front first. This is so of every one of the surfaces, so it
// is so of all of them, however they pass through each other: around no point they go less than zero times.
#pragma once

#include <optional>

#include "math/transform.h"
#include "mesh/triangle_mesh.h"

namespace luxo {

/// Whether that is certain; in double, so that what is closer than 1e-12 of its size counts as meeting. False
/// where a surface within another bounds a hollow. In parallel. Cost, of a closed million triangles: about 1
/// s on one core, and 70 bytes a triangle meanwhile; of what is not closed nothing.
[[nodiscard]] bool boundsSolid(const TriangleMesh& mesh);

/// How many times a closed mesh, placed there, goes around a point: of one that bounds a solid 0 outside, and
/// more inside. Nothing where its corners, each moved by up to `slack`, may meet the point, or the lines from
/// it along the axes their edges. Cost: some 30 ns a cluster, and as much for each triangle of those that a
/// line meets.
[[nodiscard]] std::optional<int> windingNumber(const TriangleMesh& mesh, const Transform& place,
                                               const Vec3& point, double slack);

}  // namespace luxo
