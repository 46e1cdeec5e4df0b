// SPDX-License-Identifier: Apache-2.0
// Where a point of triangles that a vertex program has moved (scene/vertex_movement.h) was before, in the
// place of the frame of maps of normals (scene/normal_map.h): who runs the program there again in the pixel
// has no use for the other. shaders/lib/rest_frame.glsl has the same.
#pragma once

#include "reference/caster.h"
#include "tessellate/mesh.h"

namespace luxo {

/// The point, and in w the normal, by 15 bits a number (off by 5e-5 at most): a number of magnitude 2 and
/// more, which no frame has. `normal`: of any length but 0.
[[nodiscard]] Vec4f restFrame(const Vec3f& point, const Vec3& normal);

/// Of a point that a ray has met of the node: its frame for maps of normals, or where it was at rest.
[[nodiscard]] Vec4f frameOf(const SnapshotNode& node, const reference::Hit& hit);

}  // namespace luxo
