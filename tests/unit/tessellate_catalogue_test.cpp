// SPDX-License-Identifier: Apache-2.0
// Adaptive meshes of every surface of the catalogue: without cracks, of the right shape, the right way round.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "catalogue_names.h"
#include "surface/catalogue.h"
#include "tessellate/block_plan.h"
#include "tessellate/edge_net.h"
#include "tessellate/tessellator.h"

namespace luxo {
namespace {

/// Numbers the corners of triangles: one number per point of the surface, what joints and poles identify
/// being one. Positions cannot tell: surfaces may touch and pass through themselves.
class Weld {
 public:
  Weld(const Surface& surface, const Mesh& mesh, const MeshDesc& desc) : surface_(surface), mesh_(mesh) {
    std::vector<Block> blocks = planBlocks(surface, {}, CurvatureMap(surface, {}), desc);
    const EdgeNet net(surface.topology(), blocks);
    for (const EdgeVertex& v : net.vertices()) {
      const Domain& d = surface.patchDomain(v.patch);
      onEdges_[{v.patch, parameterAt(d.u, v.partU), parameterAt(d.v, v.partV)}] = classes_.size();
      classes_.push_back(classes_.size());
    }
    for (const Twin& twin : net.twins()) classes_[classOf(twin.b)] = classOf(twin.a);
  }

  std::size_t number(std::size_t triangle, int corner) {
    const auto uv = [&](int k) { return mesh_.parameters[mesh_.indices[3 * triangle + k]]; };
    const Vec2 center = (uv(0) + uv(1) + uv(2)) / 3.0;
    const std::uint32_t patch = surface_.patchAt(center.x, center.y);
    Vec2 at = uv(corner);
    // A pole has a vertex for every triangle; its first is that at the edge's lower end.
    const Domain& d = surface_.patchDomain(patch);
    const auto collapsed = [&](Side side) { return surface_.topology().edge(patch, side).collapsed(); };
    if ((at.y == d.v.lo && collapsed(Side::VMin)) || (at.y == d.v.hi && collapsed(Side::VMax))) at.x = d.u.lo;
    if ((at.x == d.u.lo && collapsed(Side::UMin)) || (at.x == d.u.hi && collapsed(Side::UMax))) at.y = d.v.lo;
    const auto found = onEdges_.find({patch, at.x, at.y});
    return found != onEdges_.end() ? classOf(found->second)
                                   : classes_.size() + mesh_.indices[3 * triangle + corner];
  }

 private:
  [[nodiscard]] std::size_t classOf(std::size_t vertex) const {
    while (classes_[vertex] != vertex) vertex = classes_[vertex];
    return vertex;
  }

  const Surface& surface_;
  const Mesh& mesh_;
  std::map<std::tuple<std::uint32_t, double, double>, std::size_t> onEdges_;
  std::vector<std::size_t> classes_;
};

bool onBorder(const Surface& surface, const Vec2& p, const Vec2& q) {
  for (std::uint32_t patch = 0; patch < surface.patchCount(); ++patch) {
    const Domain& d = surface.patchDomain(patch);
    const auto is = [&](Side side) { return surface.topology().edge(patch, side).kind == Edge::Border; };
    if ((p.x == d.u.lo && q.x == d.u.lo && is(Side::UMin)) ||
        (p.x == d.u.hi && q.x == d.u.hi && is(Side::UMax)) ||
        (p.y == d.v.lo && q.y == d.v.lo && is(Side::VMin)) ||
        (p.y == d.v.hi && q.y == d.v.hi && is(Side::VMax)))
      return true;
  }
  return false;
}

class CatalogueMesh : public testing::TestWithParam<std::string> {};

TEST_P(CatalogueMesh, IsAManifoldOfTheRightShape) {
  const Surface surface = makeSurface(GetParam());
  const double size = glm::length(surface.framing({}).extent());
  std::mt19937 random(7);
  std::uniform_real_distribution<double> exponent(0.5, 3);
  for (int k = 0; k < 4; ++k) {
    const double tolerance = size * std::pow(10, -exponent(random));
    SCOPED_TRACE("tolerance " + std::to_string(tolerance));
    const MeshDesc desc{.tolerance = tolerance};
    const Mesh mesh = tessellate(surface, {}, desc);
    EXPECT_LE(mesh.bound, tolerance);
    EXPECT_EQ(mesh.dropped, 0u);
    Weld weld(surface, mesh, desc);
    std::map<std::pair<std::size_t, std::size_t>, std::pair<int, int>> edges;
    std::map<std::size_t, Vec3> vertices;
    for (std::size_t t = 0; t < mesh.triangleCount(); ++t)
      for (int c = 0; c < 3; ++c) {
        const std::size_t a = weld.number(t, c), b = weld.number(t, (c + 1) % 3);
        ASSERT_NE(a, b) << "triangle " << t;
        const Vec3& position = mesh.positions[mesh.indices[3 * t + c]];
        ASSERT_EQ(vertices.try_emplace(a, position).first->second, position) << "one point has the same bits";
        auto& uses = edges[{std::min(a, b), std::max(a, b)}];
        ++(a < b ? uses.first : uses.second);
      }
    for (std::size_t t = 0; t < mesh.triangleCount(); ++t)
      for (int c = 0; c < 3; ++c) {
        const std::uint32_t i = mesh.indices[3 * t + c], j = mesh.indices[3 * t + (c + 1) % 3];
        const std::size_t a = weld.number(t, c), b = weld.number(t, (c + 1) % 3);
        const auto& [forward, backward] = edges.at({std::min(a, b), std::max(a, b)});
        const Vec2 &p = mesh.parameters[i], &q = mesh.parameters[j];
        ASSERT_LE(forward + backward, 2) << p.x << ", " << p.y << " to " << q.x << ", " << q.y;
        if (surface.topology().orientable) {
          ASSERT_LE(std::max(forward, backward), 1);
        }
        if (forward + backward == 1) {
          ASSERT_TRUE(onBorder(surface, p, q)) << p.x << ", " << p.y << " to " << q.x << ", " << q.y;
        }
      }
    EXPECT_EQ(static_cast<int>(vertices.size() + mesh.triangleCount()) - static_cast<int>(edges.size()),
              surface.topology().eulerCharacteristic);
  }
}

TEST_P(CatalogueMesh, HasNoTriangleLargerThanItsBlocksCells) {
  // What the bound rests on where blocks of different cells meet.
  const Surface surface = makeSurface(GetParam());
  const MeshDesc desc{.tolerance = glm::length(surface.framing({}).extent()) / 500};
  std::vector<Block> blocks = planBlocks(surface, {}, CurvatureMap(surface, {}), desc);
  const EdgeNet net(surface.topology(), blocks);
  const Mesh mesh = tessellate(surface, {}, desc);
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    const std::uint32_t* i = &mesh.indices[3 * t];
    const Vec2 &a = mesh.parameters[i[0]], &b = mesh.parameters[i[1]], &c = mesh.parameters[i[2]];
    const Vec2 center = (a + b + c) / 3.0;
    const auto holdsCenter = [&](const Block& block) {
      return domainOf(block.tile, surface.patchDomain(block.patch)).contains(center.x, center.y);
    };
    const auto block = std::find_if(blocks.begin(), blocks.end(), holdsCenter);
    ASSERT_NE(block, blocks.end());
    const Domain d = domainOf(block->tile, surface.patchDomain(block->patch));
    const Vec2 cell(d.u.width() / block->segments.u, d.v.width() / block->segments.v);
    const Vec2 size = glm::max(a, glm::max(b, c)) - glm::min(a, glm::min(b, c));
    ASSERT_LE(size.x, cell.x * (1 + 1e-9)) << "triangle " << t;
    ASSERT_LE(size.y, cell.y * (1 + 1e-9)) << "triangle " << t;
  }
}

TEST_P(CatalogueMesh, FacesTheWayItsNormalsPoint) {
  const Surface surface = makeSurface(GetParam());
  const double size = glm::length(surface.framing({}).extent());
  const Mesh mesh = tessellate(surface, {}, {.tolerance = size / 3000});
  std::size_t opposed = 0;
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    const std::uint32_t* i = &mesh.indices[3 * t];
    const Vec3 area =
        glm::cross(mesh.positions[i[1]] - mesh.positions[i[0]], mesh.positions[i[2]] - mesh.positions[i[0]]);
    const Vec3 normal = mesh.normals[i[0]] + mesh.normals[i[1]] + mesh.normals[i[2]];
    for (int k = 0; k < 3; ++k) ASSERT_NEAR(glm::length(mesh.normals[i[k]]), 1, 1e-12);
    if (!(glm::dot(area, normal) > 0)) ++opposed;
  }
  // Slivers at cusps and pinch points may turn over.
  EXPECT_LE(opposed, mesh.triangleCount() / 200);
}

INSTANTIATE_TEST_SUITE_P(Catalogue, CatalogueMesh, testing::ValuesIn(catalogueNames()),
                         [](const auto& test) { return test.param; });

TEST(Teapot, TakesFewTriangles) {
  // 900 pixels wide at half a pixel.
  const Surface teapot = makeSurface("teapot");
  const Vec3 extent = teapot.bounds({}).extent();
  const Mesh mesh = tessellate(teapot, {}, {.tolerance = 0.5 * std::max(extent.x, extent.z) / 900});
  std::printf("teapot, 900 px wide at 0.5 px: %zu triangles\n", mesh.triangleCount());
  EXPECT_LE(mesh.triangleCount(), 25'000u);
}

}  // namespace
}  // namespace luxo
