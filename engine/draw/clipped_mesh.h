// SPDX-License-Identifier: Apache-2.0
// What a picture shows of meshes that reach far out of it.
//
// A vertex a million pixels outside of the picture is rounded to a sixteenth of a pixel by single precision,
// and the edges that end there with it. So triangles so long are clipped in double (I. Sutherland and G.
// Hodgman, Reentrant Polygon Clipping, 1974), and what is left is drawn relative to its own middle.
#pragma once

#include <memory>

#include "cull/cull.h"
#include "scene/snapshot.h"
#include "tessellate/mesh.h"

namespace luxo {

/// The part of a mesh that is in the picture or no farther outside of it than the picture is large; the mesh
/// itself where its edges on the screen are short enough for single precision. Triangles that share an edge
/// share the bits of its ends. Cost: nothing where edges are short, else some 100 ns per triangle.
[[nodiscard]] std::shared_ptr<const Mesh> clippedMesh(const View& view, const SnapshotNode& node,
                                                      const VisibleNode& visible,
                                                      const std::shared_ptr<const Mesh>& mesh);

}  // namespace luxo
