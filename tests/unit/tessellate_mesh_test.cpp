// SPDX-License-Identifier: Apache-2.0
// The mesh as a combinatorial and geometric object: edges, seams, poles, winding, normals, area, volume.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <set>

#include "surface_samples.h"
#include "tessellate/tessellator.h"

namespace luxo {
namespace {

constexpr double kMeshUlp = 0x1p-52;
constexpr std::uint32_t kCounts[] = {1, 2, 3, 20, 257};

/// A mesh, and what was asked for.
struct MadeMesh {
  Mesh mesh;
  std::optional<Segments> uniform;  ///< raised to what works
};

Mesh grid(const Surface& surface, const std::vector<double>& parameters, Segments segments) {
  return tessellate(surface, parameters, {.uniform = segments});
}

/// At least three columns close a seam, and two rows lie between two poles.
Segments raised(const SurfaceSample& sample, Segments wanted) {
  const bool poles = sample.vMin == Edge::Pole && sample.vMax == Edge::Pole;
  return {std::max(wanted.u, sample.u == Edge::Seam ? 3u : 1u),
          std::max(wanted.v, sample.vMin == Edge::Seam ? 3u
                             : poles                   ? 2u
                                                       : 1u)};
}

template <class Check>
void forEveryMesh(const Check& check) {
  for (const SurfaceSample& sample : surfaceSamples()) {
    for (const std::uint32_t u : kCounts)
      for (const std::uint32_t v : kCounts) {
        SCOPED_TRACE(sample.name + ", " + std::to_string(u) + " x " + std::to_string(v));
        check(sample, MadeMesh{grid(sample.surface, sample.parameters, {u, v}), raised(sample, {u, v})});
        if (testing::Test::HasFatalFailure()) return;
      }
    for (const double tolerance : {10.0, 0.3, 0.02, 0.001}) {
      SCOPED_TRACE(sample.name + ", tolerance " + std::to_string(tolerance));
      check(sample, MadeMesh{tessellate(sample.surface, sample.parameters, {.tolerance = tolerance}), {}});
      if (testing::Test::HasFatalFailure()) return;
    }
  }
}

Vec3 areaVector(const Mesh& mesh, std::size_t triangle) {
  const Vec3 &a = mesh.positions[mesh.indices[3 * triangle]],
             &b = mesh.positions[mesh.indices[3 * triangle + 1]],
             &c = mesh.positions[mesh.indices[3 * triangle + 2]];
  return 0.5 * glm::cross(b - a, c - a);
}

bool isMoebius(const SurfaceSample& sample) { return sample.name == "moebius"; }

/// One number per distinct position, equal bits being equal positions (0 and -0 too).
std::vector<std::uint32_t> weld(const Mesh& mesh) {
  std::vector<std::pair<std::array<double, 3>, std::uint32_t>> sorted;
  for (const Vec3& p : mesh.positions)
    sorted.push_back({{p.x + 0.0, p.y + 0.0, p.z + 0.0}, static_cast<std::uint32_t>(sorted.size())});
  std::sort(sorted.begin(), sorted.end());
  std::vector<std::uint32_t> welded(sorted.size());
  std::uint32_t count = 0;
  for (std::size_t i = 0; i < sorted.size(); ++i)
    welded[sorted[i].second] = i > 0 && sorted[i].first != sorted[i - 1].first ? ++count : count;
  return welded;
}

TEST(Mesh, CountsFollowTheTopology) {
  forEveryMesh([](const SurfaceSample& sample, const MadeMesh& made) {
    if (!made.uniform) return;
    const auto [n, m] = *made.uniform;
    std::size_t vertices = std::size_t{n + 1} * (m + 1), triangles = std::size_t{2} * n * m;
    for (const Edge edge : {sample.vMin, sample.vMax}) {
      if (edge != Edge::Pole && edge != Edge::Apex) continue;
      vertices -= 1;  // one for each triangle that ends there
      triangles -= n;
    }
    EXPECT_EQ(made.mesh.positions.size(), vertices);
    EXPECT_EQ(made.mesh.normals.size(), vertices);
    EXPECT_EQ(made.mesh.parameters.size(), vertices);
    EXPECT_EQ(made.mesh.triangleCount(), triangles);
    EXPECT_EQ(made.mesh.indices.size(), 3 * triangles);
    EXPECT_EQ(made.mesh.dropped, 0u);
  });
  EXPECT_EQ(grid(rectangle(1, 1), {}, {1, 1'000'000}).triangleCount(), 2u * kMaxSegments);
}

TEST(Mesh, EveryVertexIsFiniteUsedAndHasAUnitNormal) {
  forEveryMesh([](const SurfaceSample& sample, const MadeMesh& made) {
    const Mesh& mesh = made.mesh;
    std::vector<bool> used(mesh.positions.size(), false);
    for (const std::uint32_t index : mesh.indices) {
      ASSERT_LT(index, mesh.positions.size());
      used[index] = true;
    }
    const Domain& d = sample.surface.domain();
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      ASSERT_TRUE(used[i]) << "vertex " << i;
      const Vec3 &p = mesh.positions[i], &n = mesh.normals[i];
      ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) << "vertex " << i;
      ASSERT_NEAR(glm::length(n), 1, 4 * kMeshUlp) << "vertex " << i;  // false for NaN and zero
      ASSERT_TRUE(d.u.contains(mesh.parameters[i].x) && d.v.contains(mesh.parameters[i].y)) << "vertex " << i;
    }
  });
}

TEST(Mesh, VerticesLieOnTheSurfaceWithItsExactNormal) {
  // To 1e-13: tens of roundings of numbers near 1. This is also outwardness: the closed forms point outward.
  forEveryMesh([](const SurfaceSample& sample, const MadeMesh& made) {
    const Mesh& mesh = made.mesh;
    std::vector<double> us, vs;
    for (const Vec2& p : mesh.parameters) {
      us.push_back(p.x);
      vs.push_back(p.y);
    }
    const SurfacePoints exact = sample.surface.evaluate(us, vs, sample.parameters);
    for (std::size_t i = 0; i < us.size(); ++i) {
      ASSERT_LE(glm::length(mesh.positions[i] - exact.position[i]),
                1e-15 * glm::length(exact.position[i]) + 1e-15);
      ASSERT_LE(glm::length(mesh.normals[i] - sample.normal(us[i], vs[i])), 1e-13) << us[i] << ", " << vs[i];
    }
  });
}

TEST(Mesh, NoTriangleIsDegenerate) {
  forEveryMesh([](const SurfaceSample&, const MadeMesh& made) {
    const Mesh& mesh = made.mesh;
    for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
      const std::uint32_t* i = &mesh.indices[3 * t];
      ASSERT_TRUE(i[0] != i[1] && i[1] != i[2] && i[2] != i[0]) << "triangle " << t;
      // Far above what rounding of coordinates near 1 can make of a zero area.
      ASSERT_GT(glm::length(areaVector(mesh, t)), 1e-10) << "triangle " << t;
    }
  });
}

/// An edge of the welded mesh, from the lesser vertex to the greater: how often it is used in either
/// direction, and one of its pairs of vertices of the mesh itself.
struct WeldedEdge {
  std::uint32_t from, to;
  int forward, backward;
  std::uint32_t i, j;
};

std::vector<WeldedEdge> edgesOf(const Mesh& mesh, const std::vector<std::uint32_t>& weld) {
  std::vector<WeldedEdge> edges;
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t i = mesh.indices[3 * t + k], j = mesh.indices[3 * t + (k + 1) % 3];
      const bool forward = weld[i] < weld[j];
      edges.push_back({std::min(weld[i], weld[j]), std::max(weld[i], weld[j]), forward, !forward, i, j});
    }
  const auto ends = [](const WeldedEdge& edge) { return std::pair(edge.from, edge.to); };
  std::sort(edges.begin(), edges.end(),
            [&](const WeldedEdge& a, const WeldedEdge& b) { return ends(a) < ends(b); });
  std::size_t count = 0;
  for (const WeldedEdge& edge : edges)
    if (count > 0 && ends(edges[count - 1]) == ends(edge)) {
      edges[count - 1].forward += edge.forward;
      edges[count - 1].backward += edge.backward;
    } else {
      edges[count++] = edge;
    }
  edges.resize(count);
  return edges;
}

/// The number of closed curves that the border edges make, each vertex of which has exactly two of them.
int countBorders(const std::vector<WeldedEdge>& edges) {
  std::map<std::uint32_t, std::vector<std::uint32_t>> neighbours;
  for (const WeldedEdge& edge : edges)
    if (edge.forward + edge.backward == 1) {
      neighbours[edge.from].push_back(edge.to);
      neighbours[edge.to].push_back(edge.from);
    }
  int curves = 0;
  std::set<std::uint32_t> seen;
  for (const auto& [start, ends] : neighbours) {
    EXPECT_EQ(ends.size(), 2u);
    if (!seen.insert(start).second) continue;
    ++curves;
    for (std::vector<std::uint32_t> open{start}; !open.empty();) {
      const std::uint32_t at = open.back();
      open.pop_back();
      for (const std::uint32_t next : neighbours[at])
        if (seen.insert(next).second) open.push_back(next);
    }
  }
  return curves;
}

TEST(Mesh, IsAManifoldOfTheRightShape) {
  forEveryMesh([](const SurfaceSample& sample, const MadeMesh& made) {
    const Mesh& mesh = made.mesh;
    const std::vector<std::uint32_t> welded = weld(mesh);
    const auto edges = edgesOf(mesh, welded);
    for (const WeldedEdge& edge : edges)
      ASSERT_TRUE(edge.forward + edge.backward <= 2 &&
                  (!sample.orientable || (edge.forward <= 1 && edge.backward <= 1)))
          << "edge " << edge.from << "-" << edge.to << " runs " << edge.forward << " and " << edge.backward
          << " times";
    ASSERT_EQ(countBorders(edges), sample.borders);
    const auto vertices = static_cast<int>(*std::max_element(welded.begin(), welded.end())) + 1;
    EXPECT_EQ(vertices - static_cast<int>(edges.size()) + static_cast<int>(mesh.triangleCount()),
              sample.euler);
  });
}

TEST(Mesh, BordersLieOnBordersOnly) {
  // No T-junction: an edge with one triangle lies on an edge of the domain that is joined to nothing.
  forEveryMesh([](const SurfaceSample& sample, const MadeMesh& made) {
    const Mesh& mesh = made.mesh;
    const Domain& d = sample.surface.domain();
    for (const WeldedEdge& edge : edgesOf(mesh, weld(mesh))) {
      if (edge.forward + edge.backward != 1) continue;
      const Vec2 &p = mesh.parameters[edge.i], &q = mesh.parameters[edge.j];
      const auto along = [&](Edge kind, double at, int axis) {
        return kind == Edge::Border && p[axis] == at && q[axis] == at;
      };
      ASSERT_TRUE(along(sample.u, d.u.lo, 0) || along(sample.u, d.u.hi, 0) || along(sample.vMin, d.v.lo, 1) ||
                  along(sample.vMax, d.v.hi, 1))
          << "(" << p.x << ", " << p.y << ") to (" << q.x << ", " << q.y << ")";
    }
  });
}

TEST(Mesh, WhatIsOnePointHasOnePosition) {
  // No two vertices are nearly the same: seams and poles have the same bits on all sides.
  forEveryMesh([](const SurfaceSample&, const MadeMesh& made) {
    std::vector<Vec3> sorted = made.mesh.positions;
    std::sort(sorted.begin(), sorted.end(), [](const Vec3& a, const Vec3& b) {
      return std::array{a.x, a.y, a.z} < std::array{b.x, b.y, b.z};
    });
    for (std::size_t i = 0; i < sorted.size(); ++i)
      for (std::size_t k = i + 1; k < sorted.size() && sorted[k].x - sorted[i].x < 1e-9; ++k)
        ASSERT_TRUE(sorted[k] == sorted[i] || glm::length(sorted[k] - sorted[i]) > 1e-9);
  });
}

TEST(Mesh, ParametersCanBeInterpolatedInEveryTriangle) {
  // No triangle spans more than a cell, nor the seam, and what ends in a pole has the middle's u there.
  forEveryMesh([](const SurfaceSample& sample, const MadeMesh& made) {
    if (!made.uniform) return;
    const Mesh& mesh = made.mesh;
    const Domain& d = sample.surface.domain();
    const Vec2 cell(d.u.width() / made.uniform->u, d.v.width() / made.uniform->v);
    for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
      const std::uint32_t* i = &mesh.indices[3 * t];
      const Vec2 &a = mesh.parameters[i[0]], &b = mesh.parameters[i[1]], &c = mesh.parameters[i[2]];
      const Vec2 low = glm::min(a, glm::min(b, c)), high = glm::max(a, glm::max(b, c));
      const Vec2 size = high - low;
      ASSERT_NEAR(size.x, cell.x, 1e-12 * d.u.width()) << "triangle " << t;
      ASSERT_NEAR(size.y, cell.y, 1e-12 * d.v.width()) << "triangle " << t;
      for (const Vec2& p : {a, b, c}) {
        const bool pole = (p.y == d.v.lo && (sample.vMin == Edge::Pole || sample.vMin == Edge::Apex)) ||
                          (p.y == d.v.hi && (sample.vMax == Edge::Pole || sample.vMax == Edge::Apex));
        if (pole) {
          ASSERT_NEAR(p.x, 0.5 * (low.x + high.x), 1e-15 * d.u.width());
        }
      }
    }
  });
}

TEST(Mesh, AnApexHasTheNormalOfEachColumnsMiddle) {
  for (const auto& [s, v] : {std::pair{cone(1.5, 0, 2), 1.0}, {cone(0, 1.5, 2), 0.0}}) {
    const Mesh mesh = grid(s, {}, {8, 3});
    int apexes = 0;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      if (mesh.parameters[i].y != v) continue;
      const double middle = (apexes++ + 0.5) / 8;
      EXPECT_NEAR(mesh.parameters[i].x, middle, kMeshUlp);
      const double up = v == 1 ? 1.5 : -1.5;
      const Vec3 expected = Vec3(2 * std::cos(kTau * middle), up, -2 * std::sin(kTau * middle)) / 2.5;
      EXPECT_LE(glm::length(mesh.normals[i] - expected), 1e-14);
    }
    EXPECT_EQ(apexes, 8);
  }
}

TEST(Mesh, TrianglesWindCounterClockwiseFromOutside) {
  forEveryMesh([](const SurfaceSample& sample, const MadeMesh& made) {
    const Mesh& mesh = made.mesh;
    // Waves and twists cut into a few pieces have triangles steeper than any normal of the surface.
    const bool wavy = sample.name == "flag" || isMoebius(sample);
    if (wavy && (!made.uniform || made.uniform->u < 20)) return;
    for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
      const Vec3 area = areaVector(mesh, t);
      for (int k = 0; k < 3; ++k)
        ASSERT_GT(glm::dot(area, mesh.normals[mesh.indices[3 * t + k]]), 0) << "triangle " << t;
    }
  });
}

double areaOf(const Mesh& mesh) {
  double area = 0;
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) area += glm::length(areaVector(mesh, t));
  return area;
}

double volumeOf(const Mesh& mesh) {
  double volume = 0;
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t)
    volume += glm::dot(mesh.positions[mesh.indices[3 * t]], areaVector(mesh, t)) / 3;
  return volume;
}

TEST(Mesh, AreasConvergeQuadratically) {
  for (const SurfaceSample& sample : surfaceSamples()) {
    const auto error = [&](std::uint32_t n) {
      return std::abs(areaOf(grid(sample.surface, sample.parameters, {n, n})) - sample.area) / sample.area;
    };
    const double coarse = error(64), fine = error(128);
    // The Moebius band's area is known to 7 digits.
    EXPECT_LT(fine, 2e-3) << sample.name;
    if (fine < 1e-6) continue;
    EXPECT_NEAR(coarse / fine, 4, 0.2) << sample.name;
  }
  EXPECT_NEAR(areaOf(grid(rectangle(3, 2), {}, {7, 5})), 6, 1e-14);
  EXPECT_NEAR(areaOf(grid(paraboloid(0.2, 1.8), {}, {1024, 1024})), 10.26179, 1e-4);
}

TEST(Mesh, VolumesArePositiveAndConvergeQuadratically) {
  for (const SurfaceSample& sample : surfaceSamples()) {
    if (!sample.volume) continue;
    const auto volume = [&](std::uint32_t n) {
      return volumeOf(grid(sample.surface, sample.parameters, {n, n}));
    };
    EXPECT_GT(volume(3), 0) << sample.name;
    const double coarse = (*sample.volume - volume(64)) / *sample.volume,
                 fine = (*sample.volume - volume(128)) / *sample.volume;
    EXPECT_LT(std::abs(fine), 1.5e-3) << sample.name;
    EXPECT_NEAR(coarse / fine, 4, 0.2) << sample.name;
    // The area vectors of a closed mesh cancel.
    const Mesh mesh = grid(sample.surface, sample.parameters, {64, 64});
    Vec3 sum(0);
    for (std::size_t t = 0; t < mesh.triangleCount(); ++t) sum += areaVector(mesh, t);
    EXPECT_LE(glm::length(sum), 1e-12) << sample.name;
  }
}

TEST(Mesh, SameInputSameBits) {
  for (const SurfaceSample& sample : surfaceSamples()) {
    const Mesh a = tessellate(sample.surface, sample.parameters, {.tolerance = 1e-4}),
               b = tessellate(sample.surface, sample.parameters, {.tolerance = 1e-4});
    EXPECT_EQ(a.positions, b.positions);
    EXPECT_EQ(a.normals, b.normals);
    EXPECT_EQ(a.indices, b.indices);
  }
}

TEST(Mesh, ASingularEdgeIsCutUntilItsBoxesAreSmall) {
  // The second derivative of sqrt(v) is unbounded at v = 0.
  const Surface s = revolve([](auto v) { return ProfilePoint{sqrt(v), v}; });
  for (const double tolerance : {0.1, 0.02}) {
    const Mesh mesh = tessellate(s, {}, {.tolerance = tolerance});
    EXPECT_LE(mesh.bound, tolerance);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      ASSERT_TRUE(std::isfinite(glm::length(mesh.positions[i])));
      ASSERT_NEAR(glm::length(mesh.normals[i]), 1, 4 * kMeshUlp);
    }
    for (std::size_t t = 0; t < mesh.triangleCount(); ++t) ASSERT_GT(glm::length(areaVector(mesh, t)), 0);
  }
}

}  // namespace
}  // namespace luxo
