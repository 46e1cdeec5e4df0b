// SPDX-License-Identifier: Apache-2.0
// Textures on what is seen through, and what is seen through by their alpha: against known answers, and
// against the ground truth in every pixel.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>
#include <string>
#include <utility>

#include "base/error.h"
#include "image/image.h"
#include "scene/scene_builder.h"
#include "scene/scene_reader.h"
#include "scene/scene_writer.h"
#include "support/meshes.h"
#include "support/verified_picture.h"
#include "surface/library.h"

namespace luxo::test {
namespace {

constexpr PixelSize kLayerTextureSize{120, 90};

/// Leaves: ovals of some colours, each opaque in its middle, with a soft edge.
/// Or, `whole`, no less there than anywhere.
TextureMap leaves(int side, int each, bool whole = false) {
  Image image(side, side, 4);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const double dx = (x % each + 0.5) / each - 0.5, dy = (y % each + 0.5) / each - 0.5;
      const auto pixel = image.pixel(x, y);
      pixel[0] = float(x) / float(side);
      pixel[1] = (x / each + y / each) % 2 != 0 ? 0.9f : 0.3f;
      pixel[2] = 0.2f;
      pixel[3] = whole ? 1 : float(std::clamp(1.5 - 6 * std::hypot(dx, 1.6 * dy), 0.0, 1.0));
    }
  return {.texture = std::make_shared<const Texture>(makeTexture(image, "leaves"))};
}

class LayerTexture : public VerifiedPictureTest {};

/// Things of one material around and behind each other, over a plate.
Scene thicket(const Material& material, Light::Shadow shadow = Light::Shadow::None) {
  Scene scene;
  const MaterialId leafy = scene.add(material);
  scene.add(Node{.rotation = Rotation{{1, 0, 0.4}, 0.9}, .surface = torus(1, 0.4), .material = leafy});
  scene.add(Node{.translation = Vec3(0.4, 0.2, 0.3), .surface = sphere(0.6), .material = leafy});
  scene.add(Node{.translation = Vec3(-0.8, 0.5, 0.8),
                 .rotation = Rotation{{1, 0.2, 0}, 0.7},
                 .surface = rectangle(1.5, 1.2),
                 .material = leafy});
  scene.add(Node{.translation = Vec3(0, -1.2, 0), .surface = rectangle(5, 5)});
  scene.add(Node{.translation = Vec3(2, 4, 3), .light = Light{.intensity = 0.8, .shadow = shadow}});
  scene.add(Camera{.eye = Vec3(1.5, 2.5, 4), .lookAt = Vec3(0, 0, 0)});
  return scene;
}

/// Every layer has the colour and the alpha of its own point, filtered over its own footprint.
TEST_F(LayerTexture, IsTheTruth) {
  for (const Blend blend : {Blend::Over, Blend::Add, Blend::Multiply})
    for (const bool alpha : {true, false}) {
      SCOPED_TRACE(testing::Message() << int(blend) << alpha);
      const Material material{.diffuse = Vec3(0.9),
                              .opacity = 0.8,
                              .blend = blend,
                              .map = leaves(256, 64, !alpha),
                              .mapOpacity = alpha};
      const Verified found = expectTrueColors(takeSnapshot(thicket(material), 0, kLayerTextureSize), 2000);
      EXPECT_EQ(found.verification.wrong.total(), 0U);
      EXPECT_EQ(found.statistics.error.auditFailedPx, 0U);
      EXPECT_GT(found.statistics.count.layerPoints, 4000U);
    }
}

/// Other maps, too: of normals, highlights, glow.
TEST_F(LayerTexture, AllMapsAreDrawn) {
  Image bumps(32, 32, 3);
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 32; ++x) {
      const auto pixel = bumps.pixel(x, y);
      pixel[0] = float(0.5 + 0.2 * std::sin(0.39 * x));
      pixel[1] = float(0.5 + 0.2 * std::cos(0.39 * y));
      pixel[2] = 0.9f;
    }
  Material material{.opacity = 0.6,
                    .map = leaves(128, 32),
                    .mapOpacity = true,
                    .specularMap = leaves(64, 16, true),
                    .glowMap = leaves(64, 32, true),
                    .glow = Vec3(0.2)};
  material.normalMap.texture = std::make_shared<const Texture>(makeTexture(bumps, "bumps"));
  const Verified found = expectTrueColors(takeSnapshot(thicket(material), 0, kLayerTextureSize), 2000);
  EXPECT_EQ(found.verification.wrong.total(), 0U);
}

/// Light gets through by the alpha where it passes, tinted in mode multiply.
TEST_F(LayerTexture, LightGetsThroughByTheAlpha) {
  for (const Blend blend : {Blend::Over, Blend::Multiply}) {
    SCOPED_TRACE(int(blend));
    const Material material{.diffuse = Vec3(0.9),
                            .specular = Vec3(0),
                            .blend = blend,
                            .map = leaves(128, 64),
                            .mapOpacity = true};
    const Verified found =
        expectTrueColors(takeSnapshot(thicket(material, Light::Shadow::Exact), 0, kLayerTextureSize), 2000);
    EXPECT_EQ(found.verification.wrong.total(), 0U);
    EXPECT_EQ(found.statistics.error.auditFailedPx, 0U);
  }
  // A lamp above a sheet of four texels, one of them a hole: the plate below is bright there alone.
  Image image(2, 2, 4, {1, 1, 1, 0, 1, 1, 1, 1, 1, 1, 1, 0.5f, 1, 1, 1, 1});
  TextureMap map{.texture = std::make_shared<const Texture>(makeTexture(image, "four"))};
  map.filter = TextureFilter::Nearest;
  Scene scene;
  scene.add(Node{.translation = Vec3(0, 1, 0),
                 .surface = rectangle(2, 2),
                 .material = scene.add(Material{.map = map, .mapOpacity = true})});
  scene.add(Node{.surface = rectangle(2, 2),
                 .material = scene.add(Material{.diffuse = Vec3(1), .specular = Vec3(0)})});
  scene.add(Node{.rotation = Rotation{{1, 0, 0}, -kPi / 2},
                 .light = Light{.type = Light::Type::Directional, .shadow = Light::Shadow::Exact}});
  scene.set(RenderSettings{.ambient = Vec3(0)});
  const Camera below{.eye = Vec3(0, 0.5, 0),
                     .lookAt = Vec3(0, 0, 0),
                     .up = Vec3(0, 0, -1),
                     .near = 0.01,
                     .projection = Projection::Orthographic,
                     .height = 2};
  const Image shown = draw(scene, below, {16, 16}).image;
  // The image's upper left corner is where u is lowest and v highest; u runs along x, v along -z or z.
  std::multiset<int> levels;
  for (const auto& [x, y] : {std::pair{4, 4}, {12, 4}, {4, 12}, {12, 12}})
    levels.insert(int(std::lround(100 * shown.pixel(x, y)[0])));
  EXPECT_EQ(levels, (std::multiset<int>{0, 0, 50, 100}));
}

/// Of triangles, and between vertices, and in drawings.
TEST_F(LayerTexture, MeshesShowTheSameAlpha) {
  Image image(2, 2, 4, {1, 0, 0, 1, 0, 1, 0, 0.5f, 0, 0, 1, 0, 1, 1, 1, 1});
  TextureMap map{.texture = std::make_shared<const Texture>(makeTexture(image, "four"))};
  map.filter = TextureFilter::Nearest;
  for (const bool isMesh : {false, true})
    for (const Shading shading : {Shading::Exact, Shading::Phong, Shading::Flat, Shading::Gouraud}) {
      SCOPED_TRACE(testing::Message() << isMesh << nameOf(shading));
      Scene scene;
      scene.set(plainSettings(Vec3(0, 0, 0.5)));
      const MaterialId material =
          scene.add(Material{.diffuse = Vec3(1), .specular = Vec3(0), .map = map, .mapOpacity = true});
      if (isMesh)
        scene.add(Node{.surface = quadMesh(), .material = material});
      else
        scene.add(plate(Vec3(0), {2, 2}, material));
      scene.add(Camera{.eye = Vec3(0, 0, 5), .projection = Projection::Orthographic, .height = 2});
      const Image shown = draw(scene, {8, 8}, {.shading = shading}).image;
      const int upper = isMesh ? 5 : 2, lower = 7 - upper;  // v of the mesh runs up the image
      EXPECT_TRUE(near(colorAt(shown, 2, upper), Vec3(1, 0, 0), 1e-6));
      EXPECT_TRUE(near(colorAt(shown, 5, upper), Vec3(0, 0.5, 0.25), 1e-6));
      EXPECT_TRUE(near(colorAt(shown, 2, lower), Vec3(0, 0, 0.5), 1e-6));
      EXPECT_TRUE(near(colorAt(shown, 5, lower), Vec3(1, 1, 1), 1e-6));
    }
  const Material material{.map = leaves(64, 32), .mapOpacity = true};
  const Image toon = draw(thicket(material), kLayerTextureSize, {.shading = Shading::Toon}).image;
  EXPECT_TRUE(allFinite(toon));
  EXPECT_FALSE(sameBytes(
      toon, draw(thicket({.map = leaves(64, 32)}), kLayerTextureSize, {.shading = Shading::Toon}).image));
}

/// Sheets given from the farthest to the nearest are in the order in which they lie.
TEST_F(LayerTexture, TheGivenOrderHasMapsToo) {
  const auto sheets = [&](BlendOrder order) {
    Scene scene;
    scene.set(RenderSettings{.blendOrder = order});
    const MaterialId glass = scene.add(Material{.diffuse = Vec3(0.2, 0.5, 0.9), .opacity = 0.5});
    const MaterialId leafy = scene.add(Material{.map = leaves(64, 16), .mapOpacity = true});
    scene.add(Node{.surface = rectangle(2, 2), .material = glass});
    scene.add(Node{.translation = Vec3(0.3, 0.5, 0.2), .surface = rectangle(2, 2), .material = leafy});
    scene.add(Node{.translation = Vec3(-3, 8, 3), .light = Light{.shadow = Light::Shadow::Exact}});
    scene.add(Camera{.eye = Vec3(0.3, 4, 1), .lookAt = Vec3(0, 0, 0)});
    return draw(scene, kLayerTextureSize).image;
  };
  EXPECT_TRUE(sameBytes(sheets(BlendOrder::Given), sheets(BlendOrder::Exact)));
}

TEST(LayerTextureScene, SaysSoInAMap) {
  const std::string text = R"({ "luxo": 1, "textures": { "leaf": { "checker": [[1, 0, 0], [0, 1, 0]] } },
    "materials": { "m": { "map": { "texture": "leaf", "alpha": true, "scale": [2, 2] } } },
    "surfaces": { "s": { "type": "sphere", "radius": 1 } }, "nodes": [ { "surface": "s", "material": "m" } ] })";
  const SceneFile file = parseScene(text, "scene");
  EXPECT_TRUE(takeSnapshot(buildScene(file), 0, {8, 8}).materials.back().mapOpacity);
  EXPECT_EQ(parseScene(writeScene(file), "again").materials, file.materials);
  SceneFile cut = file;
  cut.materials.back().cutoff = 0.25;
  EXPECT_EQ(takeSnapshot(buildScene(cut), 0, {8, 8}).materials.back().cutoff, 0.25);
  EXPECT_EQ(parseScene(writeScene(cut), "again").materials, cut.materials);
  const auto problem = [&](const std::string& material) -> std::string {
    try {
      static_cast<void>(takeSnapshot(
          buildScene(parseScene(
              R"({ "luxo": 1, "textures": { "leaf": { "color": [1, 0, 0] } }, "materials": { "m": )" +
                  material +
                  R"( }, "surfaces": { "s": { "type": "sphere", "radius": 1 } }, "nodes": [ { "surface": "s", "material": "m" } ], "render": { "blend_order": "given" } })",
              "scene")),
          0, {8, 8}));
    } catch (const Error& error) {
      return error.what();
    }
    return "nothing";
  };
  EXPECT_THAT(problem(R"({ "specular_map": { "texture": "leaf", "alpha": true } })"),
              testing::HasSubstr("alpha"));
  EXPECT_THAT(problem(R"({ "map": { "texture": "leaf", "alpha": true }, "shading": "lesson" })"),
              testing::HasSubstr("lesson"));
  EXPECT_EQ(problem(R"({ "map": { "texture": "leaf", "alpha": true }, "cutoff": 0.5 })"), "nothing");
  for (const char* material :
       {R"({ "map": "leaf", "cutoff": 0.5 })", R"({ "opacity": "u", "cutoff": 0.5 })",
        R"({ "map": { "texture": "leaf", "alpha": true }, "cutoff": 0.5, "blend": "add" })"})
    EXPECT_THAT(problem(material), testing::HasSubstr("\"cutoff\" makes holes")) << material;
  EXPECT_THAT(problem(R"({ "map": { "texture": "leaf", "alpha": true }, "cutoff": 1.5 })"),
              testing::HasSubstr("from 0 to 1"));
}

}  // namespace
}  // namespace luxo::test
