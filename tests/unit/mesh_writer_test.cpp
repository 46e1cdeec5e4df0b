// SPDX-License-Identifier: Apache-2.0
// Written models are read again: what a file keeps is what its format has room for.
#include "mesh/model_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <random>
#include <sstream>
#include <tuple>

#include "image/file.h"
#include "mesh/mesh_topology.h"
#include "unit/mesh_model_support.h"

namespace luxo {
namespace {

using ::testing::HasSubstr;

/// A cube of two materials and a ball that is mirrored, turned and far from its node's origin, below it.
Model twoBodies() {
  MeshArrays cube = cubeArrays();
  cube.materials = {0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1};
  Model model{.name = "bodies"};
  model.meshes = {triangleMesh(std::move(cube), "cube"), triangleMesh(ballArrays(12, 8, {50, 0, 0}), "ball")};
  model.materials = {
      {.name = "warm red", .diffuse = {0.5, 0.25, 0.125}, .specular = Vec3(0.3), .shininess = 40},
      {.name = "glass",
       .diffuse = {0.25, 0.5, 0.75},
       .specular = {0.2, 0.1, 0.05},
       .shininess = 7,
       .opacity = 0.5,
       .twoSided = true}};
  model.nodes = {{.name = "cube", .translation = {1, 2, 3}, .scale = Vec3(2), .mesh = 0},
                 {.name = "a ball",
                  .parent = 0,
                  .translation = {0, 5, 0},
                  .rotation = {0, 0, std::sqrt(0.5), std::sqrt(0.5)},
                  .scale = {-1, 1, 1},
                  .mesh = 1,
                  .camera = 0,
                  .light = 0}};
  model.cameras = {{.name = "eye", .fovY = 0.75, .near = 0.25}};
  model.lights = {{.name = "sun", .directional = true, .color = {1, 0.5, 0.25}, .intensity = 3},
                  {.name = "stage", .spot = ModelLight::Spot{0.125, 0.75}, .intensity = 5}};
  return model;
}

/// Six times the volume that the triangles of all nodes enclose, and twice their area.
std::pair<double, double> sizesOf(const Model& model) {
  double volume = 0, area = 0;
  for (std::uint32_t n = 0; n < model.nodes.size(); ++n) {
    if (model.nodes[n].mesh == kNone) continue;
    const TriangleMesh& mesh = model.meshes[model.nodes[n].mesh];
    const Transform place = worldFromNodeAt(model, n);
    for (std::size_t i = 0; i < mesh.indices().size(); i += 3) {
      const auto at = [&](std::size_t k) { return transformPoint(place, mesh.point(mesh.indices()[i + k])); };
      const double turned = mirrors(place) ? -1 : 1;
      volume += turned * glm::dot(at(0), glm::cross(at(1), at(2)));
      area += glm::length(glm::cross(at(1) - at(0), at(2) - at(0)));
    }
  }
  return {volume / 6, area / 2};
}

class WriteModel : public testing::Test {
 protected:
  Model written(const Model& model, const std::string& name, const LengthUnit& unit = {}) const {
    for (const ModelFile& file :
         filesOf(model, folder_ / name, {.deviation = 1e-5, .closed = true, .thickness = 0.5}, unit))
      writeFileAtomically(file.path, file.bytes);
    return readModel(folder_ / name);
  }
  std::string text(const std::string& name) const {
    std::ostringstream stream;
    stream << std::ifstream(folder_ / name, std::ios::binary).rdbuf();
    return stream.str();
  }

  ModelFolder folder_;
};

TEST_F(WriteModel, EveryFormatKeepsTheTrianglesAndWhatTheyEnclose) {
  const Model model = twoBodies();
  const auto [volume, area] = sizesOf(model);
  EXPECT_GT(volume, 8 * (8 + 3.0));
  for (const char* name : {"a.obj", "a.ply", "a.stl", "a.glb"}) {
    const Model read = written(model, name);
    // The reader has no use for the colours of a PLY, and says so.
    EXPECT_THAT(read.warnings, ::testing::SizeIs(name == std::string("a.ply") ? 1 : 0)) << name;
    EXPECT_EQ(read.triangleCount(), model.triangleCount()) << name;
    EXPECT_NEAR(sizesOf(read).first, volume, 1e-4) << name;
    EXPECT_NEAR(sizesOf(read).second, area, 1e-4) << name;
    for (const TriangleMesh& mesh : read.meshes) EXPECT_TRUE(mesh.closed()) << name;
  }
}

TEST_F(WriteModel, UnitsScaleWhatIsWritten) {
  const double volume = sizesOf(twoBodies()).first;
  for (const char* name : {"a.obj", "a.ply", "a.stl"})
    EXPECT_NEAR(sizesOf(written(twoBodies(), name, {"cm", 0.01})).first / 1e6, volume, 1e-4) << name;
  EXPECT_THROW(static_cast<void>(filesOf(twoBodies(), "a.glb", {}, {"cm", 0.01})), Error);
}

TEST_F(WriteModel, GlbKeepsNodesMaterialsCamerasLightsAndTheScene) {
  Model model = twoBodies();
  model.scene = "{ \"luxo\": 1 } // \xc3\xbc";
  const auto bytes = [](std::size_t count) {
    return std::make_shared<const std::vector<std::byte>>(count, std::byte(7));
  };
  model.sceneFiles = {{"a/b.png", bytes(5)}, {"empty", bytes(0)}};
  const Model read = written(model, "a.glb");
  EXPECT_EQ(read.scene, model.scene);
  ASSERT_EQ(read.sceneFiles.size(), 2U);
  for (const auto& [name, file] : model.sceneFiles) EXPECT_EQ(*read.sceneFiles.at(name), *file) << name;
  ASSERT_EQ(read.nodes.size(), 3U);  // one more, for the origin of the ball
  EXPECT_EQ(read.nodes[1].name, "a ball");
  EXPECT_EQ(read.nodes[1].parent, 0U);
  EXPECT_EQ(read.nodes[1].scale, Vec3(-1, 1, 1));
  EXPECT_EQ(read.nodes[1].camera, 0U);
  EXPECT_EQ(read.nodes[1].light, 0U);
  EXPECT_EQ(read.nodes[2].translation, Vec3(50, 0, 0));
  ASSERT_EQ(read.materials.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    const ModelMaterial &a = model.materials[i], &b = read.materials[i];
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.diffuse, b.diffuse);
    EXPECT_EQ(a.opacity, b.opacity);
    EXPECT_EQ(a.twoSided, b.twoSided);
    EXPECT_NEAR(a.shininess, b.shininess, 1e-9);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(a.specular[k], b.specular[k], 1e-12);
  }
  EXPECT_EQ(read.cameras.at(0).fovY, 0.75);
  EXPECT_EQ(read.cameras.at(0).near, 0.25);
  EXPECT_EQ(read.lights.at(0).color, Vec3(1, 0.5, 0.25));
  EXPECT_EQ(read.lights.at(0).intensity, 3);
  EXPECT_FALSE(read.lights.at(0).spot);
  EXPECT_FALSE(read.lights.at(1).directional);
  EXPECT_EQ(read.lights.at(1).spot.value().inner, 0.125);
  EXPECT_EQ(read.lights.at(1).spot.value().outer, 0.75);
  EXPECT_EQ(read.meshes.at(0).groups().size(), 2U);
}

TEST_F(WriteModel, ObjHasEachPointOnceAndItsMaterialsBesides) {
  const Model read = written(twoBodies(), "a.obj");
  ASSERT_EQ(read.materials.size(), 2U);
  for (const ModelMaterial& material : read.materials) {
    const bool glass = material.name.starts_with("glass");
    EXPECT_EQ(material.diffuse, twoBodies().materials[glass ? 1 : 0].diffuse);
    EXPECT_EQ(material.specular, twoBodies().materials[glass ? 1 : 0].specular);
    EXPECT_EQ(material.opacity, glass ? 0.5 : 1);
  }
  const std::string obj = text("a.obj");
  std::size_t points = 0;
  for (std::size_t at = obj.find("\nv "); at != std::string::npos; at = obj.find("\nv ", at + 1)) ++points;
  EXPECT_EQ(points, 8U + 12 * 7 + 2);
}

TEST_F(WriteModel, FilesSayWhatTheyAre) {
  for (const char* name : {"a.obj", "a.ply", "a.stl"}) {
    (void)written(twoBodies(), name, {"mm", 1e-3});
    EXPECT_THAT(text(name).substr(0, 300), HasSubstr("proven deviation 0.01001 mm, closed")) << name;
  }
  EXPECT_THAT(text("a.ply").substr(0, 300), HasSubstr("comment open surfaces are 500 mm thick"));
  (void)written(twoBodies(), "a.glb");
  EXPECT_THAT(text("a.glb"),
              HasSubstr(R"("extras":{"luxo":{"deviation":1e-05,"closed":true,"thickness":0.5}})"));
}

/// What is proven is not less than what is said, nor is more said than digits ask for.
TEST(ShownUpward, IsNoLessAndLessThanAUnitOfTheLastDigitMore) {
  EXPECT_EQ(shownUpward(0.125, {}, 3), "0.125 m");
  EXPECT_EQ(shownUpward(0.125, {}, 2), "0.13 m");
  EXPECT_EQ(shownUpward(0.1201, {}, 2), "0.13 m");
  EXPECT_EQ(shownUpward(9.9901, {}, 3), "10 m");
  EXPECT_EQ(shownUpward(0.75, {"cm", 0.01}, 1), "8e+01 cm");
  EXPECT_EQ(shownUpward(0, {}, 3), "0 m");
  EXPECT_EQ(shownUpward(std::numeric_limits<double>::denorm_min(), {}, 3), "4.94e-324 m");
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> exponent(-12, 3);
  for (int k = 0; k < 20'000; ++k) {
    const double metres = std::pow(10, exponent(random));
    for (const LengthUnit& unit : {LengthUnit{}, {"mm", 1e-3}, {"in", 0.0254}})
      for (const int digits : {1, 3, 4}) {
        const long double length = static_cast<long double>(metres) / static_cast<long double>(unit.metres),
                          read = std::strtod(shownUpward(metres, unit, digits).c_str(), nullptr);
        EXPECT_GE(read * (1 + 1e-18L), length) << metres << unit.name;
        EXPECT_LT(read - length, length * std::pow(10.0L, 1 - digits)) << metres << unit.name;
      }
  }
}

TEST_F(WriteModel, Refusals) {
  EXPECT_FALSE(namesWrittenModel("a.gltf"));
  EXPECT_TRUE(namesWrittenModel("b/A.GLB"));
  EXPECT_THROW(static_cast<void>(filesOf(twoBodies(), "a.gltf")), Error);
  EXPECT_THROW(static_cast<void>(filesOf(Model{}, "a.stl")), Error);
}

}  // namespace
}  // namespace luxo
