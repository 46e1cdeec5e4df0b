// SPDX-License-Identifier: Apache-2.0
// The ground truth against pictures worked out from equations: a sphere and a floor, their light, their
// shadow.
#include "reference/reference.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "scene/scene_construction.h"
#include "scene/scene_reader.h"
#include "surface/library.h"

namespace luxo {
namespace {

constexpr PixelSize kReferenceSize{96, 64};
constexpr double kRadius = 1.25;
const Vec3 kLight(4, 5, 6);

Camera camera() { return {.eye = Vec3(0, 0, 5), .lookAt = Vec3(0), .fovY = radians(40), .near = 0.1}; }

Scene sphereScene(Material material = {.diffuse = {0.6, 0.4, 0.2}, .specular = Vec3(0.3), .shininess = 30}) {
  Scene scene;
  scene.set(RenderSettings{.size = kReferenceSize, .background = {0.1, 0.2, 0.3}, .ambient = Vec3(0.05)});
  scene.add(Node{.surface = sphere(kRadius), .material = scene.add(std::move(material))});
  scene.add(Node{.translation = kLight,
                 .light = Light{.intensity = 40, .attenuation = Light::Attenuation::InverseSquare}});
  scene.add(camera());
  return scene;
}

/// Unit direction of the ray through a pixel's centre, from the definition of the camera above.
Vec3 directionOf(int x, int y) {
  const double half = std::tan(radians(20));
  return glm::normalize(
      Vec3(((x + 0.5) / kReferenceSize.width * 2 - 1) * half * kReferenceSize.width / kReferenceSize.height,
           (1 - (y + 0.5) / kReferenceSize.height * 2) * half, -1));
}

TEST(ReferencePicture, SphereByItsEquations) {
  const ReferencePicture picture = castPicture(takeSnapshot(sphereScene(), 0, kReferenceSize));
  std::uint64_t hits = 0;
  for (int y = 0; y < kReferenceSize.height; ++y)
    for (int x = 0; x < kReferenceSize.width; ++x) {
      const std::size_t i = static_cast<std::size_t>(y * kReferenceSize.width + x);
      const Vec3 eye(0, 0, 5), d = directionOf(x, y);
      const double b = glm::dot(eye, d), discriminant = b * b - (25 - kRadius * kRadius);
      const auto color = picture.color.pixel(x, y);
      if (discriminant < 0) {
        EXPECT_EQ(picture.number[i], 0U);
        EXPECT_TRUE(std::isinf(picture.depth[i]));
        EXPECT_FLOAT_EQ(color[1], 0.2F);
        continue;
      }
      ++hits;
      const Vec3 p = eye + (-b - std::sqrt(discriminant)) * d, n = p / kRadius,
                 l = glm::normalize(kLight - p);
      const Vec3 h = glm::normalize(l - d);
      const double cosine = glm::dot(n, l), far = glm::length(kLight - p);
      Vec3 expected = Vec3(0.6, 0.4, 0.2) * 0.05;
      if (cosine > 0)
        expected +=
            (Vec3(0.6, 0.4, 0.2) * cosine + Vec3(0.3) * std::pow(std::max(glm::dot(n, h), 0.0), 30.0)) *
            40.0 / (far * far);
      EXPECT_EQ(picture.number[i], 1U);
      EXPECT_NEAR(picture.depth[i], 5 - p.z, 1e-12);
      EXPECT_LT(glm::length(picture.position[i] - p), 1e-12);
      EXPECT_LT(glm::length(picture.normal[i] - n), 1e-12);
      for (int c = 0; c < 3; ++c)  // the picture holds floats
        EXPECT_NEAR(color[static_cast<std::size_t>(c)], expected[c], 1e-7 + 6e-8 * expected[c])
            << x << ',' << y;
    }
  EXPECT_GT(hits, 1000U);
  EXPECT_EQ(picture.hits, hits);
  EXPECT_EQ(picture.misses + picture.hits,
            static_cast<std::uint64_t>(kReferenceSize.width * kReferenceSize.height));
  EXPECT_EQ(picture.undecided, 0U);
}

TEST(ReferencePicture, IsTheSameOnAnyNumberOfThreads) {
  const Snapshot snapshot = takeSnapshot(sphereScene(), 0, kReferenceSize);
  const ReferencePicture one = castPicture(snapshot, {.samples = 3, .threads = 1});
  const ReferencePicture two = castPicture(snapshot, {.samples = 3, .threads = 2});
  EXPECT_TRUE(std::ranges::equal(one.color.samples(), two.color.samples()));
  EXPECT_EQ(one.depth, two.depth);
  EXPECT_EQ(one.standardErrorRms, two.standardErrorRms);
}

// A checkerboard of the surface's own parameters, in linear light alone.
TEST(ReferencePicture, PatternsAreEvaluatedAtTheHit) {
  const Pattern halves = pattern([](auto, auto v) {
    const Expr upper = lessEqual(Expr(0.5), v);
    return point(upper, 1 - upper, Expr(0));
  });
  Scene scene = sphereScene({.ambient = std::nullopt, .specular = Vec3(0), .diffusePattern = halves});
  RenderSettings settings = scene.settings();
  settings.ambient = Vec3(1);
  scene.set(settings);
  const ReferencePicture picture = castPicture(takeSnapshot(scene, 0, kReferenceSize));
  // v is the latitude: the northern half is red and the southern green.
  const auto north = picture.color.pixel(48, 20), south = picture.color.pixel(48, 44);
  EXPECT_GE(north[0], 1);
  EXPECT_EQ(north[1], 0);
  EXPECT_EQ(south[0], 0);
  EXPECT_GE(south[1], 1);
}

// Half transparent: in front of what lies behind it, its own far side included.
TEST(ReferencePicture, TransparentSurfacesAreSeenThrough) {
  Scene scene;
  scene.set(RenderSettings{.size = kReferenceSize, .background = Vec3(0.5), .ambient = Vec3(1)});
  const MaterialId glass = scene.add(
      Material{.diffuse = Vec3(1, 0, 0), .specular = Vec3(0), .opacity = 0.5, .twoSided = TwoSided::Yes});
  scene.add(Node{.surface = sphere(kRadius), .material = glass});
  scene.add(camera());
  const ReferencePicture picture = castPicture(takeSnapshot(scene, 0, kReferenceSize));
  const auto middle = picture.color.pixel(kReferenceSize.width / 2, kReferenceSize.height / 2);
  EXPECT_FLOAT_EQ(middle[0], 0.5F + 0.5F * (0.5F + 0.5F * 0.5F));  // red over red over grey
  EXPECT_FLOAT_EQ(middle[1], 0.125F);
}

// Of a ball whose fronts alone are shown the far inside is seen through a hole that the near plane cuts, and
// is not there; the same ball mirrored is the same ball, outward normals included.
TEST(ReferencePicture, BackFacesAndMirrorsFollowTheMaterial) {
  constexpr std::size_t kMiddle = kReferenceSize.width * kReferenceSize.height / 2 + kReferenceSize.width / 2;
  for (const double mirror : {1.0, -1.0})
    for (const TwoSided sides : {TwoSided::Auto, TwoSided::Yes, TwoSided::No})
      for (const Projection projection : {Projection::Perspective, Projection::Orthographic}) {
        Scene scene;
        const MaterialId material = scene.add(Material{.twoSided = sides});
        scene.add(Node{.scale = Vec3(mirror, 1, 1), .surface = sphere(kRadius), .material = material});
        Camera cut = camera();
        cut.near = 5.0;  // through the centre
        cut.projection = projection;
        scene.add(cut);
        const ReferencePicture inside = castPicture(takeSnapshot(scene, 0, kReferenceSize));
        EXPECT_EQ(inside.number[kMiddle], sides == TwoSided::No ? 0U : 1U);
        if (sides != TwoSided::No) {
          EXPECT_NEAR(inside.depth[kMiddle], 5 + kRadius, 0.01);  // half a pixel off the middle
          EXPECT_NEAR(inside.normal[kMiddle].z, sides == TwoSided::Yes ? 1 : -1, 0.01);
        }
        const ReferencePicture outside = castPicture(
            takeSnapshot(scene, 0, kReferenceSize,
                         Camera{.eye = Vec3(0, 0, 5), .lookAt = Vec3(0), .projection = projection}));
        EXPECT_NEAR(outside.depth[kMiddle], 5 - kRadius, 0.01);
        EXPECT_NEAR(outside.normal[kMiddle].z, 1, 0.01);
      }
}

// A pixel that a straight edge cuts: its mean over many samples is the part that is covered, and the stated
// error tells how far it is from that.
TEST(ReferencePicture, SamplesAverageToCoverage) {
  Scene scene;
  constexpr PixelSize kSmall{8, 8};
  scene.set(RenderSettings{.size = kSmall, .background = Vec3(0), .ambient = Vec3(1)});
  const MaterialId white = scene.add(Material{.diffuse = Vec3(1), .specular = Vec3(0)});
  // A square from x = -inf to x = 0.3 pixels right of the middle; 8 pixels are 8 metres.
  scene.add(Node{.translation = Vec3(-10 + 0.3, 0, 0),
                 .rotation = Rotation{{1, 0, 0}, radians(90)},
                 .surface = rectangle(20, 40),
                 .material = white});
  scene.add(
      Camera{.eye = Vec3(0, 0, 5), .lookAt = Vec3(0), .projection = Projection::Orthographic, .height = 8});
  const ReferencePicture picture = castPicture(takeSnapshot(scene, 0, kSmall), {.samples = 256});
  for (int y = 0; y < 8; ++y) {
    EXPECT_EQ(picture.color.pixel(3, y)[0], 1);
    EXPECT_EQ(picture.color.pixel(5, y)[0], 0);
    // Random points would err by sqrt(0.3 * 0.7 / 256) = 0.029; the stated error is that.
    EXPECT_NEAR(picture.color.pixel(4, y)[0], 0.3, 3 * 0.0287);
  }
  EXPECT_NEAR(picture.standardErrorMax, std::sqrt(0.3 * 0.7 / 255), 0.002);
}

/// By the equations of a ball seen from far away: of its silhouette and of the sun's cosine the derivatives
/// over the picture are known.
TEST(ReferencePicture, DrawsInTwoLevelsWithAnOutline) {
  constexpr double kPxPerMetre = 20;
  const Vec3 sun = glm::normalize(Vec3(1, 2, 2)), paint(0.8, 0.6, 0.4);
  Scene scene;
  scene.set(RenderSettings{.background = Vec3(1)});
  scene.add(Node{.surface = sphere(1), .material = scene.add(Material{.diffuse = paint})});
  scene.add(Node{.rotation = Rotation{glm::cross(Vec3(0, 0, 1), sun), std::acos(sun.z)},
                 .light = Light{.type = Light::Type::Directional}});
  const Snapshot snapshot = takeSnapshot(
      scene, 0, {64, 64},
      Camera{.eye = Vec3(0, 0, 5), .lookAt = Vec3(0), .projection = Projection::Orthographic, .height = 3.2});
  const ReferencePicture picture = castPicture(snapshot, {.shading = Shading::Toon});
  int inked = 0, edge = 0;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      const Vec2 p((x + 0.5 - 32) / kPxPerMetre, (32 - y - 0.5) / kPxPerMetre);
      const double r2 = glm::dot(p, p), z = std::sqrt(1 - r2);
      if (!(r2 < 1)) {
        EXPECT_EQ(picture.color.pixel(x, y)[0], 1);
        continue;
      }
      const double cosine = glm::dot(sun, Vec3(p, z));
      const double slope = glm::length(Vec2(sun) - p * (sun.z / z)) / kPxPerMetre;
      const double bright = std::clamp((cosine - 0.5) / slope + 0.5, 0.0, 1.0);
      const double outlinePx = (1 - r2) / (2 * std::sqrt(r2) / kPxPerMetre);
      const double ink = std::clamp(2.5 - outlinePx, 0.0, 1.0);
      inked += ink == 1;
      edge += bright > 0 && bright < 1;
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(picture.color.pixel(x, y)[static_cast<std::size_t>(c)],
                    paint[c] * (0.5 + 0.5 * bright) * (1 - ink), 2e-3)
            << x << ", " << y;
    }
  EXPECT_GT(inked, 100);
  EXPECT_GT(edge, 20);
}

TEST(ReferencePicture, RefusesWhatIsNotLight) {
  Scene scene = sphereScene({.name = "inky", .shading = Shading::Wireframe});
  try {
    static_cast<void>(castPicture(takeSnapshot(scene, 0, kReferenceSize)));
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("inky"), std::string::npos);
  }
}

TEST(ReferencePicture, StopsWhenAsked) {
  const ReferencePicture picture = castPicture(takeSnapshot(sphereScene(), 0, kReferenceSize),
                                               {.threads = 1, .progress = [](double) { return false; }});
  EXPECT_FALSE(picture.complete);
}

/// An exponent that a parameter gives is known to rounding only: where a formula ends, as powers do at 0,
/// cells reach a little farther, and are bounded all the same.
TEST(ReferencePicture, PowersOfAParameterEndWhereThoseOfANumberDo) {
  const Scene scene = buildScene(parseScene(R"({ "luxo": 1, "params": { "k": 0.32 },
    "surfaces": { "box": { "type": "superellipsoid", "radii": [0.7, 0.6, 0.7], "exponents": ["k", "k"] } },
    "nodes": [ { "surface": "box", "rotate": { "axis": [0, 1, 0], "angle": "24deg" } } ],
    "camera": { "eye": [0, 2.3, 6.2], "fov_y": "20deg" } })",
                                            "box.luxo.json"));
  const ReferencePicture picture = castPicture(takeSnapshot(scene, 0, {24, 18}));
  EXPECT_GT(picture.hits, 80U);
  EXPECT_EQ(picture.undecided, 0U);
}

}  // namespace
}  // namespace luxo
