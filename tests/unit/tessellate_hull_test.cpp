// SPDX-License-Identifier: Apache-2.0
// Hulls are closed, hold the surface, and wrap where the formula goes on.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "surface/catalogue.h"
#include "surface/library.h"
#include "surface_samples.h"
#include "tessellate/hull.h"

namespace luxo {
namespace {

Hull hullOf(const Surface& surface, double tolerance, std::span<const double> parameters = {}) {
  return makeHull(surface, parameters, CurvatureMap(surface, parameters), {.tolerance = tolerance});
}

double sizeOf(const Surface& surface, std::span<const double> parameters = {}) {
  return glm::length(surface.framing(parameters).extent());
}

using Triangle = std::array<Vec3, 3>;

std::vector<Triangle> slabOf(const Hull& hull, std::uint32_t patch) {
  std::vector<Triangle> triangles;
  for (std::size_t i = 0; i < hull.indices.size(); i += 3) {
    if (hull.patches[hull.indices[i]] != patch) continue;
    const auto at = [&](std::size_t k) { return hull.positions[hull.indices[i + k]]; };
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

/// Directed edges, by position, that no reverse one matches.
int openEdges(const std::vector<Triangle>& triangles) {
  using Point = std::tuple<double, double, double>;
  const auto point = [](const Vec3& p) { return Point(p.x + 0.0, p.y + 0.0, p.z + 0.0); };
  std::map<std::pair<Point, Point>, int> balance;
  for (const Triangle& t : triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const Point a = point(t[k]), b = point(t[(k + 1) % 3]);
      if (a == b) continue;
      a < b ? ++balance[{a, b}] : --balance[{b, a}];
    }
  return static_cast<int>(std::ranges::count_if(balance, [](const auto& edge) { return edge.second != 0; }));
}

/// Points of the patch that are not within its slab.
int pointsOutside(const Surface& surface, const Hull& hull, std::uint32_t patch,
                  std::span<const double> parameters, int count) {
  const std::vector<Triangle> slab = slabOf(hull, patch);
  std::mt19937 random(patch + 1);
  std::uniform_real_distribution<double> part(0, 1);
  const Domain& domain = surface.patchDomain(patch);
  int outside = 0;
  for (int k = 0; k < count; ++k) {
    double u = part(random), v = part(random);
    // Edges and corners are where walls could cut.
    if (k % 4 == 1) u = std::round(u);
    if (k % 4 == 2) v = std::round(v);
    const Vec3 p = surface.position(patch, domain.u.lo + u * domain.u.width(),
                                    domain.v.lo + v * domain.v.width(), parameters);
    if (!std::isfinite(p.x + p.y + p.z)) continue;
    if (!(windingNumber(slab, p) > 0.5)) {
      if (++outside < 3) ADD_FAILURE() << surface.name() << " patch " << patch << " part " << u << ", " << v;
    }
  }
  return outside;
}

class CatalogueHull : public testing::TestWithParam<std::string> {};

TEST_P(CatalogueHull, IsClosedAndHoldsTheSurface) {
  const Surface surface = makeSurface(GetParam());
  const double size = sizeOf(surface);
  for (const double part : {0.003}) {
    SCOPED_TRACE("tolerance " + std::to_string(part) + " of the size");
    const Hull hull = hullOf(surface, part * size);
    const std::uint32_t step = std::max(1u, surface.patchCount() / 8);
    for (std::uint32_t patch = 0; patch < surface.patchCount(); patch += step) {
      const std::vector<Triangle> slab = slabOf(hull, patch);
      ASSERT_FALSE(slab.empty());
      EXPECT_EQ(openEdges(slab), 0) << patch;
      EXPECT_GT(signedVolume(slab), 0) << patch;
      const auto points = static_cast<int>(std::clamp<std::size_t>(3'000'000 / slab.size(), 40, 400));
      EXPECT_EQ(pointsOutside(surface, hull, patch, {}, points), 0) << patch;
    }
  }
}

std::vector<std::string> names() {
  std::vector<std::string> all;
  for (const CatalogueEntry& entry : catalogue()) all.emplace_back(entry.name);
  return all;
}

INSTANTIATE_TEST_SUITE_P(Catalogue, CatalogueHull, testing::ValuesIn(names()),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace luxo
