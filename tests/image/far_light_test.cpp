// SPDX-License-Identifier: Apache-2.0
// Point lights so far away that their rays are parallel: the picture is that of the directional light,
// however far they are, and no audit has to mend it.
#include <gtest/gtest.h>

#include <string>

#include "scene/light_view.h"
#include "scene/scene_builder.h"
#include "scene/scene_reader.h"
#include "support/verified_picture.h"

namespace luxo::test {
namespace {

constexpr PixelSize kFarLightSize{320, 240};

class FarLightTest : public VerifiedPictureTest {
 protected:
  /// Casters known by equations, by cells and as triangles, opaque and not, and the light of that node.
  [[nodiscard]] static Scene sceneOf(const std::string& light) {
    return buildScene(parseScene(R"_({ "luxo": 1,
      "render": { "ambient": [0.1, 0.1, 0.1], "background": [0, 0, 0] },
      "materials": { "m": { "diffuse": [0.7, 0.7, 0.7], "specular": 0 },
                     "glass": { "diffuse": [0.4, 0.6, 0.5], "specular": 0, "opacity": 0.4 } },
      "surfaces": { "floor": { "type": "rectangle", "size": [40, 40] }, "ball": { "type": "sphere", "radius": 1 },
                    "torus": { "type": "torus", "major": 0.8, "minor": 0.3 }, "klein": { "type": "klein" },
                    "helicoid": { "type": "helicoid" } },
      "camera": { "eye": [1, 7, 6], "look_at": [0.5, 0, 0], "fov_y": "50deg" },
      "nodes": [ { "name": "floor", "surface": "floor", "material": "m" },
        { "surface": "ball", "material": "m", "translate": [-2.6, 1.6, 0] },
        { "surface": "torus", "material": "m", "translate": [0, 1.6, 0.3], "rotate": { "axis": [1, 0.3, 0], "angle": 0.9 } },
        { "surface": "klein", "material": "m", "translate": [2.6, 1.6, 0.6] },
        { "surface": "helicoid", "material": "glass", "translate": [0.5, 2.5, 2], "scale": [0.4, 0.4, 0.4] }, )_" +
                                     light + "] }",
                                 "far light"));
  }

  /// Toward (-0.3, 0.9, 0.2), as far as `times` of that.
  [[nodiscard]] static std::string pointLight(const std::string& times, const std::string& shadow) {
    return R"({ "translate": ["-0.3*)" + times + R"(", "0.9*)" + times + R"(", "0.2*)" + times +
           R"("], "light": {)" + shadow + " } }";
  }
  [[nodiscard]] static std::string sun(const std::string& shadow) {
    return R"_({ "rotate": { "axis": [-0.9, -0.3, 0], "angle": "acos(0.2/sqrt(0.94))" },
                 "light": { "type": "directional", )_" +
           shadow + " } }";
  }

  [[nodiscard]] Image unaudited(const std::string& light) {
    const Picture picture = draw(sceneOf(light), kFarLightSize, {.audit = {.extent = AuditExtent::None}});
    EXPECT_EQ(picture.statistics.error.nonfinitePx, 0U);
    EXPECT_EQ(picture.statistics.error.unconvergedPx, 0U);
    // What both lights leave to rays is where they graze a caster: a dozen pixels.
    EXPECT_LT(picture.statistics.error.shadowRaysPx, 40U);
    return picture.image;
  }

  static void expectSame(const Image& image, const Image& expected) {
    int different = 0, dark = 0;
    for (int y = 0; y < kFarLightSize.height; ++y)
      for (int x = 0; x < kFarLightSize.width; ++x) {
        different += !near(colorAt(image, x, y), colorAt(expected, x, y), 1e-5);
        dark += colorAt(expected, x, y).x < 0.1;
      }
    EXPECT_EQ(different, 0);
    EXPECT_GT(dark, 2000) << "there is no shadow: the test shows nothing";
  }
};

TEST_F(FarLightTest, IsADirection) {
  for (const std::string shadow : {R"("shadow": "exact")", R"("shadow": "planar", "shadow_plane": "floor")",
                                   R"("shadow": "map", "map": { "size": 512, "slope_bias": 2 })"}) {
    const Image expected = unaudited(sun(shadow));
    for (const std::string times : {"1e12", "1e17", "1e18"}) {
      SCOPED_TRACE(shadow + " at " + times);
      expectSame(unaudited(pointLight(times, shadow)), expected);
    }
  }
}

/// A node in a larger one: farther away than any number of the scene, and than floats have squares.
TEST_F(FarLightTest, BeyondTheSquaresOfFloatsIsADirection) {
  const std::string exact = R"("shadow": "exact")";
  expectSame(unaudited(R"({ "scale": [1e4, 1e4, 1e4], "children": [ )" + pointLight("1e18", exact) + "] }"),
             unaudited(sun(exact)));
}

/// 1 / d^2 of the same intensity: |(-0.3, 0.9, 0.2)|^2 = 0.94.
TEST_F(FarLightTest, FadesAsFarAsItIs) {
  const std::string exact = R"("shadow": "exact")";
  const Image expected = unaudited(sun(exact));
  for (const auto& [times, intensity] : {std::pair("1e6", "0.94e12"), {"1e9", "0.94e18"}}) {
    SCOPED_TRACE(times);
    const Image image = unaudited(
        pointLight(times, exact + R"(, "attenuation": "inverse-square", "intensity": )" + intensity));
    // From end to end of the floor 1e6 m change by 4e-5 of themselves.
    const int different = differingPixels(image, expected, 1e-4);
    EXPECT_LT(different, 5);
  }
}

/// As far as its rays are a quarter of a texel from parallel a depth map takes them for what they are.
TEST(FarLight, OfADepthMapIsADirectionWhereItsTexelsDoNotTell) {
  const Box casters{Vec3(-1), Vec3(1)}, receivers{Vec3(-4), Vec3(4)};
  const auto isDirection = [&](double distance, int size) {
    const SnapshotLight light{.positionWorld = Vec4(0, distance, 0, 1), .map = ShadowMapThen{.radius = 2}};
    const SnapshotLight seen = asMapped(light, casters, receivers, size);
    EXPECT_EQ(lightViews(seen, casters, receivers, size)[0].perspective(), !seen.directional());
    // What looks 2 m wide from there.
    EXPECT_NEAR(seen.map->radius, seen.directional() ? 2 / distance : 2, 1e-9);
    return seen.directional();
  };
  EXPECT_FALSE(isDirection(100, 64));
  EXPECT_TRUE(isDirection(1e5, 64));
  EXPECT_FALSE(isDirection(1e5, 4096));
  EXPECT_TRUE(isDirection(1e17, 4096));
}

/// A caster a kilometre above: whatever else there is, the rays that count are those to what is seen.
TEST(FarLight, OfADepthMapIsTheDirectionInWhichItIsSeen) {
  const Box casters{Vec3(-1, 0, -1), Vec3(1500, 1000, 1)}, receivers{Vec3(-1, 0, -1), Vec3(1, 0, 1)};
  const SnapshotLight light{.positionWorld = Vec4(0, 3e7, 0, 1), .map = ShadowMapThen{}};
  const SnapshotLight seen = asMapped(light, casters, receivers, 2048);
  ASSERT_TRUE(seen.directional());
  EXPECT_EQ(Vec3(seen.positionWorld), Vec3(0, 1, 0));
}

}  // namespace
}  // namespace luxo::test
