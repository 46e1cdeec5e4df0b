// SPDX-License-Identifier: Apache-2.0
// Light through what is seen through: against closed forms, and against the reference's rays.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "reference/reference.h"
#include "scene/scene_builder.h"
#include "scene/scene_reader.h"
#include "support/verified_picture.h"

namespace luxo::test {
namespace {

constexpr PixelSize kTransmittanceSize{240, 180};

class TransmittanceTest : public VerifiedPictureTest {
 protected:
  /// A floor at y = 0 that reflects nothing but diffuse light, of the colour 1, and these nodes.
  [[nodiscard]] static Scene sceneOf(const std::string& nodes) {
    return buildScene(parseScene(R"_({ "luxo": 1,
      "render": { "ambient": [0, 0, 0], "background": [0, 0, 0] },
      "materials": {
        "floor": { "diffuse": [1, 1, 1], "specular": 0 },
        "clay": { "diffuse": [0.6, 0.4, 0.3], "specular": 0 },
        "half": { "diffuse": [0, 0, 0], "specular": 0, "opacity": 0.5 },
        "quarter": { "diffuse": [0, 0, 0], "specular": 0, "opacity": 0.25 },
        "glow": { "diffuse": [0.2, 0, 0], "specular": 0, "opacity": 0.3, "blend": "add" },
        "stained": { "diffuse": [0.9, 0.5, 0.1], "specular": 0, "opacity": 0.2, "blend": "multiply" },
        "ramp": { "diffuse": [0, 0, 0], "specular": 0, "opacity": "u*v" },
        "nothing": { "opacity": 0 },
        "painted": { "diffuse": ["u", "v", 0.5], "specular": 0, "blend": "multiply", "opacity": 0 } },
      "surfaces": { "floor": { "type": "rectangle", "size": [40, 40] },
                    "pane": { "type": "rectangle", "size": [4, 4] },
                    "card": { "type": "rectangle", "size": [2, 2] },
                    "ball": { "type": "sphere", "radius": 1 },
                    "klein": { "type": "klein" },
                    "torus": { "type": "torus", "major": 1, "minor": 0.4 } },
      "camera": { "eye": [0, 1.5, 3], "look_at": [0, 0, 0], "fov_y": "50deg" },
      "nodes": [ { "name": "floor", "surface": "floor", "material": "floor" }, )_" +
                                     nodes + "] }",
                                 "transmittance"));
  }

  static constexpr const char* kNoon =
      R"({ "rotate": { "axis": [1, 0, 0], "angle": -1.5707963267948966 },
           "light": { "type": "directional", "shadow": "exact" } })";
  static constexpr const char* kPlanarNoon =
      R"({ "rotate": { "axis": [1, 0, 0], "angle": -1.5707963267948966 },
           "light": { "type": "directional", "shadow": "planar", "shadow_plane": "floor" } })";

  /// A pane, high over all that the camera sees, and the sun in the zenith: N.L is 1 there.
  static std::string pane(const std::string& material, double height) {
    return R"({ "surface": "pane", "translate": [0, )" + std::to_string(height) + R"(, 0], "material": ")" +
           material + R"(" }, )";
  }

  /// Every pixel of the floor below the pane shows `light(x, z)`: in exact shadows, and in planar ones, as
  /// panes are meshes of no error.
  template <class Light>
  void expectFloor(const std::string& nodes, const Light& light) {
    for (const char* noon : {kNoon, kPlanarNoon}) expectFloorOf(sceneOf(nodes + noon), light);
  }
  template <class Light>
  void expectFloorOf(const Scene& scene, const Light& light) {
    const Picture picture = draw(scene, kTransmittanceSize);
    const CameraModel camera(scene.cameras()[0], kTransmittanceSize);
    int seen = 0;
    for (int y = 0; y < kTransmittanceSize.height; ++y)
      for (int x = 0; x < kTransmittanceSize.width; ++x) {
        const Ray ray = camera.through(centerOf(x, y));
        const auto t = hitPlane(ray, Vec3(0), Vec3(0, 1, 0));
        if (!t) continue;
        const Vec3 at = ray.at(*t);
        if (std::max(std::abs(at.x), std::abs(at.z)) > 1.99) continue;
        const Vec3 expected = light(at.x, at.z);
        ASSERT_TRUE(near(colorAt(picture.image, x, y), expected, 2e-6)) << x << ", " << y;
        ++seen;
      }
    EXPECT_GT(seen, 5000);
    EXPECT_EQ(picture.statistics.error.auditFailedPx, 0U);
    EXPECT_EQ(picture.statistics.error.unconvergedPx, 0U);
  }
};

TEST_F(TransmittanceTest, OfPanesIsTheProductOfWhatTheyLetThrough) {
  const auto all = [](const Vec3& light) { return [=](double, double) { return light; }; };
  expectFloor(pane("half", 5), all(Vec3(0.5)));
  expectFloor(pane("half", 5) + pane("quarter", 6) + pane("quarter", 7), all(Vec3(0.5 * 0.75 * 0.75)));
  expectFloor(pane("nothing", 5), all(Vec3(1)));
  expectFloor(pane("glow", 5), all(Vec3(0.7)));  // what it adds to what is seen it does not add to light
  expectFloor(pane("stained", 5), all(0.8 * Vec3(0.9, 0.5, 0.1)));
  expectFloor(pane("stained", 5) + pane("half", 6), all(0.4 * Vec3(0.9, 0.5, 0.1)));
  expectFloor(pane("half", 5) + pane("clay", 6), all(Vec3(0)));
}

TEST_F(TransmittanceTest, OfAPatternIsThatOfThePointThatTheRayMeets) {
  // A rectangle's u is along x, its v against z.
  const auto u = [](double x) { return x / 4 + 0.5; };
  const auto v = [](double z) { return 0.5 - z / 4; };
  expectFloor(pane("ramp", 5), [&](double x, double z) { return Vec3(1 - u(x) * v(z)); });
  expectFloor(pane("painted", 5), [&](double x, double z) { return Vec3(u(x), v(z), 0.5); });
}

/// Below a glass ball the light has met it twice.
TEST_F(TransmittanceTest, OfABallIsThatOfBothItsSides) {
  const Scene scene =
      sceneOf(R"({ "surface": "ball", "material": "half", "translate": [0, 5, 0] }, )" + std::string(kNoon));
  const Picture picture = draw(scene, kTransmittanceSize);
  const CameraModel camera(scene.cameras()[0], kTransmittanceSize);
  int below = 0;
  for (int y = 0; y < kTransmittanceSize.height; ++y)
    for (int x = 0; x < kTransmittanceSize.width; ++x) {
      const Ray ray = camera.through(centerOf(x, y));
      const auto t = hitPlane(ray, Vec3(0), Vec3(0, 1, 0));
      const auto isBelow = settled(
          [&](const Vec2& pixel) {
            const Ray near = camera.through(pixel);
            const Vec3 at = near.at(*hitPlane(near, Vec3(0), Vec3(0, 1, 0)));
            return Vec2(at.x, at.z).x * at.x + at.z * at.z < 1;
          },
          centerOf(x, y), 1e-3);
      if (!t || *t > 8 || !isBelow) continue;
      ASSERT_TRUE(near(colorAt(picture.image, x, y), Vec3(*isBelow ? 0.25 : 1), 2e-6)) << x << ", " << y;
      below += *isBelow;
    }
  EXPECT_GT(below, 3000);
}

constexpr const char* kGlassCrowd = R"(
  { "surface": "klein", "material": "stained", "translate": [1.2, 1.6, 0], "scale": [0.4, 0.4, 0.4] },
  { "surface": "torus", "material": "half", "translate": [-1, 1.3, 0], "rotate": { "axis": [1, 0.3, 0], "angle": 0.9 } },
  { "surface": "torus", "material": "quarter", "translate": [-0.6, 1.3, 0.2] },
  { "surface": "ball", "material": "ramp", "translate": [0.2, 0.6, 1], "scale": [0.4, 0.4, 0.4] },
  { "surface": "ball", "material": "clay", "translate": [0, 1.8, 0.5], "scale": [0.3, 0.3, 0.3] },
  { "translate": [2, 6, 1], "light": { "intensity": 0.6, "shadow": "exact" } },
  { "rotate": { "axis": [1, 0.5, 0], "angle": -0.9 }, "light": { "type": "directional", "intensity": 0.3, "shadow": "exact" } })";

TEST_F(TransmittanceTest, IsTheTruth) {
  const Camera camera{.eye = Vec3(0.5, 4, 6), .lookAt = Vec3(0, 0.7, 0), .fovY = 0.7};
  const Snapshot snapshot = takeSnapshot(sceneOf(kGlassCrowd), 0, kTransmittanceSize, camera);
  const Verified found = verified(snapshot);
  EXPECT_EQ(found.verification.wrong.total(), 0U);
  EXPECT_EQ(found.statistics.error.auditFailedPx, 0U);
  // Measured: 1.2e-3 of the pixels, where a ray of light grazes glass.
  EXPECT_LE(found.statistics.error.shadowRaysPx, 100U);
  const Image usual = renderer().render(snapshot).image;
  for (const int size : {32, 256}) {
    const Image other = renderer().render(snapshot, {.shadowGridSize = size, .layerGridSize = size}).image;
    EXPECT_TRUE(sameBytes(usual, other)) << size;
  }
}

/// Cards of glass that shade each other and themselves: as meshes they are the surfaces.
constexpr const char* kGlassCards = R"(
  { "surface": "card", "material": "stained", "translate": [-0.3, 1.1, 0], "rotate": { "axis": [1, 0, 0], "angle": "60deg" } },
  { "surface": "card", "material": "ramp", "translate": [0.3, 1.2, 0], "rotate": { "axis": [0.2, 0, 1], "angle": "70deg" } },
  { "surface": "card", "material": "ramp", "translate": [0, 0.5, 0.3] },
  { "rotate": { "axis": [1, -0.6, 0], "angle": "-55deg" }, "light": { "type": "directional", "shadow": "exact" } },
  { "translate": [3, 6, 4], "light": { "intensity": 0.5, "shadow": "exact" } })";

/// What floats leave open of the light on what is seen through rays settle on meshes, too.
TEST_F(TransmittanceTest, IsSettledByRaysOnMeshes) {
  const Camera camera{.eye = Vec3(4, 2.4, 6), .lookAt = Vec3(0, 0.7, 0), .fovY = 0.52};
  std::uint64_t settled = 0;
  for (const char* nodes : {kGlassCards, kGlassCrowd})
    for (const BlendOrder order : {BlendOrder::Exact, BlendOrder::Given}) {
      Snapshot snapshot = takeSnapshot(sceneOf(nodes), 0, kTransmittanceSize, camera);
      snapshot.blendOrder = order;
      for (const Shading shading : {Shading::Flat, Shading::Gouraud, Shading::Phong, Shading::Toon}) {
        SCOPED_TRACE(nameOf(shading));
        const Picture picture = renderer().render(snapshot, {.shading = shading});
        EXPECT_EQ(picture.statistics.error.uncertifiedPx, 0U);
        EXPECT_EQ(picture.statistics.error.unconvergedPx, 0U);
        settled += picture.statistics.error.resolvedByRaysPx;
        if (nodes != kGlassCards || shading == Shading::Toon || shading == Shading::Gouraud) continue;
        const Image truth = castPicture(snapshot, {.shading = shading}).color;
        const int different = differingPixels(picture.image, truth, 1e-3);
        EXPECT_LE(different, 4);
      }
    }
  EXPECT_GT(settled, 100U);
}

/// A shade in closed form lets nothing through; one of glass is a caster like others.
TEST_F(TransmittanceTest, OfALampShadeOfGlass) {
  const Scene scene = buildScene(parseScene(R"({ "luxo": 1,
    "materials": { "glass": { "opacity": 0.4, "blend": "multiply", "diffuse": [0.9, 0.3, 0.2] } },
    "surfaces": { "shade": { "type": "paraboloid" },
                  "floor": { "type": "rectangle", "size": [9, 9] } },
    "nodes": [ { "surface": "floor" },
               { "name": "shade", "surface": "shade", "material": "glass", "translate": [0, 1.5, 0] },
               { "translate": [0, 1.7, 0], "light": { "shadow": "exact" } } ],
    "camera": { "eye": [1, 4, 6], "look_at": [0, 0.7, 0], "fov_y": "40deg" } })",
                                            "shade"));
  const Verified found = verified(takeSnapshot(scene, 0, kTransmittanceSize));
  EXPECT_EQ(found.verification.wrong.total(), 0U);
}

TEST_F(TransmittanceTest, OrderOfNodesChangesNoByte) {
  const std::string light = kNoon;
  const std::vector<std::string> nodes = {
      R"({ "name": "a", "surface": "torus", "material": "stained", "translate": [0, 3, 0] }, )",
      R"({ "name": "b", "surface": "ball", "material": "half", "translate": [0.3, 5, 0] }, )",
      R"({ "name": "c", "surface": "ball", "material": "quarter", "translate": [-0.2, 8, 0.1] }, )",
      R"({ "name": "d", "surface": "klein", "material": "ramp", "translate": [0, 12, 0] }, )"};
  const Image first =
      draw(sceneOf(nodes[0] + nodes[1] + nodes[2] + nodes[3] + light), kTransmittanceSize).image;
  EXPECT_TRUE(sameBytes(
      first, draw(sceneOf(nodes[3] + nodes[1] + nodes[0] + nodes[2] + light), kTransmittanceSize).image));
  EXPECT_TRUE(sameBytes(
      first, draw(sceneOf(nodes[2] + nodes[3] + nodes[1] + nodes[0] + light), kTransmittanceSize).image));
}

/// Only lights that have a transparent caster are found so.
TEST_F(TransmittanceTest, CostsNothingWhereAllIsOpaque) {
  const auto shadowPasses = [&](const std::string& material) {
    return draw(sceneOf(R"({ "surface": "ball", "material": ")" + material +
                        R"(", "translate": [0, 5, 0] }, )" + kNoon),
                kTransmittanceSize)
        .statistics.count;
  };
  const FrameCounts clay = shadowPasses("clay"), glass = shadowPasses("half");
  EXPECT_EQ(clay.shadowPasses, glass.shadowPasses);
  EXPECT_EQ(clay.passes + 1, glass.passes);
}

/// A planar shadow of glass: each face that the light meets takes its part.
TEST_F(TransmittanceTest, OfPlanarShadowsToo) {
  const Scene scene = sceneOf(R"({ "surface": "ball", "material": "half", "translate": [0, 5, 0] },
         )" + std::string(kPlanarNoon));
  const Picture picture = draw(scene, kTransmittanceSize);
  const CameraModel camera(scene.cameras()[0], kTransmittanceSize);
  for (int y = 60; y < kTransmittanceSize.height; ++y)
    for (int x = 0; x < kTransmittanceSize.width; ++x) {
      const Ray ray = camera.through(centerOf(x, y));
      const Vec3 at = ray.at(*hitPlane(ray, Vec3(0), Vec3(0, 1, 0)));
      const double radius = glm::length(Vec2(at.x, at.z));
      // A mesh has the tolerance of half a pixel, here 0.02 metres at most.
      if (std::abs(radius - 1) < 0.02) continue;
      ASSERT_TRUE(near(colorAt(picture.image, x, y), Vec3(radius < 1 ? 0.25 : 1), 2e-6)) << x << ", " << y;
    }
}

}  // namespace
}  // namespace luxo::test
