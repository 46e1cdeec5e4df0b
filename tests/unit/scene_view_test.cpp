// SPDX-License-Identifier: Apache-2.0
// Cameras: matrices against values derived by hand, depth, awkward directions, and values out of range.
#include "scene/view.h"

#include <cmath>
#include <limits>

#include "scene_test_support.h"

namespace luxo {
namespace {

using test::expectNear;
using test::expectSceneError;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Half the height is tan 45 degrees = 1 at depth 1: f = 50 pixels.
Camera squareAngle() { return {.eye = Vec3(0, 0, 5), .lookAt = Vec3(0), .fovY = radians(90)}; }

TEST(View, PerspectiveMatchesValuesDerivedByHand) {
  const View view = viewAt(squareAngle(), 0, {200, 100});
  EXPECT_NEAR(view.pixelsPerUnit, 50, 1e-12);
  EXPECT_NEAR(view.halfExtent.x, 2, 1e-14);
  const Vec3 point = eyeFromWorldPoint(view, {1, 0.5, 0});
  expectNear(point, {1, 0.5, -5}, 1e-15);
  const Vec4 clip = view.clipFromEye * Vec4(point, 1);
  EXPECT_NEAR(clip.x, 0.5, 1e-15);
  EXPECT_NEAR(clip.y, 0.5, 1e-15);
  EXPECT_EQ(clip.z, 0.1);
  EXPECT_EQ(clip.w, 5);
  const Vec2 pixel = pixelFromEye(view, point);
  EXPECT_NEAR(pixel.x, 110, 1e-12);
  EXPECT_NEAR(pixel.y, 45, 1e-12);  // y counts down
}

TEST(View, AxesFollowTheRightHand) {
  Camera camera = squareAngle();
  camera.eye = Vec3(-3, 0, 0);  // looking along +X with +Y up, +Z is on the right
  const View view = viewAt(camera, 0, {100, 100});
  expectNear(view.right(), {0, 0, 1}, 1e-15);
  expectNear(view.up(), {0, 1, 0}, 1e-15);
  expectNear(view.forward(), {1, 0, 0}, 1e-15);
  expectNear(eyeFromWorldPoint(view, {0, 2, 1}), {1, 2, -3}, 1e-15);
}

TEST(View, DepthIsReversedAndInfinite) {
  const View view = viewAt(squareAngle(), 0, {100, 100});
  const auto depth = [&](double distance) {
    const Vec4 clip = view.clipFromEye * Vec4(0.3, -0.2, -distance, 1);
    return clip.z / clip.w;
  };
  EXPECT_EQ(depth(0.1), 1);
  EXPECT_DOUBLE_EQ(depth(1), 0.1);
  EXPECT_DOUBLE_EQ(depth(1e9), 1e-10);
  EXPECT_EQ(view.far, kInfinity);
}

TEST(View, OrthographicFitsItsDepthAroundTheScene) {
  Camera camera = squareAngle();
  camera.projection = Projection::Orthographic;
  camera.height = 4;
  const View view = viewAt(camera, 0, {200, 100}, {Vec3(-1, -1, -1), Vec3(1, 1, 1)});
  EXPECT_DOUBLE_EQ(view.pixelsPerUnit, 25);
  // The scene lies at depths 4 to 6; a sixteenth of the larger of its depth, 2, and the height, 4, is to
  // spare.
  EXPECT_NEAR(view.near, 3.75, 1e-12);
  EXPECT_NEAR(view.far, 6.25, 1e-12);
  const auto clip = [&](const Vec3& world) {
    return view.clipFromEye * Vec4(eyeFromWorldPoint(view, world), 1);
  };
  EXPECT_NEAR(clip({0, 0, 5 - view.near}).z, 1, 1e-12);
  EXPECT_NEAR(clip({0, 0, 5 - view.far}).z, 0, 1e-12);
  EXPECT_NEAR(clip({0, 0, 0}).z, 0.5, 1e-12);
  EXPECT_EQ(clip({1, 1, 0}).w, 1);
  EXPECT_NEAR(clip({4, 2, 0.5}).x, 1, 1e-15);
  EXPECT_NEAR(clip({4, 2, 0.5}).y, 1, 1e-15);
  EXPECT_NEAR(pixelFromEye(view, eyeFromWorldPoint(view, {1, 1, 0})).x, 125, 1e-12);
}

TEST(View, OrthographicNearPlaneStillCuts) {
  Camera camera = squareAngle();
  camera.projection = Projection::Orthographic;
  camera.near = 4.5;
  const View view = viewAt(camera, 0, {100, 100}, {Vec3(-1), Vec3(1)});
  EXPECT_EQ(view.near, 4.5);
  camera.eye = Vec3(0, 0, -50);  // everything lies behind
  camera.lookAt = Vec3(0, 0, -51);
  const View away = viewAt(camera, 0, {100, 100}, {Vec3(-1), Vec3(1)});
  EXPECT_GT(away.far, away.near);
  const View flat = viewAt(squareAngle(), 0, {100, 100}, {Vec3(-1, -1, 0), Vec3(1, 1, 0)});
  EXPECT_GT(flat.far, flat.near);
}

/// Where a point of eye space is drawn: x right, y down, as gl_FragCoord.
Vec2 drawnAt(const View& view, const Vec3& pointEye) {
  const Vec4 clip = view.clipFromEye * Vec4(pointEye, 1);
  return {(clip.x / clip.w + 1) * 0.5 * view.size.width, (1 - clip.y / clip.w) * 0.5 * view.size.height};
}

TEST(View, OffCentreSamplesMoveThePictureAsFarAtEveryDepth) {
  const Vec2 offset(0.375, -0.25);
  for (const Projection projection : {Projection::Perspective, Projection::Orthographic}) {
    Camera camera = squareAngle();
    camera.projection = projection;
    const View view = viewAt(camera, 0, {200, 100}, {Vec3(-40), Vec3(40)});
    const View moved = sampledAt(view, offset);
    for (const Vec3& point : {Vec3(0.01, 0.02, -0.2), Vec3(3, -2, -5), Vec3(-7, 1, -30)}) {
      const Vec2 drawn = drawnAt(moved, point), pixel = pixelFromEye(moved, point);
      EXPECT_NEAR(drawn.x + offset.x, pixel.x, 1e-12);
      EXPECT_NEAR(drawn.y + offset.y, pixel.y, 1e-12);
      EXPECT_EQ(pixel, pixelFromEye(view, point));
      const Vec4 before = view.clipFromEye * Vec4(point, 1), after = moved.clipFromEye * Vec4(point, 1);
      EXPECT_EQ(before.z, after.z);
      EXPECT_EQ(before.w, after.w);
    }
    EXPECT_EQ(sampledAt(moved, offset), moved) << "the offset is from the centre, not from the last one";
  }
}

TEST(View, UpWithoutDirectionHasADefinedAnswer) {
  Camera camera = squareAngle();
  camera.eye = Vec3(0, 10, 0);  // straight down: -Z is up in the picture
  const View down = viewAt(camera, 0, {100, 100});
  expectNear(down.right(), {1, 0, 0}, 1e-15);
  expectNear(down.up(), {0, 0, -1}, 1e-15);

  camera.eye = Vec3(0, -10, 0);  // straight up
  expectNear(viewAt(camera, 0, {100, 100}).up(), {0, 0, -1}, 1e-15);

  camera.eye = Vec3(0, 0, 5);
  camera.up = Vec3(0);  // no up at all: +Y
  expectNear(viewAt(camera, 0, {100, 100}).up(), {0, 1, 0}, 1e-15);

  camera.eye = Vec3(3, 3, 0);
  camera.up = Vec3(-1, -1, 0);  // parallel to the view direction: +Y again
  expectNear(viewAt(camera, 0, {100, 100}).up(), {-std::sqrt(0.5), std::sqrt(0.5), 0}, 1e-15);
}

TEST(View, RotationIsOrthonormalHoweverAwkwardTheCamera) {
  test::Random random(1);
  for (int i = 0; i < 10000; ++i) {
    Camera camera = squareAngle();
    const Vec3 eye = random.inCube(1) * std::pow(10, random.uniform(-12, 12));
    camera.eye = eye;
    camera.lookAt = random.inCube(1) * std::pow(10, random.uniform(-12, 12));
    // Every third `up` is parallel to the view direction up to a part in 10^6 to 10^18.
    camera.up = i % 3 ? random.inCube(1) * std::pow(10, random.uniform(-200, 200))
                      : camera.lookAt.at(0) - eye +
                            random.inCube(1) * glm::length(eye) * std::pow(10, random.uniform(-18, -6));
    const Mat3 r = viewAt(camera, 0, {100, 100}).eyeFromWorld;
    const Mat3 product = glm::transpose(r) * r;
    for (int c = 0; c < 3; ++c)
      for (int k = 0; k < 3; ++k) ASSERT_NEAR(product[c][k], c == k, 2e-15);
    ASSERT_GT(glm::determinant(r), 0);
  }
}

TEST(View, ObjectsFarFromTheOriginKeepTheirPlaceRelativeToTheEye) {
  Camera camera = squareAngle();
  camera.eye = Vec3(6.371e6, 0, 5);
  camera.lookAt = Vec3(6.371e6, 0, 0);
  const View view = viewAt(camera, 0, {100, 100});
  const Transform place = eyeFromObject(view, {Mat3(2), Vec3(6.371e6 + 1.5, 0, 0)});
  expectNear(transformPoint(place, {1, 0, 0}), {3.5, 0, -5}, 1e-14);
}

TEST(View, MovesWithTime) {
  Camera camera = squareAngle();
  EXPECT_FALSE(camera.movesWithTime());
  camera.eye = [](double t) { return Vec3(0, 0, 5 + t); };
  EXPECT_TRUE(camera.movesWithTime());
  expectNear(viewAt(camera, 2, {100, 100}).eye, {0, 0, 7}, 0);
}

TEST(View, EveryValueOutOfRangeIsNamed) {
  const auto reject = [](auto change, const std::vector<std::string>& texts, PixelSize size = {100, 100}) {
    Camera camera = squareAngle();
    camera.name = "top";
    change(camera);
    expectSceneError([&] { (void)viewAt(camera, 0, size); }, texts);
  };
  const auto same = [](Camera&) {};
  reject([](Camera& c) { c.lookAt = c.eye; }, {"top", "eye and look_at", "(0, 0, 5)"});
  reject([](Camera& c) { c.eye = Vec3(0, kNaN, 0); }, {"eye", "nan"});
  reject([](Camera& c) { c.lookAt = Vec3(kInfinity, 0, 0); }, {"look_at", "inf"});
  reject([](Camera& c) { c.up = Vec3(kNaN); }, {"up", "nan"});
  for (const double degrees : {0.0, -10.0, 180.0, 400.0, kNaN})
    reject([&](Camera& c) { c.fovY = radians(degrees); }, {"fov_y", "180"});
  for (const double value : {0.0, -1.0, kNaN, kInfinity}) {
    reject([&](Camera& c) { c.near = value; }, {"near", "above 0"});
    reject([&](Camera& c) { c.projection = Projection::Orthographic, c.height = value; },
           {"height", "above 0"});
  }
  reject(same, {"0x100"}, {0, 100});
  reject(same, {"100x0"}, {100, 0});
  reject(same, {"-5x100"}, {-5, 100});
}

TEST(View, ExtremeButLegalValuesStayFinite) {
  for (const double degrees : {1e-6, 1e-3, 179.0, 179.999999}) {
    Camera camera = squareAngle();
    camera.fovY = radians(degrees);
    const View view = viewAt(camera, 0, {16384, 1});
    EXPECT_TRUE(std::isfinite(view.clipFromEye[0][0]) && std::isfinite(view.clipFromEye[1][1]));
    EXPECT_GT(view.pixelsPerUnit, 0);
  }
  Camera far = squareAngle();
  far.eye = Vec3(1e308, 0, 0), far.lookAt = Vec3(-1e308, 0, 0);  // their difference is not a double
  expectNear(viewAt(far, 0, {10, 10}).forward(), {-1, 0, 0}, 1e-15);
}

}  // namespace
}  // namespace luxo
