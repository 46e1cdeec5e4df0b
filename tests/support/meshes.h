// SPDX-License-Identifier: Apache-2.0
// Triangle meshes that tests make themselves.
#pragma once

#include <random>

#include "mesh/triangle_mesh.h"
#include "surface/surface.h"

namespace luxo::test {

/// From -1 to 1 in x and y, normal +Z, uv from 0 to 1: two triangles.
[[nodiscard]] TriangleMesh quadMesh();
/// From -1 to 1, with flat normals: closed.
[[nodiscard]] TriangleMesh cubeMesh();
/// cubeMesh(), each of whose triangles is there so many times; with parameters, unless they are all 0.
[[nodiscard]] TriangleMesh repeatedCube(std::uint32_t times, bool parameters);
/// An icosahedron whose triangles were cut in four so many times, corners on the unit sphere: closed, with
/// smooth normals.
[[nodiscard]] TriangleMesh icosphere(int cuts);
/// Like a head, about 2 high, its face toward +Z: sockets, brows, a nose, lips, ears and a neck that is cut
/// off, so that it is open there; smooth normals, u around it from the back and v from the top down, with a
/// seam. 2 * columns * rows triangles.
[[nodiscard]] TriangleMesh headMesh(int columns, int rows);
/// The triangles of a formula surface, with its normals and parameters.
[[nodiscard]] TriangleMesh meshOf(const Surface& surface, double tolerance);
/// Triangles with corners anywhere in the cube from -1 to 1, of about that size, with given normals and uvs.
[[nodiscard]] TriangleMesh soup(std::mt19937& random, std::uint32_t triangles, double size);

}  // namespace luxo::test
