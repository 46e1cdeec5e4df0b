// SPDX-License-Identifier: Apache-2.0
// PLY and STL, both binary: triangles of single precision in the world.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/srgb_curve.h"
#include "mesh/model_target.h"

namespace luxo {
namespace {

struct Counts {
  std::uint64_t vertices = 0, triangles = 0;
};

/// Both formats number with 32 bits.
Counts countsOf(const std::vector<PlacedMesh>& meshes) {
  Counts counts;
  for (const PlacedMesh& placed : meshes) {
    counts.vertices += placed.mesh().positions().size();
    counts.triangles += placed.mesh().triangleCount();
  }
  if (std::max(counts.vertices, counts.triangles) >= std::numeric_limits<std::int32_t>::max())
    throw Error(ErrorKind::Scene, fmt::format("{} triangles are too many for one file", counts.triangles),
                "allow a larger deviation");
  return counts;
}

void appendPoint(std::vector<std::byte>& bytes, const Vec3& v) {
  for (int i = 0; i < 3; ++i) append(bytes, float(v[i]));
}

std::array<std::uint8_t, 3> codesOf(const Vec3& colour) {
  std::array<std::uint8_t, 3> codes{};
  for (int i = 0; i < 3; ++i)
    codes[std::size_t(i)] =
        std::uint8_t(std::floor(255 * srgbFromLinear(std::clamp(colour[i], 0.0, 1.0)) + 0.5));
  return codes;
}

}  // namespace

std::vector<std::byte> writePly(const Model& model, const ModelClaim& claim, const LengthUnit& unit) {
  const std::vector<PlacedMesh> meshes = placedMeshes(model, unit);
  const Counts counts = countsOf(meshes);
  std::vector<std::byte> bytes;
  appendText(bytes, "ply\nformat binary_little_endian 1.0\n");
  for (const std::string& line : comments(claim, unit)) appendText(bytes, fmt::format("comment {}\n", line));
  appendText(bytes, fmt::format("element vertex {}\n"
                                "property float x\nproperty float y\nproperty float z\n"
                                "property float nx\nproperty float ny\nproperty float nz\n"
                                "property uchar red\nproperty uchar green\nproperty uchar blue\n"
                                "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
                                counts.vertices, counts.triangles));
  bytes.reserve(bytes.size() + 27 * counts.vertices + 13 * counts.triangles);
  for (const PlacedMesh& placed : meshes) {
    const TriangleMesh& mesh = placed.mesh();
    // A vertex that several materials share has the colour of the last.
    std::vector<std::array<std::uint8_t, 3>> colours(mesh.positions().size());
    for (const MeshGroup& group : mesh.groups())
      for (std::uint32_t t = group.firstTriangle; t < group.firstTriangle + group.triangles; ++t)
        for (const std::uint32_t corner : placed.corners(t))
          colours[corner] = codesOf(model.materials[group.material].diffuse);
    for (std::uint32_t i = 0; i < colours.size(); ++i) {
      appendPoint(bytes, placed.point(i));
      appendPoint(bytes, placed.normal(i));
      append(bytes, colours[i]);
    }
  }
  std::uint32_t first = 0;
  for (const PlacedMesh& placed : meshes) {
    for (std::uint32_t t = 0; t < placed.mesh().triangleCount(); ++t) {
      append(bytes, std::uint8_t(3));
      for (const std::uint32_t corner : placed.corners(t)) append(bytes, first + corner);
    }
    first += std::uint32_t(placed.mesh().positions().size());
  }
  return bytes;
}

std::vector<std::byte> writeStl(const Model& model, const ModelClaim& claim, const LengthUnit& unit) {
  const std::vector<PlacedMesh> meshes = placedMeshes(model, unit);
  const Counts counts = countsOf(meshes);
  // It must not begin with "solid", which would be a text.
  std::string header = comments(claim, unit)[0];
  header.resize(80);
  std::vector<std::byte> bytes;
  bytes.reserve(84 + 50 * counts.triangles);
  appendText(bytes, header);
  append(bytes, std::uint32_t(counts.triangles));
  for (const PlacedMesh& placed : meshes)
    for (std::uint32_t t = 0; t < placed.mesh().triangleCount(); ++t) {
      const auto [a, b, c] = placed.corners(t);
      const Vec3 pa = placed.point(a), pb = placed.point(b), pc = placed.point(c);
      appendPoint(bytes, luxo::unit(glm::cross(pb - pa, pc - pa)));
      for (const Vec3& p : {pa, pb, pc}) appendPoint(bytes, p);
      append(bytes, std::uint16_t(0));
    }
  return bytes;
}

}  // namespace luxo
