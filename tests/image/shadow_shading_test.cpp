// SPDX-License-Identifier: Apache-2.0
// Shadows where light is interpolated between vertices, or counted in steps: of every light what it gives
// without shadows, wherever it is seen from.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "scene/scene_builder.h"
#include "scene/scene_reader.h"
#include "support/picture.h"

namespace luxo::test {
namespace {

constexpr PixelSize kShadowShadingSize{120, 90};
constexpr double kFloorY = 0, kPaneY = 1;

struct Sun {
  Vec3 at;
  double intensity;
};

/// A ball of radius 1 at (0, 3, 0), the only caster, over a pane that is seen through, over a floor.
class ShadowShadingTest : public PictureTest {
 protected:
  [[nodiscard]] static Scene sceneOf(const std::vector<Sun>& suns, bool shadows, const std::string& caster,
                                     bool pane, const std::string& look = R"("diffuse": [0.6, 0.5, 0.4])") {
    std::string text = R"_({ "luxo": 1,
      "render": { "ambient": [0.1, 0.1, 0.1], "background": [0, 0, 0] },
      "materials": { "m": { "specular": 0.4, "shininess": 20, )_" +
                       look + R"_( },
                     "pane": { "diffuse": [0.2, 0.4, 0.5], "opacity": 0.4 },
                     "caster": { )_" +
                       caster + R"_( } },
      "surfaces": { "floor": { "type": "rectangle", "size": [8, 8] }, "ball": { "type": "sphere", "radius": 1 } },
      "camera": { "eye": [2, 7, 6], "look_at": [0, 0.5, 0], "fov_y": "55deg" },
      "nodes": [ { "surface": "floor", "material": "m" },
                 { "name": "caster", "surface": "ball", "material": "caster", "translate": [0, 3, 0] })_";
    if (pane) text += R"(, { "surface": "floor", "material": "pane", "translate": [0, 1, 0] })";
    for (const Sun& sun : suns)
      text += ", { \"translate\": [" + std::to_string(sun.at.x) + ", " + std::to_string(sun.at.y) + ", " +
              std::to_string(sun.at.z) + "], \"light\": { \"intensity\": " + std::to_string(sun.intensity) +
              (shadows ? R"(, "shadow": "exact", "casters": ["caster"])" : "") + " } }";
    return buildScene(parseScene(text + "] }", "shadow_shading"));
  }

  /// Whether a point sees a light past the ball, or nothing where that is not sure to a pixel's thousandth;
  /// where the pixel shows no point of the plane, nothing, too.
  [[nodiscard]] static std::optional<bool> sees(const CameraModel& camera, int x, int y, double plane,
                                                const Vec3& light) {
    return settled(
        [&](const Vec2& pixel) {
          const luxo::test::Ray ray = camera.through(pixel);
          const Vec3 at = ray.at(hitPlane(ray, Vec3(0, plane, 0), Vec3(0, 1, 0)).value_or(0));
          const Vec3 way = unit(light - at), from = at - Vec3(0, 3, 0);
          const double b = glm::dot(from, way), c = glm::dot(from, from) - 1;
          return b > 0 || b * b < c;
        },
        centerOf(x, y), 1e-3);
  }

  /// Calls with every pixel that shows the floor, and not the ball.
  void forFloor(const Scene& scene, const std::function<void(const CameraModel&, int, int)>& call) {
    const Image id = draw(scene, kShadowShadingSize, {.output = Output::Id}).image;
    const CameraModel camera(scene.cameras()[0], kShadowShadingSize);
    for (int y = 0; y < kShadowShadingSize.height; ++y)
      for (int x = 0; x < kShadowShadingSize.width; ++x)
        if (const float number = id.pixel(x, y)[0]; number == 1 || number == 3) call(camera, x, y);
  }
};

const std::vector<Sun> kTwo{{Vec3(2, 7, 1), 0.5}, {Vec3(-3, 6, -1), 0.3}};
constexpr const char* kOpaque = R"("diffuse": [0.7, 0.7, 0.7])";

/// One light alone, or none, as without shadows.
std::vector<Sun> only(std::vector<Sun> suns, std::size_t kept) {
  for (std::size_t i = 0; i < suns.size(); ++i)
    if (i != kept) suns[i].intensity = 0;
  return suns;
}

TEST_F(ShadowShadingTest, GouraudIsTheSumOfWhatIsSeenOfEachLight) {
  // Nine lights are more than one draw interpolates.
  std::vector<Sun> nine;
  for (int i = 0; i < 9; ++i)
    nine.push_back({Vec3(5 * std::cos(0.7 * i), 6 + 0.2 * i, 5 * std::sin(0.7 * i)), 0.1 + 0.01 * i});
  const std::string pattern = R"_("diffuse": ["0.5+0.3*sin(9u)", 0.5, "0.4+0.2*cos(7v)"])_";
  for (const auto& [suns, look] : {std::pair(kTwo, std::string(R"("diffuse": [0.6, 0.5, 0.4])")),
                                   std::pair(kTwo, pattern), std::pair(nine, pattern)}) {
    const DrawOptions options{.shading = Shading::Gouraud};
    const Scene scene = sceneOf(suns, true, kOpaque, false, look);
    const Picture picture = draw(scene, kShadowShadingSize, options);
    const auto without = [&](std::size_t light) {
      return draw(sceneOf(only(suns, light), false, kOpaque, false, look), kShadowShadingSize, options).image;
    };
    const Image dark = without(suns.size());
    std::vector<Image> alone;
    for (std::size_t i = 0; i < suns.size(); ++i) alone.push_back(without(i));
    int lit = 0, shadowed = 0;
    forFloor(scene, [&](const CameraModel& camera, int x, int y) {
      Vec3 expected = colorAt(dark, x, y);
      for (std::size_t i = 0; i < suns.size(); ++i) {
        const auto visible = sees(camera, x, y, kFloorY, suns[i].at);
        if (!visible) return;
        if (*visible) expected += colorAt(alone[i], x, y) - colorAt(dark, x, y);
        ++(*visible ? lit : shadowed);
      }
      ASSERT_TRUE(near(colorAt(picture.image, x, y), expected, 2e-6)) << x << ", " << y;
    });
    EXPECT_GT(lit, 2000);
    EXPECT_GT(shadowed, 250);
    EXPECT_EQ(picture.statistics.error.unconvergedPx, 0U);
  }
}

const std::vector<Sun> kOne{{Vec3(2, 7, 1), 0.5}};

TEST_F(ShadowShadingTest, ToonCountsTheLightThatIsSeen) {
  const DrawOptions options{.shading = Shading::Toon};
  const Scene scene = sceneOf(kOne, true, kOpaque, false);
  const Image image = draw(scene, kShadowShadingSize, options).image;
  int bright = 0, dark = 0;
  forFloor(scene, [&](const CameraModel& camera, int x, int y) {
    const auto isBright = settled(
        [&](const Vec2& pixel) {
          const luxo::test::Ray ray = camera.through(pixel);
          const Vec3 at = ray.at(hitPlane(ray, Vec3(0), Vec3(0, 1, 0)).value_or(0));
          bool any = false;
          for (const Sun& sun : kOne) {
            const Vec3 way = unit(sun.at - at), from = at - Vec3(0, 3, 0);
            const double b = glm::dot(from, way), c = glm::dot(from, from) - 1;
            any |= (b > 0 || b * b < c) && way.y > 0.5;
          }
          return any;
        },
        centerOf(x, y), 1.5);
    if (!isBright) return;
    ASSERT_TRUE(near(colorAt(image, x, y), (*isBright ? 1.0 : 0.5) * Vec3(0.6, 0.5, 0.4), 1e-5))
        << x << ", " << y;
    ++(*isBright ? bright : dark);
  });
  EXPECT_GT(bright, 2000);
  EXPECT_GT(dark, 100);
}

/// Behind a ball of glass, which the light meets twice.
TEST_F(ShadowShadingTest, WhatComesThroughACasterCounts) {
  const std::string stained = R"("diffuse": [0.9, 0.8, 0.4], "opacity": 0.1, "blend": "multiply")";
  const Vec3 once = 0.9 * Vec3(0.9, 0.8, 0.4), through = once * once;
  const std::vector<Sun>& sun = kOne;
  // The floor beside the camera's view of the glass ball alone.
  const auto showsBall = [&](const CameraModel& camera, int x, int y) {
    const luxo::test::Ray ray = camera.through(centerOf(x, y));
    return hitSphere(ray, Vec3(0, 3, 0), 1.05).has_value();
  };
  for (const Shading shading : {Shading::Gouraud, Shading::Toon}) {
    const Scene scene = sceneOf(sun, true, stained, false);
    const Image image = draw(scene, kShadowShadingSize, {.shading = shading}).image;
    const Image all =
                    draw(sceneOf(sun, false, stained, false), kShadowShadingSize, {.shading = shading}).image,
                none = draw(sceneOf(only(sun, 1), false, stained, false), kShadowShadingSize,
                            {.shading = shading})
                           .image;
    int below = 0;
    forFloor(scene, [&](const CameraModel& camera, int x, int y) {
      const auto visible = sees(camera, x, y, kFloorY, sun[0].at);
      if (!visible || *visible || showsBall(camera, x, y)) return;
      const luxo::test::Ray ray = camera.through(centerOf(x, y));
      const Vec3 at = ray.at(*hitPlane(ray, Vec3(0), Vec3(0, 1, 0)));
      const double cosine = unit(sun[0].at - at).y;
      Vec3 expected = colorAt(none, x, y) + through * (colorAt(all, x, y) - colorAt(none, x, y));
      if (shading == Shading::Toon)
        for (int c = 0; c < 3; ++c) {
          if (std::abs(cosine * through[c] - 0.5) < 0.02) return;  // at the edge between two levels
          expected[c] = colorAt(cosine * through[c] > 0.5 ? all : none, x, y)[c];
        }
      ASSERT_TRUE(near(colorAt(image, x, y), expected, 5e-6)) << x << ", " << y << " " << nameOf(shading);
      ++below;
    });
    EXPECT_GT(below, 100) << nameOf(shading);
  }
}

/// On the pane a shadow lies that is not on the floor below it.
TEST_F(ShadowShadingTest, FallOnWhatIsSeenThrough) {
  for (const Shading shading : {Shading::Gouraud, Shading::Toon}) {
    const DrawOptions options{.shading = shading};
    const Scene scene = sceneOf(kTwo, true, kOpaque, true);
    const auto without = [&](std::size_t light, bool pane) {
      return draw(sceneOf(only(kTwo, light), false, kOpaque, pane), kShadowShadingSize, options).image;
    };
    const Picture picture = draw(scene, kShadowShadingSize, options);
    const Image& image = picture.image;
    const Image dark = without(2, true);
    const Image both[] = {without(0, true), without(1, true)};
    const Image floorDark = without(2, false), floors[] = {without(0, false), without(1, false)};
    int onPaneAlone = 0, checked = 0;
    std::uint64_t off = 0;
    forFloor(scene, [&](const CameraModel& camera, int x, int y) {
      const luxo::test::Ray ray = camera.through(centerOf(x, y));
      const Vec3 onPane = ray.at(*hitPlane(ray, Vec3(0, kPaneY, 0), Vec3(0, 1, 0))),
                 onFloor = ray.at(*hitPlane(ray, Vec3(0), Vec3(0, 1, 0)));
      const double reach =
          std::max({std::abs(onPane.x), std::abs(onPane.z), std::abs(onFloor.x), std::abs(onFloor.z)});
      if (reach > 3.9) return;
      Vec3 pane(0), floor(0);  // what lights add to what is not lit
      for (std::size_t i = 0; i < 2; ++i) {
        const auto seesPane = sees(camera, x, y, kPaneY, kTwo[i].at),
                   seesFloor = sees(camera, x, y, kFloorY, kTwo[i].at);
        if (!seesPane || !seesFloor) return;
        onPaneAlone += !*seesPane && *seesFloor;
        const Vec3 ofFloor = 0.6 * (colorAt(floors[i], x, y) - colorAt(floorDark, x, y));
        const Vec3 ofPane = colorAt(both[i], x, y) - colorAt(dark, x, y) - ofFloor;
        // A drawing is as bright as its brightest light, away from edges between its two levels.
        const auto join = [&](Vec3& sum, const Vec3& more) {
          sum = shading == Shading::Toon ? glm::max(sum, more) : sum + more;
        };
        if (*seesPane) join(pane, ofPane);
        if (*seesFloor) join(floor, ofFloor);
      }
      off += !near(colorAt(image, x, y), colorAt(dark, x, y) + pane + floor, 5e-6);
      ++checked;
    });
    EXPECT_GT(checked, 1000) << nameOf(shading);
    // What floats leave open of a mesh that is seen through is told, not settled.
    EXPECT_LE(off, picture.statistics.error.uncertifiedPx) << nameOf(shading);
    EXPECT_LT(off, 5U) << nameOf(shading);
    EXPECT_GT(onPaneAlone, 30) << nameOf(shading);
  }
}

/// Of a sheet that is seen through, far from its coarse mesh: in the light or not as the surface's own point
/// is.
TEST_F(ShadowShadingTest, StartsAtTheSurfaceOfWhatIsSeenThrough) {
  const Vec3 sun(3, 6, 1), ball(0.8, 2, 0.2);
  const double kRadius = 0.7;
  const auto sceneWith = [&](double intensity, bool shadow) {
    return buildScene(parseScene(R"_({ "luxo": 1,
      "render": { "ambient": [0.2, 0.2, 0.2], "background": [0, 0, 0] },
      "materials": { "veil": { "diffuse": [0.6, 0.5, 0.4], "specular": 0, "opacity": 0.5 } },
      "surfaces": { "veil": { "type": "formula", "u": [-1.5, 1.5], "v": [-1.5, 1.5],
                              "position": ["u", "0.3*cos(2u)*cos(2v)", "-v"] },
                    "ball": { "type": "sphere", "radius": 0.7 } },
      "camera": { "eye": [-1, 4, 2], "look_at": [0, 0, 0], "fov_y": "40deg" },
      "nodes": [ { "surface": "veil", "material": "veil" },
                 { "name": "ball", "surface": "ball", "translate": [0.8, 2, 0.2] },
                 { "translate": [3, 6, 1], "light": { "intensity": )_" +
                                     std::to_string(intensity) +
                                     (shadow ? R"(, "shadow": "exact", "casters": ["ball"])" : "") +
                                     " } } ] }",
                                 "veil"));
  };
  for (const Shading shading : {Shading::Phong, Shading::Flat, Shading::Gouraud, Shading::Toon}) {
    DrawOptions options{.shading = shading, .tolerancePx = 6};
    const auto show = [&](double intensity, bool shadow, Output output = Output::Color) {
      options.output = output;
      return draw(sceneWith(intensity, shadow), kShadowShadingSize, options).image;
    };
    const Image image = show(0.7, true), lit = show(0.7, false), dark = show(0, false),
                id = show(0.7, true, Output::Id), uv = show(0.7, true, Output::Uv),
                positions = show(0.7, true, Output::Position);
    const auto sees = [&](const Vec3& from) {
      const Vec3 way = unit(sun - from), off = from - ball;
      const double b = glm::dot(off, way);
      return b > 0 ? 1.0 : glm::length(off - b * way) - kRadius;  // in the light where it is above 0
    };
    int shadowed = 0, farFromMesh = 0;
    for (int y = 0; y < kShadowShadingSize.height; ++y)
      for (int x = 0; x < kShadowShadingSize.width; ++x) {
        if (id.pixel(x, y)[0] != 1) continue;
        const double u = uv.pixel(x, y)[0], v = uv.pixel(x, y)[1];
        const double height = sees(Vec3(u, 0.3 * std::cos(2 * u) * std::cos(2 * v), -v));
        if (std::abs(height) < 1e-4) continue;
        shadowed += height < 0;
        farFromMesh += (sees(colorAt(positions, x, y)) < 0) != (height < 0);
        ASSERT_TRUE(near(colorAt(image, x, y), colorAt(height > 0 ? lit : dark, x, y), 5e-6))
            << x << ", " << y << " " << nameOf(shading);
      }
    EXPECT_GT(shadowed, 200) << nameOf(shading);
    // Those with light between vertices, and outlines, have finer meshes.
    EXPECT_GT(farFromMesh, shading == Shading::Phong || shading == Shading::Flat ? 10 : 2)
        << nameOf(shading) << ": the test shows less than it says";
  }
}

/// In all these shadings a light that shines from behind lights nothing.
TEST_F(ShadowShadingTest, GouraudHasNoLightFromBehind) {
  // The ball alone, coarse, and its own caster: behind the terminator of its normals there is ambient light.
  const std::vector<Sun>& sun = kOne;
  const Scene scene = sceneOf(sun, true, kOpaque, false);
  const DrawOptions options{.shading = Shading::Gouraud, .tolerancePx = 4};
  const Image image = draw(scene, kShadowShadingSize, options).image,
              dark = draw(sceneOf(only(sun, 1), false, kOpaque, false), kShadowShadingSize, options).image;
  DrawOptions geometry = options;
  geometry.output = Output::Id;
  const Image id = draw(scene, kShadowShadingSize, geometry).image;
  geometry.output = Output::Normal;
  const Image normals = draw(scene, kShadowShadingSize, geometry).image;
  geometry.output = Output::Position;
  const Image positions = draw(scene, kShadowShadingSize, geometry).image;
  int behind = 0;
  for (int y = 0; y < kShadowShadingSize.height; ++y)
    for (int x = 0; x < kShadowShadingSize.width; ++x) {
      if (id.pixel(x, y)[0] != 2) continue;
      const double cosine = glm::dot(colorAt(normals, x, y), unit(sun[0].at - colorAt(positions, x, y)));
      if (cosine > -1e-5) continue;
      ASSERT_TRUE(near(colorAt(image, x, y), colorAt(dark, x, y), 1e-6)) << x << ", " << y;
      ++behind;
    }
  EXPECT_GT(behind, 30);
}

TEST_F(ShadowShadingTest, ManySamplesAreInEveryShading) {
  for (const Shading shading : {Shading::Gouraud, Shading::Toon}) {
    const Picture four =
        draw(sceneOf(kTwo, true, kOpaque, true), {80, 60}, {.shading = shading, .samples = 4});
    EXPECT_EQ(four.statistics.error.nonfinitePx, 0U);
    EXPECT_GT(four.statistics.count.shadowPasses, 0U);
  }
}

}  // namespace
}  // namespace luxo::test
