// SPDX-License-Identifier: Apache-2.0
#include "surface/bezier.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <string>
#include <tuple>

#include "base/error.h"
#include "surface/scaled.h"
#include "surface/surface_code.h"
#include "surface/teapot.h"

namespace luxo {
namespace {

/// The sum of the definition, in another order of operations: weights by binomials, no factoring.
Vec3 bernsteinSum(const BezierPatch& patch, double u, double v) {
  const double binomial[] = {1, 3, 3, 1};
  Vec3 sum(0);
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i)
      sum += binomial[i] * std::pow(u, i) * std::pow(1 - u, 3 - i) * binomial[j] * std::pow(v, j) *
             std::pow(1 - v, 3 - j) * patch[4 * j + i];
  return sum;
}

BezierPatch randomPatch(std::mt19937_64& random) {
  std::uniform_real_distribution<double> coordinate(-1, 1);
  BezierPatch patch;
  for (Vec3& p : patch) p = {coordinate(random), coordinate(random), coordinate(random)};
  return patch;
}

TEST(Bezier, IsTheSumOfItsDefinition) {
  std::mt19937_64 random(1);
  std::vector<BezierPatch> patches;
  for (int k = 0; k < 5; ++k) patches.push_back(randomPatch(random));
  const Surface s = bezier(patches);
  ASSERT_EQ(s.patchCount(), 5u);
  EXPECT_EQ(s.domain(), (Domain{{0, 5}, {0, 1}}));
  for (std::uint32_t k = 0; k < 5; ++k)
    for (double u = 0; u <= 1; u += 0.125)
      for (double v = 0; v <= 1; v += 0.125) {
        // 16 terms of magnitude at most sqrt(3), a dozen roundings each.
        const Vec3 expected = bernsteinSum(patches[k], u, v);
        EXPECT_NEAR(glm::length(s.position(k, k + u, v) - expected), 0, 1e-14);
        if (u > 0 && u < 1) {
          EXPECT_EQ(s.position(k + u, v), s.position(k, k + u, v)) << "a place names its patch";
        }
      }
  for (std::uint32_t k = 0; k < 5; ++k) EXPECT_EQ(s.position(k, k, 0), patches[k][0]) << "corners are exact";
}

TEST(Bezier, GridsEqualPointsOnEveryPatch) {
  const Surface s = teapot();
  const std::vector<double> vs{0, 0.3, 1};
  for (std::uint32_t k = 0; k < s.patchCount(); ++k) {
    const std::vector<double> us{double(k), k + 0.7, k + 1.0};
    const SurfacePoints grid = s.evaluateGrid(k, us, vs, {});
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) {
        const SurfacePoints p = s.evaluate(k, {&us[i], 1}, {&vs[j], 1}, {});
        EXPECT_EQ(grid.position[3 * j + i], p.position[0]);
        EXPECT_EQ(grid.du[3 * j + i], p.du[0]);
        EXPECT_EQ(grid.dv[3 * j + i], p.dv[0]);
        EXPECT_EQ(s.position(k, us[i], vs[j]), p.position[0]);
      }
  }
}

TEST(Bezier, BoundsHoldEveryPartAndAreTight) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> part(0, 1);
  const std::vector<BezierPatch> patches{randomPatch(random), randomPatch(random), randomPatch(random)};
  const Surface s = bezier(patches);
  // The definition again: interval evaluation of the formula, without the control points' hull.
  const SurfaceFunction& f = *s.patches()[0].function;
  for (int trial = 0; trial < 200; ++trial) {
    const std::uint32_t k = trial % 3;
    double a = part(random), b = part(random), c = part(random), d = part(random);
    if (a > b) std::swap(a, b);
    if (c > d) std::swap(c, d);
    const Domain cell{{k + a, k + b}, {c, d}};
    const Box box = s.boundPosition(k, cell, {});
    const Surface::CellBounds bounds = s.boundCell(k, cell, {});
    EXPECT_FALSE(bounds.kinked);
    const TangentBounds all =
        f.bounder.tangents(cell.u, cell.v, std::vector<double>(s.patches()[k].constants));
    double longest[3] = {0, 0, 0};
    const Vec3 middle = s.position(k, cell.u.mid(), cell.v.mid());
    EXPECT_TRUE(all.middle.contains(middle));
    EXPECT_LT(glm::length(all.middle.extent()), 1e-12);
    for (int i = 0; i <= 8; ++i)
      for (int j = 0; j <= 8; ++j) {
        const double u = std::min(cell.u.hi, cell.u.lo + cell.u.width() * i / 8);
        const double v = std::min(cell.v.hi, cell.v.lo + cell.v.width() * j / 8);
        ASSERT_TRUE(box.contains(s.position(k, u, v)));
        const SurfacePoints at = s.evaluate(k, {&u, 1}, {&v, 1}, {});
        ASSERT_TRUE(all.position.contains(at.position[0]));
        ASSERT_TRUE(all.du.contains(at.du[0]) && all.dv.contains(at.dv[0]));
        const auto second = f.second.evaluate({&u, 1}, {&v, 1}, PatchInputs(s.patches()[k], {}));
        for (int m = 0; m < 3; ++m)
          longest[m] = std::max(
              longest[m], glm::length(Vec3(second[3 * m][0], second[3 * m + 1][0], second[3 * m + 2][0])));
      }
    const double proven[3] = {bounds.second.uu, bounds.second.uv, bounds.second.vv};
    for (int m = 0; m < 3; ++m) EXPECT_GE(proven[m], longest[m] * (1 - 1e-13));
    // On small parts the hull is nearly the part itself: its gap shrinks with the square of the size.
    const bool small = cell.u.width() < 0.2 && cell.v.width() < 0.2;
    for (int m = 0; m < 3 && small; ++m) EXPECT_LE(proven[m], 1.25 * longest[m] + 0.5) << m;
    // A mean value of the second derivatives; the hull is wider by as much again, at most.
    const double du = proven[0] * cell.u.width() + proven[1] * cell.v.width();
    const double dv = proven[1] * cell.u.width() + proven[2] * cell.v.width();
    EXPECT_LE(glm::length(all.du.extent()), 4 * du + 1e-10);
    EXPECT_LE(glm::length(all.dv.extent()), 4 * dv + 1e-10);
  }
}

TEST(Bezier, JoinsPatchesWhicheverWayTheyRun) {
  // A flat sheet of two squares, the second turned and mirrored in all eight ways.
  const auto sheet = [](const auto& place) {
    BezierPatch patch;
    for (int j = 0; j < 4; ++j)
      for (int i = 0; i < 4; ++i) patch[4 * j + i] = place(i / 3.0, j / 3.0);
    return patch;
  };
  const BezierPatch first = sheet([](double u, double v) { return Vec3(u, 0, v); });
  for (int way = 0; way < 8; ++way) {
    SCOPED_TRACE(way);
    const BezierPatch second = sheet([&](double u, double v) {
      if (way & 1) u = 1 - u;
      if (way & 2) v = 1 - v;
      if (way & 4) std::swap(u, v);
      return Vec3(1 + u, 0, v);
    });
    const Topology t = bezier({first, second}).topology();
    ASSERT_EQ(t.joints.size(), 1u);
    EXPECT_TRUE(t.joints[0].smooth);
    EXPECT_FALSE(t.joints[0].flipped);
    EXPECT_TRUE(t.orientable);
    EXPECT_FALSE(t.borderless);
    EXPECT_EQ(t.eulerCharacteristic, 1);
    const bool mirrored = ((way & 1) != 0) != ((way & 2) != 0) ? (way & 4) == 0 : (way & 4) != 0;
    EXPECT_EQ(t.orientation(0), 1);
    EXPECT_EQ(t.orientation(1), mirrored ? -1 : 1) << "both have the same outside";
  }
}

TEST(Bezier, RefusesWhatIsNoSurface) {
  EXPECT_THROW(static_cast<void>(bezier({})), Error);
  BezierPatch patch = teapotPatches()[5];
  patch[7].y = std::numeric_limits<double>::quiet_NaN();
  try {
    static_cast<void>(bezier({teapotPatches()[0], patch}));
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::Scene);
    EXPECT_NE(std::string(error.what()).find("control point 8 of patch 2"), std::string::npos)
        << error.what();
  }
}

TEST(Teapot, HasTheClassicControlPoints) {
  const std::vector<BezierPatch> patches = teapotPatches();
  ASSERT_EQ(patches.size(), 32u);
  Box box;
  std::set<std::tuple<double, double, double>> distinct;
  for (const BezierPatch& patch : patches)
    for (const Vec3& p : patch) {
      box.add(p);
      distinct.insert({p.x, p.y, p.z});
    }
  // Of the classic 306 vertices four are never used, and twelve of the bottom's repeat the body's.
  EXPECT_EQ(distinct.size(), 306u - 4 - 12);
  EXPECT_EQ(box.min, Vec3(-3, 0, -2));
  EXPECT_EQ(box.max, Vec3(3.525, 3.15, 2));
  // Symmetric about the plane z = 0.
  for (const auto& [x, y, z] : distinct)
    EXPECT_TRUE(distinct.contains({x, y, -z})) << x << ' ' << y << ' ' << z;
  // Collapsed edges: bottom and knob, four patches each.
  int collapsed = 0;
  for (const BezierPatch& p : patches)
    for (const int row : {0, 12})
      collapsed += p[row] == p[row + 1] && p[row] == p[row + 2] && p[row] == p[row + 3];
  EXPECT_EQ(collapsed, 8);
}

TEST(Teapot, HangsTogetherAsFourPieces) {
  const Surface s = teapot();
  const Topology& t = s.topology();
  int counts[4] = {};
  for (const auto& edges : t.edges)
    for (const EdgeKind& e : edges) ++counts[static_cast<int>(e.kind)];
  // Borders: rim, lid, two ends each of handle and spout; four or two edges each. Everything else is joined.
  EXPECT_EQ(counts[static_cast<int>(Edge::Border)], 4 + 4 + 2 * 2 + 2 * 2);
  EXPECT_EQ(counts[static_cast<int>(Edge::Pole)], 8);
  EXPECT_EQ(counts[static_cast<int>(Edge::Apex)], 0);
  EXPECT_EQ(counts[static_cast<int>(Edge::Seam)], 2 * static_cast<int>(t.joints.size()));
  // Body and lid are disks, handle and spout are tubes.
  EXPECT_EQ(t.eulerCharacteristic, 1 + 1 + 0 + 0);
  EXPECT_TRUE(t.orientable);
  EXPECT_FALSE(t.closed || t.borderless);
  for (const Joint& j : t.joints) EXPECT_TRUE(j.smooth && !j.flipped);
}

TEST(Teapot, NormalsAtTheCollapsedEdgesAreVertical) {
  const Surface s = teapot();
  int poles = 0;
  for (std::uint32_t k = 0; k < s.patchCount(); ++k)
    for (const Side side : kSides) {
      if (s.topology().edge(k, side).kind != Edge::Pole) continue;
      ++poles;
      for (double part = 0; part <= 1; part += 0.125) {
        const EdgePoint e = edgePoint(s.patchDomain(k), side, part);
        const Vec3 up(0, s.position(k, e.u, e.v).y > 1 ? 1 : -1, 0);
        EXPECT_NEAR(glm::length(s.normal(k, e.u, e.v) - up), 0, 1e-12);
      }
    }
  EXPECT_EQ(poles, 8);
}

TEST(Teapot, NormalsPointOutward) {
  const Surface s = teapot();
  // Body and lid: away from the axis or, where they are level, as a closed pot's would. Handle and spout:
  // away from the middle of the section.
  for (std::uint32_t k = 0; k < s.patchCount(); ++k)
    for (double a = 0.05; a < 1; a += 0.15)
      for (double v = 0.05; v < 1; v += 0.15) {
        const Vec3 p = s.position(k, k + a, v), n = s.normal(k, k + a, v);
        if (k >= 4 && k < 12) {
          EXPECT_GT(n.x * p.x + n.z * p.z, 0) << "body, patch " << k;
        } else if (k < 4) {
          EXPECT_GT(n.x * p.x + n.z * p.z - n.y, 0) << "bottom, patch " << k;
        } else if (k >= 16 && k < 20) {
          EXPECT_GT(n.y + n.x * p.x + n.z * p.z, 0) << "lid, patch " << k;
        } else if (k >= 24 && (k < 30 || v < 0.4)) {
          // Beyond v = 0.4 the spout's lip turns into its mouth. The halves' sections are convex: the other
          // half's patch has the middle between them.
          const std::uint32_t other = k % 2 == 0 ? k + 1 : k - 1;
          const Vec3 middle = 0.5 * (s.position(k, k + 0.5, v) + s.position(other, other + 0.5, v));
          EXPECT_GT(glm::dot(n, p - middle), 0) << "patch " << k << " at " << a << ' ' << v;
        }
      }
}

// Of a shader's u = 17.8 float keeps four bits fewer than of 0.8.
TEST(Bezier, ShadersCountUFromWhereThePatchBegins) {
  const Surface surface = scaled(teapot(), Vec3(1, 2, 3));
  const Patch& patch = surface.patches()[17];
  EXPECT_EQ(patch.originOfU(), 17);
  Graph graph;
  const Tape local(graph, patch.function->position.expressions(graph, {{*patch.function->originOfU, 0}}));
  std::array<double, 3> p{};
  for (const double u : {0.0, 0.3125, 1.0}) {
    local.evaluatePoint(u, 0.25, patch.constants, p);
    EXPECT_EQ(Vec3(p[0], p[1], p[2]), surface.position(17, 17 + u, 0.25)) << u;
  }
  const SurfaceCode code = surfaceCode(*patch.function, patch.constants.size());
  EXPECT_EQ(code.parameters, patch.constants.size() - 1);
  EXPECT_NE(code.glsl.find("#define LUXO_ORIGIN_OF_U 48\n"), std::string::npos);
  EXPECT_EQ(code.glsl.find("parameterAt(48)"), std::string::npos);
}

TEST(Teapot, IsAsHighAsAsked) {
  for (const double height : {0.25, 3.15, 10.0}) {
    const Surface s = teapot(height);
    const double scale = height / kTeapotHeight;
    const Box box = s.bounds({});
    // The surface touches the table and the top exactly; its bounds do within rounding.
    EXPECT_NEAR(box.min.y, 0, 1e-12 * height);
    EXPECT_NEAR(box.max.y, height, 1e-12 * height);
    EXPECT_NEAR(box.min.z, -2 * scale, 1e-12 * height);
    EXPECT_NEAR(box.max.z, 2 * scale, 1e-12 * height);
  }
  for (const double height : {0.0, -1.0, std::numeric_limits<double>::infinity()})
    EXPECT_THROW(static_cast<void>(teapot(height)), Error);
}

}  // namespace
}  // namespace luxo
