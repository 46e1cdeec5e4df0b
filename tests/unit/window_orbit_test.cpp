// SPDX-License-Identifier: Apache-2.0
// The orbit camera against the projection of the scene stage, which knows nothing of it.
#include "window/orbit_camera.h"

#include "scene/view.h"

#include <gtest/gtest.h>

#include <random>

namespace luxo::window {
namespace {

constexpr double kFov = radians(50);
constexpr PixelSize kOrbitSize{1280, 720};
const Vec2 kSizePx(1280, 720);
// Poses hold about five operations on numbers of size 20, projections then scale by 1e3 pixels.
constexpr double kPoseError = 1e-13, kPixelError = 1e-9;

double heightPerDistance() { return 2 * std::tan(kFov / 2); }

OrbitCamera orbit(const Pose& pose) { return OrbitCamera(pose, heightPerDistance()); }

View viewOf(const OrbitCamera& camera) {
  const Pose pose = camera.pose();
  return viewAt(Camera{.eye = pose.eye, .lookAt = pose.lookAt, .up = pose.up, .fovY = kFov}, 0, kOrbitSize);
}

View viewOf(const Pose& pose) {
  return viewAt(Camera{.eye = pose.eye, .lookAt = pose.lookAt, .up = pose.up, .fovY = kFov}, 0, kOrbitSize);
}

Vec2 project(const View& view, const Vec3& world) {
  return pixelFromEye(view, eyeFromWorldPoint(view, world));
}

// What the window shows at a pixel, at the depth of the pivot.
Vec3 atPivotDepth(const OrbitCamera& camera, const Vec2& pixel) {
  const View view = viewOf(camera);
  const Vec2 offset = (pixel - 0.5 * kSizePx) / view.pixelsPerUnit * camera.distance();
  return view.eye + view.forward() * camera.distance() + view.right() * offset.x - view.up() * offset.y;
}

double difference(const Vec3& a, const Vec3& b) { return glm::length(a - b); }
double difference(const Vec2& a, const Vec2& b) { return glm::length(a - b); }

const Pose kLamp{.eye = {18 * std::sin(5.25), 9, 18 * std::cos(5.25)}, .lookAt = {0, 5, 0}, .up = {0, 1, 0}};

TEST(WindowOrbit, TakesOverWithoutMovingThePicture) {
  const Pose poses[] = {
      kLamp,
      {.eye = {1, 2, 3}, .lookAt = {-4, 5, 6}, .up = {0.3, 0.9, -0.2}},  // a tilted camera stays tilted
      {.eye = {0, 9, 0}, .lookAt = {0, 1, 0}, .up = {0, 1, 0}},          // straight down
      {.eye = {0, 9, 0}, .lookAt = {0, 1, 0}, .up = {1, 0, 0}},
      {.eye = {0.05, 9, 0}, .lookAt = {0, 1, 0}, .up = {0, 1, 0}},  // nearer to the pole than a drag may get
      {.eye = {0, 0, 5}, .lookAt = {0, 0, 0}, .up = {0, 0, 0}},
      {.eye = {0, 0, 5}, .lookAt = {0, 0, 0}, .up = {0, 0, 1}},
  };
  for (const Pose& pose : poses) {
    const OrbitCamera camera = orbit(pose);
    EXPECT_LT(difference(camera.pose().eye, pose.eye), kPoseError);
    EXPECT_EQ(camera.pose().lookAt, pose.lookAt);
    const View expected = viewOf(pose), actual = viewOf(camera);
    for (int column = 0; column < 3; ++column) {
      EXPECT_LT(difference(expected.eyeFromWorld[column], actual.eyeFromWorld[column]), 1e-12)
          << "eye " << pose.eye.x << ' ' << pose.eye.y << ' ' << pose.eye.z;
    }
  }
}

TEST(WindowOrbit, ADragOfTheWindowsHeightIsHalfATurn) {
  OrbitCamera camera = orbit({.eye = {0, 0, 5}});
  camera.turn({360, 0}, kSizePx);  // to the right by half the height: the eye goes left by a quarter turn
  EXPECT_LT(difference(camera.pose().eye, {-5, 0, 0}), kPoseError);
  camera.turn({-360, 0}, kSizePx);
  EXPECT_LT(difference(camera.pose().eye, {0, 0, 5}), kPoseError);
  camera.turn({0, 240}, kSizePx);  // down by a third of it: the eye goes up by 60 degrees
  EXPECT_LT(difference(camera.pose().eye, {0, 5 * std::sqrt(0.75), 2.5}), kPoseError);
  EXPECT_LT(difference(camera.pose().up, {0, 0.5, -std::sqrt(0.75)}), kPoseError);
}

TEST(WindowOrbit, NeverGoesOverThePole) {
  OrbitCamera camera = orbit(kLamp);
  camera.turn({0, 1e6}, kSizePx);
  const Vec3 above = unit(camera.pose().eye - camera.pose().lookAt);
  EXPECT_NEAR(std::asin(above.y), radians(89), 1e-9);
  camera.turn({0, -1e7}, kSizePx);
  const Vec3 below = unit(camera.pose().eye - camera.pose().lookAt);
  EXPECT_NEAR(std::asin(below.y), -radians(89), 1e-9);
  EXPECT_GT(viewOf(camera).up().y, 0);
}

TEST(WindowOrbit, ZoomKeepsWhatIsUnderTheCursor) {
  for (const Vec2 cursor : {Vec2(640, 360), Vec2(100, 650), Vec2(1279, 0), Vec2(-50, 900)}) {
    for (const double notches : {1.0, -1.0, 0.25, 7.0, -12.0}) {
      OrbitCamera camera = orbit(kLamp);
      const double distance = camera.distance();
      const Vec3 point = atPivotDepth(camera, cursor);
      camera.zoom(notches, cursor, kSizePx);
      EXPECT_NEAR(camera.distance() / distance, std::pow(1.1, -notches), 1e-14);
      EXPECT_LT(difference(project(viewOf(camera), point), cursor), kPixelError);
    }
  }
}

TEST(WindowOrbit, ZoomOutUndoesZoomIn) {
  OrbitCamera camera = orbit(kLamp);
  for (int i = 0; i < 20; ++i) camera.zoom(1, {200, 500}, kSizePx);
  for (int i = 0; i < 20; ++i) camera.zoom(-1, {200, 500}, kSizePx);
  // Each step rounds the pivot, of size 10 at most, three times.
  EXPECT_LT(difference(camera.pose().eye, kLamp.eye), 40 * 3 * 20 * 1.2e-16);
}

TEST(WindowOrbit, PanCarriesWhatIsUnderTheCursor) {
  OrbitCamera camera = orbit(kLamp);
  camera.turn({90, -40}, kSizePx);
  const Vec2 from(300, 200), drag(123, -77);
  const Vec3 point = atPivotDepth(camera, from);
  const double distance = camera.distance();
  camera.pan(drag, kSizePx);
  EXPECT_LT(difference(project(viewOf(camera), point), from + drag), kPixelError);
  EXPECT_EQ(camera.distance(), distance);
  EXPECT_GT(difference(camera.pose().lookAt, kLamp.lookAt), 0.1);  // the pivot itself moves
}

TEST(WindowOrbit, ParallelCameraZoomsByItsHeight) {
  const double height = 10, distance = glm::length(kLamp.eye - kLamp.lookAt);
  OrbitCamera camera(kLamp, height / distance);
  EXPECT_NEAR(camera.height(), 10, 1e-14);
  camera.zoom(2, {640, 360}, kSizePx);
  EXPECT_NEAR(camera.height(), 10 / 1.21, 1e-14);
}

TEST(WindowOrbit, IgnoresWhatMakesNoSense) {
  const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
  OrbitCamera camera = orbit(kLamp);
  const Pose before = camera.pose();
  camera.turn({nan, 1}, kSizePx);
  camera.pan({infinity, 1}, kSizePx);
  camera.zoom(nan, {1, 1}, kSizePx);
  camera.zoom(infinity, {1, 1}, kSizePx);
  camera.zoom(1, {1, nan}, kSizePx);
  camera.turn({5, 5}, {0, 0});
  camera.pan({5, 5}, {1280, 0});
  EXPECT_EQ(camera.pose(), before);
}

// Seeded: any sequence of gestures leaves a camera that the scene stage accepts.
TEST(WindowOrbit, StaysUsableWhateverIsDone) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> pixels(-3000, 3000), notches(-150, 150);
  std::uniform_int_distribution<int> gesture(0, 2);
  OrbitCamera camera = orbit(kLamp);
  const double first = camera.distance();
  for (int i = 0; i < 100'000; ++i) {
    const Vec2 at(pixels(random), pixels(random));
    switch (gesture(random)) {
      case 0:
        camera.turn(at, kSizePx);
        break;
      case 1:
        camera.pan(at, kSizePx);
        break;
      default:
        camera.zoom(notches(random), at, kSizePx);
    }
    ASSERT_GE(camera.distance(), first * 0.99e-4);
    ASSERT_LE(camera.distance(), first * 1.01e4);
    const View view = viewOf(camera);  // throws for anything that is not finite, and for eye == look_at
    // At worst the pivot is 2e7 m away, where doubles are 4e-9 apart, and the eye 2e-3 m from it, at 89
    // degrees: 4e-9 / 2e-3 / cos(89 degrees) = 1e-4 for a direction.
    ASSERT_GT(view.up().y, std::sin(radians(1)) - 1e-4);
    ASSERT_NEAR(view.right().y, 0, 1e-4);  // the horizon stays level
  }
}

}  // namespace
}  // namespace luxo::window
