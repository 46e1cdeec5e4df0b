// SPDX-License-Identifier: Apache-2.0
// What positions in shaders are relative to.
#include "draw/instance_data.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scene/scene.h"
#include "surface/library.h"

namespace luxo {
namespace {

Vec3 originOf(const Scene& scene, const Camera& camera) {
  return shadingOrigin(takeSnapshot(scene, 0, {320, 240}, camera));
}

TEST(ShadingOrigin, IsTheEyeUnlessThatIsFarFromWhatIsSeen) {
  Scene scene;
  scene.add(Node{.surface = sphere(1)});
  Camera camera{.eye = Vec3(0, 0, 10), .lookAt = Vec3(0)};
  EXPECT_EQ(originOf(scene, camera), Vec3(0, 0, 10));
  camera.eye = Vec3(0, 0, 1000);
  EXPECT_EQ(originOf(scene, camera), Vec3(0));

  // A floor begins below the eye: the ball is a small part of all there is.
  scene.add(Node{.translation = Vec3(0, -1.5, 0), .surface = rectangle(3000, 3000)});
  EXPECT_EQ(originOf(scene, camera), Vec3(0, 0, 1000));
  // A telescope shows the ball, and beside it nothing of the floor.
  camera.fovY = 1e-3;
  EXPECT_NEAR(glm::length(originOf(scene, camera)), 0, 1e-9);
  camera.projection = Projection::Orthographic;
  camera.height = 1.0;
  EXPECT_NEAR(glm::length(originOf(scene, camera)), 0, 1e-9);
  // From above it shows the floor behind the ball, too.
  camera = {.eye = Vec3(0, 1000, 0), .lookAt = Vec3(0), .up = Vec3(0, 0, 1), .fovY = 1e-3};
  EXPECT_NEAR(glm::length(originOf(scene, camera) - Vec3(0, -0.25, 0)), 0, 1e-9);
  // And along it much of it.
  camera = {.eye = Vec3(0, 10, 1000), .lookAt = Vec3(0, -1.5, 0), .fovY = 0.01};
  EXPECT_EQ(originOf(scene, camera), Vec3(0, 10, 1000));
}

}  // namespace
}  // namespace luxo
