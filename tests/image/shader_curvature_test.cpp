// SPDX-License-Identifier: Apache-2.0
// What shaders are told of how their surface bends, and what turns with their node.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>

#include "base/error.h"
#include "scene/scene_builder.h"
#include "scene/scene_reader.h"
#include "scene/shader_files.h"
#include "scene/surface_names.h"
#include "support/meshes.h"
#include "support/picture.h"

namespace luxo::test {
namespace {

using testing::HasSubstr;

constexpr PixelSize kShaderCurvatureSize{80, 60};

Scene sceneOf(const std::string& material, const std::string& surface, const std::string& shader) {
  SceneFile file = parseScene(R"({ "luxo": 1, "render": { "ambient": 1, "background": 0 },
      "params": { "wide": { "value": 0.5, "range": [0.1, 1] } },
      "materials": { "m": { "specular": 0, )" +
                                  material + R"( } },
      "surfaces": { "s": )" + surface +
                                  R"( },
      "nodes": [ { "surface": "s", "material": "m", "translate": [0.1, 0.2, 0], "rotate": { "axis": [1, 0, 0.3], "angle": "50deg" } } ],
      "camera": { "eye": [0.4, 1.5, 3], "look_at": [0, 0, 0] } })",
                              "scene");
  if (!file.source.shaders) file.source.shaders = std::make_shared<ShaderFiles>();
  file.source.shaders->put("m.frag", shaderOf(shader));
  return buildScene(file);
}

using ShaderCurvature = PictureTest;

/// As formulas of a material have it, of surfaces that move with a parameter, too; also where it is seen
/// through.
TEST_F(ShaderCurvature, IsThatOfFormulas) {
  const std::string text = R"(
vec4 material(Point p) { return vec4(0.5 + 0.4 * tanh(p.K), 0.5 + 0.4 * tanh(p.H), 0.5 + 0.3 * tanh(p.k1 - p.k2), 1.0); })";
  for (const char* surface :
       {R"({ "type": "torus", "major": 1, "minor": "wide" })", R"({ "type": "klein" })",
        R"({ "type": "teapot", "height": 1 })",
        R"({ "type": "formula", "u": [-1, 1], "v": [-1, 1], "position": ["u", "wide*sin(3u)*v", "v"] })"}) {
    SCOPED_TRACE(surface);
    const Scene plain =
                    sceneOf(R"c("diffuse": ["0.5+0.4*tanh(K)", "0.5+0.4*tanh(H)", "0.5+0.3*tanh(k1-k2)"])c",
                            surface, text),
                own = sceneOf(R"("shader": "m.frag")", surface, text),
                veil = sceneOf(R"("shader": "m.frag")", surface, "#pragma luxo opacity\n" + text);
    for (const Shading shading : {Shading::Exact, Shading::Phong}) {
      const Image wanted = draw(plain, kShaderCurvatureSize, {.shading = shading}).image;
      EXPECT_LE(largestDifference(draw(own, kShaderCurvatureSize, {.shading = shading}).image, wanted), 1e-5);
    }
    // At the seam of the bottle, which has one side, its ends have opposite normals.
    EXPECT_LE(differingPixels(draw(veil, kShaderCurvatureSize).image, draw(plain, kShaderCurvatureSize).image,
                              1e-3),
              5);
  }
}

/// From C++, of a ball: K = 1 / r^2, H = k1 = k2 = 1 / r.
TEST_F(ShaderCurvature, OfABallIsKnown) {
  Scene scene;
  scene.set(plainSettings());
  const Surface ball = sphere(2);
  Material material{
      .shader = shaderOf("vec4 material(Point p) { return vec4(p.K, p.H, 0.5 * (p.k1 + p.k2), 1.0); }"),
      .curvature = curvaturePattern(ball)};
  scene.add(Node{.surface = ball, .material = scene.add(material)});
  const Image image = draw(scene, Camera{.eye = Vec3(0, 0, 9)}, kShaderCurvatureSize).image;
  EXPECT_TRUE(near(colorAt(image, 40, 30), Vec3(0.25, 0.5, 0.5), 1e-4));
  EXPECT_TRUE(near(colorAt(image, 46, 22), Vec3(0.25, 0.5, 0.5), 1e-4));
}

TEST_F(ShaderCurvature, IsNothingOfTriangles) {
  Scene scene;
  scene.set(plainSettings());
  scene.add(Node{.surface = quadMesh(),
                 .material = scene.add(Material{
                     .shader = shaderOf("vec4 material(Point p) { return vec4(p.K, p.k1, 0.5, 1.0); }")})});
  const Image image = draw(scene, Camera{.eye = Vec3(0, 0, 5)}, kShaderCurvatureSize).image;
  EXPECT_TRUE(near(colorAt(image, 40, 30), Vec3(0, 0, 0.5), 0));
}

TEST_F(ShaderCurvature, WhatIsNotKnownIsTold) {
  const std::string text = "vec4 material(Point p) { return vec4(p.H); }";
  const auto message = [](const auto& make) -> std::string {
    try {
      make();
    } catch (const Error& error) {
      return error.what();
    }
    return "nothing";
  };
  Scene scene;
  scene.add(Node{.surface = sphere(1), .material = scene.add(Material{.shader = shaderOf(text)})});
  EXPECT_THAT(
      message([&] { static_cast<void>(draw(scene, Camera{.eye = Vec3(0, 0, 5)}, kShaderCurvatureSize)); }),
      HasSubstr("which material 'material' does not know"));
}

/// Su is a direction of the node; the gradient of what is 0 on the surface is along its normal.
TEST_F(ShaderCurvature, DirectionsTurnWithTheNode) {
  const Surface saddle =
      surface([](auto u, auto v) { return point(3 * u, 2 * v, u * v); }, {{-1, 1}, {-1, 1}});
  const auto errorOf = [&](const std::string& value) {
    Scene scene;
    scene.set(plainSettings());
    scene.add(
        Node{.translation = Vec3(0.5, -0.2, 0),
             .rotation = Rotation{{1, 2, 0.5}, 0.6},
             .scale = Vec3(0.7, 1.3, 0.5),
             .surface = saddle,
             .material = scene.add(Material{
                 .shader = shaderOf("vec4 material(Point p) { return vec4(vec3(" + value + "), 1.0); }")})});
    const Image image = draw(scene, Camera{.eye = Vec3(0.5, 1, 9)}, kShaderCurvatureSize).image;
    double largest = 0;
    for (const float sample : image.samples()) largest = std::max(largest, double(sample));
    return largest;
  };
  EXPECT_LE(errorOf("length(worldVector(vec3(3.0, 0.0, p.uv.y)) - p.Su)"), 1e-3);
  EXPECT_LE(errorOf("length(objectVector(p.Sv) - vec3(0.0, 2.0, p.uv.x))"), 1e-3);
  EXPECT_LE(
      errorOf("length(cross(normalize(worldNormal(vec3(-p.uv.y / 3.0, -p.uv.x / 2.0, 1.0))), p.normal))"),
      1e-4);
  EXPECT_GT(
      errorOf("length(cross(normalize(worldVector(vec3(-p.uv.y / 3.0, -p.uv.x / 2.0, 1.0))), p.normal))"),
      0.1);
}

}  // namespace
}  // namespace luxo::test
