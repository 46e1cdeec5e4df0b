// SPDX-License-Identifier: Apache-2.0
// Textures on surfaces: what the filter says where the answer is known, where the image lies, and what scene
// files say of them.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "base/diagnostic.h"
#include "image/image.h"
#include "scene/scene_builder.h"
#include "scene/scene_reader.h"
#include "scene/scene_writer.h"
#include "scene/snapshot.h"
#include "scene/texture_map.h"
#include "scene_test_support.h"
#include "support/meshes.h"

namespace luxo::test {
namespace {

namespace fs = std::filesystem;

/// Two rows of two: red, green, blue, white; halves hold them exactly.
TextureMap fourTexels() {
  Image image(2, 2, 3, {1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1});
  return {.texture = std::make_shared<const Texture>(makeTexture(image, "four"))};
}

Vec3 texelOf(int x, int y) {
  constexpr std::array<std::array<double, 3>, 4> kColors{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}}};
  const auto& color = kColors[static_cast<std::size_t>(2 * y + x)];
  return {color[0], color[1], color[2]};
}

int wrappedTexel(int i, TextureWrap wrap) {
  if (wrap == TextureWrap::Clamp) return i < 0 ? 0 : i > 1 ? 1 : i;
  const int k = ((i % 4) + 4) % 4;
  if (wrap == TextureWrap::Mirror) return std::array{0, 1, 1, 0}[static_cast<std::size_t>(k)];
  return k % 2;
}

constexpr TextureWrap kWraps[] = {TextureWrap::Repeat, TextureWrap::Clamp, TextureWrap::Mirror};

TEST(TextureMap, EveryFilterAndWrapOfFourTexels) {
  for (const TextureWrap wrapU : kWraps)
    for (const TextureWrap wrapV : kWraps) {
      TextureMap map = fourTexels();
      map.wrapU = wrapU;
      map.wrapV = wrapV;
      for (double v = -1.97; v < 2.5; v += 0.11)
        for (double u = -1.93; u < 2.5; u += 0.13) {
          map.filter = TextureFilter::Nearest;
          const auto texel = [&](double x, double y) {
            return texelOf(wrappedTexel(int(std::floor(x)), wrapU), wrappedTexel(int(std::floor(y)), wrapV));
          };
          expectNear(Vec3(map.at({}, {u, v}, Footprint(0))), texel(2 * u, 2 * v), 1e-12);
          map.filter = TextureFilter::Trilinear;
          const double x = 2 * u - 0.5, y = 2 * v - 0.5, fx = x - std::floor(x), fy = y - std::floor(y);
          const Vec3 wanted = (1 - fy) * ((1 - fx) * texel(x, y) + fx * texel(x + 1, y)) +
                              fy * ((1 - fx) * texel(x, y + 1) + fx * texel(x + 1, y + 1));
          expectNear(Vec3(map.at({}, {u, v}, Footprint(0.25))), wanted, 1e-9);
        }
    }
}

TEST(TextureMap, AWideFootprintSeesTheMeanAndOneWithoutAValueToo) {
  const TextureMap map = fourTexels();
  const Vec3 mean(0.5);
  const double nan = std::nan("");
  for (const Footprint& footprint : {Footprint(4), Footprint(Vec2(9, 0), Vec2(0, 12)), Footprint(nan),
                                     Footprint(Vec2(1e30, 0), Vec2(0, 1e300))})
    expectNear(Vec3(map.at({}, {0.3, 0.8}, footprint)), mean, 1e-3);
}

/// Stripes along u, sixteen texels each way.
TextureMap stripes(std::uint32_t anisotropy) {
  Image image(16, 16, 1);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) image.pixel(x, y)[0] = static_cast<float>(y / 4 % 2);
  return {.texture = std::make_shared<const Texture>(makeTexture(image, "stripes")),
          .anisotropy = anisotropy};
}

TEST(TextureMap, AnisotropyFiltersAlongTheFootprintAlone) {
  const Footprint alongU(Vec2(0.5, 0), Vec2(0, 1.0 / 16)), turned(Vec2(0.25, 0), Vec2(-0.25, 1.0 / 16));
  for (const Footprint& footprint : {alongU, turned}) {
    EXPECT_NEAR(stripes(8).at({}, {0.4, 0.375}, footprint).x, 1, 0.05);
    EXPECT_NEAR(stripes(8).at({}, {0.4, 0.125}, footprint).x, 0, 0.05);
    EXPECT_LT(stripes(1).at({}, {0.4, 0.375}, footprint).x, 0.8);
  }
}

TEST(TextureMap, NothingJumpsAsTheFootprintGrows) {
  Image image(64, 64, 1);
  for (int i = 0; i < 64 * 64; ++i) image.samples()[static_cast<std::size_t>(i)] = float(i * 37 % 101) / 101;
  const TextureMap map{.texture = std::make_shared<const Texture>(makeTexture(image, "noise"))};
  const auto of = [&](double size) {
    return map.at({}, {0.37, 0.61}, Footprint(Vec2(size, 0.2 * size), Vec2(0.02, 0.1 * size))).x;
  };
  for (double size = 1e-3; size < 2; size *= 1.002) EXPECT_NEAR(of(size), of(size * 1.002), 0.02) << size;
}

TEST(TextureMap, ColoursAreWeighedByTheirAlpha) {
  Image image(2, 1, 4, {1, 0, 0, 1, 0, 1, 0, 0});
  const TextureMap map{.texture = std::make_shared<const Texture>(makeTexture(image, "half"))};
  const Vec4 between = map.at({}, {0.5, 0.5}, Footprint(0));
  expectNear(Vec3(between), {1, 0, 0}, 1e-9);
  EXPECT_NEAR(between.w, 0.5, 1e-9);
}

Vec2 placeOf(const TextureMap& map, const Surface& surface, const Vec2& uv) {
  const TexturePlacement at = map.on(surface);
  return at.linear * uv + at.constant;
}

TEST(TextureMap, LiesOnceOnAFormulaAndByTheirUvOnTriangles) {
  TextureMap map = fourTexels();
  const Surface wide = surface([](auto u, auto v) { return point(u, v, 0); }, {{2, 6}, {-1, 1}});
  const auto expectPlace = [](const Vec2& a, const Vec2& b) {
    EXPECT_NEAR(a.x, b.x, 1e-12);
    EXPECT_NEAR(a.y, b.y, 1e-12);
  };
  expectPlace(placeOf(map, wide, {2, 1}), {0, 0});
  expectPlace(placeOf(map, wide, {6, -1}), {1, 1});
  expectPlace(placeOf(map, quadMesh(), {0.25, 0.75}), {0.25, 0.75});
  map.scale = {2, 3};
  map.offset = {0.1, 0.2};
  map.angle = kPi / 2;
  expectPlace(placeOf(map, quadMesh(), {0.25, 0.5}), {0.1 - 1.5, 0.2 + 0.5});
}

Scene textured(const std::string& members, std::vector<Diagnostic>* warnings = nullptr,
               const fs::path& folder = {}) {
  return buildScene(parseScene("{ \"luxo\": 1,\n" + members + " }", "s", folder), {}, warnings);
}

const Material& materialOf(const Snapshot& snapshot) { return snapshot.materials.at(1); }

TEST(SceneTextures, CheckersAndColoursNeedNoFile) {
  std::vector<Diagnostic> warnings;
  const Scene scene = textured(R"("params": { "k": 3 },
    "textures": { "floor": { "checker": [[1, 0.5, 0], 0.25], "squares": 4, "wrap": "mirror", "filter": "nearest",
                             "anisotropy": 2 }, "one": { "color": "#ffffff" } },
    "materials": { "m": { "map": { "texture": "floor", "offset": ["t", 0.5], "scale": ["k", 2], "rotate": "90deg" } },
                   "n": { "map": "one", "diffuse": 0.5 } },
    "surfaces": { "s": { "type": "sphere" } },
    "nodes": [ { "surface": "s", "material": "m" }, { "surface": "s", "material": "n" } ])",
                               &warnings);
  EXPECT_TRUE(warnings.empty());
  const Snapshot snapshot = takeSnapshot(scene, 2, {8, 8});
  const Material &m = snapshot.materials.at(snapshot.nodes[0].material.index),
                 &n = snapshot.materials.at(snapshot.nodes[1].material.index);
  EXPECT_EQ(m.diffuse, Vec3(1)) << "times what the texture says";
  EXPECT_EQ(n.diffuse, Vec3(0.5));
  ASSERT_TRUE(m.map.valid() && n.map.valid());
  EXPECT_EQ(m.map.wrapU, TextureWrap::Mirror);
  EXPECT_EQ(m.map.filter, TextureFilter::Nearest);
  EXPECT_EQ(m.map.anisotropy, 2U);
  EXPECT_EQ(m.map.offset, Vec2(2, 0.5));
  EXPECT_EQ(m.map.scale, Vec2(3, 2));
  EXPECT_NEAR(m.map.angle, kPi / 2, 1e-12);
  EXPECT_EQ(n.map.texture->levels.size(), 1U);
  // The mean in linear light.
  const auto mean = m.map.texture->levels.back().texel(0, 0);
  EXPECT_NEAR(mean[0], 0.625, 1e-3);
  EXPECT_NEAR(mean[1], 0.375, 1e-3);
  EXPECT_NEAR(mean[2], 0.125, 1e-3);
}

TEST(SceneTextures, AreWrittenAsTheyAreRead) {
  const std::string text = R"({ "luxo": 1,
    "textures": { "a": { "file": "a.png", "wrap": "clamp", "data": true },
                  "b": { "checker": [[1, 0, 0], 0.5], "squares": 6, "filter": "nearest", "anisotropy": 4 } },
    "materials": { "m": { "map": { "texture": "a", "scale": [2, "t"], "rotate": 1 } },
                   "n": { "map": "b", "diffuse": 0.7 } } })";
  const SceneFile file = parseScene(text, "s"), again = parseScene(writeScene(file), "again");
  EXPECT_EQ(file, again) << writeScene(file);
}

TEST(SceneTextures, MistakesAreToldWithTheirPlace) {
  const std::pair<std::string, std::vector<std::string>> kMistakes[] = {
      {R"("materials": { "m": { "map": "wood" } })", {"s:2:30", "there is no texture 'wood'"}},
      {R"("textures": { "wood": { "wrap": "clamp" } })", {"s:2:23", "a texture needs an image", "\"file\""}},
      {R"("textures": { "wood": { "file": "a.png", "color": 1 } })", {"s:2:15", "a texture has one image"}},
      {R"("textures": { "wood": { "color": 1, "anisotropy": 17 } })", {"s:2:51", "from 1 to 16"}},
      {R"("textures": { "wood": { "color": 1, "wrap": "clam" } })", {"s:2:45", "clamp"}},
      {R"("textures": { "wood": { "checker": [0, 1], "squares": 3 } })", {"s:2:55", "even number"}},
      {R"("textures": { "wood": { "checker": 1 } })", {"s:2:36", "an array of 2 colours"}},
      {R"("textures": { "wood": { "color": 1, "fitler": "nearest" } })", {"s:2:37", "filter"}},
      {R"("textures": { "wood": { "file": "../a.png" } })", {"s:2:33", "outside of the scene's folder"}},
      {R"("textures": { "wood": { "file": "/a.png" } })", {"s:2:33", "named from the root"}},
      {R"("textures": { "w": { "color": 1 } }, "materials": { "m": { "diffuse": ["u", 0, 0], "map": "w" } })",
       {"s:2:", "there is a map, too"}},
  };
  for (const auto& mistake : kMistakes)
    expectSceneError([&] { static_cast<void>(textured(mistake.first)); }, mistake.second);
}

class TextureFolder : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        fs::temp_directory_path() /
        ("luxo_textures_" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path folder_;
};

TEST_F(TextureFolder, FilesAreReadRelativeToTheScene) {
  Image image(2, 2, 3, {1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1});
  image.save(folder_ / "four.png");
  const Scene scene = textured(R"("textures": { "four": { "file": "four.png" } },
    "materials": { "m": { "map": "four" } }, "nodes": [ { "material": "m" } ])",
                               nullptr, folder_);
  const TextureMap map = materialOf(takeSnapshot(scene, 0, {8, 8})).map;
  ASSERT_TRUE(map.valid());
  EXPECT_EQ(map.texture->levels[0].texel(1, 0), (std::array<float, 4>{0, 1, 0, 1}));
}

TEST_F(TextureFolder, WithoutItsFileItIsDrawnWithoutAndSaidOnce) {
  std::vector<Diagnostic> warnings;
  const std::string members = R"("textures": { "wood": { "file": "wood.png" } },
    "materials": { "m": { "map": "wood" }, "n": { "map": "wood" } },
    "nodes": [ { "material": "m" }, { "material": "n" } ],
    "x-surfaces": {} )";
  const Scene scene = textured(members, &warnings, folder_);
  EXPECT_FALSE(materialOf(takeSnapshot(scene, 0, {8, 8})).map.valid());
  std::size_t about = 0;
  for (const Diagnostic& warning : warnings) about += warning.message.find("'wood.png'") != std::string::npos;
  EXPECT_EQ(about, 1U);
  // Also where nobody asks for what takes time, or for advice.
  warnings.clear();
  static_cast<void>(buildScene(parseScene("{ \"luxo\": 1,\n" + members + " }", "s", folder_), {}, &warnings,
                               WarningsAbout::WhatIsLacking));
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].message.find("drawn without"), std::string::npos);
}

TEST_F(TextureFolder, ADamagedFileIsAnError) {
  std::ofstream(folder_ / "bad.png") << "\x89PNG and nothing more";
  expectSceneError(
      [&] {
        static_cast<void>(textured(R"("textures": { "bad": { "file": "bad.png" } })", nullptr, folder_));
      },
      {"s:2:", "bad.png"});
}

TEST(SceneTextures, OfWhatIsSeenThroughAreDrawn) {
  std::vector<Diagnostic> warnings;
  const Scene scene = textured(R"("textures": { "w": { "color": 1 } },
    "materials": { "m": { "map": "w", "opacity": 0.5 } }, "nodes": [ { "material": "m" } ])",
                               &warnings);
  EXPECT_TRUE(materialOf(takeSnapshot(scene, 0, {8, 8})).drawsMaps());
  EXPECT_TRUE(warnings.empty());
}

}  // namespace
}  // namespace luxo::test
