// SPDX-License-Identifier: Apache-2.0
// Pictures of what a material's shader says how opaque it is.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/log.h"
#include "formula/expression.h"
#include "support/verified_picture.h"
#include "surface/library.h"

namespace luxo::test {
namespace {

using testing::HasSubstr;

constexpr PixelSize kShaderOpacitySize{80, 60};
const Camera kOpacityCamera{.eye = Vec3(1.5, 2.5, 4), .lookAt = Vec3(0, 0, 0)};
const std::string kMayBeSeenThrough = "#pragma luxo opacity\n";

Material seenThroughBy(const std::string& text, Material rest = {}) {
  rest.shader = std::make_shared<const MaterialShader>(MaterialShader{{{"test.frag", text}}});
  return rest;
}

/// A ring around a ball, seen through where its material is, over a plate that is in the shadow of a bar.
Scene ringAroundBall(const Material& ring, Light::Shadow shadow = Light::Shadow::None) {
  Scene scene;
  const NodeId bar = scene.add(Node{.translation = Vec3(0.6, 1.6, 0.9),
                                    .surface = sphere(0.25),
                                    .material = scene.add(Material{.diffuse = Vec3(0.6, 0.1, 0.1)})});
  scene.add(
      Node{.rotation = Rotation{{1, 0, 0.4}, 0.9}, .surface = torus(1, 0.4), .material = scene.add(ring)});
  scene.add(Node{.surface = sphere(0.5), .material = scene.add(Material{.diffuse = Vec3(0.2, 0.5, 0.3)})});
  scene.add(Node{.translation = Vec3(0, -1.2, 0), .surface = rectangle(5, 5)});
  scene.add(Node{.translation = Vec3(2, 4, 3),
                 .light = Light{.intensity = 30,
                                .attenuation = Light::Attenuation::InverseSquare,
                                .shadow = shadow,
                                .casters = {bar}}});
  return scene;
}

class ShaderOpacity : public VerifiedPictureTest {};

/// blinnPhong() with an opacity is what a material without a shader has.
TEST_F(ShaderOpacity, IsThatOfAMaterialWithoutAShader) {
  const std::string text =
      "vec4 material(Point p) { return vec4(blinnPhong(vec3(0.7, 0.3, 0.2), vec3(0.5), 40.0), ";
  for (const Blend blend : {Blend::Over, Blend::Add, Blend::Multiply})
    for (const Light::Shadow shadow : {Light::Shadow::None, Light::Shadow::Exact}) {
      const Material plain{.diffuse = Vec3(0.7, 0.3, 0.2),
                           .specular = Vec3(0.5),
                           .shininess = 40,
                           .opacity = 0.4,
                           .blend = blend};
      Material same = plain;
      same.opacity = 0.8;
      for (const Shading shading : {Shading::Exact, Shading::Phong, Shading::Flat}) {
        SCOPED_TRACE(testing::Message() << int(blend) << " " << int(shadow) << " " << nameOf(shading));
        const Image wanted =
            draw(ringAroundBall(plain, shadow), kOpacityCamera, kShaderOpacitySize, {.shading = shading})
                .image;
        // By the shader, by the key, by both.
        Material opaque = plain;
        opaque.opacity = 1;
        for (const Material& material : {seenThroughBy(kMayBeSeenThrough + text + "0.4); }", opaque),
                                         seenThroughBy(text + "1.0); }", plain),
                                         seenThroughBy(kMayBeSeenThrough + text + "0.5); }", same)})
          EXPECT_LE(largestDifference(draw(ringAroundBall(material, shadow), kOpacityCamera,
                                           kShaderOpacitySize, {.shading = shading})
                                          .image,
                                      wanted),
                    2e-6);
      }
    }
}

TEST_F(ShaderOpacity, OneThingIsTheSameInEitherOrder) {
  const Material ring = seenThroughBy(
      kMayBeSeenThrough + "vec4 material(Point p) { return vec4(p.uv, 0.2, fract(8 * p.uv.x)); }");
  Scene given = ringAroundBall(ring, Light::Shadow::Exact), exact = given;
  given.set(RenderSettings{.blendOrder = BlendOrder::Given});
  EXPECT_TRUE(sameBytes(draw(given, kOpacityCamera, kShaderOpacitySize).image,
                        draw(exact, kOpacityCamera, kShaderOpacitySize).image));
}

TEST_F(ShaderOpacity, MayBeAnotherAtEveryPoint) {
  Graph graph;
  const Expr u = graph.variable(0), v = graph.variable(1);
  const Material plain{
      .specular = Vec3(0),
      .diffusePattern = Pattern(graph, std::array{u, v, Expr(0.5), 0.5 + 0.6 * sin(6 * kTau * u)}, 0)};
  const Material own = seenThroughBy(kMayBeSeenThrough + R"(
vec4 material(Point p) {
  return vec4(blinnPhong(vec3(p.uv, 0.5), vec3(0), 1.0), 0.5 + 0.6 * sin(37.69911184 * p.uv.x)); })");
  for (const Shading shading : {Shading::Exact, Shading::Phong})
    EXPECT_LE(largestDifference(draw(ringAroundBall(own), kOpacityCamera, kShaderOpacitySize,
                                     {.shading = shading, .samples = 4})
                                    .image,
                                draw(ringAroundBall(plain), kOpacityCamera, kShaderOpacitySize,
                                     {.shading = shading, .samples = 4})
                                    .image),
              2e-5);
}

TEST_F(ShaderOpacity, OfZeroIsAHole) {
  const Material hole = seenThroughBy(kMayBeSeenThrough +
                                      "vec4 material(Point p) { return vec4(1.0, 0.5, 7.0, 0.0); }"),
                 opaque = seenThroughBy(kMayBeSeenThrough +
                                        "vec4 material(Point p) { return vec4(0.5, 0.25, 2.0, 1.5); }"),
                 solid = seenThroughBy("vec4 material(Point p) { return vec4(0.5, 0.25, 2.0, 1.0); }");
  Material nothing;
  nothing.opacity = 0;
  for (const Shading shading : {Shading::Exact, Shading::Phong}) {
    const auto shown = [&](const Material& ring) {
      return draw(ringAroundBall(ring), kOpacityCamera, kShaderOpacitySize, {.shading = shading}).image;
    };
    EXPECT_LE(largestDifference(shown(hole), shown(nothing)), tolerance(2e-6, 4e-4));
    EXPECT_GT(largestDifference(shown(opaque), shown(nothing)), 0.4);
  }
  const auto solidly = [&](const Material& ring) {
    return draw(ringAroundBall(ring), kOpacityCamera, kShaderOpacitySize).image;
  };
  EXPECT_LE(largestDifference(solidly(opaque), solidly(solid)), 2e-6);
}

/// What the material's own opacity leaves nothing of is no geometry, whatever its shader says.
TEST_F(ShaderOpacity, OfNextToNothingIsNotInPicturesOfTheGeometry) {
  const std::string text = "vec4 material(Point p) { return vec4(0.5, 0.25, 2.0, 1.0); }";
  for (const Shading shading : {Shading::Exact, Shading::Phong}) {
    const auto shown = [&](double opacity) {
      return draw(ringAroundBall(seenThroughBy(text, {.opacity = opacity})), kOpacityCamera,
                  kShaderOpacitySize, {.shading = shading, .output = Output::Id})
          .image;
    };
    EXPECT_TRUE(sameBytes(shown(0.0009), shown(0)));
    EXPECT_FALSE(sameBytes(shown(0.001), shown(0)));
  }
}

/// What a point of what is seen through tells its shader is what an opaque one does: in exact shading, on the
/// triangles of a formula, and on triangles of their own with tangents; found by searches and by rays.
TEST_F(ShaderOpacity, ThePointIsThatOfAnOpaqueMaterial) {
  const auto both = [&](const Surface& surface, const Vec3& scale, const std::string& value,
                        Shading shading) {
    std::vector<Image> images;
    for (const std::string& pragma : {std::string(), kMayBeSeenThrough}) {
      Scene scene;
      scene.add(Node{.translation = Vec3(0.2, 0.1, -0.3),
                     .rotation = Rotation{{1, 2, 0.5}, 0.6},
                     .scale = scale,
                     .surface = surface,
                     .material = scene.add(
                         seenThroughBy(pragma + "vec4 material(Point p) { return vec4(" + value + ", 1.0); }",
                                       {.twoSided = TwoSided::Yes}))});
      images.push_back(draw(scene, kOpacityCamera, kShaderOpacitySize, {.shading = shading}).image);
    }
    return largestDifference(images[0], images[1]);
  };
  const Surface saddle = surface([](auto u, auto v) { return point(1.5 * u, 1.5 * v, u * v); },
                                 {{-1, 1}, {-1, 1}}),
                // Without bounds, so that rays find it.
      endless = surface([](auto u, auto v) { return point(1.5 * u, 1.5 * v, log(1 - u * u - v * v)); },
                        {{-1, 1}, {-1, 1}});
  const std::string values[] = {"p.position",
                                "p.object",
                                "p.normal",
                                "p.tangent",
                                "p.bitangent",
                                "p.Su",
                                "p.Sv",
                                "vec3(20.0 * p.footprint[0], 0.0)",
                                "vec3(20.0 * p.footprint[1], 0.0)"};
  for (const std::string& value : values) {
    SCOPED_TRACE(value);
    // Measured: 2e-4, of footprints, which grow without bound toward silhouettes; 6e-5 of all else.
    const double most = value.find("footprint") != std::string::npos ? 4e-4 : 1e-4;
    EXPECT_LE(both(saddle, Vec3(1), value, Shading::Exact), most);
    EXPECT_LE(both(saddle, Vec3(-1, 1, 1), value, Shading::Exact), most) << "mirrored";
    EXPECT_LE(both(saddle, Vec3(1), value, Shading::Phong), tolerance(1e-4, 2e-3));
    EXPECT_LE(both(endless, Vec3(1), value, Shading::Exact), 1e-4) << "by rays";
  }
}

TEST_F(ShaderOpacity, WhatIsWrongIsTold) {
  const auto refusal = [&](const Material& material) -> std::string {
    try {
      static_cast<void>(draw(ringAroundBall(material), kOpacityCamera, kShaderOpacitySize));
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::Scene);
      return error.what() + std::string("\n") + error.hint();
    }
    return "it was drawn";
  };
  EXPECT_THAT(refusal(seenThroughBy("vec4 material(Point p) { return vec4(1, 1, 1, 0.5); }")),
              HasSubstr("#pragma luxo opacity"));
  Material glass;
  glass.opacity = 0.5;
  EXPECT_THAT(refusal(seenThroughBy(
                  "// #pragma luxo opacity\nvec4 material(Point p) { return vec4(1, 1, 1, 0.5); }", glass)),
              HasSubstr("opacity below 1"));
  EXPECT_THAT(refusal(seenThroughBy(
                  kMayBeSeenThrough +
                  "vec4 material(Point p) { float x = 0.0; while (x < 1.0) x *= 0.5; return vec4(x); }")),
              HasSubstr("more than 32768 times"));
  EXPECT_THAT(refusal(seenThroughBy(kMayBeSeenThrough +
                                    "vec4 material(Point p) { return vec4(trace(p.normal).color, 1.0); }")),
              HasSubstr("sends rays"));
  const Picture picture = draw(
      ringAroundBall(seenThroughBy(
          kMayBeSeenThrough + "vec4 material(Point p) { return vec4(sqrt(p.position.x), 0.5, 0.5, 0.3); }")),
      kOpacityCamera, kShaderOpacitySize);
  EXPECT_GT(picture.statistics.error.nonfinitePx, 100U);
  for (std::size_t i = 0; i < picture.image.samples().size(); ++i)
    ASSERT_TRUE(std::isfinite(picture.image.samples()[i]));
}

/// As a caster it is as opaque as its key says; and that is told.
TEST_F(ShaderOpacity, ShadowsAreThoseOfTheKey) {
  const auto scene = [](const Material& ball) {
    Scene made;
    made.add(Node{.translation = Vec3(0, 0.4, 0), .surface = sphere(0.5), .material = made.add(ball)});
    made.add(Node{.translation = Vec3(0, -1.2, 0), .surface = rectangle(5, 5)});
    made.add(Node{.translation = Vec3(2, 4, 3), .light = Light{.shadow = Light::Shadow::Exact}});
    return made;
  };
  std::vector<std::string> told;
  setLogSink([&](LogLevel, const std::string& message) { told.push_back(message); });
  for (const double opacity : {1.0, 0.5}) {
    const Material own = seenThroughBy(
        kMayBeSeenThrough + "vec4 material(Point p) { return vec4(vec3(0.3), 0.0); }", {.opacity = opacity});
    const Verified found = verified(takeSnapshot(scene(own), 0, kShaderOpacitySize, kOpacityCamera));
    EXPECT_EQ(found.verification.wrong.total(), 0U);
    const Image shown = draw(scene(own), kOpacityCamera, kShaderOpacitySize).image;
    Material veil{.opacity = opacity};
    const Image wanted = draw(scene(veil), kOpacityCamera, kShaderOpacitySize).image;
    const Image id = draw(scene(veil), kOpacityCamera, kShaderOpacitySize, {.output = Output::Id}).image;
    for (int y = 0; y < kShaderOpacitySize.height; ++y)
      for (int x = 0; x < kShaderOpacitySize.width; ++x)
        if (id.pixel(x, y)[0] == 2) {
          EXPECT_TRUE(near(colorAt(shown, x, y), colorAt(wanted, x, y), 2e-6)) << x << " " << y;
        }
  }
  setLogSink({});
  EXPECT_THAT(told, testing::Contains(HasSubstr("shadows do not know")));
}

}  // namespace
}  // namespace luxo::test
