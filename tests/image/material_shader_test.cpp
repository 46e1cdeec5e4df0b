// SPDX-License-Identifier: Apache-2.0
// Pictures of materials that have a shader: what it is given, what becomes of what it gives.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/error.h"
#include "scene/shader_files.h"
#include "support/picture.h"
#include "surface/library.h"

namespace luxo::test {
namespace {

using testing::HasSubstr;

constexpr PixelSize kMaterialShaderSize{72, 56};
const Camera kCamera{.eye = Vec3(1.5, 2.5, 4), .lookAt = Vec3(0, 0, 0)};

Material litBy(const std::string& text, std::vector<UniformValue> uniforms = {}) {
  return {.shader = shaderOf(text), .uniforms = std::move(uniforms)};
}

/// A ring that throws its shadow on a plate, both of these materials.
Scene ringOnPlate(const Material& ring, const Material& plate, Light::Shadow shadow) {
  Scene scene;
  scene.add(
      Node{.rotation = Rotation{{1, 0, 0.4}, 0.9}, .surface = torus(1, 0.4), .material = scene.add(ring)});
  scene.add(Node{.translation = Vec3(0, -1.2, 0), .surface = rectangle(5, 5), .material = scene.add(plate)});
  scene.add(Node{
      .translation = Vec3(2, 4, 3),
      .light = Light{.intensity = 30, .attenuation = Light::Attenuation::InverseSquare, .shadow = shadow}});
  return scene;
}

class MaterialShaderPicture : public PictureTest {
 protected:
  std::string refusalOf(const Material& material) {
    try {
      static_cast<void>(draw(ringOnPlate(material, {}, Light::Shadow::None), kCamera, kMaterialShaderSize));
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::Scene);
      return error.what();
    }
    ADD_FAILURE() << "it was drawn";
    return {};
  }
};

/// With a name that luxo's own shaders have, too.
constexpr const char* kPlain = R"(
uniform vec3 paint;
uniform float shine[2];
float highlight(vec3 n, vec3 h, float power) { return power; }
vec4 material(Point p) { return vec4(blinnPhong(paint, vec3(0.5), highlight(p.normal, p.viewer, shine[1])), 1.0); })";

TEST_F(MaterialShaderPicture, TheLightOfMaterialsWithoutOne) {
  const Material own = litBy(kPlain, {{"shine", {3, 40}}, {"paint", {0.7, 0.3, 0.2}}}),
                 plain{.diffuse = Vec3(0.7, 0.3, 0.2), .specular = Vec3(0.5), .shininess = 40};
  for (const Light::Shadow shadow : {Light::Shadow::None, Light::Shadow::Exact})
    for (const Shading shading : {Shading::Exact, Shading::Phong, Shading::Flat})
      for (const Composition composition : {Composition::Auto, Composition::Deferred}) {
        const DrawOptions options{.shading = shading, .composition = composition};
        const Image shown = draw(ringOnPlate(own, own, shadow), kCamera, kMaterialShaderSize, options).image;
        const Image wanted =
            draw(ringOnPlate(plain, plain, shadow), kCamera, kMaterialShaderSize, options).image;
        EXPECT_LE(largestDifference(shown, wanted), 1e-6)
            << nameOf(shading) << (shadow == Light::Shadow::Exact ? " in shadow" : "");
      }
}

/// Where the sky is open it gets the ambient light, like them.
TEST_F(MaterialShaderPicture, AmbientOcclusionIsItsToo) {
  const Material own = litBy(kPlain, {{"shine", {3, 40}}, {"paint", {0.7, 0.3, 0.2}}}),
                 plain{.diffuse = Vec3(0.7, 0.3, 0.2), .specular = Vec3(0.5), .shininess = 40};
  const auto shown = [&](const Material& material, double radius) {
    Scene scene = ringOnPlate(material, material, Light::Shadow::None);
    scene.set(RenderSettings{.ambient = Vec3(1), .ambientOcclusion = {.radius = radius}});
    return draw(scene, kCamera, kMaterialShaderSize).image;
  };
  EXPECT_LE(largestDifference(shown(own, 1), shown(plain, 1)), 1e-6);
  EXPECT_GT(largestDifference(shown(own, 1), shown(own, 0)), 0.1);
}

/// As the language has it: what the scene does not give is what its declaration says, or 0.
TEST_F(MaterialShaderPicture, UniformsThatAreNotGivenAreTheirInitialisersOrZero) {
  const Material own = litBy(R"(
const float kPi = 0.25, kTiny = 0.5;  // names of luxo's, too
uniform float a, b = kPi;             // a const of float
uniform vec3 c[2];
uniform mat3 d;
uniform int e = 2;
float sum(const in vec3 x) { return x.x + x.y + x.z; }
vec4 material(Point p) { return vec4(sum(c[0] + c[1] + d[1]) + a, b + kTiny, 0.1 * float(e), 1.0); })");
  for (const Composition composition : {Composition::Auto, Composition::Deferred}) {
    const Image image = draw(ringOnPlate(own, own, Light::Shadow::None), kCamera, kMaterialShaderSize,
                             {.composition = composition})
                            .image;
    EXPECT_TRUE(near(colorAt(image, kMaterialShaderSize.width / 2, kMaterialShaderSize.height - 12),
                     Vec3(0, 0.75, 0.2), 1e-6));
  }
}

/// What a buffer holds as numbers.
TEST_F(MaterialShaderPicture, UniformsMayBeTrueOrFalse) {
  const std::string text = R"(
uniform bool on, off, kept = true, given = true;
uniform bvec3 three;
uniform bool some[4];
uniform bvec2 pairs[2];
float one(bool is) { return is ? 1.0 : 0.0; }
vec4 material(Point p) {
  bool all = on && !off && kept && !given && three == bvec3(true, false, true) && pairs[1] == bvec2(false, true);
  int k = int(p.uv.x < 1e9);
  return vec4(one(all), 0.25 * (one(some[0]) + one(some[k]) + one(some[2]) + one(some[3])), one(any(pairs[0])), 1.0);
})";
  const Material own = litBy(text, {{"on", {1}},
                                    {"given", {0}},
                                    {"three", {1, 0, 1}},
                                    {"some", {0, 1, 1, 1}},
                                    {"pairs", {0, 0, 0, 1}}}),
                 none = litBy(text);
  const auto shown = [&](const Material& material) {
    return colorAt(
        draw(ringOnPlate(material, material, Light::Shadow::None), kCamera, kMaterialShaderSize).image,
        kMaterialShaderSize.width / 2, kMaterialShaderSize.height - 12);
  };
  EXPECT_TRUE(near(shown(own), Vec3(1, 0.75, 0), 1e-6));
  EXPECT_TRUE(near(shown(none), Vec3(0), 1e-6));
}

/// Of u from 0 to 1: 4096 numbers, which copied to each point took drivers minutes.
TEST_F(MaterialShaderPicture, ElementsOfArraysAreReadWhereTheyLie) {
  constexpr std::size_t kMany = 4096;
  std::vector<double> many(kMany), turns(9 * 64), grid(6);
  for (std::size_t i = 0; i < kMany; ++i) many[i] = double(i) / (2 * kMany);
  for (std::size_t i = 0; i < turns.size(); ++i) turns[i] = double(i % 9 == 5) * double(i / 9) / 64;
  for (std::size_t i = 0; i < grid.size(); ++i) grid[i] = double(i) / 8;
  const auto plate = [&](const std::string& body) {
    Scene scene;
    scene.add(
        Node{.surface =
                 surface([](auto u, auto v) { return point(2 * u - 1, 2 * v - 1, 0 * u); }, {{0, 1}, {0, 1}}),
             .material = scene.add(litBy("uniform float many[4096], grid[2][3]; uniform mat3 turns[64];\n"
                                         "uniform uint which = 2u; uniform int far;\n"
                                         "float sum(float x[3]) { return x[0] + x[1] + x[2]; }\n"
                                         "vec4 material(Point p) { return vec4(" +
                                             body + ", 1.0); }",
                                         {{"many", many}, {"turns", turns}, {"grid", grid}}))});
    return draw(scene, Camera{.eye = Vec3(0, 0, 5), .projection = Projection::Orthographic, .height = 2},
                {64, 64})
        .image;
  };
  const Image ramp = plate("many[int(4096.0 * p.uv.x)], (turns[int(64.0 * p.uv.y)] * vec3(0, 0, 1)).y, 0.0");
  const Image others = plate("grid[1][which], sum(grid[1]), many[far + 99999] + many[far - 1]");
  for (int i = 0; i < 64; ++i) {
    EXPECT_NEAR(colorAt(ramp, i, 7).x, (i + 0.5) / 128, 1.0 / kMany) << i;
    EXPECT_NEAR(colorAt(ramp, 7, i).y, (63 - i) / 64.0, 1e-6) << i;
    EXPECT_TRUE(near(colorAt(others, i, i), Vec3(5 / 8.0, 12 / 8.0, many.back() + many.front()), 1e-6)) << i;
  }
}

/// An error in it would be told.
TEST_F(MaterialShaderPicture, OneThatIsNotInThePictureIsNotCompiled) {
  const auto shown = [&](const Vec3& place) {
    Scene scene = ringOnPlate({}, {}, Light::Shadow::None);
    scene.add(
        Node{.translation = place, .surface = sphere(0.5), .material = scene.add(litBy("this is none"))});
    return draw(scene, kCamera, kMaterialShaderSize).statistics.count.shadersCompiled;
  };
  EXPECT_EQ(shown(Vec3(3, 5, 8)), 0u) << "behind the eye";
  EXPECT_THROW(static_cast<void>(shown(Vec3(0))), Error);
}

/// A node whose scale makes a thin surface round, which is drawn as another one: the place is the scene's.
TEST_F(MaterialShaderPicture, ThePlaceInTheNodeIsOfTheScenesSurface) {
  Scene scene;
  Node node{.surface =
                surface([](auto u, auto v) { return point(1e-4 * cos(v) * cos(u), sin(v), cos(v) * sin(u)); },
                        {{0, kTau}, {-1.5, 1.5}})};
  node.scale = Vec3(1e4, 1, 1);
  node.material =
      scene.add(litBy("vec4 material(Point p) { return vec4(0.5 + 4000.0 * p.object.x, 0.5, 0.5, 1.0); }"));
  scene.add(std::move(node));
  const Camera aside{.eye = Vec3(5, 0, 0), .lookAt = Vec3(0)};
  const Vec3 middle = colorAt(draw(scene, aside, kMaterialShaderSize).image, kMaterialShaderSize.width / 2,
                              kMaterialShaderSize.height / 2);
  EXPECT_NEAR(middle.x, 0.9, 0.01);  // x is 1e-4, but for half a pixel
}

/// The same sum, written as a user does.
TEST_F(MaterialShaderPicture, LightsWithTheirExactShadows) {
  const Material own = litBy(R"(
vec4 material(Point p) {
  vec3 sum = 0.4 * ambientLight();
  for (int i = 0; i < lightCount(); ++i) {
    Light l = light(i);
    sum += 0.4 * max(dot(p.normal, l.direction), 0.0) * l.radiance * l.visible;
  }
  return vec4(sum, 1.0);
})"),
                 plain{.diffuse = Vec3(0.4), .specular = Vec3(0)};
  const Image shown = draw(ringOnPlate(own, own, Light::Shadow::Exact), kCamera, kMaterialShaderSize).image;
  const Image wanted =
      draw(ringOnPlate(plain, plain, Light::Shadow::Exact), kCamera, kMaterialShaderSize).image;
  EXPECT_LE(largestDifference(shown, wanted), 1e-6);
}

TEST_F(MaterialShaderPicture, ThePointIsWhatOutputsTell) {
  const auto shown = [&](const std::string& value, Composition composition) {
    const Material own = litBy("vec4 material(Point p) { return vec4(" + value + ", 1.0); }");
    return draw(ringOnPlate(own, own, Light::Shadow::None), kCamera, kMaterialShaderSize,
                {.composition = composition})
        .image;
  };
  for (const Composition composition : {Composition::Auto, Composition::Deferred})
    for (const auto& [value, output] : {std::pair{"p.position", Output::Position},
                                        {"p.normal", Output::Normal},
                                        {"vec3(p.uv, 0.0)", Output::Uv}}) {
      const Image image = shown(value, composition);
      const Scene scene = ringOnPlate({}, {}, Light::Shadow::None);
      const Image wanted = draw(scene, kCamera, kMaterialShaderSize, {.output = output}).image;
      const Image id = draw(scene, kCamera, kMaterialShaderSize, {.output = Output::Id}).image;
      double largest = 0;
      for (std::size_t i = 0; i < id.samples().size(); ++i)
        for (std::size_t c = 0; c < 3 && id.samples()[i] > 0; ++c)
          largest = std::max(
              largest, std::abs(double(image.samples()[3 * i + c]) - double(wanted.samples()[3 * i + c])));
      EXPECT_LE(largest, 2e-5) << value;
    }
}

/// Of S = (3u, 2v, u v): Su = (3, 0, v), Sv = (0, 2, u), turned and moved with the node.
TEST_F(MaterialShaderPicture, TheFrameIsThatOfTheSurface) {
  const Surface saddle =
      surface([](auto u, auto v) { return point(3 * u, 2 * v, u * v); }, {{-1, 1}, {-1, 1}});
  const auto errorOf = [&](const std::string& value) {
    Scene scene;
    scene.set(plainSettings());
    scene.add(Node{.translation = Vec3(0.5, -0.2, 0),
                   .rotation = Rotation{{1, 2, 0.5}, 0.6},
                   .surface = saddle,
                   .material = scene.add(litBy("uniform mat3 turn; vec4 material(Point p) { vec3 u = turn * "
                                               "vec3(3, 0, p.uv.y), v = turn * vec3(0, 2, p.uv.x);"
                                               " return vec4(vec3(" +
                                                   value + "), 1.0); }",
                                               {{"turn", [] {
                                                   std::vector<double> rows;
                                                   const Mat3 m = rotation(Vec3(1, 2, 0.5), 0.6);
                                                   for (int row = 0; row < 3; ++row)
                                                     for (int column = 0; column < 3; ++column)
                                                       rows.push_back(m[column][row]);
                                                   return rows;
                                                 }()}}))});
    const Image image = draw(scene, Camera{.eye = Vec3(0.5, 1, 9)}, kMaterialShaderSize).image;
    double largest = 0;
    for (const float sample : image.samples()) largest = std::max(largest, double(sample));
    return largest;
  };
  constexpr double kRounding = 4e-6;  // of numbers up to 3
  EXPECT_EQ(errorOf("0.5"), 0.5);
  EXPECT_LE(errorOf("length(p.Su - u)"), kRounding);
  EXPECT_LE(errorOf("length(p.Sv - v)"), kRounding);
  EXPECT_LE(errorOf("length(p.tangent - normalize(u))"), kRounding);
  EXPECT_LE(errorOf("length(p.object - vec3(3.0 * p.uv.x, 2.0 * p.uv.y, p.uv.x * p.uv.y))"), kRounding);
  EXPECT_LE(errorOf("abs(dot(p.bitangent, p.normal)) + abs(dot(p.bitangent, p.tangent)) + (dot(p.bitangent, "
                    "v) > 0.0 ? 0.0 : 1.0)"),
            kRounding);
}

TEST_F(MaterialShaderPicture, WhatIsNoNumberIsMagentaAndCounted) {
  const Material own = litBy("vec4 material(Point p) { return vec4(sqrt(p.position.x), 0.5, 0.5, 1.0); }");
  for (const Composition composition : {Composition::Auto, Composition::Deferred}) {
    const Picture picture = draw(ringOnPlate(own, own, Light::Shadow::None), kCamera, kMaterialShaderSize,
                                 {.composition = composition});
    std::uint64_t magenta = 0;
    for (std::size_t i = 0; i < picture.image.samples().size(); i += 3) {
      const auto pixel = picture.image.samples().subspan(i, 3);
      ASSERT_TRUE(std::isfinite(pixel[0]) && std::isfinite(pixel[1]) && std::isfinite(pixel[2]));
      magenta += pixel[0] == 1 && pixel[1] == 0 && pixel[2] == 1;
    }
    EXPECT_GT(magenta, 500u);
    EXPECT_EQ(picture.statistics.error.nonfinitePx, magenta);
  }
}

TEST_F(MaterialShaderPicture, LoopsWithoutEndAndOpacitiesAreRefused) {
  EXPECT_THAT(
      refusalOf(litBy("vec4 material(Point p) { float x = 0.0; while (x < 1.0) x *= 0.5; return vec4(x); }")),
      HasSubstr("more than 32768 times"));
  EXPECT_THAT(refusalOf(litBy("vec4 material(Point p) { return vec4(1, 1, 1, 0.5); }")),
              HasSubstr("opacity below 1"));
  EXPECT_THAT(refusalOf(litBy("vec4 material(Point p) { if (p.uv.x < 0.5) discard; return vec4(1); }")),
              HasSubstr("'discard'"));
}

/// Materials differ in their values alone: one module, one pipeline.
TEST_F(MaterialShaderPicture, MaterialsOfAShaderShareItsPipeline) {
  const auto made = [&](double paint) {
    Scene scene = ringOnPlate(litBy(kPlain, {{"paint", {0.5, 0.5, 0.5}}}),
                              litBy(kPlain, {{"paint", {paint, 0, 0}}}), Light::Shadow::Exact);
    return draw(scene, kCamera, kMaterialShaderSize).statistics.count.pipelinesCreated;
  };
  const std::uint64_t first = made(0.5);
  EXPECT_GT(first, 0u);
  EXPECT_EQ(made(0.9), 0u);
}

/// Ward's highlight on a plate that faces the eye and a lamp above its middle: at a distance r from there the
/// half vector is by atan(r / h) / 2 off the normal, so that the ratio of what is seen along and across the
/// grooves is exp(-tan^2 (1 / a^2 - 1 / b^2)).
TEST_F(MaterialShaderPicture, BrushedSteelIsLongAcrossItsGrooves) {
  constexpr double kAlong = 0.15, kAcross = 0.45, kHeight = 2;
  Material steel{.shader = ShaderFiles(LUXO_SOURCE_DIR "/apps/scenes/gallery").get("steel.frag"),
                 .uniforms = {{"roughness", {kAlong, kAcross}}, {"depth", {0}}, {"metal", {1, 1, 1}}}};
  Scene scene;
  scene.add(Node{
      .rotation = Rotation{{1, 0, 0}, kPi / 2}, .surface = rectangle(4, 4), .material = scene.add(steel)});
  scene.add(Node{.translation = Vec3(0, 0, kHeight), .light = Light{}});
  scene.set(RenderSettings{.ambient = Vec3(0)});
  constexpr int kPixels = 81;
  const Image image =
      draw(scene, Camera{.eye = Vec3(0, 0, 5), .projection = Projection::Orthographic, .height = 2},
           {kPixels, kPixels})
          .image;
  const auto highlight = [&](int x, int y) {
    const double r = std::hypot(x - 40, y - 40) * 2 / kPixels;
    return image.pixel(x, y)[0] - 0.1 * kHeight / std::hypot(r, kHeight);  // without what is diffuse
  };
  for (const int step : {8, 16, 24}) {
    const double r = step * 2.0 / kPixels, tangent = std::tan(std::atan(r / kHeight) / 2);
    const double wanted = std::exp(-tangent * tangent * (1 / (kAlong * kAlong) - 1 / (kAcross * kAcross)));
    EXPECT_NEAR(highlight(40 + step, 40) / highlight(40, 40 + step), wanted, 1e-3) << step;
  }
}

}  // namespace
}  // namespace luxo::test
