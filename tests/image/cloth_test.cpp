// SPDX-License-Identifier: Apache-2.0
// Pictures of cloth: of the triangles that the reference casts its rays at, whatever was asked for before.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>

#include "draw/device_cloth_simulation.h"
#include "scene/scene_builder.h"
#include "scene/scene_reader.h"
#include "scenes/gallery.h"
#include "support/verified_picture.h"

namespace luxo::test {
namespace {

class ClothPictures : public VerifiedPictureTest {
 protected:
  [[nodiscard]] Scene galleryCloth() {
    const auto scenes = galleryScenes();
    Scene scene =
        buildScene(galleryDescription(*std::ranges::find(scenes, "gallery/cloth", &EmbeddedScene::name)));
    scene.set(simulation_ = std::make_shared<DeviceClothSimulation>(context()));
    return scene;
  }
  void TearDown() override {
    simulation_.reset();
    VerifiedPictureTest::TearDown();
  }

 private:
  std::shared_ptr<DeviceClothSimulation> simulation_;
};

// Point, light and shadow of every pixel, as it falls, as it lies, and as it hangs.
TEST_F(ClothPictures, AreThoseOfTheReference) {
  const Scene scene = galleryCloth();
  for (const double time : {0.0, 0.3, 0.7}) {
    SCOPED_TRACE(time);
    const Verified v = verified(takeSnapshot(scene, time, {160, 90}));
    EXPECT_EQ(v.verification.wrong.total(), 0U);
    EXPECT_GT(v.verification.coverage.both, 7000U);
  }
}

TEST_F(ClothPictures, AreAFunctionOfTime) {
  const Scene scene = galleryCloth();
  const auto at = [&](double time) { return draw(scene, {96, 54}, {.shading = Shading::Phong}, time).image; };
  const Image first = at(0.4);
  for (const double time : {0.1, 0.6, 0.2}) static_cast<void>(at(time));
  EXPECT_TRUE(sameBytes(at(0.4), first));
  EXPECT_FALSE(sameBytes(at(0.41), first));
}

// A scene in C++ needs to know of no device.
TEST_F(ClothPictures, ARendererMovesTheClothOfItsScenes) {
  Scene scene;
  scene.add(Node{.surface = Surface(Cloth{.columns = 8, .rows = 8, .pins = {{0, 1}, {1, 1}}})});
  scene.add(Camera{.eye = Vec3(0, 0, 3)});
  RenderSettings settings = plainSettings();
  settings.size = {48, 48};
  settings.time = 0.2;
  scene.set(settings);
  const Image moved = renderer().render(scene).image;
  settings.time = 0;
  scene.set(settings);
  EXPECT_FALSE(sameBytes(renderer().render(scene).image, moved));
}

}  // namespace
}  // namespace luxo::test
