// SPDX-License-Identifier: Apache-2.0
// What a file has no room for is told, and nothing else; what it has comes back.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <random>

#include "export/exported_model.h"
#include "image/file.h"
#include "image/png.h"
#include "reference/reference.h"
#include "scene/model_scene.h"
#include "scene/scene_builder.h"
#include "scene/scene_reader.h"
#include "scene/snapshot.h"
#include "unit/image_test_support.h"

namespace luxo {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

using Warnings = std::vector<std::string>;

Scene sceneOf(const std::string& text) {
  return buildScene(parseScene("{ \"luxo\": 1, " + text + " }", "scene"));
}

/// Of an export into a file of that name.
Warnings warningsOf(const Scene& scene, const char* file, double time = 0) {
  return exportedModel(scene, time, {.tolerance = 0.05, .kept = keptBy(file)}).warnings;
}

constexpr const char* kFormats[] = {"a.glb", "a.obj", "a.ply", "a.stl"};

TEST(ExportLosses, NothingIsToldOfWhatIsKept) {
  const Scene plain =
      sceneOf(R"("surfaces": { "s": { "type": "sphere" } }, "nodes": [ { "surface": "s" } ])");
  const Scene coloured = sceneOf(R"("materials": { "m": { "diffuse": [1, 0.5, 0] } },
    "surfaces": { "s": { "type": "sphere" } }, "nodes": [ { "surface": "s", "material": "m" } ])");
  const Scene shiny = sceneOf(R"("materials": { "m": { "specular": 0.3, "shininess": 9, "opacity": 0.5 } },
    "surfaces": { "s": { "type": "sphere" } }, "nodes": [ { "surface": "s", "material": "m" } ])");
  for (const char* file : kFormats) EXPECT_THAT(warningsOf(plain, file), IsEmpty()) << file;
  for (const char* file : {"a.glb", "a.obj", "a.ply"})
    EXPECT_THAT(warningsOf(coloured, file), IsEmpty()) << file;
  EXPECT_THAT(warningsOf(coloured, "a.stl"), ElementsAre("the file has no room for materials"));
  for (const char* file : {"a.glb", "a.obj"}) EXPECT_THAT(warningsOf(shiny, file), IsEmpty()) << file;
  const Scene bulb = sceneOf(R"("surfaces": { "s": { "type": "sphere" } },
    "nodes": [ { "surface": "s" }, { "light": { "type": "directional" } } ])");
  const ExportDesc lit{.tolerance = 0.05, .kept = Kept::Triangles},
      litByLuxo{.tolerance = 0.05, .kept = Kept::Triangles, .ownLights = false};
  EXPECT_THAT(exportedModel(bulb, 0, lit).warnings, ElementsAre("the file has no room for lights"));
  EXPECT_THAT(exportedModel(bulb, 0, litByLuxo).warnings, IsEmpty());
  EXPECT_THAT(warningsOf(shiny, "a.ply"),
              ElementsAre("the file has no room for materials but their colours"));
}

/// Of triangles alone nothing of what their materials and lights would have lost.
TEST(ExportLosses, WhatHasNoRoomIsToldOnce) {
  const Scene scene = sceneOf(R"scene("textures": { "tiles": { "checker": [0, 1] } },
    "materials": { "shades": { "diffuse": ["u", 0.5, 0], "blend": "add", "opacity": 0.5 },
                   "tiled": { "map": "tiles", "normal_map": "tiles", "isolines": [ { "of": "u", "step": 0.1 } ] } },
    "surfaces": { "s": { "type": "rectangle" } },
    "nodes": [ { "surface": "s", "material": "shades" }, { "surface": "s", "material": "tiled" },
               { "name": "bulb", "translate": [0, 3, 0], "light": { "type": "point" } } ],
    "camera": { "eye": [0, 1, 5] })scene");
  EXPECT_THAT(warningsOf(scene, "a.stl"), ElementsAre("the file has no room for materials, cameras, lights"));
  EXPECT_THAT(warningsOf(scene, "a.ply"),
              ElementsAre(HasSubstr("its colour is a formula"), "material 'tiled': its map is not exported",
                          "the file has no room for materials but their colours, cameras, lights"));
  const Warnings obj = warningsOf(scene, "a.obj");
  for (const char* told : {"its colour is a formula", "blends as 'over'", "its isolines", "cameras, lights"})
    EXPECT_THAT(obj, Contains(HasSubstr(told)));
  for (const char* kept : {"materials", "its map", "its normal_map", "falls off"})
    EXPECT_THAT(obj, Not(Contains(HasSubstr(kept))));
  const Warnings glb = warningsOf(scene, "a.glb");
  EXPECT_THAT(glb, Contains(HasSubstr("'bulb' is as bright everywhere")));
  EXPECT_THAT(glb, Not(Contains(HasSubstr("no room"))));
  // A PLY has lost nothing else of these.
  const auto ply = [](const std::string& material) {
    return warningsOf(sceneOf(R"("textures": { "tiles": { "checker": [0, 1] } }, "materials": { "m": { )" +
                              material + R"( } }, "surfaces": { "s": { "type": "rectangle" } },
                              "nodes": [ { "surface": "s", "material": "m" } ])"),
                      "a.ply");
  };
  const char* const others = "the file has no room for materials but their colours";
  EXPECT_THAT(ply(R"("diffuse": ["u", 0, 0])"), ElementsAre(HasSubstr("its colour is a formula")));
  EXPECT_THAT(ply(R"("map": "tiles")"), ElementsAre("material 'm': its map is not exported"));
  EXPECT_THAT(ply(R"("diffuse": ["u", 0, 0], "shininess": 9)"),
              ElementsAre(HasSubstr("its colour is a formula"), others));
  EXPECT_THAT(ply(R"("diffuse": ["u", 0, 0], "opacity": "v")"),
              ElementsAre(HasSubstr("its colour is a formula"), others));
}

/// What is not exported has lost nothing.
TEST(ExportLosses, NothingIsToldOfWhatIsInvisible) {
  const Scene scene =
      sceneOf(R"("materials": { "air": { "diffuse": [1, 0, 0], "specular": 1, "opacity": 0 } },
    "surfaces": { "s": { "type": "sphere" } },
    "nodes": [ { "surface": "s" }, { "surface": "s", "material": "air" } ])");
  for (const char* file : kFormats) EXPECT_THAT(warningsOf(scene, file), IsEmpty()) << file;
}

/// By each format that keeps materials, which are lit otherwise there.
TEST(ExportLosses, ShadingIsTold) {
  const Scene scene = sceneOf(R"("render": { "shading": "toon", "ambient_occlusion": { "radius": 1 } },
    "surfaces": { "s": { "type": "sphere" } }, "nodes": [ { "surface": "s" } ])");
  for (const char* file : {"a.glb", "a.obj"})
    EXPECT_THAT(warningsOf(scene, file), ElementsAre("the scene's shading, toon, is not exported",
                                                     "ambient occlusion is not exported"))
        << file;
  for (const char* file : {"a.ply", "a.stl"}) EXPECT_THAT(warningsOf(scene, file), IsEmpty()) << file;
}

/// Whether a movement is told of, file by file.
std::vector<bool> toldToStand(const std::string& text) {
  std::vector<bool> told;
  for (const char* file : kFormats)
    told.push_back(std::ranges::any_of(warningsOf(sceneOf(text), file, 2.5), [](const std::string& warning) {
      return warning.starts_with("the triangles stand still, as they are at 2.5 s");
    }));
  return told;
}

TEST(ExportLosses, WhatMovesStandsStillAndThatIsTold) {
  const std::string ball = R"("surfaces": { "s": { "type": "sphere" } }, )";
  const auto nodes = [&](const std::string& node) { return ball + R"("nodes": [ )" + node + " ]"; };
  const std::vector<bool> all(4, true), none(4, false), glb{true, false, false, false};
  EXPECT_EQ(toldToStand(nodes(R"({ "surface": "s" })")), none);
  EXPECT_EQ(toldToStand(nodes(R"({ "surface": "s", "translate": ["t", 0, 0] })")), all);
  EXPECT_EQ(toldToStand(nodes(R"({ "scale": ["1 + 0.1*t", 1, 1], "children": [ { "surface": "s" } ] })")),
            all);
  EXPECT_EQ(toldToStand(R"("surfaces": { "s": { "type": "sphere", "radius": "1 + 0.1*t" } },
                           "nodes": [ { "surface": "s" } ])"),
            all);
  EXPECT_EQ(toldToStand(R"("params": { "r": "1 + 0.1*t" },
                           "surfaces": { "s": { "type": "sphere", "radius": "r" } },
                           "nodes": [ { "surface": "s" } ])"),
            all);
  EXPECT_EQ(toldToStand(R"("params": { "r": 2 }, "surfaces": { "s": { "type": "sphere", "radius": "r" } },
                           "nodes": [ { "surface": "s" } ])"),
            none);
  // What these formats have no room for does not stand still in them.
  EXPECT_EQ(toldToStand(nodes(R"({ "surface": "s" })") + R"x(, "camera": { "eye": ["3*sin(t)", 1, 5] })x"),
            glb);
  EXPECT_EQ(
      toldToStand(nodes(R"({ "surface": "s" }, { "translate": ["t", 3, 0], "light": { "type": "point" } })")),
      glb);
  EXPECT_EQ(toldToStand(R"("materials": { "m": { "diffuse": ["0.1*t", 0, 0] } }, )" +
                        nodes(R"({ "surface": "s", "material": "m" })")),
            (std::vector<bool>{true, true, true, false}));
}

/// Which parameters a value reads is not known: of one that may read what moves no more than that is said.
TEST(ExportLosses, WhatParametersMayMoveIsTold) {
  const auto told = [](const std::string& radius, const char* file) {
    return warningsOf(sceneOf(R"x("params": { "a": "0.5 + 0.1*sin(t)", "b": 2 },
                                 "surfaces": { "s": { "type": "sphere", "radius": )x" +
                              radius + R"( } }, "nodes": [ { "surface": "s" } ])"),
                      file, 2.5);
  };
  const char* const still = "the triangles stand still, as they are at 2.5 s";
  for (const char* file : {"a.obj", "a.ply", "a.stl"}) {
    EXPECT_THAT(told("2", file), IsEmpty()) << file;
    EXPECT_THAT(told(R"("b")", file), ElementsAre(std::string(still) + "; parameters may move them")) << file;
    EXPECT_THAT(told(R"("b + t")", file), ElementsAre(still)) << file;
  }
  EXPECT_THAT(told(R"("a")", "a.glb"), ElementsAre(still));
}

/// A model that moves in its file stands still in the next.
TEST(ExportLosses, AnimatedModelsStandStill) {
  Model model;
  model.meshes = {triangleMesh({.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, .indices = {0, 1, 2}})};
  model.materials = {{.name = "m"}};
  model.nodes = {{.name = "n", .mesh = 0}};
  model.ambient = Vec3(0.1);
  model.nodes[0].translationKeys = Keyframes{.times = {0, 1}, .values = {Vec4(0), Vec4(1)}};
  const Scene scene = modelScene(std::make_shared<const Model>(model));
  for (const char* file : kFormats)
    EXPECT_THAT(warningsOf(scene, file), ElementsAre("the triangles stand still, as they are at 0 s"))
        << file;
}

class ExportMaps : public testing::Test {
 protected:
  /// Every texel differs from the others, so that none can stand for another.
  void SetUp() override {
    Image noise(5, 3, 3);
    std::mt19937 random(3);
    for (float& sample : noise.samples()) sample = float(random() % 256) / 255;
    writeFileAtomically(folder_ / "noise.png", encodePng(noise, Codes::Data));
  }

  Scene scene(const std::string& material, const std::string& texture = R"("wrap": "repeat")") const {
    return buildScene(parseScene(R"scene({ "luxo": 1, "textures": {
        "colours": { "file": "noise.png", )scene" +
                                     texture + R"scene( },
        "numbers": { "file": "noise.png", "data": true } },
      "materials": { "m": { )scene" + material +
                                     R"scene( } },
      "surfaces": { "sheet": { "type": "formula", "u": [-1, 3], "v": [2, 4], "position": ["u", "0.1*u*v", "v"] } },
      "nodes": [ { "surface": "sheet", "material": "m" } ] })scene",
                                 "scene", folder_.path()));
  }
  [[nodiscard]] ExportedModel exported(const Scene& scene) const {
    return exportedModel(scene, 0, {.tolerance = 1e-3, .kept = Kept::Materials});
  }
  [[nodiscard]] Model writtenAndRead(const ExportedModel& made, const char* name = "a sheet.obj") const {
    for (const ModelFile& file : filesOf(made.model, folder_ / name, made.claim))
      writeFileAtomically(file.path, file.bytes);
    return readModel(folder_ / name);
  }

  ScratchFolder folder_;
};

/// Read again, every map has its texels, and each point of the surface the same place in it.
TEST_F(ExportMaps, GoAlongIntoAnObj) {
  Scene scene = this->scene(R"("diffuse": 0.7, "specular": [0.2, 0.5, 1], "shininess": 12,
    "map": { "texture": "colours", "offset": [0.2, 0.1], "scale": [3, 2] }, "glow_map": "colours",
    "specular_map": { "texture": "numbers", "offset": [-0.25, 0.5] },
    "normal_map": { "texture": "numbers", "scale": [2, 1] })",
                            R"("wrap": "clamp")");
  Material material = scene[MaterialId{1}].at({0, {}});
  material.normalScale = 0.5;  // as models have them
  material.glow = {0.5, 1, 0.25};
  scene.set(MaterialId{1}, material);
  const ExportedModel made = exported(scene);
  EXPECT_THAT(made.warnings, IsEmpty());
  const auto model = std::make_shared<const Model>(writtenAndRead(made));
  EXPECT_THAT(model->warnings, IsEmpty());
  EXPECT_EQ(model->images.size(), 2U);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "a sheet_map1.png"));
  const Snapshot before = takeSnapshot(scene, 0, {8, 8}), after = takeSnapshot(modelScene(model), 0, {8, 8});
  const Material &written = before.materials[before.nodes[0].material.index],
                 &read = after.materials[after.nodes[0].material.index];
  EXPECT_EQ(read.diffuse, written.diffuse);
  EXPECT_EQ(read.specular, written.specular);
  EXPECT_EQ(read.shininess, written.shininess);
  EXPECT_EQ(read.glow, written.glow);
  EXPECT_EQ(read.normalScale, written.normalScale);
  const TriangleMesh& mesh = model->meshes[0];
  ASSERT_EQ(mesh.uvs().size(), mesh.positions().size());
  for (std::size_t k = 0; k < 4; ++k) {
    const TextureMap &from = *written.maps()[k], &to = *read.maps()[k];
    ASSERT_TRUE(to.valid()) << k;
    EXPECT_EQ(to.texture->levels[0].halves, from.texture->levels[0].halves) << k;
    EXPECT_EQ(to.wrapU, from.wrapU) << k;
    EXPECT_EQ(to.wrapV, from.wrapV) << k;
    const TexturePlacement on = from.on(before.nodes[0].surface), onAgain = to.on(after.nodes[0].surface);
    for (std::uint32_t i = 0; i < mesh.positions().size(); ++i) {
      const Vec3 point = mesh.point(i);
      EXPECT_LT(glm::distance(onAgain.linear * Vec2(mesh.uvs()[i]) + onAgain.constant,
                              on.linear * Vec2(point.x, point.z) + on.constant),
                2e-6)
          << k << " " << i;
    }
  }
}

/// Though an MTL has words for what begins like these.
TEST_F(ExportMaps, AreFoundWhateverTheFileIsCalled) {
  const ExportedModel made = exported(scene(R"("map": "colours", "normal_map": "numbers")"));
  for (const char* name : {"-x.obj", "-o.obj", "#x.obj", "# x.obj"}) {
    const Model model = writtenAndRead(made, name);
    EXPECT_THAT(model.warnings, IsEmpty()) << name;
    EXPECT_TRUE(model.materials[0].map.given() && model.materials[0].normalMap.given()) << name;
  }
}

/// Under the same light, from the same place. Without its maps it is another picture.
TEST_F(ExportMaps, GiveTheSamePictureFromAnObj) {
  constexpr PixelSize kSize{48, 32};
  const auto pictureOf = [&](Scene shown) {
    shown.add(Camera{.eye = Vec3(1.5, 2, 6), .lookAt = Vec3(1, 0.3, 3)});
    shown.add(Node{.rotation = Rotation{{1, 0, 0}, -1}, .light = Light{.type = Light::Type::Directional}});
    return castPicture(takeSnapshot(shown, 0, kSize, CameraId{0})).color;
  };
  const auto meanDifference = [](const Image& a, const Image& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.samples().size(); ++i) sum += std::abs(a.samples()[i] - b.samples()[i]);
    return sum / double(a.samples().size());
  };
  const char* const plain = R"("diffuse": [0.7, 0.9, 0.4], "specular": 0.5)";
  const Scene scene = this->scene(std::string(plain) + R"(, "map": { "texture": "colours", "scale": [2, 1] },
    "normal_map": { "texture": "numbers", "offset": [0.1, 0.3] }, "specular_map": "numbers")");
  Model read = writtenAndRead(exported(scene));
  read.lights.emplace_back();  // of no node: no others are added
  const Image before = pictureOf(scene), after = pictureOf(modelScene(std::make_shared<const Model>(read)));
  EXPECT_LT(meanDifference(before, after), 0.002);
  EXPECT_GT(meanDifference(before, pictureOf(this->scene(plain))), 0.05);
}

TEST_F(ExportMaps, AnAlphaIsAnOpacityInAnObj) {
  Image holes(2, 2, 4);
  std::ranges::copy(std::initializer_list<float>{1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0.2f, 1, 1, 1, 0.8f},
                    holes.samples().begin());
  writeFileAtomically(folder_ / "noise.png", encodePng(holes));
  const char* const seenThrough = R"("map": { "texture": "colours", "alpha": true })";
  const ExportedModel made = exported(scene(seenThrough));
  EXPECT_THAT(made.warnings, IsEmpty());
  const Model model = writtenAndRead(made);
  EXPECT_TRUE(model.materials[0].map.given() && model.materials[0].opacityFromMap);
  EXPECT_EQ(model.materials[0].diffuse, Vec3(1));
  EXPECT_FALSE(writtenAndRead(exported(scene(R"("map": "colours")"))).materials[0].opacityFromMap);
  EXPECT_THAT(exported(scene(std::string(seenThrough) + R"(, "cutoff": 0.5)")).warnings,
              ElementsAre("material 'm': its cutoff is not exported"));
}

/// None is written that would lie elsewhere, or be read otherwise.
TEST_F(ExportMaps, ThatAnMtlCannotSayAreTold) {
  const auto told = [&](const std::string& material, const std::string& texture = R"("wrap": "repeat")") {
    const ExportedModel made = exported(scene(material, texture));
    EXPECT_THAT(writtenAndRead(made).images.size(), made.model.images.size());
    return made.warnings;
  };
  EXPECT_THAT(told(R"("map": { "texture": "colours", "rotate": "30deg" })"),
              ElementsAre("material 'm': its map is not exported"));
  EXPECT_THAT(told(R"("glow_map": "colours")", R"("wrap": "mirror")"),
              ElementsAre("material 'm': its glow_map is not exported"));
  EXPECT_THAT(told(R"("diffuse": 0, "map": "colours")"),
              ElementsAre("material 'm': its map is not exported"));
  EXPECT_THAT(told(R"("map": "colours")", R"("filter": "nearest")"),
              ElementsAre("material 'm': its filter, nearest, is not exported"));
  EXPECT_THAT(told(R"("normal_map": { "texture": "numbers", "space": "object" })"),
              ElementsAre("material 'm': its normal_map, in the axes of the object, is not exported"));
}

}  // namespace
}  // namespace luxo
