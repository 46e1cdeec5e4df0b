// SPDX-License-Identifier: Apache-2.0
// "Outside" must be a proof: no sampled point of a shape that is called outside may be inside.
#include "math/frustum.h"

#include <limits>

#include "scene/view.h"
#include "scene_test_support.h"

namespace luxo {
namespace {

bool inside(const Frustum& frustum, const Vec3& p) {
  for (const Plane& plane : frustum.planes)
    if (glm::dot(plane.normal, p) + plane.offset < 0) return false;
  return true;
}

View someView(test::Random& random, int i) {
  return viewAt({.eye = random.inCube(10),
                 .lookAt = random.inCube(10),
                 .fovY = radians(random.uniform(1, 170)),
                 .projection = i % 2 ? Projection::Perspective : Projection::Orthographic},
                0, {300, 200}, {Vec3(-30), Vec3(30)});
}

TEST(Frustum, PlanesAreThePicturesEdges) {
  test::Random random(11);
  for (int i = 0; i < 2000; ++i) {
    const View view = someView(random, i);
    const Frustum frustum = frustumOf(view);
    for (int k = 0; k < 20; ++k) {
      const Vec3 world = random.inCube(20), eye = eyeFromWorldPoint(view, world);
      const Vec2 pixel = pixelFromEye(view, eye);
      const double edge =
          std::min({std::abs(pixel.x), std::abs(pixel.x - 300), std::abs(pixel.y), std::abs(pixel.y - 200)});
      if (edge < 1e-6 || std::abs(-eye.z - view.near) < 1e-9) continue;
      const bool shown = -eye.z > view.near && pixel.x > 0 && pixel.x < 300 && pixel.y > 0 && pixel.y < 200;
      ASSERT_EQ(inside(frustum, world), shown);
    }
  }
}

TEST(Frustum, OutsideIsAProof) {
  test::Random random(12);
  int boxesOutside = 0, spheresOutside = 0;
  for (int i = 0; i < 3000; ++i) {
    const View view = someView(random, i);
    const Frustum frustum = frustumOf(view);
    Box box;
    box.add(random.inCube(2));
    box.add(random.inCube(2));
    const Rotation turn = random.rotation();
    const Transform place = compose(random.inCube(15), rotation(turn.axis, turn.angle), random.scale());
    const Sphere sphere{random.inCube(15), random.uniform(0, 4)};
    const bool boxOut = outside(frustum, place, box), sphereOut = outside(frustum, sphere);
    boxesOutside += boxOut;
    spheresOutside += sphereOut;
    for (int k = 0; k < 64; ++k) {
      const Vec3 part(random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1));
      const Vec3 inBox = transformPoint(place, box.min + part * box.extent());
      const Vec3 onSphere = sphere.center + sphere.radius * random.direction();
      ASSERT_FALSE(boxOut && inside(frustum, inBox));
      ASSERT_FALSE(sphereOut && inside(frustum, onSphere));
    }
  }
  EXPECT_GT(boxesOutside, 500);  // and it does decide
  EXPECT_GT(spheresOutside, 500);
}

TEST(Frustum, TouchingIsNotOutside) {
  const View view = viewAt({.eye = Vec3(0, 0, 5), .fovY = radians(90)}, 0, {100, 100});
  const Frustum frustum = frustumOf(view);
  // At depth 5 the picture ends at x = 5, at the far side of a sphere or box that touches it from outside.
  const Transform here{};
  EXPECT_FALSE(outside(frustum, here, {Vec3(5, -1, 0), Vec3(6, 1, 0)}));
  EXPECT_TRUE(outside(frustum, here, {Vec3(5 + 1e-9, -1, 0), Vec3(6, 1, 0)}));
  EXPECT_FALSE(outside(frustum, here, {Vec3(5 + 1e-9, -1, 0), Vec3(6, 1, 0)}, 1e-8));  // within the slack
  EXPECT_FALSE(outside(frustum, Sphere{{0, 0, 5.9}, 1}));  // reaches the near plane
  EXPECT_TRUE(outside(frustum, Sphere{{0, 0, 5.9001}, 1 - 1e-9}));
}

TEST(Frustum, WhatIsNotFiniteIsNeverOutside) {
  const Frustum frustum = frustumOf(viewAt({.eye = Vec3(0, 0, 5)}, 0, {100, 100}));
  EXPECT_FALSE(outside(frustum, Transform{}, {Vec3(-kInfinity), Vec3(kInfinity)}));
  EXPECT_FALSE(outside(frustum, Sphere{Vec3(0), kInfinity}));
  EXPECT_FALSE(outside(frustum, Sphere{Vec3(std::numeric_limits<double>::quiet_NaN()), 1}));
}

}  // namespace
}  // namespace luxo
