// SPDX-License-Identifier: Apache-2.0
// Pictures of programs in the course's style: what the language gives them is what a fixed pipeline would.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/error.h"
#include "draw/material_program.h"
#include "image/image.h"
#include "scene/shader_files.h"
#include "support/picture.h"
#include "surface/library.h"

namespace luxo::test {
namespace {

using testing::HasSubstr;

constexpr PixelSize kCourseSize{72, 56};
Camera cameraAt(const Vec3& place) { return {.eye = place + Vec3(1.5, 2.5, 4), .lookAt = place}; }
const Camera kCamera = cameraAt(Vec3(0));

MaterialShaderPtr ofTheCourse(const std::string& fragment, const std::string& vertex = {}) {
  return ShaderFiles(LUXO_SOURCE_DIR "/apps/scenes/course").get(fragment, vertex);
}

/// The vertex program in front of the fragment program; empty: none.
MaterialShaderPtr programs(const std::string& vertex, const std::string& fragment) {
  MaterialShader shader{{{"test.frag", fragment}}};
  if (!vertex.empty()) {
    shader.vertex = 1;
    shader.files.push_back({"test.vert", vertex});
  }
  return std::make_shared<const MaterialShader>(std::move(shader));
}

Scene ringOnPlate(const Material& material, Light::Shadow shadow, const Vec3& at = Vec3(0)) {
  Scene scene;
  const MaterialId shown = scene.add(material);
  Node ring{
      .translation = at, .rotation = Rotation{{1, 0, 0.4}, 0.9}, .surface = torus(1, 0.4), .material = shown};
  ring.scale = Vec3(1, 0.8, 1.2);
  scene.add(std::move(ring));
  scene.add(Node{.translation = at + Vec3(0, -1.2, 0), .surface = rectangle(5, 5), .material = shown});
  scene.add(Node{
      .translation = at + Vec3(2, 4, 3),
      .light = Light{.intensity = 20, .attenuation = Light::Attenuation::InverseSquare, .shadow = shadow}});
  scene.add(Node{.rotation = Rotation{{1, 0, 0}, -1.0},
                 .light = Light{.type = Light::Type::Directional, .color = Vec3(0.2, 0.3, 0.5)}});
  return scene;
}

class CoursePicture : public PictureTest {
 protected:
  [[nodiscard]] Image shown(const MaterialShaderPtr& shader, const Camera& camera = kCamera,
                            const Vec3& at = Vec3(0)) {
    return draw(ringOnPlate({.shader = shader}, Light::Shadow::None, at), camera, kCourseSize,
                {.composition = Composition::Deferred})
        .image;
  }
  /// A fragment program that shows green where the condition holds everywhere.
  void expectHolds(const std::string& vertex, const std::string& before, const std::string& condition,
                   const Camera& camera = kCamera, const Vec3& at = Vec3(0)) {
    const Image image = shown(programs(vertex, before + "\nvoid main() { gl_FragColor = " + condition +
                                                   " ? vec4(0, 1, 0, 1) : vec4(1, 0, 0, 1); }"),
                              camera, at);
    std::size_t wrong = 0, right = 0;
    for (std::size_t i = 0; i < image.samples().size(); i += 3) {
      wrong += image.samples()[i] == 1;
      right += image.samples()[i + 1] == 1;
    }
    EXPECT_EQ(wrong, 0u) << condition;
    EXPECT_GT(right, 1000u) << condition;
  }
  std::string refusalOf(const MaterialShaderPtr& shader) {
    try {
      static_cast<void>(shown(shader));
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::Scene);
      return error.what();
    }
    ADD_FAILURE() << "it was drawn";
    return {};
  }
};

// The formula is luxo's own, in eye space. A cosine is off by some 2^-20 after the matrices, and its power 25
// by 25 times that of itself, which the light of at most 1 magnifies no more: 3e-5.
TEST_F(CoursePicture, LightAtVerticesAndInFragmentsIsThatOfMaterialsWithoutAShader) {
  Material plain{.diffuse = Vec3(0.6, 0.3, 0.2), .specular = Vec3(0.3), .shininess = 25}, own = plain;
  struct Case {
    const char *fragment, *vertex;
    Light::Shadow shadow;
    Shading shading;
  };
  for (const Case& one : {Case{"phong.frag", "point.vert", Light::Shadow::Exact, Shading::Exact},
                          Case{"phong.frag", "point.vert", Light::Shadow::None, Shading::Flat},
                          Case{"color.frag", "gouraud.vert", Light::Shadow::None, Shading::Phong},
                          Case{"color.frag", "", Light::Shadow::Exact, Shading::Exact}}) {
    own.shader = ofTheCourse(one.fragment, one.vertex);
    const DrawOptions options{.shading = one.shading};
    EXPECT_LE(largestDifference(draw(ringOnPlate(own, one.shadow), kCamera, kCourseSize, options).image,
                                draw(ringOnPlate(plain, one.shadow), kCamera, kCourseSize, options).image),
              3e-5)
        << one.fragment << " " << one.vertex << " " << nameOf(one.shading);
  }
}

TEST_F(CoursePicture, ColoursOfTheMaterialAreItsOwn) {
  Material material{.diffuse = Vec3(0.6, 0.3, 0.2), .specular = Vec3(0.25), .shininess = 25};
  for (const auto& [ambient, wanted] : {std::pair{std::optional<Vec3>(), Vec3(0.6, 0.3, 0.2)},
                                        {std::optional(Vec3(0.1, 0.5, 0.4)), Vec3(0.1, 0.5, 0.4)}}) {
    material.ambient = ambient;
    material.shader =
        programs("",
                 "void main() { gl_FragColor = gl_FrontMaterial.ambient + gl_FrontMaterial.specular + "
                 "0.01 * gl_FrontMaterial.shininess; }");
    const Image image = draw(ringOnPlate(material, Light::Shadow::None), kCamera, kCourseSize).image;
    EXPECT_TRUE(
        near(colorAt(image, kCourseSize.width / 2, kCourseSize.height - 12), wanted + Vec3(0.5), 1e-6));
  }
}

// In the order of their nodes, however luxo sorts them; a wide light is one.
TEST_F(CoursePicture, LightsHaveTheOrderOfTheScene) {
  const MaterialShaderPtr shader =
      programs("",
               "void main() { gl_FragColor = vec4(gl_LightSource[0].diffuse.r, gl_LightSource[1].diffuse.r, "
               "gl_LightSource[2].diffuse.r, 1); }");
  for (const double first : {0.25, 0.75}) {
    Scene scene;
    scene.add(Node{.surface = rectangle(9, 9), .material = scene.add(Material{.shader = shader})});
    scene.add(Node{.translation = Vec3(1, 3, 0), .light = Light{.intensity = first}});
    scene.add(Node{.translation = Vec3(-1, 3, 0), .light = Light{.intensity = 1 - first}});
    const Image image = draw(scene, kCamera, kCourseSize).image;
    EXPECT_TRUE(
        near(colorAt(image, kCourseSize.width / 2, kCourseSize.height / 2), Vec3(first, 1 - first, 0), 1e-6));
  }
}

// What the matrices make of the vertex is where the raster has the pixel: half a pixel off would be 1 / 56 of
// clip space.
TEST_F(CoursePicture, MatricesLeadToThePixel) {
  const std::string vertex = R"(
varying vec4 clip, eye, again;
varying vec3 n;
void main() {
  eye = gl_ModelViewMatrix * gl_Vertex;
  clip = gl_ProjectionMatrix * eye;
  again = gl_ModelViewProjectionMatrixInverse * ftransform() - gl_Vertex;
  n = normalize(mat3(gl_ModelViewMatrixInverseTranspose) * gl_Normal) - normalize(gl_NormalMatrix * gl_Normal);
  gl_Position = ftransform();
})",
                    fragment = "varying vec4 clip, eye, again;\nvarying vec3 n;\n";
  for (const Projection projection : {Projection::Perspective, Projection::Orthographic})
    for (const Vec3& at : {Vec3(0), Vec3(300, 20, -700)}) {
      Camera camera = cameraAt(at);
      camera.projection = projection;
      camera.height = 4;
      expectHolds(vertex, fragment,
                  "all(lessThan(abs((0.5 * clip.xy / clip.w + 0.5) * vec2(72.0, 56.0) - gl_FragCoord.xy), "
                  "vec2(0.02)))",
                  camera, at);
      expectHolds(vertex, fragment, "clip.z > -clip.w && clip.z < clip.w && eye.z < 0.0", camera, at);
      expectHolds(vertex, fragment, "length(n) < 1e-5 && gl_FrontFacing", camera, at);
      if (at == Vec3(0)) expectHolds(vertex, fragment, "all(lessThan(abs(again), vec4(1e-3)))", camera, at);
    }
}

TEST_F(CoursePicture, AVertexStaysWhereTheSurfaceIs) {
  const std::string fragment = "void main() { gl_FragColor = vec4(1.0); }";
  for (const char* place :
       {"ftransform() + vec4(0.001, 0.0, 0.0, 0.0)", "ftransform() - vec4(0.0, 0.0, 0.01, 0.0)", "gl_Vertex",
        "gl_ModelViewProjectionMatrix * vec4(1.01 * gl_Vertex.xyz, 1.0)", "-ftransform()",
        "ftransform() / 0.0"})
    EXPECT_THAT(refusalOf(programs("void main() { gl_Position = " + std::string(place) + "; }", fragment)),
                HasSubstr("the vertex program moves the vertex"))
        << place;
  const Vec3 far(300, 20, -700);
  for (const char* place :
       {"gl_ProjectionMatrix * gl_ModelViewMatrix * gl_Vertex",
        "gl_ProjectionMatrix * (gl_ModelViewMatrix * gl_Vertex)", "2.5 * ftransform()",
        "ftransform() / ftransform().w", "gl_Vertex * gl_ModelViewProjectionMatrixTranspose"})
    EXPECT_NO_THROW(static_cast<void>(shown(
        programs("void main() { gl_Position = " + std::string(place) + "; }", fragment), cameraAt(far), far)))
        << place;
}

// Every rule of the language has a green dot on its board, and no red one.
TEST_F(CoursePicture, TheRulesOfTheLanguageHold) {
  Scene scene;
  scene.add(Node{.surface = surface([](auto u, auto v) { return point(u, v, 0 * u); }, {{0, 1}, {0, 1}}),
                 .material = scene.add(Material{.shader = ofTheCourse("types.frag", "types.vert")})});
  const Camera camera{.eye = Vec3(0.5, 0.5, 2),
                      .lookAt = Vec3(0.5, 0.5, 0),
                      .projection = Projection::Orthographic,
                      .height = 1};
  const Image image = draw(scene, camera, {64, 64}).image;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column)
      EXPECT_TRUE(near(colorAt(image, 16 * column + 8, 16 * row + 8), Vec3(0.1, 0.55, 0.2), 1e-6))
          << "rule " << column + 4 * (3 - row);
}

// Each its own: functions, constants, structures, macros, uniforms of one value; and names that the language
// has since.
TEST_F(CoursePicture, ProgramsDoNotShareNames) {
  expectHolds(
      R"(
#define TWICE(x) (2.0 * (x))
const float k = 1.0;
uniform float common = 4.0;
struct Light { vec3 position; float filter[2]; };
float sample(float x) { return x + k; }
float total = 0.5;
varying float position, normal, material;
varying vec2 patch[2];
void main() {
  Light l;
  l.position = vec3(1.0);
  l.filter[1] = 2.0;
  position = sample(TWICE(total)) + step(0.5, l.position.x);  // 3
  normal = common + l.filter[1];                   // 6
  patch[1] = vec2(7.0, 8.0);
  material = 9.0;
  gl_TexCoord[2] = vec4(5.0);
  gl_Position = ftransform();
})",
      R"(
#define TWICE(x) (20.0 * (x))
const float k = 10.0, step = 4.0;  // a function of the language, in the vertex program
uniform float common;
struct Light { float position; };
float sample(float x) { return x * k; }
float total = 50.0;
varying float position, normal, material;
varying vec2 patch[2];
float two() { const float mod = 2.0; return mod; })",
      "sample(TWICE(total)) == 10000.0 && position == 3.0 && normal == 6.0 && patch[1] == vec2(7.0, 8.0) && "
      "material == 9.0 && common == 4.0 && gl_TexCoord[2].t == 5.0 && Light(2.0).position == mod(7.0, 5.0) "
      "&& step == 4.0 && two() == 2.0");
}

TEST_F(CoursePicture, EachProgramOfTheCourseCompiles) {
  for (const auto& [fragment, vertex] :
       std::initializer_list<std::pair<const char*, const char*>>{{"hello.frag", "hello.vert"},
                                                                  {"toon.frag", "point.vert"},
                                                                  {"texture.frag", "point.vert"},
                                                                  {"bump.frag", "bump.vert"},
                                                                  {"mirror.frag", "point.vert"},
                                                                  {"varying.frag", "matrices.vert"},
                                                                  {"flow.frag", "types.vert"},
                                                                  {"functions.frag", "types.vert"},
                                                                  {"coordinates.frag", ""},
                                                                  {"holes.frag", ""},
                                                                  {"varying.frag", "qualifiers.vert"},
                                                                  {"wave.frag", "wave.vert"}})
    EXPECT_TRUE(MaterialProgram(ofTheCourse(fragment, vertex)).inCourseStyle()) << fragment;
}

// A hole is what is behind it, whatever the program goes on to compute; alpha says nothing by itself.
TEST_F(CoursePicture, WhatIsDiscardedIsAHole) {
  const auto picture = [&](const std::string& fragment) {
    return draw(ringOnPlate({.shader = programs("", fragment)}, Light::Shadow::Exact), kCamera, kCourseSize)
        .image;
  };
  const std::string holes = "fract(8.0 * gl_TexCoord[0].s) < 0.5",
                    colour = "gl_FragColor = vec4(gl_Color.rgb, 0.25);";
  const Image wanted = picture("#pragma luxo opacity\nvoid main() { " + colour +
                               " gl_FragColor.a = " + holes + " ? 0.0 : 1.0; }");
  EXPECT_EQ(largestDifference(picture("void main() { if (" + holes + ") discard; " + colour + " }"), wanted),
            0);
  EXPECT_EQ(largestDifference(
                picture("void cut(bool is) { if (is) discard; }\nvoid main() { cut(" + holes + "); " +
                        colour + " if (" + holes + ") gl_FragColor = vec4(log(-gl_TexCoord[0].s - 1.0)); }"),
                wanted),
            0);
  EXPECT_EQ(largestDifference(
                picture("#pragma luxo opacity\nvoid main() { " + colour + " if (" + holes + ") discard; }"),
                picture("#pragma luxo opacity\nvoid main() { " + colour + " if (" + holes +
                        ") gl_FragColor.a = 0.0; }")),
            0);
  const Image nothing = picture("void main() { gl_FragColor = gl_Color; discard; }");
  for (std::size_t i = 3; i < nothing.samples().size(); ++i)
    ASSERT_EQ(nothing.samples()[i], nothing.samples()[i % 3]) << "the background alone";
}

// What OpenGL does with one texture that modulates: fragments of a vertex program that has no other.
TEST_F(CoursePicture, AVertexProgramAloneHasTheFixedFunctionalitysFragments) {
  const std::string vertex =
      "void main() { gl_FrontColor = vec4(0.5 + 0.5 * gl_Normal, 1.0); gl_TexCoord[0] = 2.0 * "
      "gl_MultiTexCoord0; "
      "gl_Position = ftransform(); }";
  MaterialShader alone{{kFixedFragments, {"test.vert", vertex}}, 1};
  for (const bool textured : {false, true}) {
    TextureMap map;
    if (textured) {
      Image halves(4, 2, 3);
      for (int i = 0; i < 8; ++i) halves.pixel(i % 4, i / 4)[0] = i % 2 != 0 ? 1.0f : 0.25f;
      map.texture = std::make_shared<const Texture>(makeTexture(halves, "halves"));
    }
    Scene fixed = ringOnPlate({.map = map, .shader = std::make_shared<const MaterialShader>(alone)},
                              Light::Shadow::None);
    Scene own =
        ringOnPlate({.map = map,
                     .shader = programs(
                         vertex, textured ? "uniform sampler2D map; void main() { gl_FragColor = gl_Color * "
                                            "texture2D(map, gl_TexCoord[0].st); }"
                                          : "void main() { gl_FragColor = gl_Color; }")},
                    Light::Shadow::None);
    EXPECT_EQ(
        largestDifference(draw(fixed, kCamera, kCourseSize).image, draw(own, kCamera, kCourseSize).image), 0);
  }
}

TEST_F(CoursePicture, LoopsWithoutEndAreRefused) {
  EXPECT_THAT(
      refusalOf(programs("varying float x; void main() { x = 1.0; while (x > 0.0) x *= 1.0; gl_Position = "
                         "ftransform(); }",
                         "varying float x; void main() { gl_FragColor = vec4(x); }")),
      HasSubstr("more than 32768 times"));
}

/// Uniforms that both programs have, true or false, and arrays of which elements are read.
TEST_F(CoursePicture, UniformsOfBothProgramsAreOne) {
  const MaterialShaderPtr shader = programs(
      "uniform bool on; uniform vec3 tones[200]; uniform float shared = 0.25; varying vec3 tone;\n"
      "void main() { tone = on ? tones[int(gl_Vertex.y * 0.0) + 150] : vec3(0); gl_Position = ftransform(); "
      "}",
      "uniform bool on; uniform vec3 tones[200]; uniform float shared; varying vec3 tone;\n"
      "void main() { gl_FragColor = vec4(on ? tone.r : 0.0, tones[7].g, shared, 1.0); }");
  std::vector<double> tones(600);
  tones[450] = 0.5;
  tones[22] = 0.75;
  const Material material{.shader = shader, .uniforms = {{"on", {1}}, {"tones", tones}}};
  const Image image = draw(ringOnPlate(material, Light::Shadow::None), kCamera, kCourseSize).image;
  EXPECT_TRUE(
      near(colorAt(image, kCourseSize.width / 2, kCourseSize.height - 12), Vec3(0.5, 0.75, 0.25), 1e-6));
}

}  // namespace
}  // namespace luxo::test
