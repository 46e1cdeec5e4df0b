// SPDX-License-Identifier: Apache-2.0
// Shadows of casters that are known as equations, against the reference's rays, in every pixel.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>

#include "scene/scene_builder.h"
#include "scene/scene_reader.h"
#include "support/verified_picture.h"

namespace luxo::test {
namespace {

class ClosedShadowTest : public VerifiedPictureTest {};

constexpr std::array kKinds = {R"("type": "sphere", "radius": 0.8)",
                               R"("type": "cylinder", "radius": 0.6, "height": 1.5)",
                               R"("type": "cone", "height": 1.4)",
                               R"("type": "disk")",
                               R"("type": "rectangle", "size": [1.6, 1.1])",
                               R"("type": "ellipsoid")",
                               R"("type": "paraboloid", "focal_length": 0.2, "height": 1)",
                               R"("type": "hyperboloid")",
                               R"("type": "hyperboloid2")",
                               R"("type": "hyperbolic_paraboloid")",
                               R"("type": "torus", "major": 0.8, "minor": 0.3)",
                               R"("type": "torus", "major": 1, "minor": 0.04)",
                               R"("type": "torus", "major": 0.7, "minor": 0.6)"};

/// Some of all kinds, turned, stretched and mirrored, in lights near, far, between them and at infinity.
class RandomCasters {
 public:
  explicit RandomCasters(unsigned seed) : random_(seed) {}

  [[nodiscard]] Scene scene() {
    std::string surfaces, nodes;
    for (std::size_t i = 0; i < kKinds.size(); ++i)
      surfaces += fmt::format(R"("s{}": {{ {} }}, )", i, kKinds[i]);
    const int casters = 2 + pick(4), lights = 1 + pick(2);
    for (int i = 0; i < casters; ++i)
      nodes += fmt::format(
          R"({{ "surface": "s{}", "translate": [{}, {}, {}], "rotate": {{ "axis": [{}, {}, {}], "angle": {} }},
                "scale": [{}, {}, {}] }}, )",
          pick(kKinds.size()), in(-2, 2), in(-0.2, 2.2), in(-2, 2), in(-1, 1), in(-1, 1), in(-1, 1.01),
          pick(3) > 0 ? in(0, 6.28) : 0, (pick(3) > 0 ? 1 : -1) * in(0.4, 1.6), in(0.3, 1.6), in(0.4, 1.6));
    if (pick(4) > 0) nodes += R"({ "surface": "floor" }, )";
    for (int i = 0; i < lights; ++i) {
      const double far = pick(3) == 0 ? in(0.1, 1.5) : pick(4) == 0 ? 1e4 : 6;
      if (pick(3) == 0)
        nodes += fmt::format(
            R"({{ "rotate": {{ "axis": [{}, {}, {}], "angle": {} }},
                  "light": {{ "type": "directional", "intensity": 0.5, "shadow": "exact" }} }}, )",
            in(-1, 1), in(-1, 1), in(-1, 1.01), in(0, 6.28));
      else
        nodes += fmt::format(
            R"({{ "translate": [{}, {}, {}], "light": {{ "intensity": 0.6, "shadow": "exact" }} }}, )",
            in(-1, 1) * far, in(0.05, 1) * far, in(-1, 1) * far);
    }
    nodes.resize(nodes.size() - 2);
    return buildScene(parseScene(fmt::format(R"({{ "luxo": 1, "render": {{ "ambient": 0.1 }},
          "surfaces": {{ {} "floor": {{ "type": "rectangle", "size": [14, 14] }} }},
          "camera": {{ "eye": [{}, {}, {}], "look_at": [0, 0.7, 0], "fov_y": "45deg" }}, "nodes": [ {} ] }})",
                                             surfaces, in(-5, 5), in(0.5, 6), in(2, 6), nodes),
                                 "casters"));
  }

 private:
  [[nodiscard]] double in(double lo, double hi) { return lo + (hi - lo) * (random_() / 4294967296.0); }
  [[nodiscard]] int pick(std::size_t count) { return static_cast<int>(random_() % count); }

  std::mt19937 random_;
};

TEST_F(ClosedShadowTest, OfRandomCastersAreTheTruth) {
  std::uint64_t byRays = 0, pixels = 0;
  for (unsigned seed = 1; seed <= 16; ++seed) {
    SCOPED_TRACE(seed);
    const Verified found = verified(takeSnapshot(RandomCasters(seed).scene(), 0, {72, 54}));
    EXPECT_EQ(found.verification.wrong.total(), 0U);
    EXPECT_EQ(found.statistics.error.auditFailedPx, 0U);
    byRays += found.statistics.error.shadowRaysPx;
    pixels += 72 * 54;
  }
  // Far below what one caster that is left to rays as a whole would make it.
  EXPECT_LE(byRays, pixels / 500);
}

/// No grid, no cells: nothing is made for the shadow of what has an equation.
/// Lamps before the end of a rod, in the plane of a rim, and on an apex, over a floor that is far away: the
/// light is followed from the lamp, where floats know it best. From the floor the borders were left to rays,
/// for the rod 451 pixels of 76,800.
TEST_F(ClosedShadowTest, OfLampsAtTheirEndsAreTheTruth) {
  struct Lamp {
    int kind;
    Vec3 at;
    std::uint64_t rays;  // at most: twice as many as measured, where there are some
  };
  const double apex = 1.4, rim = 1.5;
  for (const Lamp& lamp :
       {Lamp{1, {0.3, rim + 0.05, 0.2}, 4}, Lamp{1, {0.7, rim, 0}, 4}, Lamp{1, {0.61, 0.7, 0}, 4},
        Lamp{2, {0, apex + 0.02, 0}, 84}, Lamp{2, {0, apex, 0}, 19'200}, Lamp{2, {1.1, 0, 0.1}, 4},
        Lamp{6, {0.1, 1.02, 0}, 4}, Lamp{6, {0.3, 0.5, 0.2}, 4}, Lamp{7, {0.2, 0.9, 0.4}, 4}}) {
    SCOPED_TRACE(
        fmt::format("{}, at ({}, {}, {})", kKinds[std::size_t(lamp.kind)], lamp.at.x, lamp.at.y, lamp.at.z));
    const Scene scene =
        buildScene(parseScene(fmt::format(R"({{ "luxo": 1, "render": {{ "ambient": 0.1 }},
          "surfaces": {{ "caster": {{ {} }}, "floor": {{ "type": "rectangle", "size": [400, 400] }} }},
          "camera": {{ "eye": [9, 14, 25], "look_at": [0, -6, 0], "fov_y": "50deg" }},
          "nodes": [ {{ "surface": "floor", "translate": [0, -9, 0] }},
                     {{ "surface": "caster", "rotate": {{ "axis": [1, 0, 0.4], "angle": 0.3 }}, "children": [
                       {{ "translate": [{}, {}, {}], "light": {{ "intensity": 1, "shadow": "exact" }} }} ] }} ] }})",
                                          kKinds[std::size_t(lamp.kind)], lamp.at.x, lamp.at.y, lamp.at.z),
                              "lamp"));
    const Verified found = verified(takeSnapshot(scene, 0, {160, 120}));
    EXPECT_EQ(found.verification.wrong.total(), 0U);
    EXPECT_EQ(found.statistics.error.unconvergedPx, 0U);
    EXPECT_LE(found.statistics.error.shadowRaysPx, lamp.rays);
  }
}

TEST_F(ClosedShadowTest, MakeNothing) {
  const auto made = [&](const char* type, const char* light) {
    const Scene scene =
        buildScene(parseScene(fmt::format(R"({{ "luxo": 1, "surfaces": {{ "s": {{ "type": "{}" }} }},
             "nodes": [ {{ "surface": "s" }}, {{ "surface": "s", "translate": [0.5, -3, 0] }},
                        {{ "translate": [1, 9, 2], "light": {{ {} }} }} ] }})",
                                          type, light),
                              "casters"));
    Renderer fresh(context());
    return fresh.render(takeSnapshot(scene, 0, {64, 48})).statistics.count.tessellated;
  };
  for (const char* type : {"sphere", "cylinder", "torus", "hyperboloid2", "hyperbolic_paraboloid"})
    EXPECT_EQ(made(type, R"("shadow": "exact")"), made(type, "")) << type;
  EXPECT_GT(made("klein", R"("shadow": "exact")"), made("klein", "")) << "which has cells";
}

/// Two cylinders of one radius on each other: all points of one lie on the other's equation, beyond its edge.
/// No ray is asked but at that edge.
TEST_F(ClosedShadowTest, OfWhatGoesOnBeyondItsEdgesAreSettled) {
  const Scene scene = buildScene(parseScene(
      R"({ "luxo": 1, "surfaces": { "c": { "type": "cylinder", "radius": 0.7, "height": 1 },
                                    "r": { "type": "rectangle", "size": [2, 2] } },
           "camera": { "eye": [3, 4, 5], "look_at": [0, 0.8, 0], "fov_y": "40deg" },
           "nodes": [ { "surface": "c" }, { "surface": "c", "translate": [0, 1, 0] },
                      { "surface": "r", "translate": [1, 0, 0] }, { "surface": "r", "translate": [3, 0, 0] },
                      { "translate": [-2, 4, 2], "light": { "shadow": "exact" } } ] })",
      "casters"));
  const Verified found = verified(takeSnapshot(scene, 0, {160, 120}));
  EXPECT_EQ(found.verification.wrong.total(), 0U);
  EXPECT_LE(found.statistics.error.shadowRaysPx, 4U);
}

/// A wire over the camera, thinner than what floats leave of where rays are: only those that come as near to
/// it as that are left over, not those through its hole, beside it or above.
TEST_F(ClosedShadowTest, OfAThinRingAskFewRays) {
  for (const char* light : {R"("translate": [-0.2, 6, 0.1], "light": { "shadow": "exact" })",
                            R"("translate": [0.1, 2.5, 0], "light": { "shadow": "exact" })",
                            R"("rotate": { "axis": [1, 0.2, 0], "angle": -1.4 },
                               "light": { "type": "directional", "shadow": "exact" })"}) {
    SCOPED_TRACE(light);
    const Scene scene = buildScene(parseScene(
        fmt::format(R"({{ "luxo": 1, "surfaces": {{ "floor": {{ "type": "rectangle", "size": [9, 9] }},
                                          "wire": {{ "type": "torus", "major": 0.5, "minor": 2e-4 }} }},
             "camera": {{ "eye": [0.6, 1.4, 0.8], "look_at": [0, 0, 0], "fov_y": "50deg" }},
             "nodes": [ {{ "surface": "floor" }}, {{ {} }},
                        {{ "surface": "wire", "translate": [0, 1.7, 0],
                           "rotate": {{ "axis": [1, 0, 0.4], "angle": 0.3 }} }} ] }})",
                    light),
        "wire"));
    const Verified found = verified(takeSnapshot(scene, 0, {320, 240}));
    EXPECT_EQ(found.verification.wrong.total(), 0U);
    EXPECT_EQ(found.statistics.error.auditFailedPx, 0U);
    EXPECT_EQ(found.statistics.error.unconvergedPx, 0U);
    // Its shadow is up to 1,000 pixels long and a tenth of one wide: of the picture's 76,800.
    EXPECT_GT(found.statistics.error.shadowRaysPx, 0U);
    EXPECT_LE(found.statistics.error.shadowRaysPx, 200U);
  }
}

/// A lamp of two lights in the focus of one shade, beside one of its own, over a ball and a floor.
Scene lamps(const char* casters = R"("head")") {
  return buildScene(parseScene(fmt::format(R"({{ "luxo": 1, "render": {{ "ambient": 0.1 }},
           "surfaces": {{ "shade": {{ "type": "paraboloid", "focal_length": 0.2, "height": 1.8 }},
                         "floor": {{ "type": "rectangle", "size": [12, 12] }},
                         "ball": {{ "type": "sphere", "radius": 0.6 }},
                         "dust": {{ "type": "sphere", "radius": 0.01 }} }},
           "materials": {{ "both": {{ "diffuse": 0.7, "two_sided": true }} }},
           "camera": {{ "eye": [4, 5, 6], "look_at": [0, 1.5, 0], "fov_y": "45deg" }},
           "nodes": [ {{ "surface": "floor" }}, {{ "surface": "ball", "translate": [1, 0.8, 1.4] }},
                      {{ "name": "dust", "surface": "dust", "translate": [0, -9, 0] }},
                      {{ "name": "head", "surface": "shade", "material": "both", "translate": [0, 2.5, 0],
                         "rotate": {{ "axis": [1, 0, -0.3], "angle": 1.9 }}, "children": [
                           {{ "translate": [0, 0.2, 0], "light": {{ "color": [1, 0.3, 0.2], "shadow": "exact",
                              "casters": [{0}] }} }},
                           {{ "translate": [0, 0.2, 0], "light": {{ "color": [0.2, 0.3, 1], "shadow": "exact",
                              "casters": [{0}] }} }} ] }},
                      {{ "name": "other", "surface": "shade", "material": "both", "translate": [-2, 1.5, 1],
                         "rotate": {{ "axis": [1, 0, 0.4], "angle": 1.4 }}, "scale": [0.5, 0.5, 0.5],
                         "children": [ {{ "translate": [0, 0.2, 0], "light": {{ "color": [0.2, 1, 0.2],
                           "intensity": 0.5, "shadow": "exact", "casters": ["other"] }} }} ] }} ] }})",
                                           casters),
                               "lamps"));
}

/// Where rounding would have a shade's wall inside of it in one pixel and outside in the next.
TEST_F(ClosedShadowTest, ShadesLeaveTheirWallsAllLightInThem) {
  const Snapshot snapshot = takeSnapshot(lamps(), 0, {160, 120});
  ASSERT_EQ(
      std::ranges::count_if(snapshot.lights, [](const SnapshotLight& l) { return l.shade.has_value(); }), 3);
  const Verified found = verified(snapshot);
  EXPECT_EQ(found.statistics.count.deferred, 0U);
  EXPECT_EQ(found.verification.wrong.total(), 0U);
  const Image fused = renderer().render(snapshot).image,
              deferred = renderer().render(snapshot, {.composition = Composition::Deferred}).image;
  EXPECT_LE(largestDifference(fused, deferred), 2e-6);
}

/// What vertices tell of a shade is not where its shadow ends.
TEST_F(ClosedShadowTest, ShadesAreCastersLikeOthersOfLightBetweenVertices) {
  const Snapshot shade = takeSnapshot(lamps(), 0, {160, 120}),
                 casters = takeSnapshot(lamps(R"("head", "dust")"), 0, {160, 120});
  ASSERT_TRUE(shade.lights[1].shade && !casters.lights[0].shade);
  const DrawOptions options{.shading = Shading::Gouraud};
  // Their lights come in another order.
  EXPECT_LE(
      largestDifference(renderer().render(shade, options).image, renderer().render(casters, options).image),
      1e-6);
}

/// Each with a light: more than one set of lights has room for.
TEST_F(ClosedShadowTest, MoreShadesThanASetHasLightsAreCastersLikeOthers) {
  std::string lamps;
  for (int row = 0; row < 5; ++row)
    for (int column = 0; column < 8; ++column)
      lamps += fmt::format(
          R"(, {{ "name": "{0}{1}", "surface": "shade", "material": "m", "translate": [{2}, 1.5, {3}],
                  "rotate": {{ "axis": [1, 0, 0.2], "angle": 3 }}, "children": [ {{ "translate": [0, 0.1, 0],
                  "light": {{ "intensity": 0.4, "shadow": "exact", "casters": ["{0}{1}"] }} }} ] }})",
          row, column, 2 * column - 7, 2.5 * row - 5);
  const Scene hall = buildScene(parseScene(
      R"({ "luxo": 1, "surfaces": { "shade": { "type": "paraboloid", "focal_length": 0.1, "height": 0.5 },
                                    "floor": { "type": "rectangle", "size": [16, 16] } },
           "materials": { "m": { "diffuse": 0.7, "two_sided": true } },
           "camera": { "eye": [8, 9, 11], "look_at": [0, 0, 0], "fov_y": "50deg" },
           "nodes": [ { "surface": "floor", "material": "m" })" +
          lamps + " ] }",
      "hall"));
  const Verified found = verified(takeSnapshot(hall, 0, {80, 60}));
  EXPECT_EQ(found.verification.wrong.total(), 0U);
  EXPECT_EQ(found.statistics.error.unconvergedPx, 0U);
}

}  // namespace
}  // namespace luxo::test
