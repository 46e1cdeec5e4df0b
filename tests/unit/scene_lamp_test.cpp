// SPDX-License-Identifier: Apache-2.0
// Luxo Grandpa's joints, shade and light against known answers and an independent forward kinematics.
#include <array>
#include <cmath>

#include "luxo_grandpa/lamp.h"
#include "scene_test_support.h"

namespace luxo {
namespace {

using test::expectNear;
using test::nodeNamed;

struct Pose {
  Vec3 joint2, joint3, vertex, focus, axis;
};

Pose poseAt(const Scene& scene, double time) {
  const Snapshot snapshot = takeSnapshot(scene, time, {1280, 720});
  const auto origin = [&](const char* name) {
    return nodeNamed(scene, snapshot, name).worldFromObject.translation;
  };
  for (const SnapshotLight& light : snapshot.lights)
    if (light.shade) {
      expectNear(light.shade->vertex, origin("shade"), 0);
      return {origin("joint 2"), origin("joint 3"), light.shade->vertex, Vec3(light.positionWorld),
              light.shade->axis};
    }
  throw std::runtime_error("the lamp has no light in its shade");
}

void expectPose(const Pose& actual, const Pose& expected, double tolerance) {
  expectNear(actual.joint2, expected.joint2, tolerance);
  expectNear(actual.joint3, expected.joint3, tolerance);
  expectNear(actual.vertex, expected.vertex, tolerance);
  expectNear(actual.focus, expected.focus, tolerance);
  expectNear(actual.axis, expected.axis, tolerance);
}

TEST(Lamp, KnownPosesToThePrintedDigits) {
  const Scene scene = luxoGrandpa();
  const auto expectAt = [&](double time, const Pose& expected) {
    SCOPED_TRACE(time);
    expectPose(poseAt(scene, time), expected, 1e-6);
  };
  expectAt(0, {{0, 4.4, 0}, {0, 8.4, 0}, {0, 8.7, 0}, {0, 8.9, 0}, {0, 1, 0}});
  expectAt(1, {{-.278382, 4.363728, .459742},
               {.428629, 8.234465, 1.179136},
               {.591199, 8.346093, 1.405212},
               {.699578, 8.420511, 1.555930},
               {.541898, .372090, .753588}});
  expectAt(3, {{-.079529, 4.124663, 1.456215},
               {.127215, 7.980280, .411480},
               {-.056160, 7.744132, .386831},
               {-.178410, 7.586699, .370399},
               {-.611249, -.787162, -.082163}});
  expectAt(9.5, {{1.482143, 4.114845, -.056369},
                 {2.284831, 7.939221, .797937},
                 {2.262666, 7.671005, .930483},
                 {2.247889, 7.492194, 1.018848},
                 {-.073884, -.894055, .441823}});
  expectAt(21, {{1.770180, 3.962804, .415800},
                {3.102988, 6.356465, 3.330248},
                {3.209671, 6.077265, 3.356055},
                {3.280793, 5.891132, 3.373259},
                {.355610, -.930667, .086022}});
}

// The same chain in plain numbers: each joint rotates all axes above it about its own axis (Rodrigues'
// formula).
using Real = long double;
using Point = std::array<Real, 3>;

Point rotate(const Point& v, Point axis, Real angle) {
  const Real length = std::sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
  for (Real& x : axis) x /= length;
  const Real along = axis[0] * v[0] + axis[1] * v[1] + axis[2] * v[2], c = std::cos(angle),
             s = std::sin(angle);
  const Point cross = {axis[1] * v[2] - axis[2] * v[1], axis[2] * v[0] - axis[0] * v[2],
                       axis[0] * v[1] - axis[1] * v[0]};
  Point turned;
  for (int i = 0; i < 3; ++i) turned[i] = v[i] * c + cross[i] * s + axis[i] * along * (1 - c);
  return turned;
}

Point plus(const Point& p, Real factor, const Point& v) {
  return {p[0] + factor * v[0], p[1] + factor * v[1], p[2] + factor * v[2]};
}

Pose independentPose(Real t) {
  const auto first = [&](const Point& v) { return rotate(v, {1, 5, 1}, 0.5L * t); };
  const auto second = [&](const Point& v) { return first(rotate(v, {2, 6, -1}, 0.75L * t)); };
  const auto third = [&](const Point& v) { return second(rotate(v, {2, 1, 2}, t)); };
  const Point up = {0, 1, 0};
  const Point joint2 = plus({0, 0.4L, 0}, 4, first(up));
  const Point joint3 = plus(joint2, 4, second(up));
  const Point axis = third(up);
  const auto vec = [](const Point& p) {
    return Vec3(static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2]));
  };
  return {vec(joint2), vec(joint3), vec(plus(joint3, 0.3L, axis)), vec(plus(joint3, 0.5L, axis)), vec(axis)};
}

TEST(Lamp, EqualsAnIndependentForwardKinematics) {
  const Scene scene = luxoGrandpa();
  for (int i = 0; i <= 2000; ++i) {
    const double t = i * 0.037;  // three periods; rates are exact doubles, so angles round only once
    SCOPED_TRACE(t);
    expectPose(poseAt(scene, t), independentPose(t), 1e-12);
  }
}

TEST(Lamp, RepeatsAfterEightPiSeconds) {
  const Scene scene = luxoGrandpa();
  for (const double t : {0.0, 1.0, 3.0, 21.0}) {
    expectPose(poseAt(scene, t + 8 * kPi), poseAt(scene, t), 1e-13);  // t + 8 pi is rounded to 7e-15 s
    expectNear(takeSnapshot(scene, t + 8 * kPi, {10, 10}).view.eye, takeSnapshot(scene, t, {10, 10}).view.eye,
               1e-12);
  }
}

TEST(Lamp, StaysInThePictureOverItsPeriod) {
  const Scene scene = luxoGrandpa();
  for (int i = 0; i < 1000; ++i) {
    const Snapshot snapshot =
        takeSnapshot(scene, i * 8 * kPi / 1000, {720, 720});  // narrower than any wide picture
    for (const SnapshotNode& node : snapshot.nodes) {
      if (scene[node.id].name == "floor") continue;
      for (int corner = 0; corner < 8; ++corner) {
        const Box& box = node.boundsObject;
        const Vec3 object(corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                          corner & 4 ? box.max.z : box.min.z);
        const Vec3 eye = transformPoint(eyeFromObject(snapshot.view, node.worldFromObject), object);
        const Vec2 pixel = pixelFromEye(snapshot.view, eye);
        ASSERT_GT(-eye.z, snapshot.view.near);
        ASSERT_TRUE(pixel.x >= 0 && pixel.x <= 720 && pixel.y >= 0 && pixel.y <= 720)
            << scene[node.id].name << " at " << pixel.x << ' ' << pixel.y << ", time step " << i;
      }
    }
  }
}

TEST(Lamp, IsTheCanonicalOne) {
  const Scene scene = luxoGrandpa();
  const Snapshot snapshot = takeSnapshot(scene, scene.settings().time, scene.settings().size);
  EXPECT_EQ(scene.settings().time, 21);
  EXPECT_EQ(snapshot.nodes.size(), 9u);  // floor, base and its top, three joints, two rods, shade
  ASSERT_EQ(snapshot.lights.size(), 2u);
  EXPECT_EQ(snapshot.lights[0].radiance, Vec3(70));
  expectNear(Vec3(snapshot.lights[0].positionWorld), {8, 14, 6}, 0);
  expectNear(snapshot.lights[1].radiance, {110, 99, 77}, 1e-13);
  EXPECT_NEAR(snapshot.lights[1].shade->cosRim, 0.8, 1e-15);
  EXPECT_EQ(snapshot.ambient, Vec3(0.05));
  const Material enamel = scene[nodeNamed(scene, snapshot, "shade").material].at(0);
  expectNear(enamel.ambientOrDiffuse(), kPi * Vec3(0.35, 0.06, 0.05), 1e-15);
}

}  // namespace
}  // namespace luxo
