// SPDX-License-Identifier: Apache-2.0
// Pictures by the lesson's formula: against this, written again here in bytes as the lesson has it, and
// against the ground truth in every pixel.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "base/srgb_curve.h"
#include "image/image.h"
#include "mesh/model.h"
#include "scene/model_scene.h"
#include "support/meshes.h"
#include "support/verified_picture.h"
#include "surface/library.h"

namespace luxo::test {
namespace {

namespace fs = std::filesystem;

constexpr int kTexels = 16;
using Bytes = std::array<std::uint8_t, 3>;

/// The maps of a head, row 0 on top.
struct Maps {
  std::vector<Bytes> diffuse, normals, tangents, exponents, glow;

  explicit Maps(unsigned seed) {
    std::mt19937 random(seed);
    const auto byte = [&](int low, int high) {
      return std::uint8_t(low + int(random() % unsigned(high - low + 1)));
    };
    for (int i = 0; i < kTexels * kTexels; ++i) {
      diffuse.push_back({byte(0, 255), byte(0, 255), byte(0, 255)});
      // Toward +Z, which is the plate's front.
      normals.push_back({byte(20, 235), byte(20, 235), byte(160, 255)});
      tangents.push_back({byte(60, 195), byte(60, 195), byte(180, 255)});
      const std::uint8_t exponent = byte(0, 60);
      exponents.push_back({exponent, exponent, exponent});
      glow.push_back({byte(0, 20), 0, byte(0, 80)});
    }
  }
};

/// An image that is written with these bytes.
Image imageOf(const std::vector<Bytes>& bytes, Codes codes) {
  Image image(kTexels, kTexels, 3);
  for (std::size_t i = 0; i < bytes.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      const double code = bytes[i][c] / 255.0;
      image.samples()[3 * i + c] = static_cast<float>(codes == Codes::Srgb ? linearFromSrgb(code) : code);
    }
  return image;
}

TextureMap mapOf(const std::vector<Bytes>& bytes, Codes codes) {
  return {.texture = std::make_shared<const Texture>(makeTexture(imageOf(bytes, codes), "bytes", codes)),
          .filter = TextureFilter::Nearest};
}

Material lessonOf(const Maps& maps, NormalSpace space, bool glows) {
  Material material{
      .diffuse = Vec3(1),
      .map = mapOf(maps.diffuse, Codes::Srgb),
      .normalMap = mapOf(space == NormalSpace::Object ? maps.normals : maps.tangents, Codes::Data),
      .normalSpace = space,
      .specularMap = mapOf(maps.exponents, Codes::Data)};
  material.lesson = true;
  if (glows) material.glowMap = mapOf(maps.glow, Codes::Srgb);
  return material;
}

const Vec3 kToLight = unit(Vec3(1, 0.2, 1.1));

Node sun(Light::Shadow shadow) {
  return {.rotation = turning(Vec3(0, 0, 1), kToLight),
          .light = Light{.type = Light::Type::Directional, .shadow = shadow}};
}

/// The lesson's fragment, of one light.
int lessonByte(int texel, const Vec3& n, double exponent, bool seesLight, const Vec3& z, int glow) {
  const double shadow = .3 + .7 * seesLight, nl = glm::dot(n, kToLight);
  const Vec3 r = unit(n * (nl * 2.0) - kToLight);
  const double spec = std::pow(std::max(glm::dot(r, z), 0.0), exponent), diff = std::max(0.0, nl);
  return int(std::min(20 + glow + texel * shadow * (1.2 * diff + .6 * spec), 255.0));
}

class LessonPicture : public VerifiedPictureTest {
 protected:
  /// Of a plate from -1 to 1 in x and y, lit from where a square keeps the light from x in 0.1 to 0.6.
  void expectTheLessons(Scene scene, const Maps& maps, NormalSpace space, bool glows, bool shadows) {
    if (shadows)
      scene.add(Node{.translation = Vec3(0.35, 0, 0) + kToLight * (2 / kToLight.z),
                     .rotation = Rotation{{1, 0, 0}, kPi / 2},
                     .surface = rectangle(0.5, 9)});
    scene.add(sun(shadows ? Light::Shadow::Exact : Light::Shadow::None));
    const Camera camera{.eye = Vec3(-2, 1, 4), .projection = Projection::Orthographic, .height = 1.9};
    constexpr PixelSize kSize{80, 80};
    const Image image = draw(scene, camera, kSize).image;
    const CameraModel model(camera, kSize);
    int compared = 0;
    for (int y = 0; y < kSize.height; ++y)
      for (int x = 0; x < kSize.width; ++x) {
        const Ray ray = model.through(centerOf(x, y));
        const Vec3 at = ray.at(*hitPlane(ray, Vec3(0), Vec3(0, 0, 1)));
        const double s = (at.x + 1) / 2 * kTexels, t = (1 - at.y) / 2 * kTexels;
        const auto isNear = [](double value) { return std::abs(value - std::round(value)) < 1e-3; };
        if (isNear(s) || isNear(t) || s < 0 || t < 0 || s > kTexels || t > kTexels) continue;
        if (shadows && (std::abs(at.x - 0.1) < 0.01 || std::abs(at.x - 0.6) < 0.01)) continue;
        const bool seesLight = !shadows || at.x < 0.1 || at.x > 0.6;
        const auto texel = std::size_t(int(t) * kTexels + int(s));
        const Bytes bytes = space == NormalSpace::Object ? maps.normals[texel] : maps.tangents[texel];
        const Vec3 n = unit(2.0 * Vec3(bytes[0], bytes[1], bytes[2]) / 255.0 - 1.0);
        for (std::size_t c = 0; c < 3; ++c) {
          const int wanted = lessonByte(maps.diffuse[texel][c], n, maps.exponents[texel][0], seesLight,
                                        model.towardViewer(at), glows ? maps.glow[texel][c] : 0);
          // As it is written; the lesson cuts off instead of rounding.
          const int shown = int(255 * srgbFromLinear(std::min(double(image.pixel(x, y)[c]), 1.0)) + 0.5);
          ASSERT_LE(std::abs(shown - wanted), 1) << x << ", " << y << ": " << shown << " for " << wanted;
        }
        ++compared;
      }
    EXPECT_GT(compared, 4000);
  }
};

TriangleMesh lessonQuad() {
  return triangleMesh({.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}},
                       .uvs = {{0, 1}, {1, 1}, {1, 0}, {0, 0}},
                       .indices = {0, 1, 2, 0, 2, 3}},
                      "quad", {.tangents = true});
}

TEST_F(LessonPicture, OfATexturedQuadHasTheLessonsBytes) {
  const Maps maps(1);
  for (const NormalSpace space : {NormalSpace::Object, NormalSpace::Tangent})
    for (const bool glows : {false, true})
      for (const bool shadows : {false, true}) {
        SCOPED_TRACE(int(space) * 4 + glows * 2 + shadows);
        Scene scene;
        scene.add(Node{.surface = lessonQuad(), .material = scene.add(lessonOf(maps, space, glows))});
        expectTheLessons(std::move(scene), maps, space, glows, shadows);
      }
}

TEST_F(LessonPicture, OfAFormulaHasTheLessonsBytes) {
  const Maps maps(2);
  for (const bool shadows : {false, true}) {
    Scene scene;
    scene.add(Node{.surface = surface([](auto x, auto y) { return point(x, y, 0); }, {{-1, 1}, {-1, 1}}),
                   .material = scene.add(lessonOf(maps, NormalSpace::Tangent, true))});
    expectTheLessons(std::move(scene), maps, NormalSpace::Tangent, true, shadows);
  }
}

/// As it lies there, by its names: what a lesson's reader has in a folder.
TEST_F(LessonPicture, OfAFolderHasTheLessonsBytes) {
  const fs::path folder = fs::temp_directory_path() / "luxo_lesson_folder";
  for (const NormalSpace space : {NormalSpace::Object, NormalSpace::Tangent}) {
    fs::remove_all(folder);
    fs::create_directories(folder);
    const Maps maps(3);
    std::ofstream(folder / "head.obj")
        << "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
           "vn 0 0 1\nf 1/1/1 2/2/1 3/3/1 4/4/1\n";
    const auto save = [&](const std::vector<Bytes>& bytes, const char* name) {
      imageOf(bytes, Codes::Srgb).save(folder / name);
    };
    save(maps.diffuse, "head_diffuse.tga");
    if (space == NormalSpace::Object)
      save(maps.normals, "head_nm.tga");
    else
      save(maps.tangents, "head_nm_tangent.tga");
    save(maps.exponents, "head_spec.tga");
    save(maps.glow, "head_glow.tga");
    const auto model = std::make_shared<const Model>(readModel(folder / "head.obj"));
    EXPECT_TRUE(model->warnings.empty());
    const Snapshot of = takeSnapshot(modelScene(model), 0, {8, 8});
    Scene scene;
    scene.add(Node{.surface = of.nodes.at(0).surface,
                   .material = scene.add(of.materials.at(of.nodes[0].material.index))});
    expectTheLessons(std::move(scene), maps, space, true, true);
  }
  fs::remove_all(folder);
}

/// Of several lights, in shadows or not, and in as many groups as they take.
TEST_F(LessonPicture, IsTheTruthsInEveryPixel) {
  for (const int lights : {2, 70})
    for (const Light::Shadow shadow : {Light::Shadow::None, Light::Shadow::Exact}) {
      if (lights > 2 && shadow == Light::Shadow::None) continue;
      Scene scene;
      const Maps maps(4);
      Material material = lessonOf(maps, NormalSpace::Tangent, true);
      for (TextureMap* map : material.maps()) map->filter = TextureFilter::Trilinear;
      Material plain{.diffuse = Vec3(0.3, 0.5, 0.4), .shininess = 12, .lesson = true};
      const MaterialId textured = scene.add(material), without = scene.add(plain);
      scene.add(Node{.translation = Vec3(0, -1, 0), .surface = rectangle(6, 6), .material = textured});
      scene.add(Node{.surface = sphere(0.7), .material = textured});
      scene.add(Node{.translation = Vec3(1.4, 0, 0), .surface = torus(0.4, 0.2), .material = without});
      scene.add(Node{
          .translation = Vec3(-1.4, 0, 0), .scale = Vec3(0.5), .surface = icosphere(3), .material = without});
      for (int i = 0; i < lights; ++i)
        scene.add(Node{.translation = Vec3(4 * std::cos(i + 0.7), 5, 4 * std::sin(i + 0.7)),
                       .light = Light{.intensity = 1.2 / lights, .shadow = shadow}});
      expectTrueColors(takeSnapshot(scene, 0, {96, 72}, Camera{.eye = Vec3(1, 1.5, 4)}), 4000);
    }
}

}  // namespace
}  // namespace luxo::test
