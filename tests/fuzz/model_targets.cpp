// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "base/assert.h"
#include "fuzz/message.h"
#include "fuzz/target.h"
#include "mesh/index_windows.h"
#include "mesh/model_source.h"
#include "mesh/mtl.h"

namespace luxo {
namespace {

void checkMesh(const TriangleMesh& mesh, std::size_t materials) {
  LUXO_REQUIRE(mesh.valid());
  LUXO_REQUIRE(mesh.triangleCount() > 0);
  LUXO_REQUIRE_COMPARE(mesh.normals().size(), ==, mesh.positions().size());
  for (std::uint32_t i = 0; i < mesh.positions().size(); ++i) {
    LUXO_REQUIRE(mesh.bounds().contains(mesh.point(i)));
    LUXO_REQUIRE(std::abs(glm::length(Vec3(mesh.normals()[i])) - 1) < 1e-6);
    if (!mesh.tangents().empty())
      LUXO_REQUIRE(std::abs(glm::length(Vec3(Vec3f(mesh.tangents()[i]))) - 1) < 1e-6);
  }
  std::uint32_t next = 0;
  for (const MeshCluster& cluster : mesh.clusters()) {
    LUXO_REQUIRE_COMPARE(cluster.firstTriangle, ==, next);
    LUXO_REQUIRE_COMPARE(cluster.material, <, materials);
    next += cluster.triangles;
    for (std::size_t i = 3 * std::size_t(cluster.firstTriangle); i < 3 * std::size_t(next); ++i) {
      const std::uint32_t vertex = mesh.indices()[i];
      LUXO_REQUIRE_COMPARE(vertex, <, mesh.positions().size());
      LUXO_REQUIRE(vertex >= cluster.firstVertex && vertex - cluster.firstVertex < kWindowVertices);
      LUXO_REQUIRE(cluster.bounds.contains(mesh.point(vertex)));
    }
  }
  LUXO_REQUIRE_COMPARE(next, ==, mesh.triangleCount());
}

void check(const Model& model) {
  LUXO_REQUIRE(!model.materials.empty());
  for (const TriangleMesh& mesh : model.meshes) checkMesh(mesh, model.materials.size());
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const ModelNode& node = model.nodes[i];
    LUXO_REQUIRE(node.parent == kNone || node.parent < i);
    LUXO_REQUIRE(node.mesh == kNone || node.mesh < model.meshes.size());
    LUXO_REQUIRE(node.camera == kNone || node.camera < model.cameras.size());
    LUXO_REQUIRE(node.light == kNone || node.light < model.lights.size());
    for (const double time : {0.0, 1.5}) {
      const Transform then = node.parentFromNodeAt(time);
      LUXO_REQUIRE(std::isfinite(glm::dot(then.linear * then.translation, Vec3(1))));
    }
  }
}

const std::filesystem::path kNowhere = "/nonexistent/luxo/model";

template <class Reader>
void fuzzModel(std::string_view input, Reader reader) {
  const ModelOptions options;
  const ModelSource source(kNowhere, options);
  if (const auto model = resultOf([&] { return reader(source, input); })) check(*model);
}

}  // namespace

void fuzzObj(std::string_view input) { fuzzModel(input, readObj); }
void fuzzPly(std::string_view input) { fuzzModel(input, readPly); }
void fuzzStl(std::string_view input) {
  const auto* first = reinterpret_cast<const std::byte*>(input.data());
  const auto file = std::make_shared<const std::vector<std::byte>>(first, first + input.size());
  fuzzModel(input, [&](const ModelSource& source, std::string_view) { return readStl(source, file); });
}
void fuzzGltf(std::string_view input) { fuzzModel(input, readGltf); }

void fuzzMtl(std::string_view input) {
  const ModelOptions options;
  const ModelSource source(kNowhere, options);
  Model model;
  MtlLibrary library;
  (void)resultOf([&] {
    readMtl(source, "fuzz.mtl", input, model, library);
    return 0;
  });
  for (const auto& [name, material] : library) {
    LUXO_REQUIRE(material.opacity >= 0 && material.opacity <= 1);
    LUXO_REQUIRE(material.shininess >= 0);
  }
}

}  // namespace luxo
