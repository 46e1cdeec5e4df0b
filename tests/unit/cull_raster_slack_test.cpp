// SPDX-License-Identifier: Apache-2.0
// A polygon that is said to turn one way does so wherever its corners are moved.
#include "cull/raster_slack.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include "math/numbers.h"

namespace luxo {
namespace {

double twiceTheArea(std::span<const Vec3> corners) {
  double area = 0;
  for (std::size_t i = 2; i < corners.size(); ++i)
    area += glm::cross(corners[i - 1] - corners[0], corners[i] - corners[0]).z;
  return area;
}

struct Areas {
  double least, most;
};

/// Of a polygon whose corners move by kMovedPx at most along x and y. The area is linear in each coordinate
/// of each corner, so that it is least and most where all of them have gone as far as they can.
Areas areasOfMoved(const std::vector<Vec3>& polygon) {
  Areas areas{twiceTheArea(polygon), twiceTheArea(polygon)};
  std::vector<Vec3> moved = polygon;
  for (unsigned ways = 0; ways < 1U << 2 * polygon.size(); ++ways) {
    for (std::size_t i = 0; i < polygon.size(); ++i)
      for (int along = 0; along < 2; ++along)
        moved[i][along] = polygon[i][along] +
                          ((ways >> (2 * i + static_cast<unsigned>(along)) & 1) != 0 ? 1 : -1) * kMovedPx;
    areas.least = std::min(areas.least, twiceTheArea(moved));
    areas.most = std::max(areas.most, twiceTheArea(moved));
  }
  return areas;
}

/// On an ellipse, from smaller than what moves corners to hundreds of times as large, round or narrow.
std::vector<Vec3> convexPolygon(std::mt19937& random, std::size_t corners) {
  std::uniform_real_distribution<double> angle(0, 2 * kPi), sizes(-1, 9), narrowness(-8, 0);
  const double size = kMovedPx * std::exp2(sizes(random)), narrow = std::exp2(narrowness(random)),
               turn = angle(random);
  std::vector<double> angles(corners);
  for (double& a : angles) a = angle(random);
  std::ranges::sort(angles);
  std::vector<Vec3> polygon;
  for (const double a : angles) {
    const double x = size * std::cos(a), y = size * narrow * std::sin(a);
    polygon.emplace_back(x * std::cos(turn) - y * std::sin(turn), x * std::sin(turn) + y * std::cos(turn), 1);
  }
  return polygon;
}

TEST(CertainArea, IsOfWhatNoMoveOfCornersTurnsOver) {
  std::mt19937 random(5);
  for (const auto& [corners, count] :
       {std::pair(3, 6000), std::pair(4, 1500), std::pair(5, 400), std::pair(7, 30)}) {
    int certain = 0, turned = 0, timid = 0;
    for (int k = 0; k < count; ++k) {
      std::vector<Vec3> polygon = convexPolygon(random, static_cast<std::size_t>(corners));
      if (k % 2 != 0) std::ranges::reverse(polygon);
      const Areas areas = areasOfMoved(polygon);
      const bool turns = areas.least <= 0 && areas.most >= 0;
      const double area = certainArea(polygon);
      if (area != 0) {
        EXPECT_FALSE(turns) << corners << " corners, " << k;
        EXPECT_NEAR(area, twiceTheArea(polygon), 1e-12 * std::abs(area));
      }
      certain += area != 0;
      turned += turns;
      timid += area == 0 && !turns;
    }
    EXPECT_GT(certain, count / 10) << corners;
    EXPECT_GT(turned, count / 10) << corners;
    EXPECT_LT(timid, certain / 4) << corners;
  }
}

// Two of the edges tell too little: the third may be as long as both.
TEST(CertainArea, LooksAtEveryEdge) {
  const std::vector<Vec3> triangle{{0, 0, 1}, {1, 0.025, 1}, {-1, 0.025, 1}};
  EXPECT_LT(areasOfMoved(triangle).least, 0);
  EXPECT_EQ(certainArea(triangle), 0);
}

TEST(CertainArea, IsNoneOfWhatHasNone) {
  EXPECT_EQ(certainArea({}), 0);
  const std::vector<Vec3> line{{0, 0, 1}, {9, 3, 1}, {3, 1, 1}};
  EXPECT_EQ(certainArea(line), 0);
  EXPECT_EQ(certainArea(std::span(line).first(2)), 0);
  const double none = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(certainArea(std::vector<Vec3>{{0, 0, 1}, {9, 0, 1}, {none, 9, 1}}), 0);
}

// The picture's y leads down.
TEST(CertainArea, IsPositiveClockwise) {
  const std::vector<Vec3> square{{0, 0, 1}, {10, 0, 2}, {10, 10, 3}, {0, 10, 4}};
  EXPECT_EQ(certainArea(square), 200);
  EXPECT_EQ(certainArea(std::vector<Vec3>(square.rbegin(), square.rend())), -200);
}

}  // namespace
}  // namespace luxo
