// SPDX-License-Identifier: Apache-2.0
#include "mesh/polygon.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <random>
#include <vector>

#include "math/vec.h"

namespace luxo {
namespace {

double areaOf(const Vec3& a, const Vec3& b, const Vec3& c) { return glm::cross(b - a, c - a).z / 2; }

/// Of a polygon that turns to the left.
double areaOf(const std::vector<Vec3>& polygon) {
  double area = 0;
  for (std::size_t i = 2; i < polygon.size(); ++i) area += areaOf(polygon[0], polygon[i - 1], polygon[i]);
  return area;
}

double borderOf(const std::vector<Vec3>& polygon) {
  double length = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i)
    length += glm::distance(polygon[i], polygon[(i + 1) % polygon.size()]);
  return length;
}

std::vector<Vec3> circle(std::size_t corners, double rounding) {
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < corners; ++i) {
    const double angle = 2 * kPi * double(i) / double(corners);
    const Vec3 p(std::cos(angle), std::sin(angle), 0);
    points.push_back(rounding == 0 ? p : rounding * glm::round(p / rounding));
  }
  return points;
}

/// They turn as the polygon does, and have its area together: they fill it once.
std::vector<std::uint32_t> filled(const std::vector<Vec3>& polygon) {
  std::vector<std::uint32_t> corners;
  EXPECT_TRUE(addTriangles(polygon, corners));
  EXPECT_EQ(corners.size(), 3 * (polygon.size() - 2));
  double area = 0;
  for (std::size_t i = 0; i + 3 <= corners.size(); i += 3) {
    const double one = areaOf(polygon[corners[i]], polygon[corners[i + 1]], polygon[corners[i + 2]]);
    EXPECT_GE(one, 0) << i;
    area += one;
  }
  EXPECT_NEAR(area, areaOf(polygon), 1e-9);
  return corners;
}

/// In how many triangles the corner is that is in most, and how long all edges of all triangles are together.
struct Work {
  std::size_t most = 0;
  double length = 0;
};
Work workOf(const std::vector<Vec3>& polygon, const std::vector<std::uint32_t>& corners) {
  std::vector<std::size_t> uses(polygon.size());
  Work work;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    work.most = std::max(work.most, ++uses[corners[i]]);
    work.length += glm::distance(polygon[corners[i]], polygon[corners[i % 3 == 2 ? i - 2 : i + 1]]);
  }
  return work;
}

TEST(Polygon, AQuadIsCutAtItsFirstCorner) {
  EXPECT_EQ(filled({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}),
            (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}));
}

/// A round halves what is left: of 2^n corners n - 1 rounds, each with two triangles a corner and edges no
/// longer than three times the border; and the last triangle.
TEST(Polygon, OfManyCornersHasFewTrianglesAtEach) {
  const std::vector<Vec3> polygon = circle(1 << 16, 0);
  const Work work = workOf(polygon, filled(polygon));
  EXPECT_LE(work.most, 2 * 15 + 1U);
  EXPECT_LE(work.length, 16 * 3 * borderOf(polygon));
}

/// Rounded so that half of its corners turn the other way.
TEST(Polygon, NearlyConvexIsAsGood) {
  const std::vector<Vec3> polygon = circle(1 << 16, 1e-8);
  std::size_t reflex = 0;
  for (std::size_t i = 2; i < polygon.size(); ++i)
    reflex += areaOf(polygon[i - 2], polygon[i - 1], polygon[i]) <= 0;
  ASSERT_GT(reflex, polygon.size() / 10);
  const Work work = workOf(polygon, filled(polygon));
  EXPECT_LE(work.most, 100U);
  EXPECT_LE(work.length, 100 * borderOf(polygon));
}

/// Corners on a straight border stay corners of triangles with an area: no neighbour has a gap there.
TEST(Polygon, CornersOnABorderAreKept) {
  const std::vector<Vec3> polygon = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0},
                                     {2, 2, 0}, {1, 2, 0}, {0, 2, 0}, {0, 1, 0}};
  const std::vector<std::uint32_t> corners = filled(polygon);
  for (std::size_t i = 0; i < corners.size(); i += 3)
    EXPECT_GT(areaOf(polygon[corners[i]], polygon[corners[i + 1]], polygon[corners[i + 2]]), 0);
}

/// Seen whole from its first corner, and concave all along: a fan is all there is, and is found at once.
TEST(Polygon, AHollowOneIsAFan) {
  std::vector<Vec3> polygon = {{0, 0, 0}, {1, 0, 0}};
  for (int i = 1; i < 100000; ++i) {
    const double angle = kPi / 2 * i / 100000;
    polygon.emplace_back(1 - std::sin(angle) + 1e-3 * std::cos(angle),
                         1 - std::cos(angle) + 1e-3 * std::sin(angle), 0);
  }
  polygon.emplace_back(0, 1, 0);
  const std::vector<std::uint32_t> corners = filled(polygon);
  EXPECT_EQ(workOf(polygon, corners).most, polygon.size() - 2);
}

/// Polygons around the origin, with radii at random: some halve, some fan out, most have ears.
TEST(Polygon, AnyStarIsFilled) {
  std::mt19937 random(20261127);
  for (int round = 0; round < 300; ++round) {
    const std::size_t corners = 4 + random() % 60;
    std::vector<Vec3> polygon;
    const double least = double(random() % 100) / 100;
    for (std::size_t i = 0; i < corners; ++i) {
      const double angle = 2 * kPi * double(i) / double(corners),
                   radius = least + (1.01 - least) * double(random() % 1000) / 1000;
      polygon.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0);
    }
    SCOPED_TRACE(round);
    (void)filled(polygon);
  }
}

}  // namespace
}  // namespace luxo
