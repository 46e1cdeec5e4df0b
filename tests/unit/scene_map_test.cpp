// SPDX-License-Identifier: Apache-2.0
// Maps of normals, highlights and glow: where their vectors lie, and what scene files say of them.
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "base/diagnostic.h"
#include "draw/paint.h"
#include "math/transform.h"
#include "scene/normal_map.h"
#include "scene/scene_builder.h"
#include "scene/scene_reader.h"
#include "scene/scene_writer.h"
#include "scene/snapshot.h"
#include "scene_test_support.h"
#include "surface/surface_triangles.h"

namespace luxo::test {
namespace {

namespace fs = std::filesystem;

const Vec3 kLeaning = unit(Vec3(0.3, 0.2, 0.9));

Vec3 bent(const Material& material, const Vec3& vector, const Vec3& normal, const NormalFrame& frame,
          const Mat3& normalFromObject = Mat3(1)) {
  return bentNormal(material, normalFromTexel(material, normalFromObject), 0.5 * vector + 0.5, normal, frame);
}

TEST(NormalMap, LeansRightAndUpOfTheImage) {
  // Su and Sv of a plate in x and y, seen from +Z; and from behind, where what leaned to +X is turned over.
  const Vec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  expectNear(bent({}, kLeaning, z, normalFrame(2.0 * x, y, z, false)), kLeaning, 1e-12);
  expectNear(bent({}, kLeaning, -z, normalFrame(2.0 * x, y, z, true)), -kLeaning, 1e-12);
  // Of a mirrored one, whose Su x Sv points inward.
  expectNear(bent({}, kLeaning, z, normalFrame(x, -y, z, false)), {kLeaning.x, -kLeaning.y, kLeaning.z},
             1e-12);
}

TEST(NormalMap, TurnsAndMirrorsWithItsImage) {
  const NormalFrame frame(1, 0, 0, 1);
  const Vec3 z(0, 0, 1);
  Material material;
  material.normalMap.scale = {-3, 2};
  expectNear(bent(material, kLeaning, z, frame), {-kLeaning.x, kLeaning.y, kLeaning.z}, 1e-12);
  // place' = turned * place: where the image's right was down it is turned back to be right.
  material.normalMap.scale = {1, 1};
  material.normalMap.angle = kPi / 2;
  expectNear(bent(material, {1, 0, 0}, z, frame), {0, 1, 0}, 1e-12);
  expectNear(bent(material, {0, 1, 0}, z, frame), {-1, 0, 0}, 1e-12);
}

TEST(NormalMap, ItsScaleIsThatOfWhatLeans) {
  const Vec3 leans = kLeaning * Vec3(2, 2, 1);
  expectNear(bent({.normalScale = 2}, kLeaning, {0, 0, 1}, NormalFrame(1, 0, 0, 1)), unit(leans), 1e-12);
}

TEST(NormalMap, OfTheObjectTurnsWithItAndToTheSideThatIsShown) {
  const Material material{.normalSpace = NormalSpace::Object};
  const Mat3 turned(Vec3(0, 1, 0), Vec3(-1, 0, 0), Vec3(0, 0, 1));
  expectNear(bent(material, kLeaning, {0, 0, 1}, NormalFrame(0), turned), turned * kLeaning, 1e-12);
  expectNear(bent(material, kLeaning, {0, 0, -1}, NormalFrame(0), turned), turned * -kLeaning, 1e-12);
}

TEST(NormalMap, IsNoneWhereNothingTellsItsFrame) {
  const Vec3 normal = unit(Vec3(1, 2, 3));
  EXPECT_EQ(bent({}, kLeaning, normal, NormalFrame(0)), normal);
  EXPECT_EQ(bent({}, Vec3(0), normal, NormalFrame(1, 0, 0, 1)), normal);
}

/// So that no scene without these maps has more to compile, to bind or to draw.
TEST(Paint, OfATextureAloneIsNoMoreThanItWas) {
  Material material;
  EXPECT_FALSE(Paint::of(material).valid());
  material.map.texture = std::make_shared<const Texture>();
  EXPECT_EQ(Paint::of(material).preamble(), "#define LUXO_TEXTURED\n#define LUXO_COLOR_MAP\n");
  EXPECT_FALSE(Paint::of(material).readsFrame());
  material.normalMap.texture = material.map.texture;
  EXPECT_TRUE(Paint::of(material).readsFrame());
  material.normalSpace = NormalSpace::Object;
  EXPECT_FALSE(Paint::of(material).readsFrame());
}

Scene built(const std::string& members, std::vector<Diagnostic>* warnings = nullptr,
            const fs::path& folder = {}) {
  return buildScene(parseScene("{ \"luxo\": 1,\n" + members + " }", "s", folder), {}, warnings);
}

const std::string kAll =
    R"("textures": { "n": { "color": [0.5, 0.5, 1] }, "s": { "color": 0.5 }, "g": { "color": [0, 0, 1] } },
    "materials": { "m": { "normal_map": { "texture": "n", "scale": [2, "t"], "space": "object" }, "specular_map": "s",
                          "glow_map": { "texture": "g", "rotate": 1 }, "shininess": 5 },
                   "n": { "normal_map": "n", "specular_map": "s", "specular": 0.2 } })";

TEST(SceneMaps, AreReadAndMove) {
  std::vector<Diagnostic> warnings;
  const Scene scene = built(kAll + R"(, "surfaces": { "s": { "type": "sphere" } },
    "nodes": [ { "surface": "s", "material": "m" }, { "surface": "s", "material": "n" } ])",
                            &warnings);
  EXPECT_TRUE(warnings.empty());
  const Snapshot snapshot = takeSnapshot(scene, 3, {8, 8});
  const Material &m = snapshot.materials.at(snapshot.nodes[0].material.index),
                 &n = snapshot.materials.at(snapshot.nodes[1].material.index);
  EXPECT_EQ(m.normalSpace, NormalSpace::Object);
  EXPECT_EQ(m.normalMap.scale, Vec2(2, 3));
  EXPECT_EQ(m.glowMap.angle, 1);
  EXPECT_EQ(m.glow, Vec3(1));
  EXPECT_EQ(m.specular, Vec3(1)) << "times what the map says";
  EXPECT_FALSE(m.map.valid());
  EXPECT_TRUE(m.specularMap.valid() && m.glowMap.valid() && m.drawsMaps());
  EXPECT_EQ(n.normalSpace, NormalSpace::Tangent);
  EXPECT_EQ(n.specular, Vec3(0.2));
}

TEST(SceneMaps, TheLessonsFormulaIsAShadingOfMaterials) {
  const std::string text = R"("materials": { "m": { "shading": "lesson", "shininess": 7 } },
    "surfaces": { "s": { "type": "sphere" } }, "nodes": [ { "surface": "s", "material": "m" } ])";
  const Snapshot snapshot = takeSnapshot(built(text), 0, {8, 8});
  const Material& material = snapshot.materials.at(snapshot.nodes[0].material.index);
  EXPECT_TRUE(material.drawsLesson());
  EXPECT_EQ(material.shadingIn(Shading::Toon), Shading::Exact);
  const SceneFile file = parseScene("{ \"luxo\": 1, " + text + " }", "s");
  EXPECT_EQ(file, parseScene(writeScene(file), "again"));
  EXPECT_TRUE(parseScene(writeScene(file), "again").materials[0].lesson);
  expectSceneError([&] { static_cast<void>(built(R"("render": { "shading": "lesson" })")); },
                   {"s:2:24", "exact"});
  expectSceneError([&] { static_cast<void>(built(R"("materials": { "m": { "shading": "leson" } })")); },
                   {"s:2:34", "lesson"});
  expectSceneError(
      [&] {
        static_cast<void>(built(R"("materials": { "m": { "shading": "lesson", "diffuse": ["u", 0, 0] } })"));
      },
      {"s:2:", "lesson's formula"});
  std::vector<Diagnostic> warnings;
  static_cast<void>(built(
      R"("materials": { "m": { "shading": "lesson", "opacity": 0.5 } }, "nodes": [ { "material": "m" } ])",
      &warnings));
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].message.find("lesson's formula"), std::string::npos);
  // Nothing comes through what multiplies by its opacity of 1.
  warnings.clear();
  static_cast<void>(built(
      R"("materials": { "m": { "shading": "lesson", "blend": "multiply" } }, "nodes": [ { "material": "m" } ])",
      &warnings));
  EXPECT_TRUE(warnings.empty());
}

TEST(SceneMaps, AreWrittenAsTheyAreRead) {
  const SceneFile file = parseScene("{ \"luxo\": 1, " + kAll + " }", "s"),
                  again = parseScene(writeScene(file), "again");
  EXPECT_EQ(file, again) << writeScene(file);
}

TEST(SceneMaps, MistakesAreToldWithTheirPlace) {
  const std::pair<std::string, std::vector<std::string>> kMistakes[] = {
      {R"("materials": { "m": { "normal_map": "bumps" } })", {"s:2:37", "there is no texture 'bumps'"}},
      {R"("materials": { "m": { "glow_map": "lamp" } })", {"s:2:35", "there is no texture 'lamp'"}},
      {R"("textures": { "n": { "color": 1 } }, "materials": { "m": { "normal_map": { "texture": "n", "space": "objekt" } } })",
       {"s:2:", "object"}},
      {R"("textures": { "n": { "color": 1 } }, "materials": { "m": { "specular_map": { "texture": "n", "space": "object" } } })",
       {"s:2:", "space"}},
      {R"("textures": { "n": { "color": 1 } }, "materials": { "m": { "normal_map": { "scale": [1, 1] } } })",
       {"s:2:", "texture"}},
      {R"("textures": { "n": { "file": "n.png" } }, "materials": { "m": { "normal_map": "n" } })",
       {"s:2:", "is read as colours", "\"data\": true"}},
      {R"("textures": { "w": { "color": 1 } }, "materials": { "m": { "diffuse": ["u", 0, 0], "glow_map": "w" } })",
       {"s:2:", "there is a map, too"}},
  };
  for (const auto& mistake : kMistakes)
    expectSceneError([&] { static_cast<void>(built(mistake.first)); }, mistake.second);
}

class MeshFolder : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() /
              ("luxo_maps_" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::create_directories(folder_);
    std::ofstream(folder_ / "flat.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    std::ofstream(folder_ / "mapped.obj")
        << "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n";
  }
  void TearDown() override { fs::remove_all(folder_); }

  [[nodiscard]] std::vector<Diagnostic> warningsOf(const std::string& mesh, const std::string& space,
                                                   bool tangents) const {
    std::vector<Diagnostic> warnings;
    const Scene scene = built(R"("textures": { "n": { "color": [0.5, 0.5, 1] } },
      "materials": { "m": { "normal_map": { "texture": "n", "space": ")" +
                                  space + R"(" } } },
      "surfaces": { "s": { "type": "mesh", "file": ")" +
                                  mesh + R"(" } }, "nodes": [ { "surface": "s", "material": "m" } ])",
                              &warnings, folder_);
    EXPECT_EQ(!takeSnapshot(scene, 0, {8, 8}).nodes[0].surface.triangles()->mesh.tangents().empty(),
              tangents);
    return warnings;
  }

  fs::path folder_;
};

TEST_F(MeshFolder, MeshesHaveTangentsWhereAMapAsksForThem) {
  EXPECT_TRUE(warningsOf("mapped.obj", "tangent", true).empty());
  EXPECT_TRUE(warningsOf("mapped.obj", "object", false).empty());
  EXPECT_TRUE(warningsOf("flat.obj", "object", false).empty());
  const std::vector<Diagnostic> warnings = warningsOf("flat.obj", "tangent", false);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].message.find("has no uvs"), std::string::npos);
}

}  // namespace
}  // namespace luxo::test
