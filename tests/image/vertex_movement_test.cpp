// SPDX-License-Identifier: Apache-2.0
// Meshes that vertex programs move: pictures, shadows and rays are those of the mesh as it was moved, and
// varyings those of its points at rest.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "draw/device_vertex_movement.h"
#include "draw/render_view.h"
#include "draw/scene_painter.h"
#include "scene/scene_builder.h"
#include "scene/scene_reader.h"
#include "scene/shader_files.h"
#include "support/meshes.h"
#include "support/verified_picture.h"
#include "surface/surface_triangles.h"

namespace luxo::test {
namespace {

using testing::HasSubstr;

constexpr PixelSize kSize{88, 66};
const Camera kCamera{.eye = Vec3(3, 3.5, 7), .lookAt = Vec3(0.4, 0.6, 0.2)};
const Vec3 kMove(0.5, 0.75, -0.25);

MaterialShaderPtr programs(const std::string& vertex, const std::string& fragment) {
  MaterialShader shader{{{"test.frag", fragment}, {"test.vert", vertex}}};
  shader.vertex = 1;
  return std::make_shared<const MaterialShader>(std::move(shader));
}

/// Hands over where a vertex is at rest, its normal, and its uv.
MaterialShaderPtr moving(const std::string& place, const std::string& before = "") {
  return programs(
      "uniform float time; varying vec3 at, n, to; varying vec2 st;\n" + before +
          "\nvoid main() {\n  at = gl_Vertex.xyz;\n  n = gl_Normal;\n  st = gl_MultiTexCoord0.st;\n"
          "  to = gl_LightSource[0].diffuse.rgb;\n  gl_Position = " +
          place + ";\n}\n",
      "varying vec3 at, n, to; varying vec2 st;\nvoid main() { gl_FragColor = vec4(0.4 + 0.15 * at + "
      "0.1 * normalize(n) + 0.02 * vec3(st, 0.0) + 0.01 * to, 1.0); }\n");
}
std::string placed(const std::string& place) {
  return "gl_ModelViewProjectionMatrix * vec4(" + place + ", 1.0)";
}

class MovedMeshes : public VerifiedPictureTest {
 protected:
  /// A mesh over a floor, in light that casts shadows.
  [[nodiscard]] Scene shown(const Surface& surface, const Material& material, Node node = {},
                            Light::Shadow shadow = Light::Shadow::Exact) {
    Scene scene;
    node.surface = surface;
    node.material = scene.add(material);
    scene.add(std::move(node));
    scene.add(Node{.translation = Vec3(0, -1.5, 0),
                   .surface = rectangle(9, 9),
                   .material = scene.add(Material{.diffuse = Vec3(0.6)})});
    scene.add(Node{
        .translation = Vec3(2, 6, 3),
        .light = Light{.intensity = 20, .attenuation = Light::Attenuation::InverseSquare, .shadow = shadow}});
    RenderSettings settings;
    settings.ambient = Vec3(0.2);
    scene.set(settings);
    scene.set(movement());
    return scene;
  }
  [[nodiscard]] std::shared_ptr<DeviceVertexMovement> movement() {
    if (!movement_) movement_ = std::make_shared<DeviceVertexMovement>(context());
    return movement_;
  }
  [[nodiscard]] Snapshot snapshotOf(const Surface& surface, const Material& material, double time = 0) {
    return takeSnapshot(shown(surface, material), time, kSize, kCamera);
  }
  [[nodiscard]] std::string refusalOf(const Surface& surface, const Material& material) {
    try {
      static_cast<void>(draw(shown(surface, material), kCamera, kSize));
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::Scene);
      return error.what();
    }
    ADD_FAILURE() << "it was drawn";
    return {};
  }
  void TearDown() override {
    movement_.reset();
    VerifiedPictureTest::TearDown();
  }

 private:
  std::shared_ptr<DeviceVertexMovement> movement_;
};

struct Movement {
  const char* name;
  std::string place;  ///< of a vertex program
  Node node;          ///< that does the same
};

std::vector<Movement> movements() {
  const double angle = 0.7;
  const std::string turned =
      fmt::format("mat3({0:.9f}, 0.0, -{1:.9f}, 0.0, 1.0, 0.0, {1:.9f}, 0.0, {0:.9f}) * gl_Vertex.xyz",
                  std::cos(angle), std::sin(angle));
  return {{"translation", "gl_Vertex.xyz + vec3(0.5, 0.75, -0.25)", Node{.translation = kMove}},
          {"scale", "gl_Vertex.xyz * vec3(0.5, 1.5, 1.25)", Node{.scale = Vec3(0.5, 1.5, 1.25)}},
          {"rotation", turned, Node{.rotation = Rotation{{0, 1, 0}, angle}}},
          {"mirror", "gl_Vertex.xyz * vec3(-1.0, 1.0, 1.0)", Node{.scale = Vec3(-1, 1, 1)}}};
}

/// Behind everything there is no point that a program could have moved: windows ask the device for faults, of
/// pixels that are not in the picture, too. The program's material is the only one, as which background
/// reads.
TEST_F(MovedMeshes, HaveNoFaultsWhereNothingIsFound) {
  for (const Light::Shadow shadow : {Light::Shadow::Exact, Light::Shadow::None}) {
    Scene scene;
    scene.add(Node{.surface = cubeMesh(),
                   .material = scene.add(Material{.shader = moving(placed("gl_Vertex.xyz + vec3(0.5)"))})});
    scene.add(Node{.translation = Vec3(2, 6, 3), .light = Light{.shadow = shadow}});
    scene.set(movement());
    const Snapshot snapshot = takeSnapshot(scene, 0, kSize, kCamera);
    gpu::FrameRing frames(context());
    ScenePainter painter(context());
    RenderView view(context(), Precision::Half);
    const VkCommandBuffer commands = frames.begin();
    FrameStatistics statistics;
    painter.record(frames, commands, view, snapshot,
                   {.shading = Shading::Exact, .composition = Composition::Deferred}, statistics);
    frames.wait(frames.submit());
    EXPECT_TRUE(view.list().deferred && view.list().runsShaders);
    EXPECT_EQ(view.shaderFaults().moved, 0U);
  }
}

// Lights between what is seen and what is seen through, and how they are held, apart: all have where points
// were at rest. A normal of 15 bits a number is off by 5e-5, a tenth of which is seen; edges of the turned
// one are off by a rounding.
TEST_F(MovedMeshes, HaveThePicturesOfNodesThatMoveAlike) {
  struct Way {
    const char* name;
    DrawOptions options;
    double opacity = 1;
    Light::Shadow shadow = Light::Shadow::Exact;
  };
  const Way ways[] = {
      {"exact", {.shading = Shading::Exact}},
      {"phong", {.shading = Shading::Phong}},
      {"flat", {.shading = Shading::Flat}},
      {"gouraud", {.shading = Shading::Gouraud}},
      {"toon", {.shading = Shading::Toon}},
      {"without shadows", {.shading = Shading::Phong}, 1, Light::Shadow::None},
      {"deferred", {.shading = Shading::Exact, .composition = Composition::Deferred}, 1, Light::Shadow::None},
      {"glass", {.shading = Shading::Exact}, 0.5},
      {"a map of depths", {.shading = Shading::Phong}, 1, Light::Shadow::Map}};
  for (const TriangleMesh& mesh : {cubeMesh(), icosphere(2)})
    for (const Movement& one : movements())
      for (const Way& way : ways) {
        SCOPED_TRACE(fmt::format("{} {} {}", mesh.name(), one.name, way.name));
        const bool isBall = mesh.name() == "icosphere";
        // Maps are fitted around boxes: that of a ball is larger once it is turned.
        if (isBall && one.name == std::string("rotation") && way.shadow == Light::Shadow::Map) continue;
        const Material moved{.opacity = way.opacity, .shader = moving(placed(one.place))},
            still{.opacity = way.opacity, .shader = moving("ftransform()")};
        const Image a = draw(shown(mesh, moved, {}, way.shadow), kCamera, kSize, way.options).image,
                    b = draw(shown(mesh, still, one.node, way.shadow), kCamera, kSize, way.options).image;
        const double most = isBall && one.name == std::string("scale") ? 3e-3 : 1e-4;
        std::size_t off = 0;
        for (std::size_t i = 0; i < a.samples().size(); ++i)
          off += !(std::abs(a.samples()[i] - b.samples()[i]) < most);
        EXPECT_LE(off, 9U) << largestDifference(a, b);
        EXPECT_FALSE(
            sameBytes(a, draw(shown(mesh, still, {}, way.shadow), kCamera, kSize, way.options).image));
      }
}

// A whole wave's heights, worked out in double.
TEST_F(MovedMeshes, AreWhereTheProgramLeads) {
  const TriangleMesh ball = icosphere(3);
  Material wave{.shader =
                    moving(placed("gl_Vertex.xyz + vec3(0.0, 0.0, 0.25 * sin(5.0 * gl_Vertex.x - time))"))};
  for (const double time : {0.0, 0.5, 7.25}) {
    wave.uniforms = {{.name = "time", .values = {time}}};
    const Surface moved = movement()->moved(ball, wave);
    const TriangleMesh& mesh = moved.triangles()->mesh;
    ASSERT_EQ(mesh.rest().size(), mesh.positions().size());
    EXPECT_EQ(mesh.positions().size(), ball.positions().size());
    for (std::uint32_t i = 0; i < mesh.positions().size(); ++i) {
      const Vec3 rest(mesh.rest()[i]);
      EXPECT_LT(glm::length(mesh.point(i) - rest - Vec3(0, 0, 0.25 * std::sin(5 * rest.x - time))), 5e-7);
      EXPECT_LT(glm::length(Vec3(mesh.restNormals()[i]) - rest), 0.05);  // of a ball
    }
  }
}

TEST_F(MovedMeshes, AreAFunctionOfTime) {
  const MaterialShaderPtr wave =
      moving(placed("gl_Vertex.xyz + vec3(0.0, 0.0, 0.25 * sin(5.0 * gl_Vertex.x - time))"));
  Scene scene = shown(icosphere(2), Material{});
  scene.set(MaterialId{1}, Animated<Material>([wave](double time) {
              return Material{.shader = wave, .uniforms = {{.name = "time", .values = {time}}}};
            }));
  const auto at = [&](double time) { return draw(scene, kCamera, kSize, {}, time).image; };
  const Image first = at(0.4);
  for (const double time : {0.1, 0.6, 0.2}) static_cast<void>(at(time));
  EXPECT_TRUE(sameBytes(at(0.4), first));
  EXPECT_FALSE(sameBytes(at(0.41), first));
  EXPECT_EQ(takeSnapshot(scene, 0.4, kSize, kCamera), takeSnapshot(scene, 0.4, kSize, kCamera));
}

// What all vertices stay in is the same surface.
TEST_F(MovedMeshes, AreTheSameWhereNothingMoves) {
  const Surface ball(icosphere(2));
  for (const char* place :
       {"gl_ProjectionMatrix * gl_ModelViewMatrix * gl_Vertex", "2.5 * ftransform()",
        "gl_ProjectionMatrix * (gl_ModelViewMatrix * vec4(gl_Vertex.xyz + time * gl_Normal, 1.0))",
        "gl_Vertex * gl_ModelViewProjectionMatrixTranspose",
        "gl_ProjectionMatrix * vec4((gl_ModelViewMatrix * gl_Vertex).xyz, 1.0)"})
    EXPECT_EQ(movement()->moved(ball, {.shader = moving(place)}).identity(), ball.identity()) << place;
  const Material moves{.shader = moving(placed("2.0 * gl_Vertex.xyz"))};
  EXPECT_EQ(movement()->moved(ball, moves).identity(), movement()->moved(ball, moves).identity());
}

// What a program makes of the rounding of a point that it leaves where it is, is no movement.
TEST_F(MovedMeshes, StayWherePointsDoButForRounding) {
  const Material twist{
      .shader =
          moving(placed("vec3(cos(2.3 * gl_Vertex.z) * gl_Vertex.x - sin(2.3 * gl_Vertex.z) * gl_Vertex.y, "
                        "sin(2.3 * gl_Vertex.z) * gl_Vertex.x + cos(2.3 * gl_Vertex.z) * gl_Vertex.y, "
                        "gl_Vertex.z)"))};
  Node node{.translation = Vec3(0.3, 0.2, 0.1), .rotation = Rotation{{1, 0.3, 0.2}, -1.1}};
  EXPECT_NO_THROW(static_cast<void>(draw(shown(quadMesh(), twist, node), kCamera, {320, 240})));
}

// Every pixel of movements that nobody thought of, with the shadows of what they make.
TEST_F(MovedMeshes, AreThoseOfTheReference) {
  std::mt19937 random(22);
  const auto number = [&](double from, double to) {
    return fmt::format("{:.4f}", std::uniform_real_distribution(from, to)(random));
  };
  for (int k = 0; k < 6; ++k) {
    std::string place = "gl_Vertex.xyz";
    for (int term = 0; term < 3; ++term)
      place += fmt::format(" + vec3({}, {}, {}) * sin(dot(vec3({}, {}, {}), gl_Vertex.xyz) + {})",
                           number(-0.25, 0.25), number(-0.25, 0.25), number(-0.25, 0.25), number(-4, 4),
                           number(-4, 4), number(-4, 4), number(0, 6));
    if (k % 2 == 1) place += fmt::format(" + {} * gl_Normal * gl_Vertex.x", number(-0.3, 0.3));
    SCOPED_TRACE(place);
    const TriangleMesh mesh = k % 3 == 0 ? cubeMesh() : icosphere(k % 3 + 1);
    Material material{.shader = moving(placed(place))};
    if (k == 4) material.opacity = 0.4;
    const Verified v = verified(snapshotOf(mesh, material));
    EXPECT_EQ(v.verification.wrong.total(), 0U);
    EXPECT_GT(v.verification.coverage.both, 2500U);
  }
}

TEST_F(MovedMeshes, OfScenesAreMovedByTheirRenderer) {
  Scene scene;
  scene.add(Node{.surface = icosphere(1),
                 .material = scene.add(Material{.shader = moving(placed("0.5 * gl_Vertex.xyz"))})});
  scene.add(kCamera);
  RenderSettings settings = plainSettings();
  settings.size = {32, 32};
  scene.set(settings);
  EXPECT_NO_THROW(static_cast<void>(renderer().render(scene)));
  try {
    static_cast<void>(takeSnapshot(scene, 0, settings.size));
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_THAT(std::string(error.what()), HasSubstr("the scene was given none"));
  }
}

// A movement is one for all views, of numbers, and of a mesh's vertices.
TEST_F(MovedMeshes, AreRefusedWhereTheyAreNone) {
  const Surface ball(icosphere(1));
  const auto refusal = [&](const std::string& place, const std::string& before = "") {
    return refusalOf(ball, {.shader = moving(place, before)});
  };
  const char* const kViews = "is not the same for all views";
  for (const char* place :
       {"gl_ProjectionMatrix * (gl_ModelViewMatrix * vec4(0.0, 0.0, 0.0, 1.0) + vec4(gl_Vertex.xyz, 0.0))",
        "vec4(gl_Vertex.xy, 0.5, 1.0)", "gl_Vertex", "ftransform() + vec4(0.1, 0.0, 0.0, 0.0)",
        "ftransform() + gl_ModelViewProjectionMatrix * gl_LightSource[0].position",
        "gl_ModelViewProjectionMatrix * (gl_Vertex + vec4(0.2 * gl_NormalMatrix * gl_Normal, 0.0))"})
    EXPECT_THAT(refusal(place), HasSubstr(kViews)) << place;
  EXPECT_THAT(refusal(placed("gl_Vertex.xyz + tangent"), "attribute vec3 tangent;"), HasSubstr(kViews));
  EXPECT_THAT(refusal(placed("gl_Vertex.xyz * texture2D(skin, st).r"), "uniform sampler2D skin;"),
              HasSubstr(kViews));
  EXPECT_THAT(refusalOf(ball, {.shader = moving(placed("gl_Vertex.xyz / (time * gl_Vertex.x)")),
                               .uniforms = {{.name = "time", .values = {0}}}}),
              HasSubstr("which is no number"));
  EXPECT_THAT(refusal("gl_ModelViewProjectionMatrix * vec4(gl_Vertex.xyz, 0.0)"), HasSubstr("at infinity"));
  EXPECT_THAT(refusal("-ftransform()"), HasSubstr("behind it"));
  EXPECT_THAT(refusal(placed("1e20 * gl_Vertex.xyz")), HasSubstr("m away"));
  EXPECT_THAT(refusal(placed("vec3(0.0)")), HasSubstr("no triangle has an area"));
  EXPECT_THAT(refusal(placed("gl_Vertex.xyz * 2.0 + 0.0 * tangent"), "attribute vec3 tangent;"),
              HasSubstr("'tangent' is of the surface as it is shown"));
  EXPECT_THAT(refusal(placed("gl_Vertex.xyz * f()"),
                      "float f() { float a = 0.0; while (a < 2.0) a += time; return a; }"),
              HasSubstr("32768"));
  // Of formulas, and between vertices that stay.
  EXPECT_THAT(refusalOf(sphere(1), {.shader = moving(placed("1.1 * gl_Vertex.xyz"))}),
              HasSubstr("the vertex program moves the vertex"));
  EXPECT_THAT(refusalOf(cubeMesh(),
                        {.shader = moving(placed(
                             "gl_Vertex.xyz + vec3(0.0, 0.3 * (1.0 - gl_Vertex.x * gl_Vertex.x), 0.0)"))}),
              HasSubstr("the vertex program moves the vertex"));
  // What says where, says it in the program's own file.
  EXPECT_THAT(refusal("gl_Vertex"), HasSubstr("test.vert:8:3"));
}

// A planar shadow falls on one plane.
TEST_F(MovedMeshes, ArePlanesOfShadowsWhileTheyAreFlat) {
  for (const auto& [place, flat] :
       {std::pair("2.0 * gl_Vertex.xyz", true),
        std::pair("gl_Vertex.xyz + vec3(0.0, 0.0, gl_Vertex.x * gl_Vertex.y)", false)}) {
    Scene scene;
    const NodeId plane = scene.add(Node{.rotation = Rotation{{1, 0, 0}, -0.5 * kPi},
                                        .surface = quadMesh(),
                                        .material = scene.add(Material{.shader = moving(placed(place))})});
    scene.add(Node{.translation = Vec3(0, 1, 0), .surface = sphere(0.3)});
    scene.add(Node{.translation = Vec3(0, 4, 0),
                   .light = Light{.shadow = Light::Shadow::Planar, .shadowPlane = plane}});
    scene.set(movement());
    if (flat)
      EXPECT_NO_THROW(static_cast<void>(draw(scene, kCamera, kSize)));
    else
      EXPECT_THROW(static_cast<void>(draw(scene, kCamera, kSize)), Error);
  }
}

TEST_F(MovedMeshes, OfTheCourseAreThoseOfTheReference) {
  const std::string folder = LUXO_SOURCE_DIR "/apps/scenes/course/";
  Scene scene = buildScene(readSceneFile(folder + "wave.luxo.json"));
  scene.set(movement());
  for (const double time : {0.0, 0.6}) {
    const Snapshot snapshot = takeSnapshot(scene, time, {160, 90});
    const Verified v = verified(snapshot);
    EXPECT_EQ(v.verification.wrong.total(), 0U);
    const auto water = std::ranges::find_if(
        snapshot.nodes, [](const SnapshotNode& node) { return node.surface.triangles() != nullptr; });
    const TriangleMesh& mesh = water->surface.triangles()->mesh;
    for (std::uint32_t i = 0; i < mesh.positions().size(); ++i) {
      const double x = mesh.rest()[i].x, z = mesh.rest()[i].z;
      EXPECT_NEAR(
          mesh.point(i).y,
          0.07 * (std::sin(4.2 * x + 1.9 * z - 2.2 * time) + 0.5 * std::sin(-2.6 * x + 6.3 * z - 3.1 * time)),
          2e-7);
    }
    const Image image = draw(scene, {160, 90}, {}, time).image;
    EXPECT_LE(*std::ranges::max_element(image.samples()), 1.0F);
  }
}

}  // namespace
}  // namespace luxo::test
