// SPDX-License-Identifier: Apache-2.0
// A sheet of triangles -> a plate that can be printed.
#pragma once

#include <cstdint>

#include "mesh/triangle_mesh.h"
#include "tessellate/mesh.h"

namespace luxo {

struct Plate {
  MeshArrays arrays;  ///< walls have no normals of their own
  /// Triangles that are turned over on one of the faces, where the surface bends more sharply than half the
  /// thickness: the plate passes through itself there.
  std::uint64_t folded = 0;
};

/// Both faces, half the thickness from the sheet along its normals, and walls along its borders. Faces that
/// meet in an edge of the sheet, a point of several normals, meet where they would if they were planes, up to
/// twice as far. With `oneSided` neighbours may have opposite normals (a Möbius strip): one face goes on as
/// the other there. Where every edge of the sheet has one triangle or two, every edge of the plate has two,
/// of opposite directions. Cost: linear.
[[nodiscard]] Plate thickened(const Mesh& sheet, double thickness, bool oneSided);

}  // namespace luxo
