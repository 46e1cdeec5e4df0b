// SPDX-License-Identifier: Apache-2.0
// Pixels as functions of points, and places of a plane as functions of pixels.
#include "draw/pixel_rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "scene/view.h"

namespace luxo {
namespace {

constexpr PixelSize kRowsSize{640, 480};

Transform tilted() {
  const Vec3 x(1.7, 0.6, -0.4), y(-0.2, 0.4, 0.1), z(0.5, -0.3, -1.4);
  return {.linear = Mat3(x, y, z), .translation = Vec3(0.3, -0.2, 0.7)};
}

View viewOf(Projection projection) {
  return viewAt({.eye = Vec3(2, 3, 5), .lookAt = Vec3(0.1, 0, 0), .projection = projection, .height = 4}, {},
                kRowsSize, {Vec3(-5), Vec3(5)});
}

/// Right of and below the picture's middle.
Vec2 pixelOf(const View& view, const Vec3& world) {
  return pixelFromEye(view, eyeFromWorldPoint(view, world)) - 0.5 * Vec2(kRowsSize.width, kRowsSize.height);
}

TEST(PixelRows, AreThePixelsOfPoints) {
  const Transform object = tilted();
  for (const Projection projection : {Projection::Perspective, Projection::Orthographic}) {
    const View view = viewOf(projection);
    const PixelRows rows = pixelRows(view, object);
    for (const Vec3& p : {Vec3(0), Vec3(0.3, -0.7, 0.2), Vec3(-1, 0.4, 0.9)}) {
      const double depth = glm::dot(rows.depth, Vec4(p, 1)), w = view.perspective() ? depth : 1;
      const Vec2 pixel(glm::dot(rows.x, Vec4(p, 1)) / w, glm::dot(rows.y, Vec4(p, 1)) / w);
      const Vec3 world = transformPoint(object, p);
      EXPECT_NEAR(glm::length(pixel - pixelOf(view, world)), 0, 1e-10);
      EXPECT_NEAR(depth, -eyeFromWorldPoint(view, world).z, 1e-13);
    }
  }
}

TEST(PixelRows, FindThePlacesOfAPlane) {
  const Transform object = tilted();
  for (const Projection projection : {Projection::Perspective, Projection::Orthographic}) {
    const View view = viewOf(projection);
    const auto rows = planeRows(view, object);
    ASSERT_TRUE(rows);
    for (const Vec3& p : {Vec3(0), Vec3(0.3, 0, 0.2), Vec3(-1, 0, 0.9)}) {
      const Vec3 pixel(pixelOf(view, transformPoint(object, p)), 1);
      const double w = glm::dot(rows->w, pixel);
      EXPECT_NEAR(glm::dot(rows->x, pixel) / w, p.x, 1e-12);
      EXPECT_NEAR(glm::dot(rows->z, pixel) / w, p.z, 1e-12);
    }
  }
}

TEST(PixelRows, NothingIsFoundOfAPlaneSeenEdgeOn) {
  for (const Projection projection : {Projection::Perspective, Projection::Orthographic}) {
    const Camera camera{.eye = Vec3(0, 0, 5), .projection = projection, .height = 4};
    EXPECT_FALSE(planeRows(viewAt(camera, {}, kRowsSize, {Vec3(-5), Vec3(5)}), Transform{}));
  }
}

TEST(PixelRows, WhatIsOutsideOfThePictureIsNotNear) {
  // A floor that reaches past the eye, which looks down along it: what is seen begins where the lowest rays
  // meet it.
  SnapshotNode floor;
  floor.boundsObject = floor.boundsWorld = {Vec3(-100, 0, -100), Vec3(100, 0, 100)};
  const View view =
      viewAt({.eye = Vec3(0, 1, 0), .lookAt = Vec3(0, 0.9, -1), .fovY = radians(40)}, {}, kRowsSize);
  const double slope = 0.1, angle = std::atan(slope) + radians(20), distance = 1 / std::sin(angle);
  EXPECT_NEAR(nearestSeen(view, floor), distance * std::cos(radians(20)), 1e-9);
}

// Of random boxes and views: no sampled point of a box that is in the picture is nearer or farther, and of
// boxes none of which is, none.
TEST(PixelRows, DepthsSeenAreThoseOfEveryPointInThePicture) {
  std::mt19937 random(7);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const auto somewhere = [&](double far) {
    return far * Vec3(between(-1, 1), between(-1, 1), between(-1, 1));
  };
  int partly = 0;
  for (int round = 0; round < 400; ++round) {
    SnapshotNode node;
    const Vec3 middle = somewhere(1), half = glm::abs(somewhere(round % 3 == 0 ? 3 : 0.7));
    node.boundsObject = {middle - half, middle + half};
    node.worldFromObject = tilted();
    node.boundsWorld = transformBounds(node.worldFromObject, node.boundsObject);
    const View view = viewAt({.eye = somewhere(4),
                              .lookAt = somewhere(1),
                              .near = 1e-3,
                              .projection = round % 2 ? Projection::Orthographic : Projection::Perspective,
                              .height = between(0.3, 4)},
                             {}, kRowsSize, {Vec3(-9), Vec3(9)});
    const auto seen = depthsSeen(view, node);
    int inside = 0;
    for (int k = 0; k < 500; ++k) {
      const Vec3 p = middle + half * somewhere(1);
      const Vec3 inEye = eyeFromWorldPoint(view, transformPoint(node.worldFromObject, p));
      if (-inEye.z < view.near) continue;
      const Vec2 pixel = pixelFromEye(view, inEye);
      if (std::min(pixel.x, pixel.y) < 0 || pixel.x > kRowsSize.width || pixel.y > kRowsSize.height) continue;
      ++inside;
      ASSERT_TRUE(seen);
      EXPECT_GE(-inEye.z, seen->nearest - 1e-9) << round;
      EXPECT_LE(-inEye.z, seen->farthest + 1e-9) << round;
    }
    partly += inside > 0 && inside < 500;
  }
  EXPECT_GT(partly, 100);
}

}  // namespace
}  // namespace luxo
