// SPDX-License-Identifier: Apache-2.0
// A triangle that is said to face one way faces it wherever a device may move its corners to.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "cull/raster_slack.h"
#include "draw/drawn_facing.h"
#include "draw/exact_data.h"
#include "math/transform.h"
#include "scene/scene.h"
#include "surface/library.h"

namespace luxo {
namespace {

using Side = DrawnFacing::Side;

Snapshot lookingAt(const Vec3& eye, const Node& node = {}, Projection projection = Projection::Perspective) {
  Scene scene;
  Node ball = node;
  ball.surface = sphere(1);
  scene.add(ball);
  scene.add(Camera{.eye = eye, .projection = projection});
  return takeSnapshot(scene, 0, {64, 48});
}

/// Of random triangles around the origin, most of them narrow.
Shell trianglesOf(std::mt19937& random, int count) {
  std::uniform_real_distribution<double> place(-0.5, 0.5), narrowness(-5, 0);
  Shell shell;
  for (int k = 0; k < count; ++k) {
    const double narrow = std::pow(10, narrowness(random));
    const Vec3 a(place(random), place(random), place(random)), b(place(random), place(random), place(random));
    const Vec3 aside(place(random), place(random), place(random));
    for (const Vec3& corner : {a, b, glm::mix(a, b, place(random) + 0.5) + narrow * aside}) {
      shell.indices.push_back(static_cast<std::uint32_t>(shell.positions.size()));
      shell.positions.push_back(corner);
    }
  }
  return shell;
}

double area(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

TEST(DrawnFacing, IsCertainOfWhatNoMoveOfCornersTurnsOver) {
  std::mt19937 random(3);
  const Snapshot snapshot = lookingAt({0.5, 0.4, 3});
  const Shell shell = trianglesOf(random, 4000);
  const DrawnFacing facing(snapshot.view, snapshot.nodes[0], shell);
  const std::vector<Vec3> corners = inPicture(snapshot.view, snapshot.nodes[0], shell.positions);
  std::uniform_real_distribution<double> angle(0, 6.3);
  const double most = 0.5 * kMovedPx;  // what a device does, with as much again to spare
  int certain = 0, turned = 0;
  for (std::uint32_t i = 0; i < shell.indices.size(); i += 3) {
    const double before = area(Vec2(corners[i]), Vec2(corners[i + 1]), Vec2(corners[i + 2]));
    bool turns = false;
    for (int move = 0; move < 200; ++move) {
      const auto moved = [&](std::uint32_t k) {
        const double way = angle(random);
        return Vec2(corners[i + k]) + most * Vec2(std::cos(way), std::sin(way));
      };
      const Vec2 a = moved(0), b = moved(1), c = moved(2);
      turns = turns || area(a, b, c) * before <= 0;
    }
    const Side drawn = facing.side(i);
    certain += drawn != Side::Either;
    turned += turns;
    // The picture's y leads down.
    EXPECT_TRUE(drawn == Side::Either || (!turns && drawn == (before < 0 ? Side::Front : Side::Back)));
  }
  EXPECT_GT(certain, 1000);
  EXPECT_GT(turned, 500);
}

TEST(DrawnFacing, ClipsWhatIsNotWhollyInThePicture) {
  const auto clips = [](const Vec3& eye) {
    const Snapshot snapshot = lookingAt(eye);
    const Surface& ball = snapshot.nodes[0].surface;
    const Shell shell = *makeShell(ball, {}, CurvatureMap(ball, {}), {.tolerance = 0.01});
    return DrawnFacing(snapshot.view, snapshot.nodes[0], shell).clips();
  };
  EXPECT_FALSE(clips({0, 0, 6}));
  EXPECT_TRUE(clips({0, 0, 2}));
}

TEST(DrawnFacing, IsCertainOfWhatIsCutAndWide) {
  const Snapshot snapshot = lookingAt({0, 0, 0.4});
  Shell shell;
  // Wide; reaching past the eye, of which a wide or a narrow part is seen.
  shell.positions = {{-1, -1, -1}, {1, -1, -1},       {0, 1, -1},  {0, 1, 1},
                     {0, -0.3, 1}, {0.0001, -0.3, 1}, {0, 0.3, -1}};
  shell.indices = {0, 1, 2, 0, 1, 3, 1, 0, 3, 4, 5, 6};
  const DrawnFacing facing(snapshot.view, snapshot.nodes[0], shell);
  EXPECT_EQ(facing.side(0), Side::Front);
  EXPECT_EQ(facing.side(3), Side::Front);
  EXPECT_EQ(facing.side(6), Side::Back);
  EXPECT_EQ(facing.side(9), Side::Either);
}

/// Of a ball's shell the top that leads outward faces the eye where it is in front, mirrored or not.
TEST(DrawnFacing, ShowsTheFrontOfWhatFacesTheEye) {
  for (const Projection projection : {Projection::Perspective, Projection::Orthographic})
    for (const double mirror : {1.0, -1.0}) {
      const Vec3 eye(0.5, 0.4, 6);
      const Snapshot snapshot = lookingAt(eye, {.scale = Vec3(mirror, 1, 1)}, projection);
      const Surface& ball = snapshot.nodes[0].surface;
      const Shell shell = *makeShell(ball, {}, CurvatureMap(ball, {}), {.tolerance = 0.01});
      const DrawnFacing facing(snapshot.view, snapshot.nodes[0], shell);
      const Shell::Part& part = shell.parts.at(0);
      int fronts = 0, backs = 0;
      for (std::uint32_t i = part.firstIndex; i < part.firstIndex + part.frontCount; i += 3) {
        const Vec3 at = transformPoint(snapshot.nodes[0].worldFromObject, shell.positions[shell.indices[i]]);
        const double facesEye = glm::dot(glm::normalize(at), glm::normalize(eye));
        if (std::abs(facesEye) < 0.5) continue;  // far off the outline
        EXPECT_EQ(facing.side(i), facesEye > 0 ? Side::Front : Side::Back);
        ++(facesEye > 0 ? fronts : backs);
      }
      EXPECT_GT(fronts, 20);
      EXPECT_GT(backs, 20);
    }
}

}  // namespace
}  // namespace luxo
