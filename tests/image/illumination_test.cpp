// SPDX-License-Identifier: Apache-2.0
// Light in a pixel against the formula of the lecture, worked out in double: known answers, and what must
// cancel.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "image/compare.h"
#include "scene/scene_builder.h"
#include "scene/scene_reader.h"
#include "support/picture.h"

namespace luxo::test {
namespace {

using Illumination = PictureTest;

constexpr PixelSize kIlluminationSize{33, 33};  // odd: the middle pixel's centre is on the optical axis
constexpr int kMiddle = 16;

Material d16() {
  return {.diffuse = {0.6, 0.4, 0.2}, .ambient = Vec3(0.1), .specular = Vec3(0.3), .shininess = 30};
}

/// The floor (normal +Y) seen so that the direction toward the viewer is v in the middle pixel.
Camera lookingAlong(const Vec3& v, Projection projection) {
  return {.eye = 5.0 * v,
          .up = std::abs(v.y) > 0.9 ? Vec3(0, 0, -1) : Vec3(0, 1, 0),
          .fovY = radians(30),
          .projection = projection,
          .height = 3};
}

/// A floor with a vertex at the origin.
Scene floorScene(const Material& material, const Vec3& ambient, std::span<const Shine> lights) {
  Scene scene;
  scene.set(RenderSettings{.background = Vec3(0), .ambient = ambient});
  scene.add(Node{.surface = rectangle(40, 40), .material = scene.add(material), .segments = Segments{2, 2}});
  for (const Shine& light : lights) addLight(scene, light);
  return scene;
}

/// Largest difference between a picture of the floor and the formula, over all its pixels.
double worstOnFloor(const Image& image, const Camera& camera, const Material& material, const Vec3& ambient,
                    std::span<const Shine> lights) {
  const CameraModel model(camera, {image.width(), image.height()});
  double worst = 0;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      const Ray ray = model.through(centerOf(x, y));
      const Vec3 point = ray.at(*hitPlane(ray, Vec3(0), {0, 1, 0}));
      const Vec3 expected =
          blinnPhong(material, ambient, lights, point, {0, 1, 0}, model.towardViewer(point));
      const Vec3 off = glm::abs(colorAt(image, x, y) - expected);
      worst = std::max({worst, off.x, off.y, off.z});
      if (std::isnan(off.x + off.y + off.z)) return std::numeric_limits<double>::infinity();
    }
  return worst;
}

TEST_F(Illumination, KnownAnswersOfTheLecture) {
  const double s = std::sqrt(0.5);
  struct Case {
    Vec3 l, v, color;
  };
  // N = (0, 1, 0): N = L = V; L and V mirrored about N; L = V at 45 degrees.
  const std::array cases{Case{{0, 1, 0}, {0, 1, 0}, {0.92, 0.72, 0.52}},
                         Case{{s, s, 0}, {-s, s, 0}, {0.744264, 0.602843, 0.461421}},
                         Case{{s, s, 0}, {s, s, 0}, {0.444273, 0.302852, 0.161431}}};
  for (const Case& c : cases)
    for (const Shading shading : {Shading::Exact, Shading::Phong, Shading::Flat})
      for (const Projection projection : {Projection::Perspective, Projection::Orthographic})
        for (const Vec4& position : {Vec4(c.l, 0), Vec4(7.0 * c.l, 1)}) {
          const Scene scene = floorScene(d16(), Vec3(0.2), std::array{Shine{.position = position}});
          const Picture picture =
              draw(scene, lookingAlong(c.v, projection), kIlluminationSize, {.shading = shading});
          EXPECT_TRUE(near(colorAt(picture.image, kMiddle, kMiddle), c.color, 1e-5))
              << nameOf(shading) << (projection == Projection::Perspective ? " perspective" : " orthographic")
              << " w = " << position.w << " v.x = " << c.v.x;
        }
}

TEST_F(Illumination, EveryPixelIsTheFormula) {
  // Steep and grazing views, point and directional lights, with and without attenuation. The largest value is
  // about 1 and single precision carries 6e-8 of it through about 50 roundings; the highlight multiplies the
  // error of N.H by its exponent.
  const std::array lights{Shine{.position = {3, 4, 1, 1}, .radiance = {9, 7, 5}, .inverseSquare = true},
                          Shine{.position = {-2, 5, 2, 1}, .radiance = {0.3, 0.2, 0.4}},
                          Shine{.position = {1, 2, -1, 0}, .radiance = {0.1, 0.3, 0.2}}};
  for (const Vec3& v : {Vec3(0.1, 0.9, 0.2), Vec3(0.9, 0.5, -0.3)})
    for (const Projection projection : {Projection::Perspective, Projection::Orthographic})
      for (const Shading shading : {Shading::Exact, Shading::Phong, Shading::Flat}) {
        const Camera camera = lookingAlong(glm::normalize(v), projection);
        const Picture picture =
            draw(floorScene(d16(), Vec3(0.2), lights), camera, kIlluminationSize, {.shading = shading});
        EXPECT_LE(worstOnFloor(picture.image, camera, d16(), Vec3(0.2), lights), tolerance(1e-5, 4e-5))
            << nameOf(shading) << (projection == Projection::Perspective ? " perspective" : " orthographic");
      }
}

TEST_F(Illumination, HighlightOfAnyExponent) {
  // Rounding turns H by a few times 6e-8, and the highlight by sqrt(n / e) of that where it is steepest. A
  // power of the rounded cosine would be wrong by 2e-7 n.
  const std::array lights{Shine{.position = {1, 5, 0.5, 1}}};
  const Camera camera = lookingAlong(glm::normalize(Vec3(-0.3, 1, 0.1)), Projection::Perspective);
  for (const double n : {0.0, 1.0, 8.0, 60.0, 500.0, 10000.0}) {
    Material material{.diffuse = Vec3(0), .specular = Vec3(1), .shininess = n};
    const Picture picture = draw(floorScene(material, Vec3(0), lights), camera, kIlluminationSize);
    EXPECT_LE(worstOnFloor(picture.image, camera, material, Vec3(0), lights), 5e-7 * std::sqrt(1 + n))
        << "shininess " << n;
  }
}

TEST_F(Illumination, NothingComesFromBelowTheHorizon) {
  const Vec3 v = glm::normalize(Vec3(-1, 0.4, 0));
  const std::array below{Shine{.position = {1, -0.2, 0, 0}}};
  const Camera camera = lookingAlong(v, Projection::Orthographic);
  Material material = d16();
  material.shininess = 2;
  const Picture gated = draw(floorScene(material, Vec3(0.2), below), camera, kIlluminationSize);
  EXPECT_TRUE(near(colorAt(gated.image, kMiddle, kMiddle), Vec3(0.1 * 0.2), 1e-7));

  material.lectureSpecular = true;
  const Vec3 h = glm::normalize(glm::normalize(Vec3(1, -0.2, 0)) + v);
  ASSERT_GT(h.y, 0.1);  // there is a highlight to leak
  const Picture ungated = draw(floorScene(material, Vec3(0.2), below), camera, kIlluminationSize);
  EXPECT_TRUE(near(colorAt(ungated.image, kMiddle, kMiddle), Vec3(0.1 * 0.2 + 0.3 * h.y * h.y), 1e-5));
}

TEST_F(Illumination, LightOnTheSurfaceIsFinite) {
  for (const bool inverseSquare : {false, true})
    for (const Shading shading : {Shading::Exact, Shading::Phong, Shading::Flat, Shading::Gouraud}) {
      const std::array lights{Shine{.position = {0, 0, 0, 1}, .inverseSquare = inverseSquare}};
      Scene scene = floorScene(d16(), Vec3(0.2), lights);
      const Picture picture = draw(scene, lookingAlong({0, 1, 0}, Projection::Perspective), kIlluminationSize,
                                   {.shading = shading});
      EXPECT_TRUE(allFinite(picture.image)) << nameOf(shading);
      // It lies in the plane: N.L = 0 around it but for rounding, which at most lets the highlight through:
      // 0.3 * cos(45 degrees)^30 = 9e-6, a metre away.
      EXPECT_TRUE(near(colorAt(picture.image, 3, 5), Vec3(0.1 * 0.2), 1e-5)) << nameOf(shading);
    }
}

TEST_F(Illumination, ShininessZeroIsAConstantHighlight) {
  // (N.H)^0 = 1 even where N.H = 0, which single-precision pow does not promise. Only the lecture's ungated
  // highlight gets there: L and V at equal angles below and above the floor, H along it.
  Material material{.diffuse = Vec3(0), .ambient = Vec3(0), .specular = Vec3(0.5), .shininess = 0};
  material.lectureSpecular = true;
  const Vec3 v = glm::normalize(Vec3(0, 1, 1));
  const std::array opposite{Shine{.position = {0, -1, 1, 0}}};  // H = (0, 0, 1), N.H = 0
  const Picture picture = draw(floorScene(material, Vec3(0), opposite),
                               lookingAlong(v, Projection::Orthographic), kIlluminationSize);
  EXPECT_TRUE(near(colorAt(picture.image, kMiddle, kMiddle), Vec3(0.5), 1e-6));
}

Scene ball(const Material& material, std::span<const Shine> lights) {
  Scene scene;
  scene.set(RenderSettings{.background = Vec3(0), .ambient = Vec3(0.2)});
  scene.add(Node{.surface = sphere(1), .material = scene.add(material)});
  scene.add(Camera{.eye = Vec3(1, 2, 4), .fovY = radians(35)});
  for (const Shine& light : lights) addLight(scene, light);
  return scene;
}

constexpr PixelSize kBall{96, 96};

TEST_F(Illumination, DirectionalLightIsAPointFarAway) {
  const Vec3 toward = glm::normalize(Vec3(1.1, 2.3, 2.9));
  for (const Shading shading : {Shading::Exact, Shading::Phong, Shading::Flat, Shading::Gouraud}) {
    const Image ideal =
        draw(ball(d16(), std::array{Shine{.position = Vec4(toward, 0)}}), kBall, {.shading = shading}).image;
    // From 1e7 m the directions differ by 1e-7 over the ball; the highlight multiplies that by up to 30.
    const Image distant =
        draw(ball(d16(), std::array{Shine{.position = Vec4(1e7 * toward, 1)}}), kBall, {.shading = shading})
            .image;
    EXPECT_LE(compare(ideal, distant).max, 1e-5) << nameOf(shading);
    EXPECT_GT(colorAt(ideal, 48, 40).x, 0.3);  // it does shine
  }
}

TEST_F(Illumination, WithoutLightOnlyAmbient) {
  const Material material{.ambient = Vec3(0.3, 0.6, 0.9)};
  const float ambient[] = {static_cast<float>(0.3 * 0.2), static_cast<float>(0.6 * 0.2),
                           static_cast<float>(0.9 * 0.2)};
  for (const Shading shading : {Shading::Exact, Shading::Phong, Shading::Flat}) {
    const Image image = draw(ball(material, {}), kBall, {.shading = shading}).image;
    int covered = 0;
    for (int y = 0; y < image.height(); ++y)
      for (int x = 0; x < image.width(); ++x) {
        const auto pixel = image.pixel(x, y);
        if (pixel[0] == 0) continue;
        ++covered;
        for (int k = 0; k < 3; ++k) ASSERT_EQ(pixel[k], ambient[k]) << nameOf(shading);
      }
    EXPECT_GT(covered, 1000);
  }
}

TEST_F(Illumination, LightsAddUp) {
  const Shine a{.position = {3, 1, 2, 1}, .radiance = {0.5, 0.1, 0.3}};
  const Shine b{.position = {-1, 2, 3, 0}, .radiance = {0.2, 0.4, 0.1}};
  const Image none = draw(ball(d16(), {}), kBall).image;
  const Image onlyA = draw(ball(d16(), std::array{a}), kBall).image;
  const Image onlyB = draw(ball(d16(), std::array{b}), kBall).image;
  const Image both = draw(ball(d16(), std::array{a, b}), kBall).image;
  EXPECT_GT(std::min(largestDifference(onlyA, none), largestDifference(onlyB, none)), 0.1);
  for (int y = 0; y < kBall.height; ++y)
    for (int x = 0; x < kBall.width; ++x)
      ASSERT_TRUE(
          near(colorAt(both, x, y) + colorAt(none, x, y), colorAt(onlyA, x, y) + colorAt(onlyB, x, y), 1e-6))
          << x << ", " << y;
}

/// More than a set of lights has room for: two in each of 24 places are one of twice the light there.
TEST_F(Illumination, ManyLightsAreTheSumOfAll) {
  const auto sceneOf = [](int inEachPlace, const std::string& floor) {
    std::string lights;
    for (int place = 0; place < 24; ++place)
      for (int i = 0; i < inEachPlace; ++i)
        lights += fmt::format(R"(, {{ "translate": [{}, {}, {}], "light": {{ "intensity": {} }} }})",
                              4 * std::cos(place), 1 + 0.2 * place, 4 * std::sin(place), 0.1 / inEachPlace);
    return buildScene(parseScene(
        R"({ "luxo": 1, "surfaces": { "ball": { "type": "sphere" }, "floor": { "type": "rectangle", "size": [6, 6] } },
             "materials": { "m": { "diffuse": [0.6, 0.5, 0.4], "specular": 0.3, "shininess": 12 },
                            "gouraud": { "diffuse": [0.6, 0.5, 0.4], "shading": "gouraud" },
                            "toon": { "diffuse": [0.6, 0.5, 0.4], "shading": "toon" } },
             "camera": { "eye": [2, 4, 6], "look_at": [0, 0.5, 0], "fov_y": "45deg" },
             "nodes": [ { "surface": "ball", "material": "m", "translate": [0, 1, 0] },
                        { "surface": "floor", "material": ")" +
            floor + "\" }" + lights + " ] }",
        "lights"));
  };
  const auto expectAlike = [&](const DrawOptions& options, double tolerance, const std::string& floor = "m") {
    const Snapshot few = takeSnapshot(sceneOf(1, floor), 0, {80, 60}),
                   many = takeSnapshot(sceneOf(2, floor), 0, {80, 60});
    ASSERT_EQ(many.lights.size(), 48U);
    const Picture lit = renderer().render(many, options);
    EXPECT_GT(lit.statistics.count.deferred, 0U);
    EXPECT_LE(largestDifference(renderer().render(few, options).image, lit.image), tolerance)
        << nameOf(options.shading) << " in " << options.samples << " over " << floor;
  };
  for (const int samples : {1, 4}) expectAlike({.samples = samples}, 2e-6);
  // Beside what searches have found, whose depths are probed.
  for (const char* floor : {"gouraud", "toon"}) expectAlike({}, 3e-4, floor);
  // Deferred light of a mesh is that of the ray's point, fused that of a corner's rounding beside it. Of many
  // samples that is another one in each of their pictures, and edges move with it: by less than a sample.
  for (const Shading shading : {Shading::Phong, Shading::Flat, Shading::Gouraud, Shading::Toon}) {
    expectAlike({.shading = shading}, 3e-4);
    expectAlike({.shading = shading, .samples = 4}, 0.1);
  }
}

}  // namespace
}  // namespace luxo::test
