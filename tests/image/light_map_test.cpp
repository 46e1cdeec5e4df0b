// SPDX-License-Identifier: Apache-2.0
// Depth maps of lights: right as far as they can be, and wrong as the lesson says they are.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "base/error.h"
#include "reference/reference.h"
#include "scene/light_view.h"
#include "scene/scene_builder.h"
#include "scene/scene_reader.h"
#include "support/verified_picture.h"

namespace luxo::test {
namespace {

constexpr PixelSize kLightMapSize{320, 240};

class LightMapTest : public VerifiedPictureTest {
 protected:
  [[nodiscard]] static Scene sceneOf(const std::string& nodes, const std::string& light,
                                     const std::string& map) {
    return buildScene(parseScene(R"_({ "luxo": 1,
      "render": { "ambient": [0, 0, 0], "background": [0, 0, 0] },
      "materials": { "m": { "diffuse": [1, 1, 1], "specular": 0 },
                     "glass": { "diffuse": [0, 0, 0], "specular": 0, "opacity": 0.5 } },
      "surfaces": { "floor": { "type": "rectangle", "size": [12, 12] },
                    "ball": { "type": "sphere", "radius": 1 },
                    "pane": { "type": "rectangle", "size": [4, 4] },
                    "wall": { "type": "formula", "position": ["0", "v", "u"], "u": [-5, 5], "v": [0, 3] } },
      "camera": { "eye": [1, 7, 6], "look_at": [0.5, 0, 0], "fov_y": "50deg" },
      "nodes": [ { "name": "floor", "surface": "floor", "material": "m" }, )_" +
                                     nodes + R"( { )" + light + R"( "shadow": "map", "map": )" + map +
                                     " } } ] }",
                                 "map"));
  }

  static constexpr const char* kBall =
      R"({ "name": "ball", "surface": "ball", "material": "m", "translate": [0, 2, 0] },)";
  static constexpr const char* kLamp = R"("translate": [-2, 6, 1], "light": {)";
  /// From above, as steep as 45 degrees, toward +x.
  static constexpr const char* kSlanted =
      R"("rotate": [ { "axis": [0, 1, 0], "angle": "-90deg" }, { "axis": [1, 0, 0], "angle": "-45deg" } ],
         "light": { "type": "directional",)";

  /// Calls `check(point, colour)` for all pixels that show the floor, and gives how many these are.
  int forEachOfFloor(const Scene& scene, const auto& check, PixelSize size = kLightMapSize) {
    const Image image = draw(scene, size).image;
    const Image id = draw(scene, size, {.output = Output::Id}).image;
    const CameraModel camera(scene.cameras()[0], size);
    int seen = 0;
    for (int y = 0; y < size.height; ++y)
      for (int x = 0; x < size.width; ++x) {
        if (id.pixel(x, y)[0] != 1) continue;
        const Ray ray = camera.through(centerOf(x, y));
        check(ray.at(*hitPlane(ray, Vec3(0), Vec3(0, 1, 0))), colorAt(image, x, y));
        ++seen;
      }
    return seen;
  }

  std::uint64_t wrongIn(const std::string& map) {
    return verified(takeSnapshot(sceneOf(kBall, kLamp, map), 0, kLightMapSize)).verification.wrong.light;
  }
};

/// From the light at (-2, 6, 1), past the ball.
bool isLit(const Vec3& p) {
  const Vec3 way = unit(Vec3(-2, 6, 1) - p), from = p - Vec3(0, 2, 0);
  const double b = glm::dot(from, way), square = b * b - glm::dot(from, from) + 1;
  return square < 0 || b > 0;
}

/// The border of a ball's shadow is off by a texel and a half at most, and nothing else is.
TEST_F(LightMapTest, IsRightButAtBorders) {
  // The whole floor, some 17 m across from 6 m above, is in 512 texels.
  const Scene scene = sceneOf(kBall, kLamp, R"({ "size": 512, "slope_bias": 1.5 })");
  // At the floor, along the ray, and longer by the slope at which it falls.
  const auto farOff = [](const Vec3& p) {
    const Vec3 to = Vec3(-2, 6, 1) - p;
    const View view = lightViews(SnapshotLight{.positionWorld = Vec4(-2, 6, 1, 1)},
                                 Box{Vec3(-6, 0, -6), Vec3(6, 3, 6)}, {}, 512)[0];
    return 1.5 * glm::length(to) / view.pixelsPerUnit * glm::length(to) / to.y;
  };
  int settledPixels = 0;
  const int seen = forEachOfFloor(scene, [&](const Vec3& p, const Vec3& color) {
    const double off = farOff(p);
    bool all = true, none = true;
    for (int k = 0; k < 16; ++k) {
      const double angle = k * kPi / 8;
      const bool lit = isLit(p + off * Vec3(std::cos(angle), 0, std::sin(angle)));
      all &= lit;
      none &= !lit;
    }
    if (!all && !none) return;
    ++settledPixels;
    EXPECT_EQ(color.x > 0.1, all) << p.x << ", " << p.z;
  });
  EXPECT_GT(settledPixels, 9 * seen / 10);
}

TEST_F(LightMapTest, GetsBetterWithSizeAndWithABias) {
  const std::uint64_t none = wrongIn(R"({ "size": 256 })"),
                      lesson = wrongIn(R"({ "size": 256, "bias": 0.04334 })"),
                      slope = wrongIn(R"({ "size": 256, "slope_bias": 1 })"),
                      larger = wrongIn(R"({ "size": 1024, "slope_bias": 1 })"),
                      plane = wrongIn(R"({ "size": 256, "receiver_plane": true, "bias": 0.005 })"),
                      normal = wrongIn(R"({ "size": 256, "normal_offset": 1.5 })");
  // Acne covers the ball's lit half, some 1,000 pixels; what is left are borders.
  EXPECT_GT(none, 400U);
  for (const std::uint64_t biased : {lesson, slope, plane, normal}) EXPECT_LT(biased, none / 3);
  EXPECT_LT(larger, slope / 2) << "borders are as thin as texels";
}

/// A bias without end leaves no shadow; and where the light is in the eye there is none to be seen: what is
/// dark then is acne.
TEST_F(LightMapTest, IsTooBrightByItsBiasAndTooDarkWithoutOne) {
  constexpr PixelSize kSize{160, 120};
  const auto wrongIn = [&](const char* light, const char* map) {
    return verified(takeSnapshot(sceneOf(kBall, light, map), 0, kSize)).verification.wrong;
  };
  const char* biased = R"({ "size": 256, "bias": 1000 })";
  const WrongPixels bright = wrongIn(kLamp, biased),
                    dark = wrongIn(R"("translate": [1, 7, 6], "light": {)", R"({ "size": 256 })");
  std::uint64_t inShadow = 0;
  forEachOfFloor(
      sceneOf(kBall, kLamp, biased), [&](const Vec3& p, const Vec3&) { inShadow += !isLit(p); }, kSize);
  EXPECT_GT(inShadow, 500U);
  EXPECT_LE(bright.shadowMissing, inShadow);
  EXPECT_GE(bright.shadowMissing + 5, inShadow) << "but for 0.01 px of its border, which is some 130 px long";
  EXPECT_EQ(bright.shadowExtra, 0U);
  EXPECT_GT(dark.shadowExtra, 100U);
  EXPECT_EQ(dark.shadowMissing, 0U);
  for (const WrongPixels& wrong : {bright, dark})
    EXPECT_EQ(wrong.shadowExtra + wrong.shadowMissing, wrong.light);
}

/// Behind a wall on the floor, a bias b along the rays leaves light to b cos 45 degrees.
TEST_F(LightMapTest, DetachesShadowsByItsBias) {
  const Scene scene =
      sceneOf(R"({ "surface": "wall", "material": "m" },)", kSlanted, R"({ "size": 2048, "bias": 0.5 })");
  const double gap = 0.5 * std::sqrt(0.5), texels = 0.03;
  int inGap = 0, behind = 0;
  forEachOfFloor(scene, [&](const Vec3& p, const Vec3& color) {
    if (p.x < texels || p.x > 2.5 || std::abs(p.z) > 3 || std::abs(p.x - gap) < texels) return;
    (p.x < gap ? inGap : behind) += 1;
    EXPECT_EQ(color.x > 0.1, p.x < gap) << p.x << ", " << p.z;
  });
  EXPECT_GT(inGap, 300);
  EXPECT_GT(behind, 2000);
}

/// What many texels tell is their mean.
TEST_F(LightMapTest, OfPcfIsAMean) {
  const Scene scene = sceneOf(kBall, kLamp, R"({ "size": 128, "slope_bias": 4, "pcf": 3 })");
  int between = 0;
  forEachOfFloor(scene, [&](const Vec3& p, const Vec3& color) {
    const double ninths = 9 * color.x / unit(Vec3(-2, 6, 1) - p).y;
    if (std::abs(ninths - std::round(ninths)) > 1e-4) ADD_FAILURE() << p.x << ", " << p.z << ": " << ninths;
    between += ninths > 0.5 && ninths < 8.5;
  });
  EXPECT_GT(between, 300);
}

/// Below the edge of a pane the sun's penumbra is as wide as the pane's height says: 2 h tan(radius).
TEST_F(LightMapTest, OfALightWithARadiusHasPenumbrae) {
  constexpr double kRadius = 0.1, kHeight = 2;
  const Scene scene = sceneOf(R"({ "surface": "pane", "material": "m", "translate": [-2, 2, 0] },)",
                              R"("rotate": { "axis": [1, 0, 0], "angle": "-90deg" },
                                 "light": { "type": "directional", "radius": 0.1,)",
                              R"({ "size": 1024, "bias": 0.02 })");
  const double half = kHeight * std::tan(kRadius);
  double nearest = 1, farthest = 0;
  forEachOfFloor(scene, [&](const Vec3& p, const Vec3& color) {
    if (std::abs(p.z) > 1) return;
    const bool lit = p.x > 1.15 * half && p.x < 2, dark = p.x < -1.15 * half && p.x > -1;
    if (lit || dark) {
      EXPECT_NEAR(color.x, lit, 1e-4) << p.x;
    }
    if (std::abs(p.x) < 0.5 * half) {
      // A part of the disc beyond a chord; its 48 points are off by up to a tenth.
      const double x = p.x / half, part = 0.5 + (std::asin(x) + x * std::sqrt(1 - x * x)) / kPi;
      EXPECT_NEAR(color.x, part, 0.12) << p.x;
      nearest = std::min(nearest, color.x);
      farthest = std::max(farthest, color.x);
    }
  });
  EXPECT_LT(nearest, 0.35);
  EXPECT_GT(farthest, 0.65);
}

/// The middle of a penumbra is right where as much of the light is seen as there; a hard shadow in its place
/// is wrong in all of it, and so is one whose light is twice as large.
TEST_F(LightMapTest, OfALightWithARadiusIsHeldAgainstThePartOfItThatIsSeen) {
  const auto snapshotOf = [](const std::string& radius) {
    return takeSnapshot(sceneOf(R"({ "surface": "pane", "material": "m", "translate": [-2, 2, 0] },)",
                                R"("rotate": { "axis": [1, 0, 0], "angle": "-90deg" },
                                   "light": { "type": "directional", "radius": )" +
                                    radius + ",",
                                R"({ "size": 1024, "bias": 0.02 })"),
                        0, {160, 120});
  };
  const Snapshot small = snapshotOf("0.1");
  const auto show = [&](const Snapshot& snapshot, Output output) {
    return renderer().render(snapshot, {.output = output}).image;
  };
  const Snapshot exact = withExactShadows(small);
  const ReferencePicture truth = castPicture(exact);
  const auto wrongWith = [&](const Snapshot& shown) {
    return verify(exact, truth,
                  {.color = show(shown, Output::Color),
                   .position = show(small, Output::Position),
                   .normal = show(small, Output::Normal),
                   .uv = show(small, Output::Uv),
                   .id = show(small, Output::Id)})
        .wrong;
  };
  const WrongPixels right = wrongWith(small), hard = wrongWith(snapshotOf("0")),
                    large = wrongWith(snapshotOf("0.2"));
  // As many hard shadows as are soft are right everywhere.
  EXPECT_EQ(wrongWith(withExactShadows(snapshotOf("0.1, \"shadow_samples\": 256"))).total(), 0U);
  // Some 200 pixels see parts of the light, and the corners of the pane are round in a map.
  EXPECT_LT(right.light, 30U);
  EXPECT_EQ(right.total(), right.light);
  EXPECT_GT(hard.light, 150U);
  EXPECT_GT(large.light, 150U);
  EXPECT_GT(hard.shadowExtra, 50U);
  EXPECT_GT(hard.shadowMissing, 50U);
}

/// Below the edge of a pane of glass the sun's light is as soft as below one that is opaque: the chord's part
/// of its disc comes through the glass, within what 64 points know of it.
TEST_F(LightMapTest, OfALightWithARadiusIsSoftBehindGlass) {
  constexpr double kHalf = 0.2;  // 2 m below, tan(0.1) wide
  const Scene scene = sceneOf(R"({ "surface": "pane", "material": "glass", "translate": [-2, 2, 0] },)",
                              R"("rotate": { "axis": [1, 0, 0], "angle": "-90deg" },
                                 "light": { "type": "directional", "radius": 0.1, "shadow_samples": 64,)",
                              R"({ "size": 64, "bias": 0.02 })");
  int between = 0;
  forEachOfFloor(scene,
                 [&](const Vec3& p, const Vec3& color) {
                   if (std::abs(p.z) > 1 || p.x < -1 || p.x > 2) return;
                   const double x = std::clamp(p.x / kHalf, -1.0, 1.0);
                   const double part = 0.5 + (std::asin(x) + x * std::sqrt(1 - x * x)) / kPi;
                   EXPECT_NEAR(color.x, 0.5 + 0.5 * part, 0.5 * 0.053 + 0.005) << p.x;
                   between += color.x > 0.55 && color.x < 0.95;
                 },
                 {160, 120});
  EXPECT_GT(between, 60);
  // A light is one, of however many points.
  EXPECT_EQ(approximateShadows(takeSnapshot(scene, 0, kLightMapSize)), 1U);
  EXPECT_EQ(withExactShadows(takeSnapshot(scene, 0, kLightMapSize)).lights.size(), 64U);
}

/// A light amid its casters sees them on six faces.
TEST_F(LightMapTest, OfALightAmidItsCasters) {
  const Scene scene = sceneOf(
      R"({ "surface": "ball", "material": "m", "translate": [2.5, 1, 0] },
         { "surface": "ball", "material": "m", "translate": [-2.5, 1, 0.5] },
         { "surface": "ball", "material": "m", "translate": [0, 1, -2.5] },)",
      R"("translate": [0, 2, 0], "light": {)", R"({ "size": 1024, "slope_bias": 1.5, "bias": 0.003 })");
  const Verified found = verified(takeSnapshot(scene, 0, kLightMapSize));
  // Borders of some 1,000 pixels' length, where a pixel is as wide as a texel.
  EXPECT_LT(found.verification.wrong.light, 500U);
  EXPECT_EQ(found.verification.wrong.total(), found.verification.wrong.light);
  EXPECT_EQ(found.statistics.error.auditFailedPx, 0U) << "an audit is of what is said to be exact";
}

/// What is seen through is no sample of a map: its light is exact.
TEST_F(LightMapTest, LeavesGlassToRays) {
  const Scene scene = sceneOf(R"({ "surface": "pane", "material": "glass", "translate": [0, 5, 0] },)",
                              R"("rotate": { "axis": [1, 0, 0], "angle": "-90deg" },
                                 "light": { "type": "directional",)",
                              R"({ "size": 64, "bias": 0.1 })");
  int below = 0;
  forEachOfFloor(scene, [&](const Vec3& p, const Vec3& color) {
    const double side = std::max(std::abs(p.x), std::abs(p.z));
    if (std::abs(side - 2) < 0.01 || side > 5) return;
    EXPECT_NEAR(color.x, side < 2 ? 0.5 : 1, 1e-5) << p.x << ", " << p.z;
    below += side < 2;
  });
  EXPECT_GT(below, 500);
  // Nor does the audit take the map's own part, below the ball, for what glass lets through.
  const FrameError error =
      draw(sceneOf(std::string(kBall) +
                       R"({ "surface": "pane", "material": "glass", "translate": [1.2, 4, 0] },)",
                   kLamp, R"({ "size": 64 })"),
           kLightMapSize, {.audit = {.extent = AuditExtent::All}})
          .statistics.error;
  EXPECT_EQ(error.auditFailedPx, 0U);
  EXPECT_EQ(error.unconvergedPx, 0U);
  EXPECT_LT(error.resolvedByRaysPx, 100U);
}

/// Shadows of a map fall on what is seen through, too.
TEST_F(LightMapTest, FallsOnLayers) {
  const auto scene = [&](const char* map) {
    return sceneOf(
        std::string(kBall) + R"({ "surface": "pane", "material": "glass", "translate": [1.2, 0.6, 0] },)",
        kLamp, map);
  };
  const Snapshot snapshot = takeSnapshot(scene(R"({ "size": 2048, "slope_bias": 1.5 })"), 0, kLightMapSize);
  const Image map = renderer().render(snapshot).image,
              exact = renderer().render(withExactShadows(snapshot)).image;
  const int different = differingPixels(map, exact, 0.01);
  EXPECT_LT(different, 250);
}

TEST_F(LightMapTest, HasMeshesOfItsCastersAndCostsNothingElse) {
  const auto counted = [&](const std::string& light) {
    return draw(sceneOf(kBall, light, R"({ "size": 64 })"), kLightMapSize).statistics.count.shadowPasses;
  };
  EXPECT_EQ(counted(R"("translate": [-2, 6, 1], "light": { "casters": ["ball"],)"), 1U);
  EXPECT_EQ(counted(R"("translate": [0, 2, 0], "light": { "casters": ["ball"],)"), 6U) << "six faces";
  EXPECT_EQ(counted(kSlanted), 1U);
  EXPECT_EQ(counted(R"("light": { "type": "directional",)"), 0U) << "along the floor";
  // Where no way of its light to what is seen leads past the ball, which is not.
  const std::string below =
      R"({ "name": "ball", "surface": "ball", "material": "m", "translate": [0, -3, 30] },)";
  const std::string lamp = R"("translate": [-2, 6, 1], "light": { "casters": ["ball"],)";
  EXPECT_EQ(draw(sceneOf(below, lamp, R"({ "size": 64 })"), kLightMapSize).statistics.count.shadowPasses, 0U);
  const Snapshot snapshot = takeSnapshot(sceneOf(kBall, kLamp, R"({ "size": 64 })"), 0, kLightMapSize);
  static_cast<void>(renderer().render(snapshot));
  DrawOptions drawn;
  drawn.skips.unchanged = false;
  const FrameCounts again = renderer().render(snapshot, drawn).statistics.count;
  EXPECT_EQ(again.tessellated, 0U);
  EXPECT_EQ(again.pipelinesCreated, 0U);
}

// The pane is beside the floor, as the light comes straight down; but not as its rim does.
TEST_F(LightMapTest, OfAWideLightIsThereForItsPenumbraAlone) {
  const auto counted = [&](const std::string& radius) {
    return draw(
               sceneOf(R"({ "name": "pane", "surface": "pane", "material": "m", "translate": [8.6, 4, 0] },)",
                       R"("rotate": { "axis": [1, 0, 0], "angle": "-90deg" },
                           "light": { "type": "directional", "casters": ["pane"], "radius": )" +
                           radius + ",",
                       R"({ "size": 64 })"),
               kLightMapSize)
        .statistics.count.shadowPasses;
  };
  EXPECT_EQ(counted("0"), 0U);
  EXPECT_EQ(counted("0.3"), 1U);
}

TEST_F(LightMapTest, OfOddLightsIsDefined) {
  for (const char* at :
       {"[0, 2, 0]", "[0, 3, 0]", "[0, 0, 0]", "[20, 0, 20]", "[1e6, 1e6, 0]", "[0, -5, 0]", "[1, 7, 6]"})
    for (const char* map : {R"({ "size": 1 })", R"({ "size": 64, "bias": 1e18, "slope_bias": 1e18 })",
                            R"({ "size": 33, "normal_offset": 1e18, "receiver_plane": true })"}) {
      SCOPED_TRACE(std::string(at) + map);
      const Scene scene =
          sceneOf(kBall, std::string(R"("translate": )") + at + R"(, "light": { "radius": 0.5,)", map);
      const Picture picture = draw(scene, {48, 36});
      EXPECT_EQ(picture.statistics.error.nonfinitePx, 0U);
    }
}

/// What `luxo render --aov light-depth` shows.
TEST_F(LightMapTest, IsSeenFromTheLight) {
  const Snapshot seen = seenFromLight(takeSnapshot(
      sceneOf(kBall, R"("translate": [0, 6, 0], "light": { "casters": ["ball"],)", R"({ "size": 129 })"), 0,
      kLightMapSize));
  EXPECT_EQ(seen.view.size, (PixelSize{129, 129}));
  const Image depth = renderer().render(seen, {.output = Output::Depth}).image;
  EXPECT_NEAR(depth.pixel(64, 64)[0], 3, 1e-6);  // 6 m above the floor, 4 above the middle of the ball
  EXPECT_TRUE(std::isinf(depth.pixel(0, 0)[0]));
  const Scene dark = buildScene(parseScene(R"({ "luxo": 1, "nodes": [] })", "dark"));
  EXPECT_THROW(static_cast<void>(seenFromLight(takeSnapshot(dark, 0, kLightMapSize))), Error);
}

}  // namespace
}  // namespace luxo::test
