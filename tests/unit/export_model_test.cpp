// SPDX-License-Identifier: Apache-2.0
// Exported scenes against mathematics: what is proven of their triangles holds, what is closed is closed.
#include "export/exported_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <map>
#include <memory>
#include <random>

#include "catalogue_names.h"
#include "export/carried_scene.h"
#include "image/png.h"
#include "scene/model_files.h"
#include "scene/model_scene.h"
#include "scene/normal_map.h"
#include "scene/scene_builder.h"
#include "scene/scene_reader.h"
#include "scene/shader_files.h"
#include "scene/texture_files.h"
#include "surface/catalogue.h"
#include "surface/library.h"
#include "unit/image_test_support.h"
#include "unit/scene_test_support.h"

namespace luxo {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

Scene sceneOf(const Surface& surface, Node node = {}) {
  Scene scene;
  node.name = "body";
  node.surface = surface;
  scene.add(std::move(node));
  return scene;
}

/// Every triangle, in the world.
std::vector<std::array<Vec3, 3>> trianglesOf(const Model& model) {
  std::vector<std::array<Vec3, 3>> triangles;
  for (std::uint32_t n = 0; n < model.nodes.size(); ++n) {
    if (model.nodes[n].mesh == kNone) continue;
    const TriangleMesh& mesh = model.meshes[model.nodes[n].mesh];
    const Transform place = worldFromNodeAt(model, n);
    const std::size_t second = mirrors(place) ? 2 : 1;
    for (std::size_t i = 0; i < mesh.indices().size(); i += 3) {
      const auto at = [&](std::size_t k) { return transformPoint(place, mesh.point(mesh.indices()[i + k])); };
      triangles.push_back({at(0), at(second), at(3 - second)});
    }
  }
  return triangles;
}

double volumeOf(const Model& model) {
  double sum = 0;
  for (const auto& [a, b, c] : trianglesOf(model)) sum += glm::dot(a, glm::cross(b, c));
  return sum / 6;
}

/// How many triangles go along each edge, a pair of points, one way and the other.
using Point = std::array<double, 3>;
std::map<std::pair<Point, Point>, std::pair<int, int>> edgesOf(const Model& model) {
  std::map<std::pair<Point, Point>, std::pair<int, int>> uses;
  for (const auto& corners : trianglesOf(model))
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 &p = corners[k], &q = corners[(k + 1) % 3];
      const Point a{p.x, p.y, p.z}, b{q.x, q.y, q.z};
      ++(a < b ? uses[{a, b}].first : uses[{b, a}].second);
    }
  return uses;
}

/// Edges that have not two triangles which go along them in opposite directions.
std::size_t badEdges(const Model& model) {
  return std::size_t(std::ranges::count_if(edgesOf(model), [](const auto& use) {
    return use.second != std::pair<int, int>{1, 1};
  }));
}

/// Edges that have not two triangles, whichever way they go along them: a one-sided surface has some that
/// both go along the same way.
std::size_t unsharedEdges(const Model& model) {
  return std::size_t(std::ranges::count_if(
      edgesOf(model), [](const auto& use) { return use.second.first + use.second.second != 2; }));
}

/// The largest of a distance over points of every triangle.
template <class Distance>
double farthest(const Model& model, const Distance& distance) {
  constexpr int kParts = 6;
  double most = 0;
  for (const auto& [a, b, c] : trianglesOf(model))
    for (int i = 0; i <= kParts; ++i)
      for (int j = 0; i + j <= kParts; ++j)
        most = std::max(most, std::abs(distance((double(i) * a + double(j) * b + double(kParts - i - j) * c) /
                                                double(kParts))));
  return most;
}

double fromTorus(const Vec3& p, double major, double minor) {
  return std::hypot(std::hypot(p.x, p.z) - major, p.y) - minor;
}

TEST(ExportedModel, ASphereIsWithinTheToleranceAndEnclosesItsVolume) {
  const Scene scene = sceneOf(sphere(2), {.translation = Vec3(1, 0, 0), .scale = Vec3(-3)});
  for (const double tolerance : {1e-1, 1e-2, 1e-3}) {
    const ExportedModel made = exportedModel(scene, 0, {.tolerance = tolerance});
    const double deviation = made.claim.deviation;
    EXPECT_LE(deviation, tolerance);
    EXPECT_GT(deviation, tolerance / 20);
    const double measured =
        farthest(made.model, [](const Vec3& p) { return glm::length(p - Vec3(1, 0, 0)) - 6; });
    EXPECT_LE(measured, deviation);
    EXPECT_GT(measured, deviation / 5);
    EXPECT_TRUE(made.claim.closed);
    EXPECT_EQ(badEdges(made.model), 0U);
    EXPECT_NEAR(volumeOf(made.model), 4 * kPi / 3 * 216, deviation * 4 * kPi * 36);
    EXPECT_EQ(made.warnings.size(), 0U);
  }
}

TEST(ExportedModel, ATorusToo) {
  const ExportedModel made = exportedModel(sceneOf(torus(2, 0.5)), 0, {.tolerance = 1e-3});
  EXPECT_LE(made.claim.deviation, 1e-3);
  EXPECT_LE(farthest(made.model, [](const Vec3& p) { return fromTorus(p, 2, 0.5); }), made.claim.deviation);
  EXPECT_EQ(badEdges(made.model), 0U);
  EXPECT_NEAR(volumeOf(made.model), 2 * kPi * kPi * 2 * 0.25, made.claim.deviation * 4 * kPi * kPi);
}

// A finer tolerance than floats can keep is met as far as they can, and that is said.
TEST(ExportedModel, WhatRoundingMovesIsPartOfTheClaim) {
  const Scene scene = sceneOf(torus(2, 0.5), {.translation = Vec3(1000, 0, 0)});
  const double there = exportedModel(scene, 0, {.tolerance = 1e-4}).claim.deviation;
  EXPECT_LE(there, 1e-4);
  const ExportedModel rounded = exportedModel(scene, 0, {.tolerance = 1e-4, .kept = Kept::Triangles});
  EXPECT_GT(rounded.claim.deviation, 1e-4);
  EXPECT_LT(rounded.claim.deviation, 2e-4);
  for (const ModelFile& file : filesOf(rounded.model, "a.stl")) {
    double most = 0;
    for (std::size_t at = 84; at + 50 <= file.bytes.size(); at += 50) {
      float v[3];
      std::memcpy(v, file.bytes.data() + at + 12, sizeof v);
      most = std::max(most, std::abs(fromTorus(Vec3(v[0] - 1000.0, v[1], v[2]), 2, 0.5)));
    }
    EXPECT_GT(most, 1e-6);  // corners were on the surface
    EXPECT_LE(most, rounded.claim.deviation);
  }
}

class ExportedCatalogue : public testing::TestWithParam<std::string> {
 protected:
  [[nodiscard]] static const CatalogueEntry& entry() { return *findCatalogueEntry(GetParam()); }
};

// Seams and poles are one line and one point, to the bit.
TEST_P(ExportedCatalogue, WhatIsClosedIsClosed) {
  const Surface surface = makeSurface(entry());
  const double size = glm::length(surface.framing({}).extent());
  const ExportedModel made = exportedModel(sceneOf(surface), 0, {.tolerance = size / 500});
  EXPECT_EQ(made.claim.closed, surface.closed());
  if (surface.closed()) {
    EXPECT_EQ(badEdges(made.model), 0U);
    EXPECT_GT(volumeOf(made.model), 0);
  }
  // Steiner's surface passes through itself along lines of the grid.
  if (entry().borderless && entry().name != "steiner_roman") {
    EXPECT_EQ(unsharedEdges(made.model), 0U);
  }
}

// Sheets become plates whose every edge has two triangles, whose volume is that of area times thickness.
TEST_P(ExportedCatalogue, WhatIsOpenIsThickened) {
  const Surface surface = makeSurface(entry());
  const double size = glm::length(surface.framing({}).extent());
  const ExportedModel made =
      exportedModel(sceneOf(surface), 0, {.tolerance = size / 500, .thickness = size / 200});
  EXPECT_TRUE(made.claim.closed);
  EXPECT_EQ(made.claim.thickness, surface.closed() ? 0 : size / 200);
  // These pass through themselves along lines of the grid: their edges have more than two triangles there.
  if (entry().name != "steiner_roman" && entry().name != "whitney_umbrella") {
    EXPECT_EQ(badEdges(made.model), 0U);
  }
}

INSTANTIATE_TEST_SUITE_P(All, ExportedCatalogue, testing::ValuesIn(catalogueNames()),
                         [](const auto& test) { return test.param; });

/// The volume of a surface made this thick.
double plateVolume(const Surface& surface, double tolerance, double thickness) {
  return volumeOf(exportedModel(sceneOf(surface), 0, {.tolerance = tolerance, .thickness = thickness}).model);
}

TEST(ExportedModel, PlatesHaveTheirThickness) {
  EXPECT_NEAR(plateVolume(rectangle(2, 3), 1e-3, 0.25), 1.5, 1e-6);
  // A pipe between two cylinders; a spherical shell's half would do as well.
  EXPECT_NEAR(plateVolume(cylinder(1, 2), 1e-5, 0.2), 2 * kPi * (1.1 * 1.1 - 0.9 * 0.9), 1e-3);
  EXPECT_NEAR(plateVolume(paraboloid(1, 1), 1e-4, 1e-3) / plateVolume(paraboloid(1, 1), 1e-4, 2e-3), 0.5,
              1e-3);
  // Without two sides, as long as it is thin: area times thickness.
  const Surface strip = makeSurface("mobius");
  const double thin = plateVolume(strip, 1e-4, 1e-3), thick = plateVolume(strip, 1e-4, 2e-3);
  EXPECT_GT(thin, 0);
  EXPECT_NEAR(thick / thin, 2, 1e-2);
}

// The walls of a box keep the thickness where they meet: their faces do where planes would.
TEST(ExportedModel, PlatesMeetInTheirEdges) {
  const Scene scene = buildScene(parseScene(R"scene({ "luxo": 1,
    "surfaces": { "roof": { "type": "formula", "u": [-1, 1], "v": [0, 2], "position": ["u", "-abs(u)", "v"] } },
    "nodes": [ { "surface": "roof" } ] })scene",
                                            "scene"));
  const ExportedModel made = exportedModel(scene, 0, {.tolerance = 1e-3, .thickness = 0.2});
  double top = -10, bottom = 10;
  for (const auto& corners : trianglesOf(made.model))
    for (const Vec3& p : corners)
      if (std::abs(p.x) < 1e-9) {
        top = std::max(top, p.y);
        bottom = std::min(bottom, p.y);
      }
  EXPECT_NEAR(top, 0.1 * std::sqrt(2.0), 1e-6);
  EXPECT_NEAR(bottom, -0.1 * std::sqrt(2.0), 1e-6);
  EXPECT_EQ(badEdges(made.model), 0U);
  EXPECT_EQ(made.warnings.size(), 0U);
}

TEST(ExportedModel, PlatesThatFoldAreToldOf) {
  const ExportedModel made =
      exportedModel(sceneOf(cylinder(0.1, 1)), 0, {.tolerance = 1e-3, .thickness = 0.5});
  EXPECT_THAT(made.warnings, Contains(HasSubstr("bends more sharply than half its thickness")));
}

TEST(ExportedModel, TrianglesStayWhatTheyAre) {
  const TriangleMesh quad = triangleMesh(
      {.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, .indices = {0, 1, 2, 0, 2, 3}});
  const ExportedModel made = exportedModel(sceneOf(Surface(quad)), 0, {.tolerance = 1e-3});
  ASSERT_EQ(made.model.meshes.size(), 1U);
  EXPECT_EQ(made.model.meshes[0].triangleCount(), 2U);
  EXPECT_LT(made.claim.deviation, 1e-6);
  EXPECT_FALSE(made.claim.closed);
}

TEST(ExportedModel, WithoutAToleranceItIsAPartOfTheScene) {
  const double deviation = exportedModel(sceneOf(sphere(2)), 0, {}).claim.deviation;
  EXPECT_LE(deviation, std::sqrt(3.0) * 4 / 2000 * 1.01);
  EXPECT_GT(deviation, std::sqrt(3.0) * 4 / 2000 / 20);
}

TEST(ExportedModel, NodesOfOneSurfaceAndMaterialShareAMesh) {
  Scene scene = sceneOf(sphere(1));
  const Surface shared = scene[NodeId{0}].surface;
  scene.add(Node{.name = "beside", .translation = Vec3(3, 0, 0), .surface = shared});
  scene.add(Node{.name = "red",
                 .surface = shared,
                 .material = scene.add(Material{.name = "red", .diffuse = {1, 0, 0}})});
  scene.add(Node{.name = "hidden", .surface = shared, .visible = false});
  const Model model = exportedModel(scene, 0, {}).model;
  ASSERT_EQ(model.nodes.size(), 3U);
  EXPECT_EQ(model.meshes.size(), 2U);
  EXPECT_EQ(model.nodes[0].mesh, model.nodes[1].mesh);
  EXPECT_EQ(model.nodes[1].translation, Vec3(3, 0, 0));
  EXPECT_EQ(model.materials.at(model.meshes[model.nodes[2].mesh].groups()[0].material).diffuse,
            Vec3(1, 0, 0));
}

TEST(ExportedModel, AShearedNodeStandsInTheWorld) {
  Scene scene;
  const NodeId outer = scene.add(Node{.scale = Vec3(1, 3, 1)});
  scene.add(Node{.parent = outer, .rotation = Rotation{{0, 0, 1}, 0.6}, .surface = sphere(1)});
  const ExportedModel made = exportedModel(scene, 0, {.tolerance = 1e-3});
  ASSERT_EQ(made.model.nodes.size(), 1U);
  EXPECT_EQ(badEdges(made.model), 0U);
  EXPECT_NEAR(volumeOf(made.model), 4 * kPi, made.claim.deviation * 40);
  // An ellipsoid: along y a third, and what is left is the sphere.
  EXPECT_LE(farthest(made.model, [](const Vec3& p) { return glm::length(Vec3(p.x, p.y / 3, p.z)) - 1; }),
            made.claim.deviation);
}

TEST(ExportedModel, CamerasAndLightsComeAlong) {
  Scene scene = sceneOf(sphere(1));
  scene.add(Camera{.name = "front", .eye = Vec3(0, 0, 5), .fovY = 0.7});
  const CameraId plan = scene.add(
      Camera{.name = "plan", .eye = Vec3(0, 7, 0), .projection = Projection::Orthographic, .height = 4.0});
  scene.add(
      Node{.name = "sun",
           .rotation = Rotation{{1, 0, 0}, -kPi / 2},
           .light = Light{.type = Light::Type::Directional, .color = Vec3(1, 0.5, 0), .intensity = 2.0}});
  scene.add(Node{.name = "bulb",
                 .translation = Vec3(0, 4, 0),
                 .light = Light{.intensity = 8.0, .attenuation = Light::Attenuation::InverseSquare}});
  scene.add(Node{.name = "lecture", .translation = Vec3(0, 0, 3), .light = Light{}});
  const ExportedModel made = exportedModel(scene, 0, {.camera = plan});
  const Model& model = made.model;
  ASSERT_EQ(model.cameras.size(), 2U);
  EXPECT_EQ(model.cameras[0].name, "plan");
  EXPECT_NEAR(model.cameras[0].height, 4, 1e-12);
  EXPECT_NEAR(model.cameras[1].fovY, 0.7, 1e-12);
  const auto node = [&](const std::string& name) {
    return std::uint32_t(std::ranges::find(model.nodes, name, &ModelNode::name) - model.nodes.begin());
  };
  test::expectNear(transformDirection(worldFromNodeAt(model, node("plan")), {0, 0, -1}), {0, -1, 0}, 1e-12);
  test::expectNear(worldFromNodeAt(model, node("front")).translation, {0, 0, 5}, 1e-12);
  ASSERT_EQ(model.lights.size(), 3U);
  const ModelLight& sun = model.lights[model.nodes[node("sun")].light];
  EXPECT_TRUE(sun.directional);
  EXPECT_EQ(sun.color, Vec3(1, 0.5, 0));
  EXPECT_NEAR(sun.intensity, 2 * kPi, 1e-12);
  test::expectNear(transformDirection(worldFromNodeAt(model, node("sun")), {0, 0, -1}), {0, -1, 0}, 1e-12);
  EXPECT_NEAR(model.lights[model.nodes[node("bulb")].light].intensity, 8 * kPi, 1e-12);
  EXPECT_NEAR(model.lights[model.nodes[node("lecture")].light].intensity, 9 * kPi, 1e-12);
  EXPECT_THAT(made.warnings, Contains(HasSubstr("'lecture' is as bright everywhere")));
}

/// What is read back shines as the scene's does: candela, half-angles, where from and where to.
TEST(ExportedModel, SpotsReadBackTheSame) {
  Scene scene = sceneOf(sphere(1));
  const NodeId arm = scene.add(Node{.translation = Vec3(1, 2, 3), .rotation = Rotation{{1, 2, 3}, 0.8}});
  scene.add(Node{.name = "stage",
                 .parent = arm,
                 .translation = Vec3(0.5, 4, 0),
                 .rotation = Rotation{{1, 0, 0}, -1.2},
                 .light = Light{.color = Vec3(1, 0.5, 0.25),
                                .intensity = 8.0,
                                .attenuation = Light::Attenuation::InverseSquare,
                                .spot = Spot{0.2, 0.6}}});
  scene.add(Node{.name = "soft",
                 .translation = Vec3(0, 5, 0),
                 .light = Light{.attenuation = Light::Attenuation::InverseSquare,
                                .spot = Spot{0.0, kPi / 2},
                                .shadow = Light::Shadow::Exact,
                                .radius = 0.1}});
  const ExportedModel made = exportedModel(scene, 0, {});
  EXPECT_THAT(made.warnings, ElementsAre(HasSubstr("'soft': its shadow is not exported")));
  const FilesInMemory files = {{"a.glb", std::make_shared<const std::vector<std::byte>>(
                                             filesOf(made.model, "a.glb", made.claim).at(0).bytes)}};
  const auto read = std::make_shared<const Model>(readModel("a.glb", {.from = FileSource(files)}));
  EXPECT_TRUE(read->warnings.empty());
  const auto byCone = [](std::vector<SnapshotLight> lights) {
    std::ranges::sort(lights, {}, [](const SnapshotLight& light) { return light.cone.value().outer; });
    return lights;
  };
  const std::vector<SnapshotLight> before = byCone(takeSnapshot(scene, 0, {64, 64}, CameraId{}, 1).lights),
                                   after = byCone(takeSnapshot(modelScene(read), 0, {64, 64}).lights);
  ASSERT_EQ(before.size(), 2U);
  ASSERT_EQ(after.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    test::expectNear(after[i].radiance, before[i].radiance, 1e-12);
    test::expectNear(Vec3(after[i].positionWorld), Vec3(before[i].positionWorld), 1e-12);
    test::expectNear(after[i].cone->axis, before[i].cone->axis, 1e-12);
    EXPECT_NEAR(after[i].cone->inner, before[i].cone->inner, 1e-15);
    EXPECT_NEAR(after[i].cone->outer, before[i].cone->outer, 1e-15);
  }
}

TEST(ExportedModel, AColourThatIsAFormulaBecomesItsMean) {
  const Scene scene = buildScene(parseScene(R"scene({ "luxo": 1,
    "materials": { "shades": { "diffuse": ["u", 0.5, 0], "opacity": 0.5 } },
    "surfaces": { "sheet": { "type": "formula", "u": [0, 1], "v": [0, 1], "position": ["u", "u*v", "v"] } },
    "nodes": [ { "surface": "sheet", "material": "shades" } ] })scene",
                                            "scene"));
  const ExportedModel made = exportedModel(scene, 0, {.tolerance = 1e-3});
  ASSERT_EQ(made.model.materials.size(), 1U);
  test::expectNear(made.model.materials[0].diffuse, {0.5, 0.5, 0}, 1e-9);
  EXPECT_NEAR(made.model.materials[0].opacity, 0.5, 1e-12);
  EXPECT_THAT(made.warnings, Contains(HasSubstr("its colour is a formula")));
}

/// Read again, the image is the same, and lies where it lay.
TEST(ExportedModel, MapsGoAlongIntoAGlb) {
  const Scene scene = buildScene(parseScene(R"scene({ "luxo": 1,
    "textures": { "tiles": { "checker": ["#ff8800", "#002244"], "squares": 4, "wrap": "mirror" } },
    "materials": { "tiled": { "map": { "texture": "tiles", "offset": [0.2, 0.1], "scale": [3, 2], "rotate": "30deg" } } },
    "surfaces": { "sheet": { "type": "formula", "u": [-1, 3], "v": [2, 4], "position": ["u", "0.1*u*v", "v"] } },
    "nodes": [ { "surface": "sheet", "material": "tiled" } ] })scene",
                                            "scene"));
  const ExportedModel made = exportedModel(scene, 0, {.tolerance = 1e-2});
  EXPECT_TRUE(made.warnings.empty());
  const ScratchFolder folder;
  const std::filesystem::path file = folder / "sheet.glb";
  const std::vector<std::byte> bytes = filesOf(made.model, file, made.claim).at(0).bytes;
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  const auto model = std::make_shared<const Model>(readModel(file));
  const Snapshot before = takeSnapshot(scene, 0, {8, 8}), after = takeSnapshot(modelScene(model), 0, {8, 8});
  const TextureMap &written = before.materials[before.nodes[0].material.index].map,
                   &read = after.materials[after.nodes[0].material.index].map;
  ASSERT_TRUE(read.valid());
  EXPECT_EQ(read.wrapU, TextureWrap::Mirror);
  EXPECT_FALSE(after.materials[after.nodes[0].material.index].glowMap.valid());
  const TextureLevel &texels = written.texture->levels[0], &again = read.texture->levels[0];
  ASSERT_EQ(again.width, texels.width);
  // What is made of 8-bit codes becomes the same codes.
  EXPECT_EQ(again.halves, texels.halves);
  const TexturePlacement on = written.on(before.nodes[0].surface), onAgain = read.on(after.nodes[0].surface);
  const TriangleMesh& mesh = model->meshes[0];
  ASSERT_EQ(mesh.uvs().size(), mesh.positions().size());
  for (std::uint32_t i = 0; i < mesh.positions().size(); ++i) {
    const Vec3 point = transformPoint(
        worldFromNodeAt(*model, static_cast<std::uint32_t>(model->nodes.size() - 1)), mesh.point(i));
    const Vec2 expected = on.linear * Vec2(point.x, point.z) + on.constant;
    EXPECT_LT(glm::distance(onAgain.linear * Vec2(mesh.uvs()[i]) + onAgain.constant, expected), 1e-6);
  }
}

/// Read again, normals bend as they did, but for the triangles' tangents, and highlights have their colours.
TEST(ExportedModel, MapsOfNormalsAndHighlightsGoAlong) {
  const ScratchFolder folder;
  const auto write = [](const std::filesystem::path& file, const std::vector<std::byte>& bytes) {
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  };
  Image bumps(4, 4, 3);
  std::mt19937 random(7);
  for (float& sample : bumps.samples()) sample = float(random() % 256) / 255;
  write(folder / "bumps.png", encodePng(bumps, Codes::Data));
  std::ofstream(folder / "s.luxo.json") << R"scene({ "luxo": 1,
    "textures": { "bumps": { "file": "bumps.png", "data": true } },
    "materials": { "rough": { "normal_map": { "texture": "bumps", "scale": [2, 1], "rotate": "90deg" },
                              "specular_map": "bumps" } },
    "surfaces": { "sheet": { "type": "formula", "u": [-1, 1], "v": [-1, 1],
                             "position": ["u + 0.3*v", "0.1*u*v", "v"] } },
    "nodes": [ { "surface": "sheet", "material": "rough" } ] })scene";
  const Scene scene = buildScene(readSceneFile(folder / "s.luxo.json"));
  const ExportedModel made = exportedModel(scene, 0, {.tolerance = 1e-4});
  EXPECT_TRUE(made.warnings.empty());
  const std::vector<std::byte> bytes = filesOf(made.model, "s.glb", made.claim).at(0).bytes;
  write(folder / "s.glb", bytes);
  // Other programs need not make their own.
  EXPECT_EQ(made.model.meshes[0].tangents().size(), made.model.meshes[0].positions().size());
  EXPECT_THAT(std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()),
              testing::HasSubstr(R"("TANGENT")"));
  const auto model = std::make_shared<const Model>(readModel(folder / "s.glb"));
  const Snapshot before = takeSnapshot(scene, 0, {8, 8}), after = takeSnapshot(modelScene(model), 0, {8, 8});
  const Material &written = before.materials[before.nodes[0].material.index],
                 &read = after.materials[after.nodes[0].material.index];
  EXPECT_EQ(read.normalMap.texture->levels[0].halves, written.normalMap.texture->levels[0].halves);

  // The highlight's colours went through sRGB codes of 8 bits: half a code where the curve is flattest.
  for (int i = 0; i < 16; ++i)
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(read.specularMap.texture->levels[0].texel(i % 4, i / 4)[std::size_t(c)],
                  written.specularMap.texture->levels[0].texel(i % 4, i / 4)[std::size_t(c)],
                  0.5 * 2.28 / 255 + 1e-3);

  const TriangleMesh& mesh = model->meshes[0];
  ASSERT_EQ(mesh.tangents().size(), mesh.positions().size());
  for (std::uint32_t i = 0; i < mesh.positions().size(); ++i) {
    const Vec3 p = mesh.point(i);
    const double v = p.z, u = p.x - 0.3 * v;
    const Vec3 su(1, 0.1 * v, 0), sv(0.3, 0.1 * u, 1), normal = unit(glm::cross(su, sv));
    const NormalFrame exact = normalFrame(su, sv, normal, false);
    const Vec4f& tangent = mesh.tangents()[i];
    const Vec3 texel(0.9, 0.3, 0.7);
    const Vec3 expected = bentNormal(written, normalFromTexel(written, Mat3(1)), texel, normal, exact);
    const Vec3 bent = bentNormal(read, normalFromTexel(read, Mat3(1)), texel, Vec3(mesh.normals()[i]),
                                 NormalFrame(tangent));
    // The directions of its edges differ from the surface's by their length times its twist.
    EXPECT_LT(glm::distance(bent, expected), 0.001) << i;
  }
}

TEST(ExportedModel, MapsThatAreLeftOutAreTold) {
  const Scene scene = buildScene(parseScene(R"scene({ "luxo": 1,
    "textures": { "tiles": { "checker": [0, 1] } },
    "materials": { "tiled": { "map": "tiles", "normal_map": { "texture": "tiles", "space": "object" } } },
    "surfaces": { "sheet": { "type": "rectangle" } },
    "nodes": [ { "surface": "sheet", "material": "tiled" } ] })scene",
                                            "scene"));
  EXPECT_THAT(exportedModel(scene, 0, {.kept = Kept::Colours}).warnings,
              Contains(HasSubstr("its map is not exported")));
  EXPECT_THAT(exportedModel(scene, 0, {}).warnings,
              ElementsAre(HasSubstr("normal_map, in the axes of the object,")));
  EXPECT_THAT(exportedModel(scene, 0, {.thickness = 0.1}).warnings,
              Contains(HasSubstr("its map is not exported")));
}

TEST(ExportedModel, WhatAGlbHasNoWordForIsTold) {
  const Scene scene = buildScene(parseScene(R"scene({ "luxo": 1,
    "render": { "shading": "flat", "ambient_occlusion": { "radius": 1 } },
    "materials": { "m": { "specular": 1, "shininess": 2, "lecture_specular": true, "shading": "toon",
                          "isolines": [ { "of": "u", "step": 0.1 } ] } },
    "surfaces": { "s": { "type": "sphere" } },
    "nodes": [ { "surface": "s", "material": "m" },
               { "name": "sun", "light": { "type": "directional", "shadow": "exact" } } ] })scene",
                                            "scene"));
  const std::vector<std::string> told = exportedModel(scene, 0, {}).warnings;
  for (const char* what : {"its shading", "its isolines", "its lecture_specular", "its highlights are weaker",
                           "the scene's shading, flat,", "ambient occlusion", "light 'sun': its shadow"})
    EXPECT_THAT(told, Contains(HasSubstr(what)));
}

/// A ball keeps its map where a plate of the same material has none, whichever comes first.
TEST(ExportedModel, APlateDoesNotTakeTheMapFromOthers) {
  for (const char* nodes :
       {R"([ { "surface": "ball", "material": "tiled" }, { "surface": "sheet", "material": "tiled" } ])",
        R"([ { "surface": "sheet", "material": "tiled" }, { "surface": "ball", "material": "tiled" } ])"}) {
    const Scene scene = buildScene(parseScene(std::string(R"scene({ "luxo": 1,
      "textures": { "tiles": { "checker": [0, 1] } },
      "materials": { "tiled": { "map": "tiles", "two_sided": true } },
      "surfaces": { "sheet": { "type": "rectangle" }, "ball": { "type": "sphere", "radius": 1 } },
      "nodes": )scene") + nodes + "}",
                                              "scene"));
    const Model model = exportedModel(scene, 0, {.tolerance = 0.1, .thickness = 0.1}).model;
    for (const TriangleMesh& mesh : model.meshes)
      EXPECT_EQ(model.materials[mesh.groups()[0].material].map.given(), !mesh.uvs().empty()) << mesh.name();
    EXPECT_EQ(
        std::ranges::count_if(model.meshes, [](const TriangleMesh& mesh) { return mesh.uvs().empty(); }), 1);
  }
}

TEST(ExportedModel, WhatIsNotProvenIsSaid) {
  const Scene holed = buildScene(parseScene(R"scene({ "luxo": 1,
    "surfaces": { "cap": { "type": "formula", "u": [-1, 1], "v": [-1, 1],
                           "position": ["u", "sqrt(1 - u^2 - v^2)", "v"] } },
    "nodes": [ { "surface": "cap" } ] })scene",
                                            "scene"));
  const ExportedModel made = exportedModel(holed, 0, {.tolerance = 1e-2});
  EXPECT_TRUE(std::isinf(made.claim.deviation));
  EXPECT_FALSE(made.claim.closed);
  EXPECT_THAT(made.warnings, Contains(HasSubstr("triangles are missing")));
  Scene empty;
  test::expectSceneError([&] { (void)exportedModel(empty, 0, {}); }, {"shows no surface"});
}

TEST(ExportedModel, TellsHowFarItIs) {
  Scene scene = sceneOf(sphere(1));
  scene.add(Node{.surface = sphere(2)});
  std::vector<double> told;
  (void)exportedModel(scene, 0, {.progress = [&](double part) { told.push_back(part); }});
  EXPECT_EQ(told, (std::vector<double>{0.5, 1}));
}

const char* const kCarried = R"scene({ "luxo": 1,
  "params": { "k": 3, "half": "k/2" },
  "surfaces": { "wave": { "type": "formula", "u": [-1, 1], "v": [-1, 1], "position": ["u", "half*sin(k*u+t)", "v"] } },
  "nodes": [ { "surface": "wave" } ] })scene";

TEST(CarriedScene, DescribesTheSame) {
  const SceneFile file = parseScene(kCarried, "scene");
  EXPECT_EQ(parseScene(carriedScene(file).text, "again"), file);
  const ParameterOverride five{"k", Quantity(5)};
  SceneFile other = parseScene(carriedScene(file, {&five, 1}, 2.5).text, "again");
  EXPECT_EQ(other.parameters[0].value, Quantity(5));
  EXPECT_EQ(other.render.time, Quantity(2.5));
  other.parameters[0].value = 3;
  other.render.time = 0;
  EXPECT_EQ(other, file);
}

/// By the names that the scene has for them, and that they have for each other, in a folder or in none.
TEST(CarriedScene, TakesItsFilesAlong) {
  const ScratchFolder folder;
  const auto write = [&](const char* name, const std::string& text) {
    std::filesystem::create_directories((folder / name).parent_path());
    std::ofstream(folder / name) << text;
  };
  const auto png = encodePng(Image(2, 2, 3), Codes::Srgb);
  const std::string image(reinterpret_cast<const char*>(png.data()), png.size());
  write("in/wood.png", image);
  write("skin.png", image);
  write("in/look/m.frag", "#include \"lib/a.glsl\"\nvec4 material(Point p) { return vec4(1); }\n");
  write("in/look/lib/a.glsl", "");
  write("in/b/head.obj", "mtllib ../head.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl a\nf 1/1 2/1 3/1\n");
  write("in/head.mtl", "newmtl a\nmap_Kd ../../skin.png\nmap_Ks missing.png\n");
  write("in/s.luxo.json", R"scene({ "luxo": 1, "textures": { "t": { "file": "./wood.png" } },
    "materials": { "m": { "map": "t" }, "n": { "shader": "look/m.frag" } },
    "surfaces": { "s": { "type": "sphere" } },
    "nodes": [ { "surface": "s", "material": "m" }, { "surface": "s", "material": "n" }, { "model": "b/../b/head.obj" } ] })scene");
  SceneFile file = readSceneFile(folder / "in/s.luxo.json", {.allowOutside = true});
  const Snapshot before = takeSnapshot(buildScene(file), 0, {8, 8});
  CarriedScene carried = carriedScene(file);
  std::vector<std::string> names;
  for (const auto& [name, bytes] : carried.files) names.push_back(name);
  EXPECT_THAT(names, testing::UnorderedElementsAre("wood.png", "../skin.png", "look/m.frag",
                                                   "look/lib/a.glsl", "b/head.obj", "head.mtl"));
  for (int again = 0; again < 2; ++again) {  // from what was carried, too
    file = parseScene(carried.text, "again", {}, {.from = FileSource(carried.files)});
    const Snapshot after = takeSnapshot(buildScene(file), 0, {8, 8});
    ASSERT_EQ(after.materials.size(), before.materials.size());
    for (std::size_t i = 0; i < before.materials.size(); ++i) {
      EXPECT_EQ(after.materials[i].map.valid(), before.materials[i].map.valid()) << i;
      EXPECT_EQ(after.materials[i].shader != nullptr, before.materials[i].shader != nullptr) << i;
    }
    EXPECT_TRUE(file.source.models->files().empty() && file.source.shaders->files().empty() &&
                file.source.textures->files().empty());  // on disk
    carried = carriedScene(file);
    EXPECT_EQ(carried.files.size(), names.size());
  }
}

}  // namespace
}  // namespace luxo
