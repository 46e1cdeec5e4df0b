// SPDX-License-Identifier: Apache-2.0
// Shells are closed, hold the surface, and wrap where the formula goes on.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <map>
#include <random>
#include <set>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "catalogue_names.h"
#include "shell/shell.h"
#include "surface/catalogue.h"
#include "surface/library.h"
#include "surface_samples.h"

namespace luxo {
namespace {

Shell shellOf(const Surface& surface, double tolerance, std::span<const double> parameters = {}) {
  return *makeShell(surface, parameters, CurvatureMap(surface, parameters), {.tolerance = tolerance});
}

double sizeOf(const Surface& surface, std::span<const double> parameters = {}) {
  return glm::length(surface.framing(parameters).extent());
}

// A few units in the last place of the largest number, and where a formula has none but exact ones, nothing.
TEST(Shell, FormulaRoundingIsWhatSinglePrecisionMovesPointsBy) {
  const auto roundingOf = [](auto formula) {
    return shellOf(surface(formula, {{-0.2, 0.2}, {-0.2, 0.2}}), 0.001).formulaRounding;
  };
  EXPECT_EQ(roundingOf([](auto u, auto v) { return point(u, 0.25 * u, v); }), 0);
  const double plain = roundingOf([](auto u, auto v) { return point(u, 0.2 * sin(8 * u), v); }),
               phase = roundingOf([](auto u, auto v) { return point(u, 0.2 * sin(8 * u + 900), v); }),
               mirror =
                   roundingOf([](auto u, auto v) { return point(u, 30 - sqrt(900 - u * u - v * v), v); });
  EXPECT_GT(plain, 0);
  EXPECT_LT(plain, 0x1p-24);
  // The phase is off by half of 2^-14, and the sine by as much; radii of 30 metres by halves of 2^-19.
  EXPECT_GT(phase, 0.2 * 0.7 * 0x1p-15);
  EXPECT_LT(phase, 0.2 * 1.1 * 0x1p-15);
  EXPECT_GT(mirror, 0.7 * 0x1p-20);
  EXPECT_LT(mirror, 2.2 * 0x1p-20);
}

using Triangle = std::array<Vec3, 3>;

std::vector<Triangle> slabOf(const Shell& shell, std::uint32_t patch) {
  std::vector<Triangle> triangles;
  for (std::size_t i = 0; i < shell.indices.size(); i += 3) {
    if (shell.patches[shell.indices[i]] != patch) continue;
    const auto at = [&](std::size_t k) { return shell.positions[shell.indices[i + k]]; };
    triangles.push_back({at(0), at(1), at(2)});
  }
  return triangles;
}

/// How many times the triangles go around a point: their solid angles (van Oosterom, Strackee 1983).
double windingNumber(const std::vector<Triangle>& triangles, const Vec3& p) {
  double sum = 0;
  for (const Triangle& t : triangles) {
    const Vec3 a = t[0] - p, b = t[1] - p, c = t[2] - p;
    const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
    sum += 2 * std::atan2(glm::dot(a, glm::cross(b, c)),
                          la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb);
  }
  return sum / (4 * kPi);
}

double signedVolume(const std::vector<Triangle>& triangles) {
  double sum = 0;
  const Vec3 origin = triangles[0][0];
  for (const auto& [a, b, c] : triangles) sum += glm::dot(a - origin, glm::cross(b - origin, c - origin)) / 6;
  return sum;
}

/// Directed edges that no reverse one matches. Ends are the same if all their bits are, or, given a `unit`,
/// if they are rounded to the same multiple of it.
int openEdges(const std::vector<Triangle>& triangles, double unit = 0) {
  using Point = std::tuple<double, double, double>;
  const auto point = [&](const Vec3& p) {
    const Vec3 q = unit > 0 ? glm::round(p / unit) + 0.0 : p;
    return Point(q.x, q.y, q.z);
  };
  std::map<std::pair<Point, Point>, int> balance;
  for (const Triangle& t : triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const Point a = point(t[k]), b = point(t[(k + 1) % 3]);
      a < b ? ++balance[{a, b}] : --balance[{b, a}];
    }
  return static_cast<int>(std::ranges::count_if(balance, [](const auto& edge) { return edge.second != 0; }));
}

/// Whether it is left to rays.
bool isInPinch(const Shell& shell, const Vec3& point) {
  return std::ranges::any_of(shell.pinches, [&](const Box& pinch) { return pinch.contains(point); });
}

/// How many of `count` points of the patch, each moved to somewhere on an ellipsoid around it, are neither
/// within its slab nor in a pinch. Every other one is on an edge, where a wall could cut.
int pointsOutside(const Surface& surface, std::span<const double> parameters, const Shell& shell,
                  std::uint32_t patch, int count, const Vec3& halfAxes = Vec3(0)) {
  const std::vector<Triangle> slab = slabOf(shell, patch);
  std::mt19937 random(patch + 1);
  std::uniform_real_distribution<double> part(0, 1);
  const Domain& domain = surface.patchDomain(patch);
  int outside = 0;
  for (int k = 0; k < count; ++k) {
    double u = part(random), v = part(random);
    if (k % 4 == 1) u = std::round(u);
    if (k % 4 == 3) v = std::round(v);
    const Vec3 p = surface.position(patch, domain.u.lo + u * domain.u.width(),
                                    domain.v.lo + v * domain.v.width(), parameters);
    const Vec3 way(part(random) - 0.5, part(random) - 0.5, part(random) - 0.5);
    const Vec3 moved = p + halfAxes * glm::normalize(way);
    if (std::isfinite(p.x + p.y + p.z) && !(windingNumber(slab, moved) > 0.5) && !isInPinch(shell, p))
      ++outside;
  }
  return outside;
}

void expectAShell(const Surface& surface, std::span<const double> parameters, const Shell& shell) {
  const std::uint32_t step = std::max(1u, surface.patchCount() / 8);
  for (std::uint32_t patch = 0; patch < surface.patchCount(); patch += step) {
    SCOPED_TRACE("patch " + std::to_string(patch));
    const std::vector<Triangle> slab = slabOf(shell, patch);
    ASSERT_FALSE(slab.empty());
    EXPECT_EQ(openEdges(slab), 0);
    EXPECT_GT(signedVolume(slab), 0);
    const auto points = static_cast<int>(std::clamp<std::size_t>(2'000'000 / slab.size(), 100, 400));
    EXPECT_EQ(pointsOutside(surface, parameters, shell, patch, points), 0);
  }
}

class CatalogueShell : public testing::TestWithParam<std::string> {};

TEST_P(CatalogueShell, IsClosedAndHoldsTheSurface) {
  // Those with pinch points; a seashell's first ring is one, as far as a coarse shell can tell.
  static const std::set<std::string> pinched{"whitney_umbrella", "boy", "steiner_roman", "cross_cap",
                                             "seashell"};
  const Surface surface = makeSurface(GetParam());
  for (const double part : {0.05, 0.01, 0.003}) {
    SCOPED_TRACE("tolerance " + std::to_string(part) + " of the size");
    const Shell shell = shellOf(surface, part * sizeOf(surface));
    EXPECT_TRUE(shell.proven || pinched.contains(GetParam()));
    expectAShell(surface, {}, shell);
  }
}

INSTANTIATE_TEST_SUITE_P(Catalogue, CatalogueShell, testing::ValuesIn(catalogueNames()),
                         [](const auto& test) { return test.param; });

// Around vertices that are in a pinch, near and far.
TEST(Shell, WhatPinchesLeaveOutIsInTheirBoxes) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> part(0, 1);
  int leftOut = 0;
  for (const char* name : {"whitney_umbrella", "steiner_roman", "cross_cap"})
    for (const double tolerance : {0.05, 0.02, 0.005}) {
      SCOPED_TRACE(name);
      const Surface surface = makeSurface(name);
      const Shell shell = shellOf(surface, tolerance * sizeOf(surface));
      std::vector<std::uint32_t> inPinch;
      for (std::uint32_t v = 0; v < shell.parameters.size() / 2; ++v)
        if (isInPinch(shell,
                      surface.position(shell.patches[v], shell.parameters[v].x, shell.parameters[v].y)))
          inPinch.push_back(v);
      ASSERT_FALSE(inPinch.empty());
      std::map<std::uint32_t, std::vector<Triangle>> slabs;
      for (int k = 0; k < 1000; ++k) {
        const std::uint32_t v = inPinch[random() % inPinch.size()], patch = shell.patches[v];
        const Domain& domain = surface.patchDomain(patch);
        const Vec2 way(domain.u.width() * (2 * part(random) - 1), domain.v.width() * (2 * part(random) - 1));
        const Vec2 at = Vec2(shell.parameters[v]) + std::pow(10, -1 - 4 * part(random)) * way;
        const Vec3 p = surface.position(patch, std::clamp(at.x, domain.u.lo, domain.u.hi),
                                        std::clamp(at.y, domain.v.lo, domain.v.hi));
        if (!slabs.contains(patch)) slabs[patch] = slabOf(shell, patch);
        if (windingNumber(slabs[patch], p) > 0.5) continue;
        ++leftOut;
        EXPECT_TRUE(isInPinch(shell, p)) << p.x << " " << p.y << " " << p.z;
      }
    }
  EXPECT_GT(leftOut, 0);
}

// Where they bend less sharply than it.
TEST(Shell, AnEllipsoidAroundEachPointIsInside) {
  const Vec3 margin(0.1, 0.02, 0.3);
  for (const char* name : {"torus", "disk", "rectangle", "mobius", "enneper", "klein_figure8", "teapot"}) {
    SCOPED_TRACE(name);
    const Surface surface = makeSurface(name);
    const double tolerance = 0.005 * sizeOf(surface);
    const Shell shell =
        *makeShell(surface, {}, CurvatureMap(surface, {}), {.tolerance = tolerance, .margin = margin});
    for (std::uint32_t patch = 0; patch < surface.patchCount(); patch += 5)
      EXPECT_EQ(pointsOutside(surface, {}, shell, patch, 400, 0.999 * tolerance * margin), 0);
  }
}

TEST(TessellateShell, BoundsHowMuchDerivativesChangeOverACell) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> within(-3, 3);
  for (const char* name : {"sphere", "torus", "teapot", "flag", "klein_figure8", "cone"}) {
    SCOPED_TRACE(name);
    const Surface surface = makeSurface(name);
    const Shell shell = shellOf(surface, 0.01 * sizeOf(surface));
    double tightest = 0;
    for (std::size_t v = 0; v < shell.positions.size() / 2; ++v) {
      const Domain& domain = surface.patchDomain(shell.patches[v]);
      const Patch& patch = surface.patches()[shell.patches[v]];
      const Vec2 cell = shell.cells[v],
                 at = shell.parameters[v] + Vec2(within(random), within(random)) * cell;
      std::array<double, 9> second{};
      patch.function->second.evaluatePoint(std::clamp(at.x, domain.u.lo, domain.u.hi),
                                           std::clamp(at.y, domain.v.lo, domain.v.hi), patch.constants,
                                           second);
      const auto length = [&](std::size_t k) {
        return glm::length(Vec3(second[k], second[k + 1], second[k + 2]));
      };
      const double change =
          length(0) * cell.x * cell.x + 2 * length(3) * cell.x * cell.y + length(6) * cell.y * cell.y;
      ASSERT_LE(change, shell.changes[v] * (1 + 1e-9)) << v;
      tightest = std::max(tightest, change / shell.changes[v]);
    }
    EXPECT_GT(tightest, 0.5) << "no bound to speak of";
  }
}

TEST(TessellateShell, KnowsTheRadiusOfItsBends) {
  EXPECT_NEAR(shellOf(sphere(2), 0.01).medianRadius, 2, 1e-9);
  EXPECT_NEAR(shellOf(torus(5, 0.25), 0.01).medianRadius, 0.25, 1e-9);
  EXPECT_TRUE(std::isinf(shellOf(disk(3), 0.01).medianRadius));
}

TEST(Shell, HoldsSurfacesThatMove) {
  for (const SurfaceSample& sample : surfaceSamples()) {
    SCOPED_TRACE(sample.name);
    const Shell shell =
        shellOf(sample.surface, 0.01 * sizeOf(sample.surface, sample.parameters), sample.parameters);
    EXPECT_TRUE(shell.proven);
    expectAShell(sample.surface, sample.parameters, shell);
  }
}

/// The walls' triangles: as many as the front has more than the back.
std::size_t wallsOf(const Shell& shell) {
  std::size_t walls = 0;
  for (const Shell::Part& part : shell.parts) walls += (2 * part.frontCount - part.count) / 3;
  return walls;
}

TEST(Shell, GoesOnWhereTheFormulaDoes) {
  const auto wraps = [](const Surface& surface) {
    const ShellPatch patch = shellOf(surface, 0.01 * sizeOf(surface)).patchData[0];
    return std::pair(patch.wrapsU, patch.wrapsV);
  };
  EXPECT_EQ(wraps(torus(1, 0.25)), std::pair(true, true));
  EXPECT_EQ(wraps(lectureTorus(1, 0.5)), std::pair(true, true));
  EXPECT_EQ(wraps(sphere(1)), std::pair(true, false));
  EXPECT_EQ(wraps(cylinder(1, 1)), std::pair(true, false));
  EXPECT_EQ(wraps(rectangle(1, 1)), std::pair(false, false));
  EXPECT_EQ(wraps(moebius(1, 0.5)), std::pair(false, false)) << "flipped";
  EXPECT_EQ(wraps(makeSurface("klein_figure8")), std::pair(false, true)) << "flipped along u only";
  EXPECT_EQ(wallsOf(shellOf(torus(1, 0.25), 0.01)), 0u);
  EXPECT_EQ(wallsOf(shellOf(sphere(1), 0.01)), 0u);
}

TEST(Shell, HasWallsWhereOnlyTheEdgesMeet) {
  // Closed and smooth on the domain; beyond its ends the bulge is steeper than at the other end.
  const Surface ring = surface(
      [](auto u, auto v) {
        const auto bulge = u * u * (1 - u) * (1 - u);
        return point((1 + bulge) * cos(kTau * u), v, (1 + bulge) * sin(kTau * u));
      },
      {});
  ASSERT_TRUE(ring.topology().seamU());
  const Shell shell = shellOf(ring, 0.01);
  EXPECT_FALSE(shell.patchData[0].wrapsU);
  expectAShell(ring, {}, shell);
}

TEST(Shell, KnowsCollapsedEdges) {
  const ShellPatch ball = shellOf(sphere(1), 0.01).patchData[0];
  EXPECT_FALSE(ball.collapsedUMin || ball.collapsedUMax);
  EXPECT_TRUE(ball.collapsedVMin && ball.collapsedVMax);
  const ShellPatch tip = shellOf(cone(1, 0, 2), 0.01).patchData[0];
  EXPECT_TRUE(tip.collapsedVMax && !tip.collapsedVMin);
  EXPECT_EQ(shellOf(disk(1), 0.01).patchData[0].orientation, -1);
}

/// Of all patches together.
std::vector<Triangle> occluderSlabs(const Shell& shell) {
  std::vector<Triangle> triangles;
  for (std::size_t i = 0; i < shell.indices.size(); i += 3) {
    if (shell.occluder.triangles[i / 3] == ShellOccluder::Triangle::Joint) continue;
    const auto at = [&](std::size_t k) { return shell.occluder.positions[shell.indices[i + k]]; };
    triangles.push_back({at(0), at(1), at(2)});
  }
  return triangles;
}

/// Whether the slabs hold the point of a patch at these parts of its domain.
bool holds(const std::vector<Triangle>& slabs, const Surface& surface, std::uint32_t patch, const Vec2& at) {
  const Domain& domain = surface.patchDomain(patch);
  const Vec3 p = surface.position(patch, domain.u.lo + at.x * domain.u.width(),
                                  domain.v.lo + at.y * domain.v.width(), {});
  return windingNumber(slabs, p) > 0.5;
}

// So no ray passes through such a slab beside the surface.
TEST(Shell, BordersAreOutsideOfOccluders) {
  // The last one's inner rim curves away from its chords.
  const Surface arch =
      luxo::surface([](auto u, auto v) { return point((1 + v) * cos(u), 0.0 * u, -(1 + v) * sin(u)); },
                    {{0, 2}, {0, 1}}, {.name = "arch"});
  for (const Surface& surface : {makeSurface("rectangle"), makeSurface("hyperbolic_paraboloid"),
                                 makeSurface("scherk"), makeSurface("helicoid"), arch}) {
    SCOPED_TRACE(surface.name());
    const Shell shell = shellOf(surface, 0.01 * sizeOf(surface));
    EXPECT_TRUE(shell.occluder.proven);
    const std::vector<Triangle> occluder = occluderSlabs(shell), slab = slabOf(shell, 0);
    EXPECT_EQ(openEdges(occluder), 0);
    for (int k = 0; k <= 40; ++k) {
      const double part = k / 40.0;
      for (const Vec2& at : {Vec2(part, 0), Vec2(part, 1), Vec2(0, part), Vec2(1, part)}) {
        EXPECT_TRUE(holds(slab, surface, 0, at)) << at.x << ' ' << at.y;
        EXPECT_FALSE(holds(occluder, surface, 0, at)) << at.x << ' ' << at.y;
      }
      EXPECT_TRUE(holds(occluder, surface, 0, Vec2(0.25 + 0.5 * part, 0.75 - 0.3 * part)));
    }
  }
}

// Of these patches no edge is a border: what is seen past one is another's.
TEST(Shell, OccludersGoOnFromPatchToPatch) {
  for (const char* name : {"superellipsoid", "supertoroid"}) {
    SCOPED_TRACE(name);
    const Surface surface = makeSurface(name);
    const double size = sizeOf(surface);
    const Shell shell = shellOf(surface, 0.01 * size);
    EXPECT_TRUE(shell.occluder.proven);
    const std::vector<std::uint32_t>& numbers = shell.occluder.slabOf;
    EXPECT_TRUE(std::ranges::all_of(numbers, [&](std::uint32_t slab) { return slab == numbers[0]; }));
    const std::vector<Triangle> occluder = occluderSlabs(shell);
    EXPECT_EQ(openEdges(occluder, 1e-9 * size), 0);
    for (std::uint32_t patch = 0; patch < surface.patchCount(); patch += 7)
      for (const double part : {0.0, 0.3, 0.5, 1.0})
        for (const Vec2& at : {Vec2(part, 0), Vec2(part, 1), Vec2(0, part), Vec2(1, part)})
          EXPECT_TRUE(holds(occluder, surface, patch, at)) << patch << ' ' << at.x << ' ' << at.y;
  }
}

// Body, lid, handle and spout are not joined to each other; each goes on from patch to patch. So does the lid
// in its knob, but around a bend that facets of coarse shells make a sharp edge: that may be a slab of its
// own.
TEST(Shell, EachPartOfTheTeapotIsASlab) {
  const Surface teapot = makeSurface("teapot");
  for (const double tolerance : {0.01, 0.002}) {
    SCOPED_TRACE(tolerance);
    const Shell shell = shellOf(teapot, tolerance * sizeOf(teapot));
    EXPECT_TRUE(shell.occluder.proven);
    const std::span slabs(shell.occluder.slabOf);  // of patches as surface/teapot.h has them
    ASSERT_EQ(slabs.size(), 32U);
    const std::span body = slabs.subspan(0, 16), lid = slabs.subspan(16, 4), knob = slabs.subspan(20, 4),
                    handle = slabs.subspan(24, 4), spout = slabs.subspan(28, 4);
    for (const std::span part : {body, lid, knob, handle, spout})
      EXPECT_EQ(std::ranges::count(part, part[0]), std::ssize(part));
    EXPECT_EQ(std::set({body[0], lid[0], handle[0], spout[0]}).size(), 4U);
    for (const std::span other : {body, handle, spout}) EXPECT_NE(knob[0], other[0]);
  }
}

TEST(Shell, KnowsBorders) {
  const auto isBordered = [](const char* name) {
    const Surface surface = makeSurface(name);
    return shellOf(surface, 0.01 * sizeOf(surface)).patchData[0].bordered;
  };
  for (const char* name : {"rectangle", "disk", "cylinder", "mobius", "enneper"})
    EXPECT_TRUE(isBordered(name)) << name;
  for (const char* name : {"sphere", "torus", "klein", "boy"}) EXPECT_FALSE(isBordered(name)) << name;
  // The teapot's handle meets its body, but is joined to nothing there; between its patches are no borders.
  const Surface teapot = makeSurface("teapot");
  const std::vector<ShellPatch> patches = shellOf(teapot, 0.01 * sizeOf(teapot)).patchData;
  const auto bordered = std::ranges::count_if(patches, &ShellPatch::bordered);
  EXPECT_GT(bordered, 0);
  EXPECT_LT(bordered, std::ssize(patches));
}

TEST(Shell, PatchesOfOneFunctionAreOnePart) {
  const Shell teapot = shellOf(makeSurface("teapot"), 0.05);
  ASSERT_EQ(teapot.parts.size(), 1u);
  EXPECT_EQ(teapot.patchData.size(), 32u);
  EXPECT_EQ(teapot.parts[0].count, teapot.indices.size());
  const Surface klein = makeSurface("klein");
  const Shell two = shellOf(klein, 0.01 * sizeOf(klein));
  ASSERT_EQ(two.parts.size(), 2u);
  EXPECT_EQ(two.parts[1].patch, 1u);
  EXPECT_EQ(two.parts[1].firstIndex, two.parts[0].count);
  EXPECT_EQ(two.parts[0].count + two.parts[1].count, two.indices.size());
  for (const Shell::Part& part : two.parts)
    for (std::size_t i = part.firstIndex; i < part.firstIndex + part.count; ++i)
      ASSERT_EQ(two.patches[two.indices[i]], part.patch);
}

TEST(Shell, TopsAreOutsideAndBottomsInside) {
  const Shell shell = shellOf(sphere(1), 0.02);
  const Shell::Part part = shell.parts.at(0);
  EXPECT_EQ(2 * part.frontCount, part.count);
  double nearest = 2, farthest = 0;
  for (std::size_t i = 0; i < part.count; ++i) {
    const double radius = glm::length(shell.positions[shell.indices[i]]);
    EXPECT_EQ(radius > 1, i < part.frontCount);
    nearest = std::min(nearest, radius);
    farthest = std::max(farthest, radius);
  }
  EXPECT_LE(std::max(farthest - 1, 1 - nearest), shell.offset * (1 + 1e-12));
  EXPECT_LT(shell.offset, 2 * kEquationTolerance * 0.02);
}

TEST(Shell, ConesHoldTheNormalsOfTheirTriangles) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> part(0, 1);
  for (const char* name : {"teapot", "flag", "boy", "klein", "hyperbolic_paraboloid"}) {
    SCOPED_TRACE(name);
    const Surface surface = makeSurface(name);
    const Shell shell = shellOf(surface, 0.01 * sizeOf(surface));
    int cones = 0;
    for (std::uint32_t i = 0; i < shell.parts[0].faceCount(); i += 3) {
      const NormalCone& cone = shell.cones[i / 3];
      if (cone.sine > 1) continue;
      ++cones;
      const auto corner = [&](std::uint32_t k) { return shell.parameters[shell.indices[i + k]]; };
      double a = part(random), b = part(random);
      if (a + b > 1) a = 1 - a, b = 1 - b;
      const Vec2 uv = a * corner(0) + b * corner(1) + (1 - a - b) * corner(2);
      const Vec3 normal = surface.normal(shell.patches[shell.indices[i]], uv.x, uv.y);
      EXPECT_GE(glm::dot(Vec3(cone.axis), normal), std::sqrt(1 - cone.sine * cone.sine))
          << uv.x << ' ' << uv.y;
    }
    EXPECT_GT(cones, 5);
  }
}

TEST(Shell, VerticesCarryTheirCells) {
  const Shell shell = shellOf(torus(1, 0.25), 0.01);
  std::vector<Vec2> largest(shell.positions.size(), Vec2(0));
  for (std::size_t i = 0; i < shell.indices.size(); i += 3) {
    const auto uv = [&](std::size_t k) { return shell.parameters[shell.indices[i + k]]; };
    const Vec2 extent = glm::max(glm::max(uv(0), uv(1)), uv(2)) - glm::min(glm::min(uv(0), uv(1)), uv(2));
    EXPECT_TRUE(extent.x < 0.5 && extent.y < 0.5) << "parameters can be interpolated";
    for (std::size_t k = 0; k < 3; ++k)
      largest[shell.indices[i + k]] = glm::max(largest[shell.indices[i + k]], extent);
  }
  EXPECT_EQ(shell.cells, largest);
}

TEST(Shell, FlatSurfacesAreAsThinAsTheMargin) {
  // Corners move along both walls' normals and the plane's by the margin, and by 1e-6 of the size. What has
  // an equation is searched for from kEquationTolerance times as far.
  const Surface flat = rectangle(3, 4);
  const auto offsetOf = [&](double tolerance, double margin) {
    return makeShell(flat, {}, CurvatureMap(flat, {}), {.tolerance = tolerance, .margin = Vec3(margin)})
        ->offset;
  };
  EXPECT_EQ(shellOf(flat, 0.01).bound, 0);
  EXPECT_LE(shellOf(flat, 0.01).triangleCount(), 2U * 6) << "a box: nothing is gained by more";
  EXPECT_NEAR(shellOf(flat, 0.01).offset, std::sqrt(3.0) * (kEquationTolerance * 0.01 / 64 + 5e-6), 1e-12);
  EXPECT_NEAR(offsetOf(0.01, 0.5), std::sqrt(3.0) * (kEquationTolerance * 0.005 + 5e-6), 1e-12);
  EXPECT_NEAR(shellOf(flat, 0.1).offset, std::sqrt(3.0) * (0.2 / 64 + 5e-6), 1e-12) << "coarse for its size";
  // A rim deviates sideways, by nearly the bound.
  const Shell rim = shellOf(disk(1), 0.01);
  EXPECT_GT(rim.offset, 0.01 * std::sqrt(2.0) * 0.5);
  expectAShell(disk(1), {}, rim);
}

TEST(Shell, IsWithinItsDistanceOfTheSurface) {
  // The planes are 1.1 bounds away, and vertices turn by mostTurn at most: 1.1 / cos 0.8 = 1.58.
  for (const char* name : {"torus", "sphere", "dupin_cyclide", "torus_knot", "spring"}) {
    const Surface surface = makeSurface(name);
    const double tolerance = 0.01 * sizeOf(surface);
    const Shell shell = shellOf(surface, tolerance);
    // Ends of a spring have walls: one more direction.
    const double allowed = shell.patchData[0].equation ? kEquationTolerance * tolerance : tolerance;
    EXPECT_LT(shell.offset, 1.9 * allowed) << name;
  }
}

TEST(Shell, TightBendsAreFinerThanTheTolerance) {
  // A wire of a tenth of the tolerance: the mesh alone would have three sides.
  const Surface wire = torus(1, 0.005);
  const Shell shell = shellOf(wire, 0.05);
  EXPECT_TRUE(shell.proven);
  EXPECT_LT(shell.offset, 0.02) << "no wider than a few wires";
  expectAShell(wire, {}, shell);
}

TEST(Shell, AFormulaThatEndsInsideOfItsRectangleHasNone) {
  const Surface holed =
      surface([](auto u, auto v) { return point(u, sqrt(u * u + v * v - 0.25), v); }, {{-1, 1}, {-1, 1}});
  EXPECT_FALSE(makeShell(holed, {}, CurvatureMap(holed, {}), {.tolerance = 0.05}).has_value());
}

TEST(Shell, EqualInputGivesEqualBits) {
  const Surface teapot = makeSurface("teapot");
  const Shell a = shellOf(teapot, 0.05), b = shellOf(teapot, 0.05);
  EXPECT_EQ(a.positions, b.positions);
  EXPECT_EQ(a.indices, b.indices);
  EXPECT_EQ(a.parameters, b.parameters);
}

TEST(Shell, TakesFewTriangles) {
  const Surface teapot = makeSurface("teapot");
  const Vec3 extent = teapot.bounds({}).extent();
  const double pixel = std::max(extent.x, extent.z) / 900;
  const std::size_t count = shellOf(teapot, 8 * pixel).triangleCount();
  std::printf("shell of the teapot, 900 px wide at 8 px: %zu triangles\n", count);
  EXPECT_LE(count, 7000u);
}

}  // namespace
}  // namespace luxo
