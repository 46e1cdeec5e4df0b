// SPDX-License-Identifier: Apache-2.0
// A picture that differs from the last one in its materials alone is lit again, and nothing of it is found
// again; any other one is drawn as if there had been none.
#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "draw/scene_painter.h"
#include "scene/scene_builder.h"
#include "scene/scene_reader.h"
#include "support/meshes.h"
#include "support/picture.h"
#include "surface/catalogue.h"

namespace luxo::test {
namespace {

constexpr PixelSize kRelightSize{64, 48};

std::shared_ptr<const Texture> chequered(float dark) {
  Image image(4, 4, 4);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x) {
      const float value = (x + y) % 2 ? dark : 1;
      for (int c = 0; c < 3; ++c) image.pixel(x, y)[static_cast<std::size_t>(c)] = value;
      image.pixel(x, y)[3] = x == 1 && y == 2 ? 0.0f : 1.0f;
    }
  return std::make_shared<const Texture>(makeTexture(image, "chequered"));
}

/// What is edited between two pictures.
struct Room {
  std::vector<Material> materials{{.diffuse = {0.7, 0.6, 0.5}},
                                  {.diffuse = {0.8, 0.2, 0.1}, .specular = Vec3(0.3)},
                                  {.diffusePattern = pattern([](auto u, auto v) {
                                     return point(0.5 + 0.5 * sin(20.0 * u), 0.5, 0.5 + 0.5 * sin(20.0 * v));
                                   })},
                                  {.diffuse = Vec3(1), .map = {.texture = chequered(0.2f)}}};
  Light light{.intensity = 0.8, .shadow = Light::Shadow::Exact};
  Vec3 lightAt{3, 5, 4}, ballAt{1.1, 0.2, 0.4};
  Vec3 ambient{0.2}, background{0.1, 0.15, 0.2};
  /// A sheet without end, and a bar beside the picture that has a shadow in it: rays find both, or its
  /// shadow.
  bool endless = false;
  double height = -2, barAt = 0;
  Camera camera{.eye = Vec3(2.5, 2.2, 4.5), .lookAt = Vec3(0, -0.2, 0)};
  DrawOptions options;

  [[nodiscard]] Snapshot snapshot() const {
    Scene scene;
    scene.set(RenderSettings{.background = background, .ambient = ambient});
    std::vector<MaterialId> ids;
    for (const Material& material : materials) ids.push_back(scene.add(material));
    // Made once: triangles that are made anew are others.
    static const Surface kFloor = rectangle(8, 8), kRing = torus(0.8, 0.3),
                         kBody = makeSurface("superellipsoid"), kMesh = icosphere(2), kBar = sphere(0.4),
                         kEndless = surface([](auto u, auto v,
                                               auto y) { return point(u / (1 - u * u), y, v / (1 - v * v)); },
                                            {{-1, 1}, {-1, 1}}, {}, Animated<double>(-2.0));
    scene.add(Node{.translation = Vec3(0, -1, 0), .surface = kFloor, .material = ids[0]});
    scene.add(Node{.rotation = Rotation{{1, 0.3, 0}, 0.9}, .surface = kRing, .material = ids[1]});
    scene.add(Node{.translation = ballAt, .surface = kBody, .material = ids[2]});
    scene.add(Node{.translation = Vec3(-1.5, 0, -0.5), .surface = kMesh, .material = ids[3]});
    if (endless)
      scene.add(Node{.surface = kEndless.withParameters({Animated<double>(height)}), .material = ids[1]});
    scene.add(Node{.translation = Vec3(2.3 + barAt, 3.6, 6), .surface = kBar, .material = ids[0]});
    scene.add(Node{.translation = lightAt, .light = light});
    return takeSnapshot(scene, 0, kRelightSize, camera);
  }
};

using Edit = std::function<void(Room&)>;

/// Of what lights.
std::vector<Edit> paintings() {
  return {[](Room& r) {
            r.materials[0].diffuse = {0.1, 0.9, 0.3};
          },
          [](Room& r) { r.materials[0].specular = Vec3(0.4); }, [](Room& r) { r.materials[1].shininess = 3; },
          [](Room& r) { r.materials[1].ambient = Vec3(0.9, 0, 0); },
          [](Room& r) {
            r.materials[2].diffusePattern = pattern([](auto u, auto) { return point(u, u * u, 0.5); });
          },
          [](Room& r) { r.materials[3].map.texture = chequered(0.6f); },
          [](Room& r) { r.materials[3].diffuse = Vec3(0.5, 1, 1); },
          [](Room& r) { r.ambient = Vec3(0.4, 0.3, 0.1); }, [](Room& r) { r.background = Vec3(0.5, 0, 0); },
          // Where it tints light it is of what is found; see others().
          [](Room& r) {
            if (r.materials[1].blend == Blend::Over) r.materials[1].diffuse = Vec3(0.2, 0.3, 0.9);
          }};
}

/// Of what is found, of shadows, of how.
std::vector<Edit> others() {
  return {
      [](Room& r) { r.materials[1].opacity = r.materials[1].opacity == 1 ? 0.5 : 1; },
      [](Room& r) { r.materials[1].opacity = r.materials[1].opacity * 0.9; },
      [](Room& r) {
        r.materials[1].opacity = 0.6;
        r.materials[1].blend = r.materials[1].blend == Blend::Over ? Blend::Multiply : Blend::Over;
      },
      [](Room& r) {
        r.materials[1].diffuse = Vec3(r.materials[1].diffuse.z, 0.5, 0.9 - r.materials[1].diffuse.x / 2);
      },
      [](Room& r) { r.light.shadowSamples = r.light.shadowSamples == 16 ? 40 : 16; },
      [](Room& r) { r.materials[3].mapOpacity = !r.materials[3].mapOpacity; },
      [](Room& r) {
        r.materials[3].mapOpacity = true;
        r.materials[3].cutoff = r.materials[3].cutoff == 0 ? 0.5 : 0;
      },
      [](Room& r) { r.materials[0].twoSided = TwoSided::No; },
      [](Room& r) { r.materials[1].shading = Shading::Phong; },
      [](Room& r) { r.materials[1].shading = Shading::Gouraud; },
      [](Room& r) { r.materials[1].shading.reset(); },
      [](Room& r) { r.light.intensity = r.light.intensity.at(0) + 0.1; },
      [](Room& r) { r.light.radius = r.light.radius.at(0) == 0 ? 0.3 : 0; },
      [](Room& r) {
        r.light.shadow = r.light.shadow == Light::Shadow::Exact ? Light::Shadow::Map : Light::Shadow::Exact;
      },
      [](Room& r) { r.lightAt.x -= 0.3; },
      [](Room& r) { r.ballAt.y += 0.1; },
      [](Room& r) { r.height += 0.1; },
      [](Room& r) { r.barAt -= 0.1; },
      [](Room& r) {
        r.materials[1].ambient = Vec3(0.2);
        r.materials[1].map.texture = r.materials[1].map.texture ? nullptr : chequered(0.3f);
      },
      [](Room& r) { r.camera.eye = r.camera.eye.at(0) + Vec3(0.1, 0, 0); },
      [](Room& r) { r.options.output = r.options.output == Output::Color ? Output::Normal : Output::Color; },
      [](Room& r) { r.options.samples = 5 - r.options.samples; },
      [](Room& r) { r.options.skips.hidden = !r.options.skips.hidden; },
      [](Room& r) {
        r.options.shading = r.options.shading == Shading::Exact ? Shading::Phong : Shading::Exact;
      }};
}

class Relighting : public PictureTest {
 protected:
  void TearDown() override {
    fresh_.reset();
    PictureTest::TearDown();
  }

  /// By a renderer whose last picture is another one: all that it has of this one is pipelines, which take
  /// longer than the picture.
  Picture anew(const Room& room) {
    if (!fresh_) fresh_.emplace(context());
    EXPECT_EQ(fresh_->render(takeSnapshot(Scene(), 0, kRelightSize)).statistics.count.drawn, 0U);
    return fresh_->render(room.snapshot(), room.options);
  }

  /// Once the room is drawn each painting is lit again, in so many passes, and is what a fresh renderer
  /// draws. Gives the pictures, and these.
  std::vector<std::pair<Picture, Picture>> paintingsLitAgain(Room& room, std::uint64_t passes) {
    EXPECT_GT(renderer().render(room.snapshot(), room.options).statistics.count.shadowPasses, 0U);
    std::vector<std::pair<Picture, Picture>> pictures;
    for (const Edit& edit : paintings()) {
      SCOPED_TRACE(pictures.size());
      edit(room);
      Picture picture = renderer().render(room.snapshot(), room.options);
      const auto& [again, fresh] = pictures.emplace_back(std::move(picture), anew(room));
      EXPECT_TRUE(sameBytes(again.image, fresh.image));
      EXPECT_EQ(again.statistics.count.passes, passes);
      EXPECT_EQ(again.statistics.count.shadowPasses, 0U);
      EXPECT_GT(fresh.statistics.count.shadowPasses, 0U);
      const FrameError &error = again.statistics.error, &expected = fresh.statistics.error;
      EXPECT_EQ(error.resolvedByRaysPx, expected.resolvedByRaysPx);
      EXPECT_EQ(error.shadowRaysPx, expected.shadowRaysPx);
      EXPECT_EQ(error.layersMissing + error.unconvergedPx, 0U);
    }
    return pictures;
  }

 private:
  std::optional<Renderer> fresh_;
};

TEST_F(Relighting, WhereMaterialsAloneChangeNothingIsFoundAgain) {
  Room room;
  for (const auto& [again, fresh] : paintingsLitAgain(room, 1)) {
    const FrameCounts& count = again.statistics.count;
    EXPECT_EQ(count.submits, 1U);
    EXPECT_EQ(count.triangles, count.drawCalls);  // one each, over all that was found
    EXPECT_EQ(count.tessellated, 0U);
    const FrameError &error = again.statistics.error, &expected = fresh.statistics.error;
    EXPECT_GT(error.resolvedByRaysPx + error.auditedPx, 0U);
    EXPECT_EQ(error.auditedPx, expected.auditedPx);
    EXPECT_EQ(error.residualMaxPx, expected.residualMaxPx);
  }
}

TEST_F(Relighting, WhatIsSeenThroughAndTheLightThroughItStay) {
  Room room;
  room.materials[1].opacity = 0.5;
  paintingsLitAgain(room, 3);  // light on both, and they are blended
  // What lets something else of the light through is found anew.
  const auto shadowPassesAfter = [&](const Edit& edit) {
    edit(room);
    const Picture picture = renderer().render(room.snapshot(), room.options);
    EXPECT_TRUE(sameBytes(picture.image, anew(room).image));
    return picture.statistics.count.shadowPasses;
  };
  EXPECT_GT(shadowPassesAfter([](Room& r) { r.materials[1].opacity = 0.7; }), 0U);
  EXPECT_GT(shadowPassesAfter([](Room& r) { r.materials[1].blend = Blend::Multiply; }), 0U);
  EXPECT_GT(shadowPassesAfter([](Room& r) { r.materials[1].diffuse.x = 0.9; }), 0U);
  EXPECT_EQ(shadowPassesAfter(paintings()[0]), 0U);
}

/// What gets through glass is of one point of the light, and of each there is a group.
TEST_F(Relighting, WhatIsSeenThroughStaysInTheLightOfEachGroup) {
  Room room;
  room.materials[1].opacity = 0.5;
  room.light.radius = 0.3;
  room.light.shadowSamples = 3;
  paintingsLitAgain(room, 7);  // light on both from each, and they are blended
}

/// The first picture lacks room for most of its points, and is drawn again: with nothing kept.
TEST_F(Relighting, WhatLackedRoomIsFoundAnewFirst) {
  Scene scene;
  scene.set(RenderSettings{.ambient = Vec3(0.2)});
  const MaterialId glass = scene.add(Material{.opacity = 0.3, .twoSided = TwoSided::Yes});
  for (int i = 0; i < 9; ++i)
    scene.add(Node{.translation = Vec3(0, 0.1 * i, 0), .surface = rectangle(8, 8), .material = glass});
  scene.add(Node{.translation = Vec3(1, 4, 1), .light = Light{}});
  const Camera camera{.eye = Vec3(0, 5, 0.5), .lookAt = Vec3(0, 0, 0)};
  const auto picture = [&](Renderer& by) { return by.render(takeSnapshot(scene, 0, kRelightSize, camera)); };
  EXPECT_GT(picture(renderer()).statistics.count.layerPoints, 4U * 64 * 48) << "they fit into the first room";
  for (const double red : {0.2, 0.9}) {
    scene.set(glass, Material{.diffuse = {red, 0.5, 0.5}, .opacity = 0.3, .twoSided = TwoSided::Yes});
    const Picture again = picture(renderer());
    Renderer fresh(context());
    EXPECT_TRUE(sameBytes(again.image, picture(fresh).image));
    EXPECT_EQ(again.statistics.count.passes, 3U);
    EXPECT_EQ(again.statistics.error.layersMissing, 0U);
  }
}

TEST_F(Relighting, TheShadowsOfEachGroupOfLightsStay) {
  Room room;
  room.light.radius = 0.3;
  room.light.shadowSamples = 40;
  paintingsLitAgain(room, 2);
}

TEST_F(Relighting, InTheShadowsOfADepthMapToo) {
  Room room;
  room.light.shadow = Light::Shadow::Map;
  room.light.map.bias = 0.02;
  paintingsLitAgain(room, 1);
}

// Where it ends its map says; it is not in the picture, whose materials tell nothing of it.
TEST_F(Relighting, NothingIsLitAgainInThePlanarShadowOfWhatIsCutOut) {
  Scene scene;
  scene.set(RenderSettings{.ambient = Vec3(0.2)});
  scene.add(Node{.name = "floor", .surface = rectangle(8, 8), .material = scene.add(Material{})});
  Material cutOut{.twoSided = TwoSided::Yes, .map = {.texture = chequered(0.5f)}};
  cutOut.mapOpacity = true;
  cutOut.cutoff = 0.5;
  const MaterialId leaf = scene.add(cutOut);
  scene.add(Node{.translation = Vec3(0, 4, 0), .surface = rectangle(2, 2), .material = leaf});
  scene.add(
      Node{.translation = Vec3(0, 8, 0),
           .light = Light{.intensity = 0.9, .shadow = Light::Shadow::Planar, .shadowPlane = NodeId{0}}});
  const Camera camera{.eye = Vec3(0, 2, 4), .lookAt = Vec3(0, 0, 0)};
  for (const double offset : {0.0, 0.3}) {
    cutOut.map.offset = {offset, 0};
    scene.set(leaf, cutOut);
    const Snapshot snapshot = takeSnapshot(scene, 0, kRelightSize, camera);
    Renderer fresh(context());
    EXPECT_TRUE(sameBytes(renderer().render(snapshot).image, fresh.render(snapshot).image)) << offset;
  }
}

TEST_F(Relighting, WhateverIsEditedThePictureIsThatOfAFreshRenderer) {
  std::mt19937 random(5);
  const std::vector<Edit> paints = paintings(), finds = others();
  for (int chain = 0; chain < 10; ++chain) {
    Room room;
    if (chain % 3 == 1) room.light.shadow = Light::Shadow::None;
    if (chain == 5) room.light.shadow = Light::Shadow::Map;
    if (chain == 4 || chain >= 6) room.materials[1].opacity = 0.5;
    if (chain == 7) room.materials[1].blend = Blend::Multiply;
    if (chain == 8) room.options.shading = Shading::Gouraud;
    if (chain == 9) room.materials[3].mapOpacity = true;
    if (chain % 2 == 1) room.options.composition = Composition::Deferred;
    for (int step = 0; step < 10; ++step) {
      const bool paint = random() % 2 == 0;
      const std::size_t which = random() % (paint ? paints : finds).size();
      (paint ? paints : finds)[which](room);
      SCOPED_TRACE(std::to_string(chain) + ", " + std::to_string(step) + (paint ? ": paint " : ": other ") +
                   std::to_string(which));
      const Picture picture = renderer().render(room.snapshot(), room.options);
      ASSERT_TRUE(sameBytes(picture.image, anew(room).image));
    }
  }
}

/// As a file has it, whose surfaces are made anew whenever it is read.
Scene sceneWith(const std::string& color) {
  const std::string before = R"json({"luxo": 1, "params": {"k": 1.5},
    "surfaces": {
      "wave": {"type": "formula", "u": [-2, 2], "v": [-2, 2], "position": ["u", "0.3 * sin(k * u) * cos(2 * v)", "v"]},
      "cup": {"type": "revolve", "v": [0, 1], "radius": "0.5 + 0.2 * v", "height": "v"},
      "pipe": {"type": "tube", "u": [0, 1], "curve": ["u", "u * u", "0"], "radius": 0.1},
      "pot": {"type": "teapot"}, "ring": {"type": "torus", "major": 0.7, "minor": 0.2}},
    "nodes": [{"surface": "wave", "material": "table", "translate": [0, -1, 0]},
      {"surface": "cup", "material": "clay", "translate": [1.4, -0.5, 0]},
      {"surface": "pipe", "material": "clay", "translate": [-1.8, 0, 0]},
      {"surface": "pot", "material": "clay", "translate": [0, -0.4, 0], "scale": [0.4, 0.4, 0.4]},
      {"surface": "ring", "material": "clay", "translate": [0, 0.9, 0]},
      {"light": {"type": "point", "shadow": "exact"}, "translate": [3, 5, 4]}],
    "camera": {"eye": [2.5, 2.2, 4.5], "look_at": [0, -0.2, 0]},
    "materials": {"table": {"diffuse": [0.6, 0.6, 0.6]}, "clay": {"diffuse": )json";
  return buildScene(parseScene(before + color + "}}}", "room"));
}

TEST_F(Relighting, AFileThatIsReadAgainWithAnotherColorIsLitAgain) {
  Scene shown = sceneWith("[0.8, 0.3, 0.1]");
  const auto render = [](Renderer& by, const Scene& scene) {
    return by.render(takeSnapshot(scene, 0, kRelightSize));
  };
  EXPECT_GT(render(renderer(), shown).statistics.count.shadowPasses, 0U);
  Scene next = sceneWith("[0.1, 0.3, 0.8]");
  shown = std::move(next);
  const Picture again = render(renderer(), shown);
  EXPECT_EQ(again.statistics.count.passes, 1U);
  EXPECT_EQ(again.statistics.count.shadowPasses, 0U);
  EXPECT_EQ(again.statistics.count.tessellated, 0U);
  Renderer fresh(context());
  EXPECT_TRUE(sameBytes(again.image, render(fresh, shown).image));
}

// No buffer that shaders read tells of them.
TEST_F(Relighting, WhatRaysAloneFindIsComparedToo) {
  Room room;
  room.endless = true;
  room.materials[1].opacity = 1;
  const auto passesAfter = [&](const Edit& edit) {
    edit(room);
    const Picture picture = renderer().render(room.snapshot(), room.options);
    EXPECT_TRUE(sameBytes(picture.image, anew(room).image));
    return picture.statistics.count.passes;
  };
  EXPECT_GT(passesAfter([](Room&) {}), 1U);
  EXPECT_EQ(passesAfter(paintings()[0]), 1U);
  EXPECT_GT(passesAfter([](Room& r) { r.height += 0.2; }), 1U);
  EXPECT_EQ(passesAfter(paintings()[1]), 1U);
  EXPECT_GT(passesAfter([](Room& r) { r.barAt -= 0.2; }), 1U);
}

// Its targets hold nothing.
TEST_F(Relighting, NothingIsLitAgainThatWasInARecordingThrownAway) {
  gpu::FrameRing frames(context());
  ScenePainter painter(context());
  RenderView view(context(), Precision::Full);
  gpu::Readback readback(context(), {kRelightSize.width, kRelightSize.height}, VK_FORMAT_R32G32B32A32_SFLOAT);
  Room room;
  room.options.audit = {.extent = AuditExtent::None};
  const auto record = [&](bool submitted) {
    const VkCommandBuffer commands = frames.begin();
    FrameStatistics statistics;
    painter.record(frames, commands, view, room.snapshot(), room.options, statistics);
    readback.record(commands, view.picture());
    if (submitted) frames.wait(frames.submit());
    return statistics.count.passes;
  };
  const std::uint64_t all = record(true);
  EXPECT_GT(all, 2U);
  paintings()[0](room);
  EXPECT_EQ(record(true), 1U);
  room.ballAt.x += 0.2;
  EXPECT_EQ(record(false), all);
  EXPECT_EQ(record(true), all);
  paintings()[1](room);
  EXPECT_EQ(record(true), 1U);
  EXPECT_EQ(frames.thrownAway(), 1U);
}

}  // namespace
}  // namespace luxo::test
