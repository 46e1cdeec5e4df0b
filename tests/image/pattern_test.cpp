// SPDX-License-Identifier: Apache-2.0
// Colours that are formulas of u and v: exact in every pixel, under every shading, and free where there are
// none.
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <string>

#include "support/picture.h"

namespace luxo::test {
namespace {

constexpr PixelSize kPatternSize{96, 64};
constexpr std::array kLitShadings{Shading::Flat, Shading::Gouraud, Shading::Phong, Shading::Exact,
                                  Shading::Toon};

/// Shaders are compiled into a folder of the test's own.
class PatternTest : public PictureTest {
 protected:
  void TearDown() override {
    PictureTest::TearDown();
    std::filesystem::remove_all(directory_);
  }

 private:
  const std::filesystem::path directory_ =
      std::filesystem::path(testing::TempDir()) / ("luxo-pattern-" + std::to_string(getpid()));
  ScopedVariable variable_{"LUXO_CACHE_DIR", directory_.c_str()};
};

Pattern checker() {
  return pattern([](auto u, auto v) {
    const Expr square = mod(floor(8 * u) + floor(8 * v), 2);
    return point(mix(0.9, 0.1, square), square, 0.25);
  });
}

Vec3 checkerAt(double u, double v) {
  const double square = std::fmod(std::floor(8 * u) + std::floor(8 * v), 2);
  return {square == 0 ? 0.9 : 0.1, square, 0.25};
}

Scene plateScene(Material material, const Vec2& size) {
  Scene scene;
  scene.set(plainSettings());
  const MaterialId id = scene.add(std::move(material));
  scene.add(plate(Vec3(0), size, id));
  return scene;
}

TEST_F(PatternTest, EveryPixelHasItsOwnColorUnderEveryShading) {
  const Scene scene = plateScene({.specular = Vec3(0), .diffusePattern = checker()}, {8, 6});
  const Camera tilted{.eye = Vec3(1, -4, 5), .lookAt = Vec3(0), .fovY = radians(50)};
  const CameraModel model(tilted, kPatternSize);
  const auto parametersAt = [&](const Vec2& pixel) {
    const Ray ray = model.through(pixel);
    const Vec3 hit = ray.at(*hitPlane(ray, Vec3(0), Vec3(0, 0, 1)));
    return Vec2(hit.x / 8 + 0.5, hit.y / 6 + 0.5);
  };
  for (const Shading shading : kLitShadings) {
    const Image image = draw(scene, tilted, kPatternSize, {.shading = shading}).image;
    int checked = 0;
    for (int y = 0; y < kPatternSize.height; ++y)
      for (int x = 0; x < kPatternSize.width; ++x) {
        const Vec2 uv = parametersAt(centerOf(x, y));
        // Inside the plate and one tile, by more than vertices snap.
        const auto sameTile = [&](const Vec2& pixel) {
          const Vec2 p = parametersAt(pixel);
          return p.x > 0 && p.x < 1 && p.y > 0 && p.y < 1 && checkerAt(p.x, p.y) == checkerAt(uv.x, uv.y);
        };
        if (settled(sameTile, centerOf(x, y), 4 * kSnapPx) != true) continue;
        // No light shines: a drawing shows its darker level.
        const Vec3 wanted = checkerAt(uv.x, uv.y) * (shading == Shading::Toon ? 0.5 : 1.0);
        ASSERT_TRUE(near(colorAt(image, x, y), wanted, 1e-6)) << nameOf(shading) << " " << x << ", " << y;
        ++checked;
      }
    EXPECT_GT(checked, 2000) << nameOf(shading);
  }
}

TEST_F(PatternTest, ParametersAreInterpolatedInPerspective) {
  const Scene scene = plateScene(
      {.specular = Vec3(0), .diffusePattern = pattern([](auto u, auto v) { return point(u, v, 0); })},
      {8, 6});
  const Camera tilted{.eye = Vec3(1, -4, 5), .lookAt = Vec3(0), .fovY = radians(50)};
  const CameraModel model(tilted, kPatternSize);
  const Image image = draw(scene, tilted, kPatternSize).image;
  for (int i = 0; i < 100; ++i) {
    const int x = 30 + 4 * (i % 10), y = 20 + 3 * (i / 10);
    const Ray ray = model.through(centerOf(x, y));
    const Vec3 hit = ray.at(*hitPlane(ray, Vec3(0), Vec3(0, 0, 1)));
    // A pixel is about 1/90 of u or v; vertices snap to 1/256 pixel.
    EXPECT_TRUE(near(colorAt(image, x, y), {hit.x / 8 + 0.5, hit.y / 6 + 0.5, 0}, 1e-4)) << x << ", " << y;
  }
}

TEST_F(PatternTest, OneColorIsThatColor) {
  const Vec3 color(0.6, 0.4, 0.2);
  const Pattern constant = pattern([&](auto, auto) { return point(color.x, color.y, color.z); });
  const auto picture = [&](Material material, Shading shading) {
    Scene scene;
    scene.set(RenderSettings{.background = Vec3(0.1), .ambient = Vec3(0.2, 0.3, 0.1)});
    const MaterialId id = scene.add(std::move(material));
    scene.add(Node{.translation = Vec3(-1, 0, 0), .surface = sphere(1), .material = id});
    scene.add(Node{.translation = Vec3(1.3, 0, 0), .surface = cylinder(0.8, 1), .material = id});
    addLight(scene, {.position = {2, 3, 4, 1}, .radiance = {0.8, 0.7, 0.6}});
    addLight(scene, {.position = {-3, 1, 2, 0}, .radiance = {0.2, 0.2, 0.4}});
    return draw(scene, Camera{.eye = Vec3(0, 1, 5)}, kPatternSize, {.shading = shading}).image;
  };
  for (const Shading shading : kLitShadings)
    for (const bool ownAmbient : {false, true}) {
      Material plain{.diffuse = color, .specular = Vec3(0.5), .shininess = 12};
      if (ownAmbient) plain.ambient = Vec3(0.3, 0.1, 0.2);
      Material patterned = plain;
      patterned.diffuse = Vec3(0.9);  // stands back
      patterned.diffusePattern = constant;
      const Image a = picture(plain, shading), b = picture(patterned, shading);
      for (int y = 0; y < kPatternSize.height; ++y)
        for (int x = 0; x < kPatternSize.width; ++x)  // sums of a few products in another order
          ASSERT_TRUE(near(colorAt(a, x, y), colorAt(b, x, y), 2e-6))
              << nameOf(shading) << " " << x << ", " << y;
    }
}

TEST_F(PatternTest, ParametersChangeAndNothingIsMadeAgain) {
  const Pattern shifted =
      pattern<2>([](auto u, auto v, auto a, auto b) { return point(u + a, v + b, a * b); });
  const auto sceneWith = [&](std::vector<double> first, std::vector<double> second) {
    Scene scene;
    scene.set(plainSettings());
    Material one{.specular = Vec3(0), .diffusePattern = shifted, .patternParameters = std::move(first)};
    Material two = one;
    two.patternParameters = std::move(second);
    const MaterialId ids[] = {scene.add(one), scene.add(two)};
    Node left = plate(Vec3(-2, 0, 0), {3, 3}, ids[0]), right = left;
    right.translation = Vec3(2, 0, 0);
    right.material = ids[1];
    scene.add(left);
    scene.add(right);
    scene.add(Camera{.eye = Vec3(0, 0, 5), .projection = Projection::Orthographic, .height = 6.4});
    return scene;
  };
  const DrawOptions meshes{.shading = Shading::Phong};
  const Picture before = draw(sceneWith({0.5, 2}, {1, 3}), kPatternSize, meshes);
  EXPECT_EQ(before.statistics.count.shadersCompiled, 1u);
  EXPECT_EQ(before.statistics.count.drawCalls, 1u) << "values do not keep draws apart";
  // Ten pixels a metre; the plates' centres, where u = v = 1/2, lie on the corner of four pixels.
  const double half = 0.5 / 30;
  EXPECT_TRUE(near(colorAt(before.image, 28, 31), {1 + half, 2.5 + half, 1}, 1e-5));
  EXPECT_TRUE(near(colorAt(before.image, 68, 31), {1.5 + half, 3.5 + half, 3}, 1e-5));
  const Picture after = draw(sceneWith({0.25, 4}, {1, 3}), kPatternSize, meshes);
  EXPECT_TRUE(near(colorAt(after.image, 28, 31), {0.75 + half, 4.5 + half, 1}, 1e-5));
  EXPECT_EQ(after.statistics.count.shadersCompiled, 0u);
  EXPECT_EQ(after.statistics.count.pipelinesCreated, 0u);
}

TEST_F(PatternTest, TheNextRunCompilesNothing) {
  const Scene scene = plateScene({.diffusePattern = checker()}, {8, 6});
  const auto compiledBy = [&](const Scene& s, const DrawOptions& options) {
    Renderer fresh(context());
    return fresh.render(takeSnapshot(s, 0, kPatternSize), options).statistics.count.shadersCompiled;
  };
  const DrawOptions meshes{.shading = Shading::Phong};
  EXPECT_EQ(compiledBy(scene, {}), 1u);
  EXPECT_EQ(compiledBy(scene, {}), 0u);
  EXPECT_EQ(compiledBy(scene, meshes), 1u);
  EXPECT_EQ(compiledBy(scene, meshes), 0u);
  EXPECT_EQ(compiledBy(plateScene({.diffusePattern = checker()}, {1, 1}),
                       {.shading = Shading::Phong, .samples = 4}),
            0u)
      << "equal formulas are one shader";
  EXPECT_EQ(compiledBy(scene, {.shading = Shading::Gouraud}), 1u);
  EXPECT_EQ(compiledBy(plateScene({}, {8, 6}), meshes), 0u) << "no pattern";
  for (const Shading view : {Shading::Normal, Shading::Uv, Shading::Wireframe})
    EXPECT_EQ(compiledBy(scene, {.shading = view}), 0u) << "views of geometry show no pattern";
}

TEST_F(PatternTest, WithoutAValueItIsBlack) {
  // The left half has no square root, the middle line divides by 0, blue is negative.
  const Pattern broken = pattern([](auto u, auto v) { return point(sqrt(u - 0.5), 1 / (v - v), u - 2); });
  Scene scene = plateScene({.specular = Vec3(0), .diffusePattern = broken}, {8, 6});
  scene.add(Camera{.eye = Vec3(0, 0, 5), .projection = Projection::Orthographic, .height = 6});
  const Image image = draw(scene, kPatternSize).image;
  EXPECT_TRUE(allFinite(image));
  EXPECT_EQ(colorAt(image, 20, 32), Vec3(0));
  EXPECT_TRUE(
      near(colorAt(image, 80, 32), {std::sqrt((80.5 - 48) / kPatternSize.width * 9 / 8), 0, 0}, 1e-5));
}

TEST_F(PatternTest, RoundingNeverCrossesASeam) {
  // u and v run from 0 to 1: below their upper end the floor is 0, at it and beyond 1, and below 0 it is -1.
  const Pattern inside = pattern([](auto u, auto v) { return point(floor(u) + 1, floor(v) + 1, 1); });
  for (const Surface& surface : {sphere(1), torus(0.7, 0.3), cylinder(0.8, 1)})
    for (int k = 0; k < 12; ++k) {
      Scene scene;
      scene.set(plainSettings(Vec3(1)));
      const MaterialId id = scene.add(Material{.specular = Vec3(0), .diffusePattern = inside});
      scene.add(Node{.rotation = Rotation{{1, k - 6, 0.3 * k}, 0.9}, .surface = surface, .material = id});
      const Image image = draw(scene, Camera{.eye = Vec3(3, 0.2 * k - 1, 0)}, kPatternSize).image;
      for (const float sample : image.samples()) ASSERT_EQ(sample, 1.0f) << surface.name() << " " << k;
    }
}

TEST_F(PatternTest, IsBlendedLikeAnyColor) {
  Scene scene = plateScene({.specular = Vec3(0), .opacity = 0.5, .diffusePattern = checker()}, {8, 6});
  scene.set(plainSettings(Vec3(0.4)));
  scene.add(Camera{.eye = Vec3(0, 0, 5), .projection = Projection::Orthographic, .height = 6});
  EXPECT_TRUE(near(colorAt(draw(scene, kPatternSize).image, 48, 30),
                   0.5 * (checkerAt(0.51, 0.51) + Vec3(0.4)), 1e-6));
}

}  // namespace
}  // namespace luxo::test
