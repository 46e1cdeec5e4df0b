// SPDX-License-Identifier: Apache-2.0
// Meshes of every named surface: finite, welded as topology says, convergent.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "catalogue_references.h"
#include "tessellate/tessellator.h"

namespace luxo {
namespace {

Mesh gridMesh(const Surface& surface, std::uint32_t u, std::uint32_t v) {
  return tessellate(surface, {}, {.uniform = Segments{u, v}});
}

struct Measures {
  double area = 0, volume = 0;
  Vec3 areaVector{0};
};

Measures measure(const Mesh& mesh) {
  Measures m;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const Vec3 &a = mesh.positions[mesh.indices[i]], &b = mesh.positions[mesh.indices[i + 1]],
               &c = mesh.positions[mesh.indices[i + 2]];
    const Vec3 twice = glm::cross(b - a, c - a);
    m.area += 0.5 * glm::length(twice);
    m.areaVector += 0.5 * twice;
    m.volume += glm::dot(a, twice) / 6;
  }
  return m;
}

class CatalogueMeshes : public testing::TestWithParam<CatalogueReference> {
 protected:
  Surface surface_ = GetParam().surface();
};

TEST_P(CatalogueMeshes, EveryVertexIsFiniteWhateverTheGrid) {
  const bool fewPatches = surface_.patchCount() <= 2;
  for (const std::uint32_t u : {1u, 2u, 3u, 20u, 257u})
    for (const std::uint32_t v : {1u, 2u, 3u, 20u, 257u}) {
      if (!fewPatches && (u > 20 || v > 20)) continue;  // Many patches are that many grids.
      const Mesh mesh = gridMesh(surface_, u, v);
      ASSERT_EQ(mesh.dropped, 0u);
      ASSERT_GT(mesh.triangleCount(), 0u);
      for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const Vec3 &p = mesh.positions[i], &n = mesh.normals[i];
        ASSERT_TRUE(std::isfinite(p.x + p.y + p.z)) << u << " x " << v;
        ASSERT_NEAR(glm::length(n), 1, 1e-15) << u << " x " << v;
      }
    }
}

TEST_P(CatalogueMeshes, WeldedTrianglesHaveTheTopologyOfTheSurface) {
  if (surface_.name() == "steiner_roman") return;  // It runs back and forth along lines of the grid.

  // Odd numbers: where the surface passes through itself no two vertices meet by chance.
  const Mesh mesh = surface_.patchCount() > 2 ? gridMesh(surface_, 5, 7) : gridMesh(surface_, 21, 19);
  std::map<std::array<double, 3>, std::uint32_t> welded;
  const auto vertex = [&](std::uint32_t index) {
    const Vec3 p = mesh.positions[index] + Vec3(0);  // + 0: no two zeros.
    return welded.try_emplace({p.x, p.y, p.z}, static_cast<std::uint32_t>(welded.size())).first->second;
  };
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::array<int, 2>> edges;  // uses, by direction
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const std::array<std::uint32_t, 3> t{vertex(mesh.indices[i]), vertex(mesh.indices[i + 1]),
                                         vertex(mesh.indices[i + 2])};
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t from = t[k], to = t[(k + 1) % 3];
      ASSERT_NE(from, to);
      ++edges[std::minmax(from, to)][from < to ? 0 : 1];
    }
  }
  const int euler = static_cast<int>(welded.size()) - static_cast<int>(edges.size()) +
                    static_cast<int>(mesh.triangleCount());
  // The teapot's handle ends on a vertex of the body: that welds them, which is no joint of edges.
  const int touching = surface_.name() == "teapot" ? 1 : 0;
  EXPECT_EQ(euler, surface_.topology().eulerCharacteristic - touching);

  std::size_t once = 0, sameWay = 0;
  for (const auto& [edge, uses] : edges) {
    ASSERT_LE(uses[0] + uses[1], 2);
    once += uses[0] + uses[1] == 1;
    sameWay += uses[0] + uses[1] == 2 && uses[0] != uses[1];
  }
  EXPECT_EQ(once == 0, surface_.topology().borderless);
  EXPECT_EQ(sameWay == 0, surface_.topology().orientable);
}

TEST_P(CatalogueMeshes, AClosedMeshFacesOutwardAllAround) {
  if (!surface_.closed()) return;
  const Measures m = measure(gridMesh(surface_, 20, 20));
  EXPECT_GT(m.volume, 0);
  EXPECT_LE(glm::length(m.areaVector), 1e-13 * m.area);
}

TEST_P(CatalogueMeshes, AreaAndVolumeConvergeQuadratically) {
  if (!GetParam().smooth || surface_.patchCount() > 2) return;
  const auto order = [](double coarse, double fine, double exact) {
    return std::log2(std::abs(coarse - exact) / std::abs(fine - exact));
  };
  const Measures coarse = measure(gridMesh(surface_, 96, 96)), fine = measure(gridMesh(surface_, 192, 192));
  if (GetParam().area && std::abs(coarse.area - *GetParam().area) > 1e-9) {
    EXPECT_NEAR(order(coarse.area, fine.area, *GetParam().area), 2, 0.1);
  }
  if (GetParam().volume) {
    EXPECT_NEAR(order(coarse.volume, fine.volume, *GetParam().volume), 2, 0.1);
  }
}

INSTANTIATE_TEST_SUITE_P(All, CatalogueMeshes, testing::ValuesIn(catalogueReferences()),
                         [](const auto& instance) {
                           std::string name = instance.param.label;
                           std::ranges::replace_if(
                               name, [](unsigned char c) { return !std::isalnum(c); }, '_');
                           return name;
                         });

}  // namespace
}  // namespace luxo
