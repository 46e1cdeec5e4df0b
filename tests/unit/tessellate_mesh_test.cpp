// SPDX-License-Identifier: Apache-2.0
// The mesh as a combinatorial and geometric object: edges, seams, poles, winding, normals, area, volume.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>

#include "surface_samples.h"
#include "tessellate/tessellator.h"

namespace luxo {
namespace {

constexpr double kUlp = 0x1p-52;
constexpr std::uint32_t kCounts[] = {1, 2, 3, 20, 257};

template <class Check>
void forEveryMesh(const Check& check) {
  for (const SurfaceSample& sample : surfaceSamples())
    for (const std::uint32_t u : kCounts)
      for (const std::uint32_t v : kCounts) {
        SCOPED_TRACE(sample.name + ", " + std::to_string(u) + " x " + std::to_string(v));
        check(sample, tessellate(sample.surface, sample.parameters, {u, v}));
        if (testing::Test::HasFatalFailure()) return;
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
  std::map<std::array<double, 3>, std::uint32_t> seen;
  std::vector<std::uint32_t> welded;
  for (const Vec3& p : mesh.positions)
    welded.push_back(seen.try_emplace({p.x + 0.0, p.y + 0.0, p.z + 0.0}, seen.size()).first->second);
  return welded;
}

TEST(Mesh, CountsFollowTheTopology) {
  forEveryMesh([](const SurfaceSample& sample, const Mesh& mesh) {
    const auto [n, m] = mesh.segments;
    const Topology& t = sample.surface.topology();
    const std::size_t columns = t.seamU() ? n : n + 1, rows = t.seamV() ? m : m + 1;
    std::size_t vertices = columns * rows, triangles = std::size_t{2} * n * m;
    for (const Edge edge : {t.vMin, t.vMax}) {
      if (edge != Edge::Pole && edge != Edge::Apex) continue;
      vertices += (edge == Edge::Pole ? 1 : n) - columns;
      triangles -= n;
    }
    EXPECT_EQ(mesh.positions.size(), vertices);
    EXPECT_EQ(mesh.normals.size(), vertices);
    EXPECT_EQ(mesh.parameters.size(), vertices);
    EXPECT_EQ(mesh.triangleCount(), triangles);
    EXPECT_EQ(mesh.indices.size(), 3 * triangles);
  });
}

TEST(Mesh, SegmentsAreRaisedToTheLeastThatWork) {
  for (const SurfaceSample& sample : surfaceSamples()) {
    const Mesh mesh = tessellate(sample.surface, sample.parameters, {1, 1});
    EXPECT_EQ(mesh.segments.u, sample.u == Edge::Seam ? 3u : 1u) << sample.name;
    EXPECT_EQ(mesh.segments.v, sample.vMin == Edge::Seam ? 3u
                               : sample.name == "sphere" ? 2u
                                                         : 1u)
        << sample.name;
    EXPECT_EQ(tessellate(sample.surface, sample.parameters, {20, 5}).segments, (Segments{20, 5}))
        << sample.name;
  }
  EXPECT_EQ(atLeastMinimal(rectangle(1, 1), {0, 1'000'000}), (Segments{1, kMostSegments}));
}

TEST(Mesh, EveryVertexIsFiniteUsedAndHasAUnitNormal) {
  forEveryMesh([](const SurfaceSample& sample, const Mesh& mesh) {
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
      ASSERT_NEAR(glm::length(n), 1, 4 * kUlp) << "vertex " << i;  // false for NaN and zero
      ASSERT_TRUE(d.u.contains(mesh.parameters[i].x) && d.v.contains(mesh.parameters[i].y)) << "vertex " << i;
    }
  });
}

TEST(Mesh, VerticesLieOnTheSurfaceWithItsExactNormal) {
  // To 1e-13: tens of roundings of numbers near 1. This is also outwardness: the closed forms point outward.
  forEveryMesh([](const SurfaceSample& sample, const Mesh& mesh) {
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
  forEveryMesh([](const SurfaceSample& sample, const Mesh& mesh) {
    // A single segment around a Moebius band joins one line to itself.
    if (isMoebius(sample) && mesh.segments.u < 3) return;
    for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
      const std::uint32_t* i = &mesh.indices[3 * t];
      ASSERT_TRUE(i[0] != i[1] && i[1] != i[2] && i[2] != i[0]) << "triangle " << t;
      // Far above what rounding of coordinates near 1 can make of a zero area.
      ASSERT_GT(glm::length(areaVector(mesh, t)), 1e-10) << "triangle " << t;
    }
  });
}

/// Edges of the welded mesh: how often each is used in either direction.
using Uses = std::pair<int, int>;
std::map<std::pair<std::uint32_t, std::uint32_t>, Uses> edgesOf(const Mesh& mesh,
                                                                const std::vector<std::uint32_t>& weld) {
  std::vector<std::pair<std::pair<std::uint32_t, std::uint32_t>, bool>> all;
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = weld[mesh.indices[3 * t + k]], b = weld[mesh.indices[3 * t + (k + 1) % 3]];
      all.push_back({{std::min(a, b), std::max(a, b)}, a < b});
    }
  std::sort(all.begin(), all.end());
  std::map<std::pair<std::uint32_t, std::uint32_t>, Uses> edges;
  for (const auto& [edge, forward] : all) {
    Uses& uses = edges.try_emplace(edges.end(), edge)->second;
    (forward ? uses.first : uses.second)++;
  }
  return edges;
}

/// The number of closed curves that the border edges make, each vertex of which has exactly two of them.
int countBorders(const std::map<std::pair<std::uint32_t, std::uint32_t>, Uses>& edges) {
  std::map<std::uint32_t, std::vector<std::uint32_t>> neighbours;
  for (const auto& [edge, uses] : edges)
    if (uses.first + uses.second == 1) {
      neighbours[edge.first].push_back(edge.second);
      neighbours[edge.second].push_back(edge.first);
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
  forEveryMesh([](const SurfaceSample& sample, const Mesh& mesh) {
    // The band closes with a twist, which is no seam: as a mesh it is a strip.
    std::vector<std::uint32_t> welded = weld(mesh);
    if (isMoebius(sample))
      for (std::uint32_t i = 0; i < welded.size(); ++i) welded[i] = i;
    const auto edges = edgesOf(mesh, welded);
    for (const auto& [edge, uses] : edges)
      ASSERT_TRUE(uses.first <= 1 && uses.second <= 1)
          << "edge " << edge.first << "-" << edge.second << " runs " << uses.first << " and " << uses.second
          << " times";
    ASSERT_EQ(countBorders(edges), sample.borders);
    const auto vertices = static_cast<int>(*std::max_element(welded.begin(), welded.end())) + 1;
    EXPECT_EQ(vertices - static_cast<int>(edges.size()) + static_cast<int>(mesh.triangleCount()),
              sample.euler);
  });
}

TEST(Mesh, TheTwistedBandHasTheBandsEulerCharacteristic) {
  // Welded to 1e-9: (0, v) with (pi, -v).
  const Mesh mesh = tessellate(moebius(1, 0.5), {}, {20, 4});
  std::map<std::array<std::int64_t, 3>, std::uint32_t> seen;
  std::vector<std::uint32_t> welded;
  for (const Vec3& p : mesh.positions)
    welded.push_back(
        seen.try_emplace({std::llround(p.x * 1e9), std::llround(p.y * 1e9), std::llround(p.z * 1e9)},
                         seen.size())
            .first->second);
  const auto edges = edgesOf(mesh, welded);
  EXPECT_EQ(static_cast<int>(seen.size() + mesh.triangleCount()) - static_cast<int>(edges.size()), 0);
  EXPECT_EQ(countBorders(edges), 1);
}

TEST(Mesh, SeamsAndPolesAreClosedByIndex) {
  // No two vertices coincide, not even nearly: the last column is the first, a pole is one vertex. Only an
  // apex has one vertex per column.
  for (const SurfaceSample& sample : surfaceSamples()) {
    if (isMoebius(sample)) continue;
    const Mesh mesh = tessellate(sample.surface, sample.parameters, {20, 20});
    std::vector<Vec3> sorted = mesh.positions;
    std::sort(sorted.begin(), sorted.end(), [](const Vec3& a, const Vec3& b) {
      return std::array{a.x, a.y, a.z} < std::array{b.x, b.y, b.z};
    });
    std::size_t coincident = 0;
    for (std::size_t i = 0; i < sorted.size(); ++i)
      for (std::size_t k = i + 1; k < sorted.size() && sorted[k].x - sorted[i].x < 1e-9; ++k)
        coincident += glm::length(sorted[k] - sorted[i]) < 1e-9;
    const bool apex = sample.vMin == Edge::Apex || sample.vMax == Edge::Apex;
    EXPECT_EQ(coincident, apex ? 20u * 19 / 2 : 0u) << sample.name;
  }
}

TEST(Mesh, AnApexHasTheNormalOfEachColumnsMiddle) {
  for (const auto& [s, v] : {std::pair{cone(1.5, 0, 2), 1.0}, {cone(0, 1.5, 2), 0.0}}) {
    const Mesh mesh = tessellate(s, {}, {8, 3});
    int apexes = 0;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      if (mesh.parameters[i].y != v) continue;
      const double middle = (apexes++ + 0.5) / 8;
      EXPECT_NEAR(mesh.parameters[i].x, middle, kUlp);
      const double up = v == 1 ? 1.5 : -1.5;
      const Vec3 expected = Vec3(2 * std::cos(kTau * middle), up, -2 * std::sin(kTau * middle)) / 2.5;
      EXPECT_LE(glm::length(mesh.normals[i] - expected), 1e-14);
    }
    EXPECT_EQ(apexes, 8);
  }
}

TEST(Mesh, TrianglesWindCounterClockwiseFromOutside) {
  forEveryMesh([](const SurfaceSample& sample, const Mesh& mesh) {
    // Waves and twists cut into a few pieces have triangles steeper than any normal of the surface.
    const bool wavy = sample.name == "flag" || isMoebius(sample);
    if (wavy && (mesh.segments.u < 20)) return;
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
      return std::abs(areaOf(tessellate(sample.surface, sample.parameters, {n, n})) - sample.area) /
             sample.area;
    };
    const double coarse = error(64), fine = error(128);
    // The Moebius band's area is known to 7 digits.
    EXPECT_LT(fine, 2e-3) << sample.name;
    if (fine < 1e-6) continue;
    EXPECT_NEAR(coarse / fine, 4, 0.2) << sample.name;
  }
  EXPECT_NEAR(areaOf(tessellate(rectangle(3, 2), {}, {7, 5})), 6, 1e-14);
  EXPECT_NEAR(areaOf(tessellate(paraboloid(0.2, 1.8), {}, {1024, 1024})), 10.26179, 1e-4);
}

TEST(Mesh, VolumesArePositiveAndConvergeQuadratically) {
  for (const SurfaceSample& sample : surfaceSamples()) {
    if (!sample.volume) continue;
    const auto volume = [&](std::uint32_t n) {
      return volumeOf(tessellate(sample.surface, sample.parameters, {n, n}));
    };
    EXPECT_GT(volume(3), 0) << sample.name;
    const double coarse = (*sample.volume - volume(64)) / *sample.volume,
                 fine = (*sample.volume - volume(128)) / *sample.volume;
    EXPECT_LT(std::abs(fine), 1.5e-3) << sample.name;
    EXPECT_NEAR(coarse / fine, 4, 0.2) << sample.name;
    // The area vectors of a closed mesh cancel.
    const Mesh mesh = tessellate(sample.surface, sample.parameters, {64, 64});
    Vec3 sum(0);
    for (std::size_t t = 0; t < mesh.triangleCount(); ++t) sum += areaVector(mesh, t);
    EXPECT_LE(glm::length(sum), 1e-12) << sample.name;
  }
}

TEST(Mesh, TheFirstVertexTellsTheCell) {
  // Cell (i, j) owns two triangles whose first vertex is its lower-left corner; one above a collapsed row,
  // which starts in the upper-left corner; one below a collapsed row.
  for (const SurfaceSample& sample : surfaceSamples()) {
    const Mesh mesh = tessellate(sample.surface, sample.parameters, {7, 5});
    const Domain& d = sample.surface.domain();
    const Topology& topology = sample.surface.topology();
    std::map<std::pair<long, long>, int> triangles;
    for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
      const Vec2& p = mesh.parameters[mesh.indices[3 * t]];
      const long i = std::lround((p.x - d.u.lo) / d.u.width() * 7),
                 j = std::lround((p.y - d.v.lo) / d.v.width() * 5);
      // In column i every other vertex lies in [i, i + 1], the last column wrapping to the first.
      for (int k = 1; k < 3; ++k) {
        const Vec2& q = mesh.parameters[mesh.indices[3 * t + k]];
        const bool collapsed =
            (q.y == d.v.lo && topology.collapsedVMin()) || (q.y == d.v.hi && topology.collapsedVMax());
        const double x = (q.x - d.u.lo) / d.u.width() * 7 - i;
        EXPECT_TRUE(collapsed || (x > -0.01 && x < 1.01) || (topology.seamU() && i == 6 && x < -5.9))
            << sample.name;
      }
      const bool aboveCollapsed =
          topology.collapsedVMin() && (mesh.parameters[mesh.indices[3 * t + 1]].y == d.v.lo ||
                                       mesh.parameters[mesh.indices[3 * t + 2]].y == d.v.lo);
      EXPECT_TRUE(!aboveCollapsed || j == 1) << sample.name;
      ++triangles[{i, aboveCollapsed ? 0 : j}];
    }
    ASSERT_EQ(triangles.size(), 35u) << sample.name;
    for (const auto& [cell, count] : triangles) {
      const bool single =
          (cell.second == 0 && topology.collapsedVMin()) || (cell.second == 4 && topology.collapsedVMax());
      EXPECT_EQ(count, single ? 1 : 2) << sample.name << ", cell " << cell.first << ", " << cell.second;
    }
  }
}

TEST(Mesh, SameInputSameBits) {
  for (const SurfaceSample& sample : surfaceSamples()) {
    const Mesh a = tessellate(sample.surface, sample.parameters, {20, 11}),
               b = tessellate(sample.surface, sample.parameters, {20, 11});
    EXPECT_EQ(a.positions, b.positions);
    EXPECT_EQ(a.normals, b.normals);
    EXPECT_EQ(a.indices, b.indices);
  }
}

TEST(Mesh, AnUnboundedSurfaceStillHasAFiniteMesh) {
  const Surface s = revolve([](auto v) { return ProfilePoint{sqrt(v), v}; });
  const Segments segments = segmentsFor(s, {}, 0.01);
  EXPECT_EQ(segments, kUnprovenSegments);
  const Mesh mesh = tessellate(s, {}, segments);
  EXPECT_TRUE(std::isinf(mesh.bound));
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    ASSERT_TRUE(std::isfinite(glm::length(mesh.positions[i])));
    ASSERT_NEAR(glm::length(mesh.normals[i]), 1, 4 * kUlp);
  }
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) ASSERT_GT(glm::length(areaVector(mesh, t)), 0);
}

}  // namespace
}  // namespace luxo
