// SPDX-License-Identifier: Apache-2.0
// Lights and casters where nobody would put them: each picture is right, or says how many of its pixels are
// not known.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>

#include "base/error.h"
#include "scene/scene_builder.h"
#include "scene/scene_reader.h"
#include "support/meshes.h"
#include "support/verified_picture.h"

namespace luxo::test {
namespace {

class ShadowHazards : public VerifiedPictureTest {
 protected:
  [[nodiscard]] static Scene sceneOf(const std::string& nodes) {
    return buildScene(parseScene(R"_({ "luxo": 1,
      "render": { "ambient": [0.1, 0.1, 0.1], "background": [0, 0, 0] },
      "materials": { "m": { "diffuse": [0.7, 0.7, 0.7], "specular": 0 }, "glass": { "opacity": 0.3 },
                     "thin": { "diffuse": [0.7, 0.7, 0.7], "specular": 0, "opacity": 0.01 } },
      "surfaces": { "floor": { "type": "rectangle", "size": [20, 20] }, "ball": { "type": "sphere" },
                    "cone": { "type": "cone", "radius": 1, "top_radius": 0, "height": 2 },
                    "pot": { "type": "teapot" }, "torus": { "type": "torus" },
                    "roof": { "type": "rectangle", "size": [1.5, 1.5] },
                    "endless": { "type": "formula", "position": ["u", "1/v", "v"], "u": [-1, 1], "v": [-1, 1] },
                    "poles": { "type": "formula", "position": ["tan(u)", "v", "0"], "u": [-2, 2], "v": [-1, 1] },
                    "torn": { "type": "formula", "position": ["u", "sqrt(u)*v", "v"], "u": [-1, 1], "v": [-1, 1] },
                    "line": { "type": "formula", "position": ["u", "1+0*v", "0"], "u": [-1, 1], "v": [-1, 1] } },
      "camera": { "eye": [1, 5, 6], "look_at": [0, 0.5, 0], "fov_y": "50deg" },
      "nodes": [ { "name": "floor", "surface": "floor", "material": "m" }, )_" +
                                     nodes + "] }",
                                 "hazards"));
  }
  [[nodiscard]] static std::string caster(const std::string& surface, const std::string& more) {
    return R"({ "name": "caster", "surface": ")" + surface + R"(", "material": "m", )" + more + " }, ";
  }
  [[nodiscard]] static std::string lightAt(const std::string& at, const std::string& more = "",
                                           const std::string& shadow = "exact") {
    return R"({ "translate": )" + at + R"(, "light": { "shadow": ")" + shadow + "\"" + more + " } }";
  }

  /// No pixel is wrong that is not counted, and every one is a number.
  FrameStatistics expectRightOrTold(const Scene& scene, PixelSize size) {
    const Verified found = verified(takeSnapshot(scene, 0, size));
    const FrameError& error = found.statistics.error;
    EXPECT_LE(found.verification.wrong.total(), error.unconvergedPx + error.uncertifiedPx);
    EXPECT_EQ(error.nonfinitePx, 0U);
    EXPECT_EQ(found.verification.nanPixels, 0U);
    return found.statistics;
  }

  /// And none is left undecided.
  void expectProven(const Scene& scene) {
    const FrameError error = expectRightOrTold(scene, {48, 36}).error;
    EXPECT_EQ(error.uncertifiedPx, 0U);
    EXPECT_EQ(error.unconvergedPx, 0U);
    EXPECT_EQ(error.auditUndecidedPx, 0U);
  }
};

constexpr PixelSize kShadowHazardsSize{48, 36};

TEST_F(ShadowHazards, LightsOnCornersAndInsideOfCasters) {
  const std::string cone = caster("cone", R"("translate": [0, 0, 0])"),
                    pot = caster("pot", R"("translate": [0, 0, 0])"),
                    torus = caster("torus", R"("translate": [0, 1, 0])");
  for (const std::string& nodes :
       {cone + lightAt("[0, 2, 0]"), cone + lightAt("[0, 2.0000001, 0]"), cone + lightAt("[1, 0, 0]"),
        pot + lightAt("[0, 3.15, 0]"), pot + lightAt("[0, 1, 0]"), torus + lightAt("[0, 1, 0]"),
        torus + lightAt("[1, 1, 0]"), torus + lightAt("[1.4, 1, 0]"), torus + lightAt("[10, 0, 10]"),
        torus + lightAt("[2, 0, 1]"), torus + lightAt("[2, 1e-9, 1]")}) {
    SCOPED_TRACE(nodes);
    expectRightOrTold(sceneOf(nodes), kShadowHazardsSize);
  }
}

/// It is behind none of it: what nothing else hides is lit on both sides, and rays prove that.
TEST_F(ShadowHazards, LightsOnTheirCasters) {
  const std::string ball = caster("ball", R"("translate": [0, 1.2, 0])"),
                    torus = caster("torus", R"("translate": [0, 1, 0])"),
                    pot = caster("pot", R"("translate": [0, 0, 0])"),
                    roof = caster("roof", R"("translate": [0, 2, 0])"),
                    glass = R"({ "surface": "ball", "material": "glass", "translate": [0, 1.2, 0] }, )";
  for (const std::string& nodes :
       {ball + lightAt("[0, 2.2, 0]"), ball + lightAt("[1, 1.2, 0]"), ball + lightAt("[0.6, 1.2, 0.8]"),
        torus + lightAt("[0, 1.4, 1]"), torus + lightAt("[1.4, 1, 0]"), torus + lightAt("[0.6, 1, 0]"),
        torus + lightAt("[0.84, 1.32, 0]"), roof + lightAt("[0, 2, 0]"), roof + lightAt("[0.4, 2, -0.3]"),
        pot + lightAt("[0, 3.15, 0]"), glass + lightAt("[0, 2.2, 0]"), lightAt("[0.5, 0, 0.5]")}) {
    SCOPED_TRACE(nodes);
    expectProven(sceneOf(nodes));
  }
  // On a corner, an edge and a face of triangles.
  for (const Vec3& at : {Vec3(1, 1, 1), Vec3(0.25, 1, 1), Vec3(0.5, 1, 0.25)}) {
    SCOPED_TRACE(at.x);
    Scene scene = sceneOf(R"({ "name": "none" })");
    scene.add(Node{.translation = Vec3(0, 1.1, 0), .surface = cubeMesh()});
    scene.add(Node{.translation = at + Vec3(0, 1.1, 0), .light = Light{.shadow = Light::Shadow::Exact}});
    expectProven(scene);
  }
}

TEST_F(ShadowHazards, ALightInARoofShinesOnBothSides) {
  const std::string light = lightAt("[0.4, 2, -0.3]"), roof = caster("roof", R"("translate": [0, 2, 0])");
  const auto pictureOf = [&](const std::string& nodes) {
    return draw(sceneOf(nodes), kShadowHazardsSize, {.composition = Composition::Deferred}).image;
  };
  const std::string bare = R"({ "translate": [0.4, 2, -0.3], "light": {} })";
  EXPECT_TRUE(sameBytes(pictureOf(roof + light), pictureOf(roof + bare)));
}

TEST_F(ShadowHazards, ACasterAroundTheCamera) {
  const std::string shell = caster("ball", R"("translate": [0, 3, 3], "scale": [8, 8, 8])");
  for (const std::string& light : {lightAt("[3, 6, 4]"), lightAt("[30, 60, 40]")}) {
    SCOPED_TRACE(light);
    const FrameStatistics told = expectRightOrTold(
        sceneOf(shell + R"({ "surface": "torus", "material": "m", "translate": [0, 1, 0] }, )" + light),
        kShadowHazardsSize);
    EXPECT_EQ(told.error.unconvergedPx + told.error.uncertifiedPx, 0U);
  }
  // From outside no light gets in.
  const Image image = draw(sceneOf(shell + lightAt("[30, 60, 40]")), kShadowHazardsSize).image;
  const float dark = 0.07F;  // the ambient light alone
  for (int y = 0; y < kShadowHazardsSize.height; ++y)
    for (int x = 0; x < kShadowHazardsSize.width; ++x)
      ASSERT_LE(image.pixel(x, y)[0], dark + 1e-6F) << x << ", " << y;
}

TEST_F(ShadowHazards, CastersWithoutEndOrWidth) {
  for (const std::string& one :
       {caster("endless", R"("translate": [0, 1, 0])"), caster("poles", R"("translate": [0, 1, 0])"),
        caster("torn", R"("translate": [0, 1.5, 0])"), caster("line", R"("translate": [0, 1, 0])"),
        caster("ball", R"("translate": [0, 2, 0], "scale": [1, 0, 1])"),
        caster("ball", R"("translate": [0, 2, 0], "scale": [0, 0, 0])"),
        caster("pot", R"("translate": [0, 2, 0], "scale": [0, 0, 0])"),
        caster("pot", R"("translate": [0, 2, 0], "scale": ["t", "t", "t"])"),
        caster("ball", R"("translate": [0, -1000000003, 0], "scale": [1e9, 1e9, 1e9])")}) {
    SCOPED_TRACE(one);
    expectRightOrTold(sceneOf(one + lightAt("[2, 6, 3]")), kShadowHazardsSize);
  }
}

/// What these shadows are of is meshes. They are defined, and what has no area has none.
TEST_F(ShadowHazards, CastersWithoutEndOrWidthInMapsAndOnPlanes) {
  const auto pictureOf = [&](const std::string& one, const std::string& light) {
    Picture picture = draw(sceneOf(one + light), kShadowHazardsSize, {.composition = Composition::Deferred});
    EXPECT_EQ(picture.statistics.error.nonfinitePx, 0U);
    EXPECT_TRUE(allFinite(picture.image));
    return std::move(picture.image);
  };
  const Image lit = pictureOf("", R"({ "translate": [2, 6, 3], "light": {} })");
  for (const std::string& light :
       {lightAt("[2, 6, 3]", R"(, "casters": ["caster"])", "map"),
        lightAt("[2, 6, 3]", R"(, "casters": ["caster"], "shadow_plane": "floor")", "planar"),
        lightAt("[2, 6, 3]", "", "map"), lightAt("[2, 6, 3]", R"(, "shadow_plane": "floor")", "planar")}) {
    SCOPED_TRACE(light);
    for (const std::string& one :
         {caster("endless", R"("translate": [0, 1, 0])"), caster("poles", R"("translate": [0, 1, 0])"),
          caster("torn", R"("translate": [0, 1.5, 0])"),
          caster("ball", R"("translate": [0, 2, 0], "scale": [1, 0, 1])"),
          caster("ball", R"("translate": [0, -1000000003, 0], "scale": [1e9, 1e9, 1e9])")}) {
      SCOPED_TRACE(one);
      static_cast<void>(pictureOf(one, light));
    }
    for (const std::string& one : {caster("line", R"("translate": [0, 1, 0])"),
                                   caster("ball", R"("translate": [0, 2, 0], "scale": [0, 0, 0])"),
                                   caster("pot", R"("translate": [0, 2, 0], "scale": [0, 0, 0])"),
                                   caster("ball", R"("translate": [0, 2, 0], "scale": ["t", "t", "t"])"),
                                   caster("pot", R"("translate": [0, 2, 0], "scale": ["t", "t", "t"])")}) {
      SCOPED_TRACE(one);
      // Where rays look for what is a point, the floor's points are theirs: they are rounded otherwise.
      EXPECT_TRUE(nearEverywhere(pictureOf(one, light), lit, 1e-6));
    }
  }
}

/// Who has no surface, or is not there, casts nothing.
TEST_F(ShadowHazards, CastersThatAreNone) {
  const std::string ball = caster("ball", R"("translate": [0, 1.2, 0])"), group = R"({ "name": "group" }, )",
                    hidden = R"({ "name": "hidden", "surface": "ball", "visible": 0 }, )";
  const auto pictureOf = [&](const std::string& light) {
    return draw(sceneOf(ball + group + hidden +
                        R"({ "name": "lamp", "translate": [2, 6, 3], "light": { "shadow": "exact")" + light +
                        " } }"),
                kShadowHazardsSize, {.composition = Composition::Deferred})
        .image;
  };
  const Image without = draw(sceneOf(ball + R"({ "translate": [2, 6, 3], "light": {} })"), kShadowHazardsSize,
                             {.composition = Composition::Deferred})
                            .image;
  for (const char* casters :
       {"[]", R"(["lamp"])", R"(["group"])", R"(["hidden"])", R"(["lamp", "group", "hidden"])"})
    EXPECT_TRUE(sameBytes(pictureOf(std::string(R"(, "casters": )") + casters), without)) << casters;
  EXPECT_FALSE(sameBytes(pictureOf(""), without));
  EXPECT_TRUE(sameBytes(pictureOf(R"(, "casters": ["caster", "caster", "caster"])"), pictureOf("")));
  // A surface that carries its light, at its middle, is dark outside, and lets none out.
  expectRightOrTold(sceneOf(R"({ "name": "both", "surface": "ball", "material": "m", "translate": [0, 2, 0],
                   "light": { "shadow": "exact", "casters": ["both"] } })"),
                    kShadowHazardsSize);
}

TEST_F(ShadowHazards, AsManyLightsAsOneLikes) {
  for (const int count : {32, 33, 100}) {
    SCOPED_TRACE(count);
    std::string nodes = caster("torus", R"("translate": [0, 1.2, 0])");
    for (int i = 0; i < count; ++i)
      nodes += (i > 0 ? ", " : "") +
               lightAt("[" + std::to_string(4 * std::cos(i)) + ", " + std::to_string(4 + std::sin(3 * i)) +
                           ", " + std::to_string(4 * std::sin(i)) + "]",
                       R"(, "intensity": 0.02)");
    const FrameStatistics told = expectRightOrTold(sceneOf(nodes), {32, 24});
    EXPECT_EQ(told.error.unconvergedPx + told.error.uncertifiedPx, 0U);
    // Of more than 32 they are found again beside what rays know.
    EXPECT_TRUE(told.count.shadowPasses == static_cast<std::uint64_t>(count) ||
                (count > 32 && told.count.shadowPasses == 2U * static_cast<std::uint64_t>(count)));
  }
}

TEST_F(ShadowHazards, SoftLightsOfOnePointAndOfAThousand) {
  const std::string ball = caster("ball", R"("translate": [0, 1.2, 0])");
  for (const char* samples : {"1", "1024"}) {
    SCOPED_TRACE(samples);
    const FrameStatistics told = expectRightOrTold(
        sceneOf(ball + lightAt("[2, 6, 3]", std::string(R"(, "radius": 0.5, "shadow_samples": )") + samples)),
        {24, 18});
    EXPECT_EQ(told.error.unconvergedPx + told.error.uncertifiedPx, 0U);
  }
  // One point is the middle: the hard shadow.
  EXPECT_TRUE(
      sameBytes(draw(sceneOf(ball + lightAt("[2, 6, 3]", R"(, "radius": 0.5, "shadow_samples": 1)")),
                     kShadowHazardsSize)
                    .image,
                draw(sceneOf(ball + lightAt("[2, 6, 3]", R"(, "radius": 0)")), kShadowHazardsSize).image));
}

TEST_F(ShadowHazards, AThousandLayers) {
  std::string nodes;
  for (int i = 0; i < 500; ++i)
    nodes += std::string(i > 0 ? ", " : "") +
             R"({ "surface": "ball", "material": "glass", "translate": [0, 1.2, 0], "scale": [)" +
             std::to_string(0.2 + 0.002 * i) + ", " + std::to_string(0.2 + 0.002 * i) + ", " +
             std::to_string(0.2 + 0.002 * i) + "] }";
  const Picture picture = draw(sceneOf(nodes + R"(, { "translate": [2, 6, 3], "light": {} })"), {24, 18});
  const FrameError& error = picture.statistics.error;
  EXPECT_EQ(error.layersMissing + error.unconvergedPx + error.uncertifiedPx + error.nonfinitePx, 0U);
  EXPECT_GT(picture.statistics.count.layerPoints, 10'000U);
  EXPECT_EQ(error.auditFailedPx, 0U);
}

/// Many nodes of a surface, each a tenth of its size, one above the other and turned.
std::string heap(int count, const std::string& surface, const std::string& material) {
  std::string nodes;
  for (int i = 0; i < count; ++i)
    nodes += R"({ "surface": ")" + surface + R"(", "material": ")" + material + R"(", "translate": [)" +
             std::to_string(std::sin(1.7 * i)) + ", " + std::to_string(0.2 + 2.0 * i / count) + ", " +
             std::to_string(std::cos(2.3 * i)) + R"(], "scale": [0.1, 0.1, 0.1],
               "rotate": { "axis": [1, 0.3, 0], "angle": )" +
             std::to_string(0.4 * std::sin(i)) + " } }, ";
  return nodes;
}

/// The light through each of the sheets to each of the layers.
TEST_F(ShadowHazards, SheetsOfGlassThatCast) {
  const FrameStatistics told =
      expectRightOrTold(sceneOf(heap(60, "floor", "glass") + lightAt("[2, 6, 3]")), {24, 18});
  EXPECT_EQ(told.error.layersMissing + told.error.unconvergedPx + told.error.uncertifiedPx, 0U);
  EXPECT_GT(told.count.shadowPasses, 100U);
  EXPECT_GT(told.count.layerPoints, 500U);
}

/// Of 200 sheets over each other each is in the light that those above leave, T = 1 - 0.01 of it each, and is
/// seen through them: of the light from above, where all face it, 0.01 (1 + T^2 + T^4 + ...) is seen, and
/// what is left of it on the floor; of the ambient light as much as without them.
TEST_F(ShadowHazards, AsManySheetsAsOneLikes) {
  constexpr int kSheets = 200;
  std::string sheets;
  for (int i = 1; i <= kSheets; ++i)
    sheets += R"({ "surface": "floor", "material": "thin", "translate": [0, )" + std::to_string(0.01 * i) +
              ", 0] }, ";
  const Scene scene = sceneOf(sheets + R"({ "rotate": { "axis": [1, 0, 0], "angle": "-90deg" },
                                            "light": { "type": "directional", "shadow": "exact" } })");
  const Camera camera{
      .eye = Vec3(1, 5, 1), .lookAt = Vec3(1, 0, 1), .up = Vec3(0, 0, -1), .fovY = radians(50)};
  constexpr PixelSize kSmall{12, 9};  // each sheet's light is looked for on each of the others
  const Picture picture = draw(scene, camera, kSmall, {.audit = {.extent = AuditExtent::None}});
  const FrameError& error = picture.statistics.error;
  EXPECT_EQ(error.layersMissing + error.unconvergedPx + error.uncertifiedPx + error.nonfinitePx, 0U);
  EXPECT_EQ(picture.statistics.count.layerPoints, std::uint64_t{kSheets} * kSmall.width * kSmall.height);
  EXPECT_EQ(picture.statistics.count.shadowPasses, 2U * kSheets) << "on what is opaque, and on the sheets";
  const double through = 1 - 0.01, twice = std::pow(through, 2 * kSheets);
  const double seen = 0.7 * (0.1 + 0.01 * (1 - twice) / (1 - through * through) + twice);
  // Each layer rounds some four times, by 2^-24 of 0.7 at most: 200 of them by 3.4e-5, were it all one way.
  for (int y = 0; y < kSmall.height; ++y)
    for (int x = 0; x < kSmall.width; ++x)
      ASSERT_TRUE(near(colorAt(picture.image, x, y), Vec3(seen), 4e-5)) << x << ", " << y;
}

/// As many that are aslant, through each other, and in the way of some of the others only.
TEST_F(ShadowHazards, AHeapOfSheets) {
  const Picture picture =
      draw(sceneOf(heap(200, "floor", "glass") + lightAt("[2, 6, 3]")), kShadowHazardsSize);
  const FrameError& error = picture.statistics.error;
  EXPECT_EQ(error.layersMissing + error.unconvergedPx + error.uncertifiedPx + error.nonfinitePx, 0U);
  EXPECT_EQ(error.auditFailedPx, 0U);
  EXPECT_TRUE(allFinite(picture.image));
  EXPECT_GT(picture.statistics.count.layerPoints, 10'000U);
  EXPECT_EQ(picture.statistics.count.shadowPasses, 2U * 201)
      << "of each, and of the floor for what is below it";
}

TEST_F(ShadowHazards, ACrowdOfCasters) {
  const FrameStatistics told = expectRightOrTold(sceneOf(heap(100, "ball", "m") + heap(100, "torus", "m") +
                                                         lightAt("[2, 6, 3]") + ", " + lightAt("[-3, 5, 1]")),
                                                 kShadowHazardsSize);
  EXPECT_EQ(told.error.unconvergedPx + told.error.uncertifiedPx, 0U);
  EXPECT_GE(told.count.shadowPasses, 400U);
}

/// Depth maps are not exact, but what they show is defined.
TEST_F(ShadowHazards, DepthMapsOfOddSizesAndBiases) {
  const std::string ball = caster("ball", R"("translate": [0, 1.2, 0])");
  const auto pictureOf = [&](const std::string& at, const std::string& map) {
    const Picture picture =
        draw(sceneOf(ball + lightAt(at, R"(, "map": )" + map, "map")), kShadowHazardsSize);
    EXPECT_EQ(picture.statistics.error.nonfinitePx, 0U);
    EXPECT_TRUE(allFinite(picture.image));
    return picture.image;
  };
  for (const char* map : {R"({ "size": 1 })", R"({ "size": 64, "pcf": 15 })", R"({ "bias": 1e18 })",
                          R"({ "slope_bias": 1e18 })", R"({ "normal_offset": 1e18 })"})
    for (const char* at : {"[2, 6, 3]", "[0, 1.2, 0]", "[2, 0, 1]", "[0, 2.2, 0]"}) {
      SCOPED_TRACE(std::string(map) + at);
      static_cast<void>(pictureOf(at, map));
    }
  // From inside it has six faces, which are too large together.
  try {
    static_cast<void>(pictureOf("[0, 1.2, 0]", R"({ "size": 8192 })"));
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::Scene);
    EXPECT_NE(std::string(error.what()).find("6 faces of 8192 texels"), std::string::npos) << error.what();
  }
  // With such a bias all is nearer to the light than anything in the map.
  const Image unshadowed =
                  draw(sceneOf(ball + R"({ "translate": [2, 6, 3], "light": {} })"), kShadowHazardsSize)
                      .image,
              biased = pictureOf("[2, 6, 3]", R"({ "bias": 1e18 })");
  for (int y = 0; y < kShadowHazardsSize.height; ++y)
    for (int x = 0; x < kShadowHazardsSize.width; ++x)
      ASSERT_TRUE(near(colorAt(biased, x, y), colorAt(unshadowed, x, y), 1e-5)) << x << ", " << y;
}

}  // namespace
}  // namespace luxo::test
