// SPDX-License-Identifier: Apache-2.0
// Models as scenes, and as surfaces of scene files.
#include "scene/model_scene.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "image/image.h"
#include "image/png.h"
#include "image_test_support.h"
#include "scene/model_files.h"
#include "scene/scene_builder.h"
#include "scene/scene_reader.h"
#include "scene_test_support.h"
#include "support/meshes.h"
#include "surface/surface_triangles.h"

namespace luxo {
namespace {

using test::expectNear;
using test::expectSceneError;

Vec4 turn(const Vec3& axis, double angle) { return {std::sin(angle / 2) * axis, std::cos(angle / 2)}; }

/// Two quads on one node that turns, one of each material; a ball below it, mirrored; a camera and a light.
Model lampModel() {
  MeshArrays arrays{.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}},
                    .indices = {0, 1, 2, 0, 2, 3},
                    .materials = {0, 1}};
  Model model{.name = "lamp"};
  model.meshes = {triangleMesh(std::move(arrays), "halves"), test::icosphere(1)};
  model.materials = {{.name = "red", .diffuse = {1, 0, 0}},
                     {.name = "blue", .diffuse = {0, 0, 1}, .twoSided = true}};
  model.nodes = {{.name = "arm", .translation = {0, 2, 0}, .mesh = 0},
                 {.name = "bulb", .parent = 0, .translation = {3, 0, 0}, .scale = {-1, 1, 1}, .mesh = 1},
                 {.name = "eye", .translation = {0, 0, 9}, .rotation = turn({0, 1, 0}, kPi / 2), .camera = 0},
                 {.name = "sun", .light = 0}};
  model.nodes[0].rotationKeys =
      Keyframes{.times = {0, 1}, .values = {turn({0, 0, 1}, 0), turn({0, 0, 1}, kPi / 2)}};
  model.cameras = {{.name = "eye", .fovY = 0.5, .near = 0.2}};
  model.lights = {{.name = "sun", .directional = true, .color = {1, 0.5, 0.25}, .intensity = 2 * kPi}};
  return model;
}

TEST(ModelScene, HasTheModelsNodesMaterialsCamerasAndLights) {
  const Scene scene = modelScene(std::make_shared<const Model>(lampModel()));
  const Snapshot still = takeSnapshot(scene, 0, {64, 64}), later = takeSnapshot(scene, 1, {64, 64});
  ASSERT_EQ(still.nodes.size(), 3U);  // two parts and the ball
  EXPECT_EQ(still.materials[still.nodes[0].material.index].name, "red");
  EXPECT_EQ(still.materials[still.nodes[1].material.index].name, "blue");
  EXPECT_EQ(still.materials[still.nodes[1].material.index].twoSided, TwoSided::Yes);
  EXPECT_EQ(still.nodes[0].surface.triangles()->count, 1U);
  expectNear(still.nodes[2].worldFromObject.translation, {3, 2, 0}, 1e-12);
  expectNear(later.nodes[2].worldFromObject.translation, {0, 5, 0}, 1e-12);
  expectNear(later.nodes[2].worldFromObject.linear[0], {0, -1, 0}, 1e-12);
  EXPECT_TRUE(scene.movesWithTime());
  expectNear(still.view.eye, {0, 0, 9}, 1e-12);
  expectNear(still.view.forward(), {-1, 0, 0}, 1e-12);
  ASSERT_EQ(still.lights.size(), 1U);
  expectNear(Vec3(still.lights[0].positionWorld), {0, 0, 1}, 1e-12);
  expectNear(still.lights[0].radiance, {2, 1, 0.5}, 1e-12);
}

TEST(ModelScene, WithoutLightsHasTwoThatLightWhatAFittedCameraSees) {
  Model model = lampModel();
  model.lights.clear();
  model.nodes.pop_back();
  const Snapshot snapshot =
      takeSnapshot(modelScene(std::make_shared<const Model>(std::move(model))), 0, {64, 64});
  ASSERT_EQ(snapshot.lights.size(), 2U);
  for (const SnapshotLight& light : snapshot.lights)
    EXPECT_GT(glm::dot(Vec3(light.positionWorld), unit(Vec3(1, 0.8, 1.5))), 0.3);
}

TEST(AddModel, StandsBelowItsNodeWithItsOwnLightsAndNoCameras) {
  const auto model = std::make_shared<const Model>(lampModel());
  Scene scene;
  const NodeId here = scene.add(Node{.name = "here", .translation = Vec3(10, 0, 0)});
  std::vector<MaterialId> materials;
  const std::vector<NodeId> parts = addModel(scene, here, model, materials);
  ASSERT_EQ(parts.size(), 3U);  // two parts and the ball
  for (const double time : {0.0, 1.0}) {
    const Snapshot alone = takeSnapshot(modelScene(model), time, {64, 64}),
                   below = takeSnapshot(scene, time, {64, 64});
    ASSERT_EQ(below.nodes.size(), alone.nodes.size());
    for (std::size_t i = 0; i < alone.nodes.size(); ++i) {
      expectNear(below.nodes[i].worldFromObject.translation,
                 alone.nodes[i].worldFromObject.translation + Vec3(10, 0, 0), 1e-12);
      EXPECT_EQ(below.materials[below.nodes[i].material.index].name,
                alone.materials[alone.nodes[i].material.index].name);
    }
    EXPECT_EQ(below.lights.size(), 1U);
  }
  EXPECT_EQ(scene[scene[parts[0]].parent].name, "here/arm");
  EXPECT_EQ(scene[parts[2]].name, "here/bulb");
  EXPECT_TRUE(scene.cameras().empty());
}

/// Two triangles of two materials, in a scene file's folder.
class NodeWithAModel : public testing::Test {
 protected:
  NodeWithAModel() {
    write("pair.obj",
          "mtllib pair.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nusemtl red\nf 1 2 3\nusemtl blue\nf 1 2 4\n");
    write("pair.mtl", "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n");
  }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }
  [[nodiscard]] Scene sceneOf(const std::string& node) const {
    return buildScene(parseScene(R"({ "luxo": 1, "surfaces": { "ball": { "type": "sphere", "radius": 1 } },
      "nodes": [ { "translate": [0, 9, 0], "light": { "shadow": "exact", "casters": ["pair"] } }, )" +
                                     node + R"(, { "surface": "ball" } ] })",
                                 "pairs.json", folder_.path()));
  }

  ScratchFolder folder_;
};

TEST_F(NodeWithAModel, HasTheModelsMaterialsAndCastsShadowsAsAWhole) {
  const Scene scene = sceneOf(R"({ "name": "pair", "model": "pair.obj", "scale": [2, 2, 2] })");
  const Snapshot snapshot = takeSnapshot(scene, 0, {64, 64});
  ASSERT_EQ(snapshot.nodes.size(), 3U);  // of the file's, then the model's
  const auto colorOf = [&](std::size_t i) {
    return snapshot.materials[snapshot.nodes[i].material.index].diffuse;
  };
  EXPECT_EQ(colorOf(1), Vec3(1, 0, 0));
  EXPECT_EQ(colorOf(2), Vec3(0, 0, 1));
  EXPECT_EQ(snapshot.nodes[1].worldFromObject.linear[0], Vec3(2, 0, 0));
  ASSERT_EQ(snapshot.lights.size(), 1U);
  EXPECT_EQ(snapshot.lights[0].casters, (std::vector{snapshot.nodes[1].id, snapshot.nodes[2].id}));
}

TEST_F(NodeWithAModel, TwoOfOneModelShareItsMaterials) {
  const Scene scene = sceneOf(R"({ "name": "pair", "model": "pair.obj" }, { "model": "pair.obj" })");
  const Snapshot snapshot = takeSnapshot(scene, 0, {64, 64});
  ASSERT_EQ(snapshot.nodes.size(), 5U);
  EXPECT_EQ(snapshot.nodes[1].material.index, snapshot.nodes[3].material.index);
  EXPECT_EQ(snapshot.nodes[2].material.index, snapshot.nodes[4].material.index);
}

TEST_F(NodeWithAModel, WhatIsWrongHasItsPlace) {
  expectSceneError([&] { static_cast<void>(sceneOf(R"({ "name": "pair", "model": "none.obj" })")); },
                   {"none.obj", "pairs.json:2:"});
  expectSceneError([&] { static_cast<void>(sceneOf(R"({ "name": "pair", "model": "../pair.obj" })")); },
                   {"../pair.obj", "pairs.json:2:"});
  expectSceneError(
      [&] { static_cast<void>(sceneOf(R"({ "name": "pair", "model": "pair.obj", "surface": "ball" })")); },
      {"a model, or a surface", "pairs.json:2:"});
}

TEST(ModelSurface, IsAllOfTheModelAtRest) {
  const Model model = lampModel();
  const Surface surface = surfaceOf(model);
  EXPECT_EQ(surface.triangles()->count, 2 + model.meshes[1].triangleCount());
  EXPECT_NEAR(surface.bounds({}).max.x, 4, 1e-6);  // the ball around (3, 2, 0)
  // Mirrored fronts are fronts: the volume of the ball is above 0.
  double volume = 0;
  for (std::uint32_t i = 0; i < surface.triangles()->count; ++i) {
    const auto [a, b, c] = surface.triangles()->points(i);
    volume += glm::dot(a - Vec3(3, 2, 0), glm::cross(b - Vec3(3, 2, 0), c - Vec3(3, 2, 0))) / 6;
  }
  EXPECT_NEAR(volume, 4 * kPi / 3, 0.7);
}

TEST(ModelSurface, OneMeshAtOnePlaceIsThatMesh) {
  Model model{.meshes = {test::quadMesh()}, .nodes = {{.mesh = 0}}};
  EXPECT_EQ(surfaceOf(model).triangles()->mesh, model.meshes[0]);
  expectSceneError([] { static_cast<void>(surfaceOf(Model{.name = "void"})); }, {"'void' has no triangles"});
}

TEST(ModelFiles, LeadNowhereElse) {
  ModelFiles files("models");
  for (const char* name : {"../a.obj", "/tmp/a.obj", "sub/../../a.obj", ""})
    expectSceneError([&] { static_cast<void>(files.get(name, {})); },
                     {"the model '" + std::string(name) + "'"});
}

TEST(ModelFiles, MayBeOutsideWhereThatIsAllowed) {
  const ScratchFolder folder;
  std::filesystem::create_directory(folder / "inner");
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 2 0\nf 1 2 3\n";
  std::ofstream(folder / "a.obj") << triangle;
  std::ofstream(folder / "inner/b.obj") << "mtllib ../a.mtl\n" << triangle;
  std::ofstream(folder / "a.mtl") << "newmtl a\n";
  double told = 0;
  ModelFiles files(folder / "inner", {.allowOutside = true, .progress = [&](double done) { told = done; }});
  EXPECT_EQ(files.get("../a.obj", {})->triangleCount(), 1U);
  EXPECT_EQ(files.get((folder / "a.obj").string(), {})->triangleCount(), 1U);
  EXPECT_TRUE(files.get("b.obj", {})->warnings.empty());
  EXPECT_EQ(told, 1);
  ModelFiles inside(folder / "inner");
  expectSceneError([&] { static_cast<void>(inside.get("b.obj", {})); }, {"outside"});
}

TEST(ModelFiles, ProblemsHaveThePlaceInTheScene) {
  SceneFile file;
  file.surfaces = {{.name = "s", .shape = MeshShape{.file = "missing.obj"}}};
  file.nodes = {NodeDesc{.surface = "s"}};
  expectSceneError([&] { static_cast<void>(buildScene(file)); }, {"missing.obj"});
}

/// A mesh has what surfaces have.
TEST(SurfaceOfTriangles, KnowsItsBoundsRangeAndShape) {
  const Surface quad = test::quadMesh(), cube = test::cubeMesh();
  EXPECT_EQ(quad.name(), "quad");
  EXPECT_EQ(quad.patchCount(), 0U);
  EXPECT_TRUE(quad.isPolygonal());
  EXPECT_FALSE(quad.isParametric());
  EXPECT_TRUE(quad.topology().orientable);
  EXPECT_EQ(quad.bounds({}), (Box{{-1, -1, 0}, {1, 1, 0}}));
  EXPECT_EQ(quad.domain(), (Domain{{0, 1}, {0, 1}}));
  EXPECT_EQ(quad.flatNormal(), std::optional(Vec3(0, 0, 1)));
  EXPECT_FALSE(quad.closed());
  EXPECT_TRUE(cube.closed());
  EXPECT_FALSE(cube.flatNormal());
  EXPECT_EQ(cube.framing({}), (Box{Vec3(-1), Vec3(1)}));
  EXPECT_NE(quad.identity(), Surface(test::quadMesh()).identity());
}

TEST(SurfaceOfTriangles, IsFittedIntoThePicture) {
  Scene scene;
  scene.add(Node{.translation = Vec3(1e3, 0, 0), .surface = test::icosphere(6)});  // 81,920 triangles
  const Snapshot snapshot = takeSnapshot(scene, 0, {200, 100});
  double reach = 0;
  for (int i = 0; i < 4000; ++i) {
    const double z = 1 - (i + 0.5) / 2000, phi = i * 2.4, r = std::sqrt(1 - z * z);
    const Vec3 point = Vec3(1e3, 0, 0) + Vec3(r * std::cos(phi), r * std::sin(phi), z);
    const Vec2 pixel = pixelFromEye(snapshot.view, eyeFromWorldPoint(snapshot.view, point));
    reach = std::max({reach, std::abs(pixel.x - 100) / 100, std::abs(pixel.y - 50) / 50});
  }
  EXPECT_NEAR(reach, 0.85, 0.02);
}

/// glTF's MASK: by the alpha of a map, where it has some; of a material without one all or nothing.
TEST(ModelScene, CutsOpacitiesOff) {
  const auto made = [](double opacity, bool mapped, float alpha) {
    Model model = lampModel();
    model.images = {{.name = "leaf.png",
                     .bytes = std::make_shared<const std::vector<std::byte>>(
                         encodePng(Image(2, 1, 4, {1, 0, 0, 1, 0, 1, 0, alpha})))}};
    ModelMaterial& material = model.materials[0];
    material.opacity = opacity;
    material.cutoff = 0.5;
    material.opacityFromMap = mapped;
    if (mapped) material.map.image = 0;
    const Snapshot snapshot =
        takeSnapshot(modelScene(std::make_shared<const Model>(std::move(model))), 0, {64, 64});
    return snapshot.materials.at(snapshot.nodes.at(0).material.index);
  };
  const Material leaf = made(0.8, true, 0.2f);
  EXPECT_TRUE(leaf.mapOpacity);
  EXPECT_EQ(leaf.cutoff, 0.5);
  EXPECT_EQ(leaf.opacity, 0.8);
  EXPECT_TRUE(leaf.transparent());
  for (const Material& whole : {made(0.8, true, 1), made(0.5, false, 1)}) {
    EXPECT_FALSE(whole.transparent());
    EXPECT_EQ(whole.opacity, 1);
  }
  EXPECT_TRUE(made(0.4, false, 1).invisible());
}

TEST(ModelScene, HasTheColoursMaps) {
  Model model = lampModel();
  Image image(2, 1, 3, {1, 0, 0, 0, 1, 0});
  model.images = {
      {.name = "two.png", .bytes = std::make_shared<const std::vector<std::byte>>(encodePng(image))}};
  ModelMap& map = model.materials[0].map;
  map = {.image = 0,
         .wrapU = ModelMap::Wrap::Mirror,
         .nearest = true,
         .offset = {0.5, 0},
         .scale = {2, 3},
         .angle = 1};
  const Snapshot snapshot =
      takeSnapshot(modelScene(std::make_shared<const Model>(std::move(model))), 0, {64, 64});
  const TextureMap& drawn = snapshot.materials.at(snapshot.nodes.at(0).material.index).map;
  ASSERT_TRUE(drawn.valid());
  EXPECT_EQ(drawn.texture->levels[0].texel(1, 0), (std::array<float, 4>{0, 1, 0, 1}));
  EXPECT_EQ(drawn.wrapU, TextureWrap::Mirror);
  EXPECT_EQ(drawn.wrapV, TextureWrap::Repeat);
  EXPECT_EQ(drawn.filter, TextureFilter::Nearest);
  EXPECT_EQ(drawn.offset, Vec2(0.5, 0));
  EXPECT_EQ(drawn.scale, Vec2(2, 3));
  EXPECT_EQ(drawn.angle, 1);
}

TEST(ModelScene, NodesHangAsDeepAsTheyLike) {
  Model model = lampModel();
  model.nodes.resize(1);
  for (std::uint32_t i = 1; i < 200'000; ++i)
    model.nodes.push_back({.parent = i - 1, .translation = {0, 0, 1}, .camera = i < 199'999 ? kNone : 0});
  const auto deep = std::make_shared<const Model>(std::move(model));
  const Snapshot still = takeSnapshot(modelScene(deep), 0, {64, 64});
  expectNear(still.view.eye, {0, 2, 199'999}, 1e-6);
  expectNear(takeSnapshot(modelScene(deep), 1, {64, 64}).view.up(), {-1, 0, 0}, 1e-6);
  EXPECT_EQ(surfaceOf(*deep).triangles()->mesh.triangleCount(), 2U);
}

TEST(ModelScene, RefusesImagesByWhatNamesThem) {
  Model model = lampModel();
  const std::string text = "this is no image";
  const auto bytes = std::as_bytes(std::span(text));
  model.images = {{.name = "leaf",
                   .place = "lamp.glb: images[3]",
                   .bytes = std::make_shared<const std::vector<std::byte>>(bytes.begin(), bytes.end())}};
  model.materials[0].map.image = 0;
  expectSceneError([&] { static_cast<void>(modelScene(std::make_shared<const Model>(model))); },
                   {"lamp.glb: images[3]: cannot read 'leaf': it is neither PNG, JPEG nor TGA"});
}

}  // namespace
}  // namespace luxo
