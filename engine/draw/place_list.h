// SPDX-License-Identifier: Apache-2.0
// Where the light rays of meshes start: not at the mesh, but at the formula's point S(u, v) that a pixel
// shows (shaders/lib/mesh_place_fragment.glsl).
#pragma once

#include "draw/draw_list.h"
#include "draw/material_list.h"

namespace luxo {

/// Whether light falls on meshes in it.
[[nodiscard]] bool isLitMesh(Shading shading);
/// Whether a node is drawn as a mesh that is only near to its surface.
[[nodiscard]] bool isOnlyNear(const Snapshot& snapshot, const SnapshotNode& node, const DrawOptions& options);

/// Fills DrawList::places and placed, of a list that finds places, and those of its layers, where there are
/// shadows. Meshes whose formula is too large for a
/// shader are left out: their light rays start at the mesh.
void listPlaces(const Snapshot& snapshot, const VisibleList& visible, const DrawOptions& options,
                Geometry& geometry, const MaterialList& materials, DrawList& list);

}  // namespace luxo
