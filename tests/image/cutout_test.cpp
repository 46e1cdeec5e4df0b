// SPDX-License-Identifier: Apache-2.0
// Models that are seen through, and surfaces that are cut out by their opacity, and the light that gets
// through them: against known answers, and against the ground truth in every pixel.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <random>
#include <utility>
#include <vector>

#include "draw/accumulation.h"
#include "image/image.h"
#include "support/meshes.h"
#include "support/random_scene.h"
#include "support/verified_picture.h"
#include "surface/library.h"

namespace luxo::test {
namespace {

class CutoutTest : public VerifiedPictureTest {};

TextureMap mapOf(const Image& image, TextureFilter filter = TextureFilter::Trilinear) {
  TextureMap map{.texture = std::make_shared<const Texture>(makeTexture(image, "cutout"))};
  map.filter = filter;
  return map;
}

/// A code of 8 bits, which half floats round down.
constexpr double kCode = 128.0 / 255;

/// Four texels: of those at the upper left and the lower right one is as opaque as the code, one more.
Image fourTexels() { return {2, 2, 4, {1, 1, 1, float(kCode), 1, 1, 1, 0.3f, 1, 1, 1, 0.4f, 1, 1, 1, 0.9f}}; }

Material cutOut(const TextureMap& map, double cutoff = kCode) {
  return {.diffuse = Vec3(1), .specular = Vec3(0), .map = map, .mapOpacity = true, .cutoff = cutoff};
}

/// A sheet of that material a metre above a plate that reflects all, and a sun overhead.
Scene sheetOverPlate(const Material& material, bool isMesh, Light::Shadow shadow = Light::Shadow::Exact) {
  Scene scene;
  scene.set(RenderSettings{.ambient = Vec3(0)});
  const MaterialId cut = scene.add(material);
  if (isMesh)
    scene.add(Node{.translation = Vec3(0, 0, 1), .surface = quadMesh(), .material = cut});
  else
    scene.add(plate(Vec3(0, 0, 1), {2, 2}, cut));
  const NodeId plane =
      scene.add(plate(Vec3(0), {4, 4}, scene.add(Material{.diffuse = Vec3(1), .specular = Vec3(0)})));
  Light light{.type = Light::Type::Directional, .shadow = shadow};
  if (shadow == Light::Shadow::Planar) light.shadowPlane = plane;
  scene.add(Node{.light = light});
  return scene;
}

Camera lookingDown(double from, double height) {
  return {.eye = Vec3(0, 0, from),
          .lookAt = Vec3(0),
          .near = 1e-3,
          .projection = Projection::Orthographic,
          .height = height};
}

/// Which parts of a sheet from -1 to 1 are opaque: a mesh has v down, a formula's image stands upright.
bool isOpaque(double x, double y, bool isMesh) { return (x < 0) == (isMesh ? y < 0 : y > 0); }

TEST_F(CutoutTest, ASheetOfFourTexelsCastsItsTwoSquares) {
  for (const bool isMesh : {true, false})
    for (const int samples : {1, 4}) {
      SCOPED_TRACE(testing::Message() << isMesh << " " << samples);
      const Picture picture =
          draw(sheetOverPlate(cutOut(mapOf(fourTexels(), TextureFilter::Nearest)), isMesh),
               lookingDown(0.5, 3), {24, 24}, {.samples = samples});
      for (int y = 0; y < 24; ++y)
        for (int x = 0; x < 24; ++x) {
          const Vec2 at((x + 0.5) / 8 - 1.5, 1.5 - (y + 0.5) / 8);
          const bool isBelow = std::max(std::abs(at.x), std::abs(at.y)) < 1;
          const bool dark = isBelow && isOpaque(at.x, at.y, isMesh);
          EXPECT_TRUE(near(colorAt(picture.image, x, y), Vec3(dark ? 0 : 1), 1e-6)) << x << ", " << y;
        }
      EXPECT_EQ(picture.statistics.error.unconvergedPx, 0U);
    }
}

/// Nor are its holes geometry, in whatever shading.
TEST_F(CutoutTest, WhatIsBehindItsHolesIsTheGeometryThere) {
  for (const bool isMesh : {true, false})
    for (const Shading shading : {Shading::Exact, Shading::Phong, Shading::Gouraud})
      for (const TextureFilter filter : {TextureFilter::Nearest, TextureFilter::Trilinear}) {
        SCOPED_TRACE(testing::Message() << isMesh << nameOf(shading) << static_cast<int>(filter));
        const Scene scene = sheetOverPlate(cutOut(mapOf(fourTexels(), filter)), isMesh);
        const Snapshot snapshot = takeSnapshot(scene, 0, {24, 24}, lookingDown(5, 3));
        const ReferencePicture truth = castPicture(snapshot);
        const auto shown = [&](Output output) {
          return renderer().render(snapshot, {.shading = shading, .output = output}).image;
        };
        const Image ids = shown(Output::Id), depths = shown(Output::Depth);
        int holes = 0;
        for (int y = 0; y < 24; ++y)
          for (int x = 0; x < 24; ++x) {
            const auto i = static_cast<std::size_t>(24 * y + x);
            ASSERT_EQ(ids.pixel(x, y)[0], static_cast<float>(truth.number[i])) << x << ", " << y;
            ASSERT_NEAR(depths.pixel(x, y)[0], truth.depth[i], 1e-5) << x << ", " << y;
            const Vec2 at((x + 0.5) / 8 - 1.5, 1.5 - (y + 0.5) / 8);
            const bool isBelow = std::max(std::abs(at.x), std::abs(at.y)) < 1;
            const bool mayBe = filter != TextureFilter::Nearest || !isBelow || !isOpaque(at.x, at.y, isMesh);
            ASSERT_TRUE(truth.depth[i] <= 4.5 || mayBe) << x << ", " << y;
            holes += isBelow && truth.depth[i] > 4.5;
          }
        EXPECT_GT(holes, 60);
      }
}

/// A planar shadow has the holes of its caster, where the rays of the light go through them.
TEST_F(CutoutTest, PlanarShadowsHaveHoles) {
  const Vec3 lamp(0.7, -0.4, 3);
  for (const bool isMesh : {true, false})
    for (const bool isPoint : {true, false}) {
      SCOPED_TRACE(testing::Message() << isMesh << " " << isPoint);
      Scene scene;
      scene.set(RenderSettings{.ambient = Vec3(0)});
      Material material = cutOut(mapOf(fourTexels(), TextureFilter::Nearest));
      material.opacity = 0.9;  // times the alpha: of the texel at the code there is a hole, too
      const MaterialId cut = scene.add(material);
      if (isMesh)
        scene.add(Node{.translation = Vec3(0, 0, 1), .surface = quadMesh(), .material = cut});
      else
        scene.add(plate(Vec3(0, 0, 1), {2, 2}, cut));
      const NodeId ground =
          scene.add(plate(Vec3(0), {8, 8}, scene.add(Material{.diffuse = Vec3(1), .specular = Vec3(0)})));
      Node light{.light = Light{.type = isPoint ? Light::Type::Point : Light::Type::Directional,
                                .shadow = Light::Shadow::Planar,
                                .shadowPlane = ground}};
      if (isPoint) light.translation = lamp;
      scene.add(light);
      constexpr int kSide = 96;
      const Picture picture = draw(scene, lookingDown(0.5, 4), {kSide, kSide});
      int dark = 0;
      for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
          const Vec2 at(4 * (x + 0.5) / kSide - 2, 2 - 4 * (y + 0.5) / kSide);
          // Where its light passes the sheet, at a third of the way to a lamp.
          const Vec2 passes = isPoint ? at + (Vec2(lamp) - at) / lamp.z : at;
          const double border =
              std::min({std::abs(passes.x), std::abs(passes.y), std::abs(std::abs(passes.x) - 1),
                        std::abs(std::abs(passes.y) - 1)});
          if (border < 0.01) continue;
          const bool isBelow = std::max(std::abs(passes.x), std::abs(passes.y)) < 1;
          // The lower right one alone is as opaque as that.
          const bool isDark = isBelow && passes.x > 0 && (isMesh ? passes.y > 0 : passes.y < 0);
          ASSERT_EQ(colorAt(picture.image, x, y).x < 0.01, isDark) << x << ", " << y;
          dark += isDark;
        }
      EXPECT_GT(dark, 400);
    }
}

/// A planar shadow of what a map makes seen through is as deep as its texels are opaque.
TEST_F(CutoutTest, PlanarShadowsAreAsDeepAsMapsAreOpaque) {
  for (const bool isMesh : {true, false}) {
    SCOPED_TRACE(isMesh);
    Material material = cutOut(mapOf(fourTexels(), TextureFilter::Nearest), 0);
    material.opacity = 0.5;
    constexpr int kSide = 96;
    const Picture picture =
        draw(sheetOverPlate(material, isMesh, Light::Shadow::Planar), lookingDown(0.5, 4), {kSide, kSide});
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x) {
        const Vec2 at(4 * (x + 0.5) / kSide - 2, 2 - 4 * (y + 0.5) / kSide);
        if (std::max(std::abs(at.x), std::abs(at.y)) > 0.99) continue;
        const std::array alpha = {kCode, 0.3, 0.4, 0.9};
        const bool lower = isMesh ? at.y > 0 : at.y < 0;
        const double expected = 1 - 0.5 * alpha[(lower ? 2U : 0U) + (at.x > 0 ? 1U : 0U)];
        // A device filters with 8 bits.
        ASSERT_NEAR(colorAt(picture.image, x, y).x, expected, 1.0 / 255) << x << ", " << y;
      }
  }
}

/// What is behind a hole is seen through it as if there was nothing, and nothing through the rest.
TEST_F(CutoutTest, HolesShowWhatIsBehind) {
  for (const bool isMesh : {true, false})
    for (const Shading shading :
         {Shading::Exact, Shading::Phong, Shading::Flat, Shading::Gouraud, Shading::Toon}) {
      SCOPED_TRACE(testing::Message() << isMesh << nameOf(shading));
      Scene scene;
      scene.set(plainSettings(Vec3(0, 0, 0.5)));
      Material material = cutOut(mapOf(fourTexels(), TextureFilter::Nearest));
      material.diffuse = Vec3(1, 0.5, 0.25);
      const MaterialId cut = scene.add(material);
      if (isMesh)
        scene.add(Node{.surface = quadMesh(), .material = cut});
      else
        scene.add(plate(Vec3(0), {2, 2}, cut));
      const Image shown = draw(scene, lookingDown(3, 3), {24, 24}, {.shading = shading}).image;
      const bool drawn = shading == Shading::Toon;  // half as bright without lights
      for (int y = 0; y < 24; ++y)
        for (int x = 0; x < 24; ++x) {
          const Vec2 at((x + 0.5) / 8 - 1.5, 1.5 - (y + 0.5) / 8);
          const bool isSheet = std::max(std::abs(at.x), std::abs(at.y)) < 1;
          const Vec3 color = isSheet && isOpaque(at.x, at.y, isMesh) ? (drawn ? 0.5 : 1) * material.diffuse
                                                                     : Vec3(0, 0, 0.5);
          EXPECT_TRUE(near(colorAt(shown, x, y), color, 1e-6)) << x << ", " << y;
        }
    }
}

/// A model of glass lets the same part of the light through as a formula of it, tinted or not.
TEST_F(CutoutTest, LightGetsThroughModelsAsThroughFormulas) {
  for (const bool isMesh : {true, false})
    for (const Blend blend : {Blend::Over, Blend::Multiply}) {
      Material material = cutOut(mapOf(fourTexels(), TextureFilter::Nearest), 0);
      material.blend = blend;
      material.diffuse = Vec3(0.5, 1, 0.75);
      material.opacity = 0.5;
      const Picture picture = draw(sheetOverPlate(material, isMesh), lookingDown(0.5, 3), {24, 24});
      const Vec3 tint = blend == Blend::Multiply ? material.diffuse : Vec3(1);
      for (const auto& [left, upper] :
           {std::pair{true, true}, {true, false}, {false, true}, {false, false}}) {
        const bool upperTexel = isMesh ? !upper : upper;
        const double alpha = upperTexel ? (left ? kCode : 0.3) : (left ? 0.4 : 0.9);
        EXPECT_TRUE(
            near(colorAt(picture.image, left ? 8 : 15, upper ? 8 : 15), (1 - 0.5 * alpha) * tint, 3e-4))
            << isMesh << int(blend) << left << upper;
      }
      EXPECT_TRUE(near(colorAt(picture.image, 1, 12), Vec3(1), 1e-6));
    }
}

/// Ovals with a soft edge, or noise.
Image alphas(std::mt19937& random, int side, bool noise) {
  std::uniform_real_distribution<float> any(0, 1);
  Image image(side, side, 4);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const auto pixel = image.pixel(x, y);
      for (std::size_t c = 0; c < 3; ++c) pixel[c] = 0.3f + 0.7f * any(random);
      const double dx = (x % 8 + 0.5) / 8 - 0.5, dy = (y % 8 + 0.5) / 8 - 0.5;
      pixel[3] = noise ? any(random) : float(std::clamp(1.5 - 4 * std::hypot(dx, 1.4 * dy), 0.0, 1.0));
    }
  return image;
}

class CutoutScene : RandomScene {
 public:
  explicit CutoutScene(std::uint32_t seed) : RandomScene(seed) {}

  Scene scene(int lights) {
    Scene scene = emptyScene();
    scene.add(Node{.translation = Vec3(0, -1.3, 0), .surface = rectangle(8, 8)});
    const int things = 3 + int(3 * any());
    for (int i = 0; i < things; ++i)
      scene.add(Node{.translation = 0.9 * direction(),
                     .rotation = Rotation{unit(direction()), 6 * any()},
                     .scale = Vec3(0.4 + 0.5 * any()),
                     .surface = surface(),
                     .material = scene.add(material())});
    for (int i = 0; i < lights; ++i) {
      const bool sun = any() < 0.5;
      Node node{.light = Light{.type = sun ? Light::Type::Directional : Light::Type::Point,
                               .color = Vec3(0.6 + 0.4 * any(), 0.8, 0.6 + 0.4 * any()),
                               .intensity = 0.9 / lights,
                               .shadow = Light::Shadow::Exact}};
      if (sun)
        node.rotation = Rotation{unit(Vec3(1, 0.6 * any() - 0.3, 0)), -0.6 - 0.8 * any()};
      else
        node.translation = above();
      scene.add(std::move(node));
    }
    scene.add(camera());
    return scene;
  }

 private:
  Surface surface() {
    switch (int(7 * any())) {
      case 0:
        return cubeMesh();
      case 1:
        return icosphere(1);
      case 2:
        return meshOf(torus(0.8, 0.3), 2e-2);
      case 3:
        return torus(0.8, 0.3);
      case 4:
        return rectangle(2, 2);
      case 5:
        return soup(random_, 20, 0.8);
      default:
        return quadMesh();
    }
  }

  Material material() {
    Material material{.diffuse = Vec3(0.9, 0.6 + 0.4 * any(), 0.9), .specular = Vec3(any() < 0.5 ? 0 : 0.2)};
    if (any() < 0.15) return material;
    const bool filtered = any() < 0.75;
    material.map = mapOf(alphas(random_, any() < 0.5 ? 8 : 32, any() < 0.4),
                         filtered ? TextureFilter::Trilinear : TextureFilter::Nearest);
    material.map.scale = Vec2(any() < 0.5 ? 1 : 1 + 3 * any());
    material.map.angle = any() < 0.5 ? 0 : 6 * any();
    material.map.wrapU = any() < 0.5 ? TextureWrap::Repeat : TextureWrap::Mirror;
    material.mapOpacity = true;
    if (any() < 0.3) material.opacity = 0.6 + 0.4 * any();
    if (any() < 0.6) {
      material.cutoff = 0.2 + 0.5 * any();
    } else if (any() < 0.4) {
      material.blend = any() < 0.5 ? Blend::Multiply : Blend::Add;
    }
    return material;
  }
};

/// Models and formulas that are cut out or seen through, in each other's light and shadow.
TEST_F(CutoutTest, RandomScenesAreTheTruthInEveryPixel) {
  std::uint64_t layers = 0;
  for (std::uint32_t seed = 23; seed < 47; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const Scene scene = CutoutScene(seed).scene(1 + int(seed % 3));
    Snapshot snapshot = takeSnapshot(scene, 0, {96, 72});
    if (seed % 4 == 0) snapshot.view = sampledAt(snapshot.view, samplePattern(4)[seed % 3]);
    const Verified found = verified(snapshot);
    const Verification& v = found.verification;
    EXPECT_EQ(v.wrong.total(), 0U) << v.wrong.hitMiss << " hit or miss, " << v.wrong.layer << " layer, "
                                   << v.wrong.point << " point, " << v.wrong.light << " light";
    EXPECT_EQ(v.nanPixels, 0U);
    EXPECT_EQ(found.statistics.error.unconvergedPx, 0U);
    EXPECT_EQ(found.statistics.error.auditFailedPx, 0U);
    EXPECT_EQ(found.statistics.error.uncertifiedPx, 0U);
    layers += found.statistics.count.layerPoints;
  }
  EXPECT_GT(layers, 50'000U);
}

/// Each of which is held against the truth above.
TEST_F(CutoutTest, FourSamplesAreTheMeanOfTheirPictures) {
  Snapshot snapshot = takeSnapshot(CutoutScene(5).scene(2), 0, {96, 72});
  const Image shown = renderer().render(snapshot, {.samples = 4}).image;
  std::vector<Image> all;
  for (const Vec2& offset : samplePattern(4)) {
    snapshot.view = sampledAt(snapshot.view, offset);
    all.push_back(renderer().render(snapshot, {}).image);
  }
  for (int y = 0; y < 72; ++y)
    for (int x = 0; x < 96; ++x) {
      Vec3 mean(0);
      for (const Image& one : all) mean += 0.25 * colorAt(one, x, y);
      ASSERT_TRUE(near(colorAt(shown, x, y), mean, 1e-5)) << x << ", " << y;
    }
}

/// Nothing that is skipped stands behind a hole.
TEST_F(CutoutTest, SkipsChangeNothing) {
  for (const std::uint32_t seed : {2U, 7U}) {
    const Snapshot snapshot = takeSnapshot(CutoutScene(seed).scene(2), 0, {96, 72});
    EXPECT_TRUE(sameBytes(renderer().render(snapshot, {}).image,
                          renderer().render(snapshot, {.skips = Skips::none()}).image));
  }
}

}  // namespace
}  // namespace luxo::test
