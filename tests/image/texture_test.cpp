// SPDX-License-Identifier: Apache-2.0
// Pictures of textures: against known answers, and against the ground truth in every pixel.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "image/image.h"
#include "support/meshes.h"
#include "support/verified_picture.h"
#include "surface/library.h"

namespace luxo::test {
namespace {

constexpr PixelSize kTextureSize{160, 120};

/// Four colours that halves hold exactly.
TextureMap fourTexels() {
  Image image(2, 2, 3, {1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1});
  return {.texture = std::make_shared<const Texture>(makeTexture(image, "four"))};
}

/// Coloured squares with a gradient in each: all that a filter may get wrong shows.
TextureMap tiles(int side, int texels) {
  Image image(side * texels, side * texels, 3);
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      const bool odd = (x / texels + y / texels) % 2 != 0;
      const auto pixel = image.pixel(x, y);
      pixel[0] = odd ? 0.9f : 0.1f;
      pixel[1] = float(x) / float(image.width());
      pixel[2] = odd ? float(y) / float(image.height()) : 0.8f;
    }
  return {.texture = std::make_shared<const Texture>(makeTexture(image, "tiles"))};
}

class TexturePicture : public VerifiedPictureTest {};

Scene litTexture(Surface surface, TextureMap map, const Node& place = {}) {
  Scene scene;
  Node node = place;
  node.surface = std::move(surface);
  node.material = scene.add(Material{.diffuse = Vec3(1), .map = std::move(map)});
  scene.add(std::move(node));
  scene.add(Node{.translation = Vec3(3, 5, 4), .light = Light{.intensity = 0.9}});
  return scene;
}

/// The texels of a plate, seen straight on in 4 x 4 pixels each, as they are.
TEST_F(TexturePicture, APlateShowsItsTexels) {
  for (const bool isMesh : {false, true})
    for (const TextureFilter filter : {TextureFilter::Nearest, TextureFilter::Trilinear}) {
      TextureMap map = fourTexels();
      map.filter = filter;
      Scene scene;
      scene.set(plainSettings());
      const MaterialId material = scene.add(Material{.diffuse = Vec3(1), .specular = Vec3(0), .map = map});
      if (isMesh)
        scene.add(Node{.surface = quadMesh(), .material = material});
      else
        scene.add(plate(Vec3(0), {2, 2}, material));
      scene.add(Camera{.eye = Vec3(0, 0, 5), .projection = Projection::Orthographic, .height = 2});
      const Image image = draw(scene, {8, 8}).image;
      const Vec3 colors[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
      for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x) {
          Vec3 wanted = colors[2 * (y / 4) + x / 4];
          if (filter == TextureFilter::Trilinear) {
            wanted = Vec3(0);
            const double s = (x + 0.5) / 4 - 0.5, t = (y + 0.5) / 4 - 0.5;
            for (int j = 0; j < 2; ++j)
              for (int i = 0; i < 2; ++i) {
                const int column = (int(std::floor(s)) + i + 2) % 2, row = (int(std::floor(t)) + j + 2) % 2;
                const double fs = s - std::floor(s), ft = t - std::floor(t);
                wanted += (i ? fs : 1 - fs) * (j ? ft : 1 - ft) * colors[2 * row + column];
              }
          }
          // A mesh's texture lies with v down, its quad's uv goes up.
          const Vec3 shown = colorAt(image, x, isMesh ? 7 - y : y);
          EXPECT_TRUE(near(shown, wanted, 1e-5)) << isMesh << " " << x << ", " << y;
        }
    }
}

TEST_F(TexturePicture, OnFormulasEveryPixelIsTheTruths) {
  const std::array<Surface, 6> surfaces = {
      sphere(1),
      torus(0.8, 0.35),
      cylinder(0.8, 1.2),
      rectangle(3, 3),
      cone(1, 0.2, 1.4),
      surface([](auto u, auto v) { return point(u, 0.2 * sin(3 * u) * cos(2 * v), v); },
              {{-1.2, 1.2}, {-1, 1}})};
  for (const Surface& s : surfaces) {
    SCOPED_TRACE(s.name());
    const Scene scene = litTexture(s, tiles(16, 16));
    expectTrueColors(
        takeSnapshot(scene, 0, kTextureSize, Camera{.eye = Vec3(2, 1.6, 3), .lookAt = Vec3(0, 0.2, 0)}),
        2000);
  }
}

TEST_F(TexturePicture, OnTrianglesEveryPixelIsTheTruths) {
  for (const Surface& s : {Surface(quadMesh()), Surface(meshOf(torus(0.7, 0.3), 1e-3))}) {
    SCOPED_TRACE(s.name());
    TextureMap map = tiles(16, 16);
    map.scale = {2, 1};
    map.wrapV = TextureWrap::Mirror;
    const Scene scene =
        litTexture(s, map, Node{.rotation = Rotation{{1, 0.3, 0}, -1.1}, .scale = Vec3(1.2, -0.9, 1)});
    expectTrueColors(takeSnapshot(scene, 0, kTextureSize, Camera{.eye = Vec3(1, 0.8, 3.2)}), 2000);
  }
}

TEST_F(TexturePicture, WithShadowsEveryPixelIsTheTruths) {
  Scene scene;
  const MaterialId floor = scene.add(Material{.diffuse = Vec3(1), .map = tiles(8, 32)});
  TextureMap small = tiles(4, 8);
  small.wrapU = TextureWrap::Clamp;
  const MaterialId ball = scene.add(Material{.diffuse = Vec3(0.8), .map = small});
  scene.add(Node{.translation = Vec3(0, -1, 0), .surface = rectangle(8, 8), .material = floor});
  scene.add(Node{.surface = sphere(0.8), .material = ball});
  scene.add(Node{.translation = Vec3(1.5, 0, 0), .scale = Vec3(0.5), .surface = icosphere(2)});
  scene.add(
      Node{.translation = Vec3(-1.5, 0, 0), .scale = Vec3(0.6), .surface = quadMesh(), .material = ball});
  scene.add(
      Node{.translation = Vec3(2, 4, 3), .light = Light{.intensity = 0.9, .shadow = Light::Shadow::Exact}});
  expectTrueColors(takeSnapshot(scene, 0, kTextureSize, Camera{.eye = Vec3(1, 1.6, 4)}), 10000);
}

/// As the ball turns below the eye, the texture at its poles and at its seam is as the truth says; and a
/// plane to the horizon.
// As a viewer of models shows one: seams, creases, its own shadow on it and on a wall.
TEST_F(TexturePicture, AHeadIsTheTruth) {
  Scene scene = litTexture(Surface(headMesh(64, 48)), tiles(16, 8));
  scene.add(plate(Vec3(0, 0, -1.6), {8, 8}, scene.add(Material{.diffuse = Vec3(0.8), .specular = Vec3(0)})));
  scene.add(
      Node{.translation = Vec3(-4, 2, 5), .light = Light{.intensity = 0.6, .shadow = Light::Shadow::Exact}});
  const Camera camera{.eye = Vec3(1.8, 0.6, 4.2), .lookAt = Vec3(0, -0.05, 0), .fovY = radians(35)};
  expectTrueColors(takeSnapshot(scene, 0, kTextureSize, camera), 15000);
}

TEST_F(TexturePicture, PolesSeamsAndHorizonsAreTheTruths) {
  for (const double height : {3.0, 0.4, -3.0}) {
    SCOPED_TRACE(height);
    Scene scene = litTexture(sphere(1), tiles(32, 8));
    expectTrueColors(takeSnapshot(scene, 0, kTextureSize, Camera{.eye = Vec3(0.7, height, 0.8)}), 1500);
  }
  TextureMap far = tiles(2, 64);
  far.scale = Vec2(50);
  const Scene scene = litTexture(rectangle(100, 100), far);
  expectTrueColors(
      takeSnapshot(scene, 0, kTextureSize, Camera{.eye = Vec3(0, 1, 40), .lookAt = Vec3(0, 0.5, 0)}), 5000);
}

TEST_F(TexturePicture, EveryShadingShowsIt) {
  TextureMap one = fourTexels();
  one.filter = TextureFilter::Nearest;
  for (const Shading shading :
       {Shading::Exact, Shading::Phong, Shading::Flat, Shading::Gouraud, Shading::Toon})
    for (const bool shadows : {false, true}) {
      Scene scene;
      scene.set(plainSettings());
      const MaterialId material = scene.add(Material{.diffuse = Vec3(1), .specular = Vec3(0), .map = one});
      scene.add(plate(Vec3(0), {2, 2}, material));
      if (shadows)
        scene.add(Node{.translation = Vec3(0, 0, 3),
                       .light = Light{.intensity = 1e-9, .shadow = Light::Shadow::Exact}});
      scene.add(Camera{.eye = Vec3(0, 0, 5), .projection = Projection::Orthographic, .height = 2});
      const Image image = draw(scene, {32, 32}, {.shading = shading}).image;
      const double level = shading == Shading::Toon ? image.pixel(4, 4)[0] : 1;
      EXPECT_GT(level, 0.4);
      EXPECT_TRUE(near(colorAt(image, 4, 4), Vec3(level, 0, 0), 1e-4)) << nameOf(shading) << shadows;
      EXPECT_TRUE(near(colorAt(image, 28, 4), Vec3(0, level, 0), 1e-4)) << nameOf(shading) << shadows;
      EXPECT_TRUE(near(colorAt(image, 4, 28), Vec3(0, 0, level), 1e-4)) << nameOf(shading) << shadows;
    }
}

TEST_F(TexturePicture, TheSameTexturesAreUploadedOnce) {
  Scene scene = litTexture(sphere(1), tiles(16, 16));
  scene.add(Camera{.eye = Vec3(2, 1.6, 3)});
  const std::uint64_t first = draw(scene, kTextureSize).statistics.count.uploadBytes,
                      second = draw(scene, kTextureSize, {.skips = {.unchanged = false}})
                                   .statistics.count.uploadBytes;
  EXPECT_GT(first, second + 256 * 256 * 8);
}

}  // namespace
}  // namespace luxo::test
