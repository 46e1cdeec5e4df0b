// SPDX-License-Identifier: Apache-2.0
// Textures as uniforms of a material's shader.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "image/image.h"
#include "scene/scene_builder.h"
#include "scene/scene_reader.h"
#include "scene/scene_writer.h"
#include "scene/shader_files.h"
#include "support/picture.h"
#include "surface/library.h"

namespace luxo::test {
namespace {

using testing::HasSubstr;

constexpr PixelSize kShaderTextureSize{80, 60};
const Camera kTexturedCamera{.eye = Vec3(1.5, 2.5, 4), .lookAt = Vec3(0, 0, 0)};

TextureMap tiles(int side, float alpha = 1) {
  Image image(side, side, 4);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const auto pixel = image.pixel(x, y);
      pixel[0] = (x / 8 + y / 8) % 2 != 0 ? 0.9f : 0.1f;
      pixel[1] = float(x) / float(side);
      pixel[2] = float(y) / float(side);
      pixel[3] = alpha;
    }
  return {.texture = std::make_shared<const Texture>(makeTexture(image, "tiles"))};
}

Material texturedBy(const std::string& text, std::vector<UniformValue> uniforms, TextureMap map = {}) {
  return {.map = std::move(map),
          .shader = std::make_shared<const MaterialShader>(MaterialShader{{{"test.frag", text}}}),
          .uniforms = std::move(uniforms)};
}

Scene ring(const Material& material) {
  Scene scene;
  scene.set(plainSettings());
  scene.add(Node{
      .rotation = Rotation{{1, 0, 0.4}, 0.9}, .surface = torus(1, 0.4), .material = scene.add(material)});
  return scene;
}

class ShaderTexture : public PictureTest {
 protected:
  Image shown(const Material& material, const DrawOptions& options = {}) {
    return draw(ring(material), kTexturedCamera, kShaderTextureSize, options).image;
  }
  std::string refusalOf(const Material& material) {
    try {
      static_cast<void>(shown(material));
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::Scene);
      return error.what();
    }
    return "it was drawn";
  }
};

/// Filtered as the material's own map is, wherever that is placed.
TEST_F(ShaderTexture, IsFilteredAsMapsAre) {
  TextureMap placed = tiles(128);
  placed.scale = Vec2(3, 2);
  placed.angle = 0.4;
  placed.offset = Vec2(0.1, 0.7);
  for (const TextureMap& map : {tiles(256), placed})
    for (const Composition composition : {Composition::Auto, Composition::Deferred})
      for (const Shading shading : {Shading::Exact, Shading::Phong}) {
        const DrawOptions options{.shading = shading, .composition = composition};
        const Image wanted = shown(
            texturedBy("vec4 material(Point p) { return vec4(colorMap(p.uv), 1.0); }", {}, map), options);
        const std::vector<UniformValue> wood{
            {.name = "other", .map = tiles(16)}, {.name = "k", .values = {1}}, {.name = "wood", .map = map}};
        const std::string head = "uniform sampler2D wood, other; uniform float k;\n";
        EXPECT_TRUE(
            sameBytes(shown(texturedBy(head + "vec4 material(Point p) { return vec4(k * texture(wood, "
                                              "p.uv).rgb, texture(other, p.uv).a); }",
                                       wood),
                            options),
                      wanted));
        EXPECT_TRUE(
            sameBytes(shown(texturedBy(head + "vec4 look(sampler2D s, Point p) { return textureGrad(s, "
                                              "p.uv, p.footprint[0], p.footprint[1]); }\n"
                                              "vec4 material(Point p) { return vec4(look(wood, p).rgb * "
                                              "k, texture(other, p.uv).a); }",
                                       wood),
                            options),
                      wanted));
      }
}

TEST_F(ShaderTexture, ItsAlphaMayBeTheOpacity) {
  const Material own = texturedBy(
      "#pragma luxo opacity\nuniform sampler2D leaf;\n"
      "vec4 material(Point p) { vec4 t = texture(leaf, p.uv); return vec4(0.8 * ambientLight() * t.rgb, "
      "t.a); }",
      {{.name = "leaf", .map = tiles(64, 0.25f)}});
  Material plain{.diffuse = Vec3(0.8), .specular = Vec3(0), .opacity = 0.25, .map = tiles(64)};
  const Image a = shown(own), b = shown(plain);
  for (std::size_t i = 0; i < a.samples().size(); ++i) ASSERT_NEAR(a.samples()[i], b.samples()[i], 1e-5);
}

TEST_F(ShaderTexture, WhatIsWrongIsTold) {
  const std::string text =
      "\nuniform sampler2D wood;\nuniform float k;\nvec4 material(Point p) { return k * texture(wood, p.uv); "
      "}";
  EXPECT_THAT(refusalOf(texturedBy(text, {})),
              testing::AllOf(HasSubstr("test.frag:2:19"), HasSubstr("the sampler 'wood' has no texture")));
  EXPECT_THAT(refusalOf(texturedBy(text, {{.name = "wood", .values = {0}}})),
              HasSubstr("is a texture, not a number"));
  EXPECT_THAT(
      refusalOf(texturedBy(text, {{.name = "wood", .map = tiles(8)}, {.name = "k", .map = tiles(8)}})),
      HasSubstr("is of type float, not a texture"));
  EXPECT_THAT(
      refusalOf(texturedBy(
          "uniform sampler2D wood[2]; vec4 material(Point p) { return texture(wood[1], p.uv); }", {})),
      HasSubstr("several samplers"));
  EXPECT_THAT(refusalOf(texturedBy(
                  "uniform sampler3D fog; vec4 material(Point p) { return texture(fog, p.object); }", {})),
              HasSubstr("'fog' is a sampler3D"));
  // One that nothing reads needs none.
  EXPECT_EQ(refusalOf(texturedBy("uniform sampler2D wood; vec4 material(Point p) { return vec4(1.0); }", {})),
            "it was drawn");
}

/// By its name, or with its place, in a scene file; written back as it was.
TEST_F(ShaderTexture, IsNamedInAScene) {
  const auto fileOf = [](const std::string& uniforms) {
    SceneFile file = parseScene(
        R"({ "luxo": 1, "params": { "turn": 0.5 }, "textures": { "squares": { "checker": [[1, 0, 0], [0, 0, 1]], "squares": 2 } },
      "materials": { "m": { "shader": "m.frag", "uniforms": { )" +
            uniforms + R"( } } },
      "surfaces": { "s": { "type": "rectangle", "size": [2, 2] } }, "nodes": [ { "surface": "s", "material": "m" } ],
      "camera": { "eye": [0, 5, 0.01], "type": "orthographic", "height": 2 } })",
        "scene");
    file.source.shaders = std::make_shared<ShaderFiles>();
    file.source.shaders->put("m.frag", std::make_shared<const MaterialShader>(MaterialShader{
                                           {{"m.frag",
                                             "uniform sampler2D skin; uniform float k; vec4 material(Point "
                                             "p) { return texture(skin, p.uv); }"}}}));
    return file;
  };
  const Image plain = draw(buildScene(fileOf(R"("skin": "squares")")), kShaderTextureSize).image;
  EXPECT_TRUE(near(colorAt(plain, 30, 20), Vec3(1, 0, 0), 1e-6) ||
              near(colorAt(plain, 30, 20), Vec3(0, 0, 1), 1e-6));
  EXPECT_GT(glm::distance(colorAt(plain, 30, 20), colorAt(plain, 50, 20)), 1.0);
  const Image moved = draw(buildScene(fileOf(R"("skin": { "texture": "squares", "offset": ["turn", 0] })")),
                           kShaderTextureSize)
                          .image;
  EXPECT_TRUE(near(colorAt(moved, 30, 20), colorAt(plain, 50, 20), 1e-6));
  const std::string written =
      writeScene(fileOf(R"("skin": { "texture": "squares", "offset": ["turn", 0] })"));
  EXPECT_THAT(written, HasSubstr("\"squares\""));
  const auto problem = [&](const std::string& uniforms) -> std::string {
    try {
      static_cast<void>(draw(buildScene(fileOf(uniforms)), kShaderTextureSize));
    } catch (const Error& error) {
      return error.what();
    }
    return "nothing";
  };
  EXPECT_THAT(problem(R"("skin": "square")"), testing::AllOf(HasSubstr("scene:2:"), HasSubstr("square")));
  EXPECT_THAT(problem(R"("skin": "squares", "k": { "texture": "squares" })"), HasSubstr("not a texture"));
}

}  // namespace
}  // namespace luxo::test
