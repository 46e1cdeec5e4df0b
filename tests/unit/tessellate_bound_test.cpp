// SPDX-License-Identifier: Apache-2.0
// The promise of a mesh: its bound, against the true surface sampled ten times more densely.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "surface_samples.h"
#include "tessellate/tessellator.h"

namespace luxo {
namespace {

constexpr double kTolerances[] = {1, 0.1, 0.01, 0.001};
constexpr int kDenser = 10;
/// Rounding of points near 3 and of their distance to a thin triangle: what a bound of zero (a plane) leaves.
constexpr double kRounding = 1e-14;

/// Distance from a point to a triangle (Ericson, Real-Time Collision Detection, 5.1.5).
double distance(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap), d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp);
  const double d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
  const double va = d3 * d6 - d5 * d4, vb = d5 * d2 - d1 * d6, vc = d1 * d4 - d3 * d2;
  if (d1 <= 0 && d2 <= 0) return glm::length(ap);
  if (d3 >= 0 && d4 <= d3) return glm::length(bp);
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return glm::length(ap - d1 / (d1 - d3) * ab);
  if (d6 >= 0 && d5 <= d6) return glm::length(cp);
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return glm::length(ap - d2 / (d2 - d6) * ac);
  if (va <= 0 && d4 >= d3 && d5 >= d6) return glm::length(bp - (d4 - d3) / (d4 - d3 + d5 - d6) * (c - b));
  return glm::length(ap - (vb * ab + vc * ac) / (va + vb + vc));
}

/// The triangles of each cell (column, row), told by the first vertex.
std::map<std::pair<long, long>, std::vector<std::size_t>> trianglesOfCells(const SurfaceSample& sample,
                                                                           const Mesh& mesh) {
  const Domain& d = sample.surface.domain();
  const Topology& topology = sample.surface.topology();
  std::map<std::pair<long, long>, std::vector<std::size_t>> cells;
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    const auto parameters = [&](int k) { return mesh.parameters[mesh.indices[3 * t + k]]; };
    const long i = std::lround((parameters(0).x - d.u.lo) / d.u.width() * mesh.segments.u);
    long j = std::lround((parameters(0).y - d.v.lo) / d.v.width() * mesh.segments.v);
    if (topology.collapsedVMin() && (parameters(1).y == d.v.lo || parameters(2).y == d.v.lo)) j = 0;
    cells[{i, j}].push_back(t);
  }
  return cells;
}

/// Largest distance from the points of a cell to the cell's own triangles, over all cells.
double measuredDeviation(const SurfaceSample& sample, const Mesh& mesh) {
  const Domain& d = sample.surface.domain();
  double worst = 0;
  std::vector<double> us, vs;
  for (const auto& [cell, triangles] : trianglesOfCells(sample, mesh)) {
    us.clear();
    vs.clear();
    for (int k = 0; k <= kDenser; ++k) {
      us.push_back(
          std::min(d.u.hi, d.u.lo + d.u.width() * (cell.first + double(k) / kDenser) / mesh.segments.u));
      vs.push_back(
          std::min(d.v.hi, d.v.lo + d.v.width() * (cell.second + double(k) / kDenser) / mesh.segments.v));
    }
    for (const Vec3& p : sample.surface.evaluateGrid(us, vs, sample.parameters).position) {
      double nearest = std::numeric_limits<double>::infinity();
      for (const std::size_t t : triangles) {
        const std::uint32_t* i = &mesh.indices[3 * t];
        nearest =
            std::min(nearest, distance(p, mesh.positions[i[0]], mesh.positions[i[1]], mesh.positions[i[2]]));
      }
      worst = std::max(worst, nearest);
    }
  }
  return worst;
}

/// Largest distance between the surface and the linear interpolant at the same (u, v): the sliding along the
/// surface counts as well. Corners are evaluated, not taken from the mesh.
double measuredSliding(const SurfaceSample& sample, const Segments& n) {
  const Domain& d = sample.surface.domain();
  const auto at = [](const Interval& range, double part) {
    return std::min(range.hi, range.lo + range.width() * part);
  };
  double worst = 0;
  for (std::uint32_t j = 0; j < n.v; ++j)
    for (std::uint32_t i = 0; i < n.u; ++i) {
      std::vector<double> us, vs;
      for (int k = 0; k <= kDenser; ++k) {
        us.push_back(at(d.u, (i + double(k) / kDenser) / n.u));
        vs.push_back(at(d.v, (j + double(k) / kDenser) / n.v));
      }
      const std::vector<Vec3> p = sample.surface.evaluateGrid(us, vs, sample.parameters).position;
      constexpr int kRow = kDenser + 1;
      const Vec3 a = p[0], b = p[kDenser], c = p[kRow * kRow - 1], e = p[kRow * kDenser];
      for (int y = 0; y <= kDenser; ++y)
        for (int x = 0; x <= kDenser; ++x) {
          const double s = double(x) / kDenser, t = double(y) / kDenser;
          const Vec3 linear = s >= t ? a + s * (b - a) + t * (c - b) : a + t * (e - a) + s * (c - e);
          worst = std::max(worst, glm::length(p[kRow * y + x] - linear));
        }
    }
  return worst;
}

TEST(Bound, IsNeverExceeded) {
  for (const SurfaceSample& sample : surfaceSamples())
    for (const double tolerance : kTolerances) {
      const Segments segments = segmentsFor(sample.surface, sample.parameters, tolerance);
      const Mesh mesh = tessellate(sample.surface, sample.parameters, segments);
      const double measured = measuredDeviation(sample, mesh);
      EXPECT_LE(mesh.bound, tolerance) << sample.name;
      EXPECT_EQ(mesh.bound, deviationBound(sample.surface, sample.parameters, segments));
      EXPECT_LE(measured, mesh.bound + kRounding) << sample.name << " at tolerance " << tolerance;
      std::printf("%-16s tolerance %-6g %4u x %-4u %7zu triangles, measured / bound = %.3f\n",
                  sample.name.c_str(), tolerance, segments.u, segments.v, mesh.triangleCount(),
                  mesh.bound > 0 ? measured / mesh.bound : 0);
    }
}

TEST(Bound, HoldsForAnySegments) {
  for (const SurfaceSample& sample : surfaceSamples())
    for (const Segments& wanted : {Segments{1, 1}, {2, 9}, {31, 2}, {5, 40}}) {
      const Mesh mesh = tessellate(sample.surface, sample.parameters, wanted);
      EXPECT_LE(measuredDeviation(sample, mesh), mesh.bound + kRounding)
          << sample.name << ", " << mesh.segments.u << " x " << mesh.segments.v;
    }
}

TEST(Bound, CoversTheSlidingOfFreeFormulas) {
  // Where the mixed derivative counts, so do points at the same (u, v).
  for (const SurfaceSample& sample : surfaceSamples()) {
    if (sample.surface.revolution() || sample.surface.flatNormal()) continue;
    for (const Segments& wanted : {Segments{3, 3}, {12, 7}, {40, 40}}) {
      const Mesh mesh = tessellate(sample.surface, sample.parameters, wanted);
      const double measured = measuredSliding(sample, mesh.segments);
      EXPECT_LE(measured, mesh.bound) << sample.name;
      std::printf("%-16s %u x %u: sliding / bound = %.3f\n", sample.name.c_str(), mesh.segments.u,
                  mesh.segments.v, measured / mesh.bound);
    }
  }
}

TEST(Bound, CirclesDeviateByTheirSagitta) {
  // r (1 - cos(pi / n)), reached in the middle of every side; the bound's leading term is r pi^2 / 2 n^2.
  const double r = 0.5;
  const SurfaceSample tube{.name = "tube", .surface = cylinder(r, 3)};
  for (const std::uint32_t n : {3u, 4u, 20u, 257u}) {
    const Mesh mesh = tessellate(tube.surface, {}, {n, 1});
    const double sagitta = r * (1 - std::cos(kPi / n));
    EXPECT_NEAR(measuredDeviation(tube, mesh), sagitta, 1e-15);
    EXPECT_LE(sagitta, mesh.bound);
    EXPECT_LE(mesh.bound, 1.1 * r * kPi * kPi / (2 * n * n));
  }
}

TEST(Bound, SphereMeshesAreAsFarOffAsCounted) {
  // Unit sphere, M x M/2 segments: the largest gap tends to pi^2 / M^2; three values counted independently.
  const SurfaceSample ball{.name = "ball", .surface = sphere(1)};
  for (const auto& [m, gap] : {std::pair{20u, 0.0242}, {64u, 0.00240}, {256u, 1.5e-4}}) {
    const Mesh mesh = tessellate(ball.surface, {}, {m, m / 2});
    double lowest = 1;
    for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
      const std::uint32_t* i = &mesh.indices[3 * t];
      lowest = std::min(lowest,
                        distance(Vec3(0), mesh.positions[i[0]], mesh.positions[i[1]], mesh.positions[i[2]]));
    }
    EXPECT_NEAR(1 - lowest, gap, 0.01 * gap) << m;
    EXPECT_LE(1 - lowest, mesh.bound);
  }
}

TEST(SegmentsFor, StraightDirectionsTakeOneSegment) {
  for (const double tolerance : {1.0, 1e-3, 1e-6, 1e-12, 1e-300}) {
    EXPECT_EQ(segmentsFor(rectangle(3, 2), {}, tolerance), (Segments{1, 1}));
    EXPECT_EQ(segmentsFor(cylinder(0.5, 3), {}, tolerance).v, 1u) << tolerance;
    EXPECT_EQ(segmentsFor(cone(1.5, 0.5, 2), {}, tolerance).v, 1u) << tolerance;
    EXPECT_EQ(segmentsFor(cone(0, 1.5, 2), {}, tolerance).v, 1u) << tolerance;
    EXPECT_EQ(segmentsFor(disk(2), {}, tolerance).v, 1u) << tolerance;
    EXPECT_EQ(segmentsFor(flag(), std::vector{0.0}, tolerance).v, 1u) << tolerance;
  }
  // A circle of 400 px within half a pixel: pi sqrt(r / 2e) = 62.8, so 63 sides, and not many more by the
  // bound.
  EXPECT_GE(segmentsFor(cylinder(400, 1), {}, 0.5).u, 63u);
  EXPECT_LE(segmentsFor(cylinder(400, 1), {}, 0.5).u, 66u);
}

TEST(SegmentsFor, GivesTheFewestTrianglesWithinTheBound) {
  for (const SurfaceSample& sample : surfaceSamples())
    for (const double tolerance : {0.3, 0.05, 0.01}) {
      const Segments found = segmentsFor(sample.surface, sample.parameters, tolerance);
      EXPECT_LE(deviationBound(sample.surface, sample.parameters, found), tolerance) << sample.name;
      const Topology& t = sample.surface.topology();
      const auto triangles = [&](Segments s) {
        return s.u * (2 * s.v - t.collapsedVMin() - t.collapsedVMax());
      };
      for (std::uint32_t u = 1; u <= 300; ++u)
        for (std::uint32_t v = 1; v <= 300; ++v) {
          const Segments other{u, v};
          if (atLeastMinimal(sample.surface, other) != other || triangles(other) >= triangles(found))
            continue;
          ASSERT_GT(deviationBound(sample.surface, sample.parameters, other), tolerance)
              << sample.name << ": " << u << " x " << v << " would do, not " << found.u << " x " << found.v;
        }
    }
}

TEST(SegmentsFor, ASmallerToleranceNeverMeansFewerTriangles) {
  for (const SurfaceSample& sample : surfaceSamples()) {
    std::size_t before = 0;
    const Topology& t = sample.surface.topology();
    for (double tolerance = 2; tolerance > 1e-9; tolerance *= 0.987) {
      const Segments s = segmentsFor(sample.surface, sample.parameters, tolerance);
      const std::size_t triangles = std::size_t{s.u} * (2 * s.v - t.collapsedVMin() - t.collapsedVMax());
      ASSERT_GE(triangles, before) << sample.name << " at tolerance " << tolerance;
      before = triangles;
    }
  }
}

TEST(SegmentsFor, ABoundIsItsOwnTolerance) {
  for (const SurfaceSample& sample : surfaceSamples())
    for (const Segments& n : {Segments{8, 8}, {20, 10}, {64, 33}}) {
      const double bound = deviationBound(sample.surface, sample.parameters, n);
      if (bound == 0) continue;
      const Segments s = segmentsFor(sample.surface, sample.parameters, bound);
      const Segments needed = atLeastMinimal(sample.surface, s);
      EXPECT_EQ(s, needed);
      EXPECT_LE(std::size_t{s.u} * s.v, std::size_t{n.u} * n.v) << sample.name;
    }
}

TEST(SegmentsFor, StopsAtTheMost) {
  const Surface ball = sphere(1);
  const Segments s = segmentsFor(ball, {}, 1e-300);
  EXPECT_EQ(s, (Segments{kMostSegments, kMostSegments}));
  EXPECT_GT(deviationBound(ball, {}, s), 1e-300);
  EXPECT_EQ(segmentsFor(ball, {}, 1e300), (Segments{3, 2}));
  EXPECT_EQ(segmentsFor(ball, {}, std::numeric_limits<double>::infinity()), (Segments{3, 2}));
}

TEST(SegmentsForDeath, WantsAPositiveTolerance) {
  const Surface ball = sphere(1);
  EXPECT_DEATH(static_cast<void>(segmentsFor(ball, {}, 0)), "tolerance");
  EXPECT_DEATH(static_cast<void>(segmentsFor(ball, {}, std::nan(""))), "tolerance");
}

}  // namespace
}  // namespace luxo
