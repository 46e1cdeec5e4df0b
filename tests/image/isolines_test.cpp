// SPDX-License-Identifier: Apache-2.0
// Lines on surfaces: as wide as is said, where mathematics has them, and as the reference has them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "scene/scene_builder.h"
#include "scene/scene_reader.h"
#include "support/verified_picture.h"

namespace luxo::test {
namespace {

// Odd: the middle of the picture is the middle of a pixel.
constexpr PixelSize kIsolinesSize{97, 73};
constexpr int kMiddleRow = 36;

const char* const kPlane =
    R"({ "type": "formula", "u": [-60, 60], "v": [-50, 50], "position": ["u", "v", 0] })";
/// 10 pixels a metre.
const char* const kFacing =
    R"({ "type": "orthographic", "height": 7.3, "eye": [0, 0, 5], "look_at": [0, 0, 0] })";

/// White, with black lines, under ambient light 1.
Scene lined(const std::string& surface, const std::string& isolines, const std::string& camera = kFacing) {
  return buildScene(parseScene(fmt::format(R"({{ "luxo": 1, "render": {{ "ambient": 1, "background": 0 }},
      "materials": {{ "m": {{ "specular": 0, "diffuse": 1, "two_sided": true, "isolines": {} }} }},
      "surfaces": {{ "s": {} }}, "nodes": [ {{ "surface": "s", "material": "m" }} ], "camera": {} }})",
                                           isolines, surface, camera),
                               "scene"));
}

/// How many pixels of a row the lines cover, beside its first, and where they are on average. That is where
/// the line is if it is a whole number of pixels wide: what a pixel shows is the line seen through a box of
/// one.
struct Covered {
  double pixels = 0, middle = 0;
};
Covered coveredIn(const Image& image, int y) {
  Covered sum;
  for (int x = 0; x < kIsolinesSize.width; ++x) {
    const double covered = 1 - colorAt(image, x, y).x / colorAt(image, 0, y).x;
    sum.pixels += covered;
    sum.middle += covered * (x + 0.5);
  }
  sum.middle /= sum.pixels;
  return sum;
}

// Every pixel of an exact picture is where it should be to a thousandth of a pixel, and a line has two sides.
constexpr double kExactPx = 2e-3;

class IsolinesTest : public VerifiedPictureTest {
 protected:
  Image drawn(const Scene& scene, const DrawOptions& options = {}) {
    return draw(scene, kIsolinesSize, options).image;
  }
};

TEST_F(IsolinesTest, AreAsWideAsIsSaidWhereverTheyAre) {
  for (const double width : {0.3, 1.0, 1.2, 3.0})
    for (const double at : {0.0, 0.013, 0.05, -0.0771}) {
      const Image image =
          drawn(lined(kPlane, fmt::format(R"({{ "of": "x", "at": {}, "width": {} }})", at, width)));
      const Covered covered = coveredIn(image, kMiddleRow);
      EXPECT_NEAR(covered.pixels, width, kExactPx) << at;
      if (width != std::floor(width)) continue;
      EXPECT_NEAR(covered.middle, 48.5 + 10 * at, kExactPx) << width;
    }
}

// The area of a band from the upper edge of the picture to the lower one, whatever its slope is to the
// pixels.
TEST_F(IsolinesTest, CoverTheirAreaAtAnySlope) {
  for (const double slope : {0.37, 0.5, -1.0}) {
    const Image image =
        drawn(lined(kPlane, fmt::format(R"({{ "of": "x + {}*y", "at": 0.013, "width": 1.2 }})", slope)));
    double pixels = 0;
    for (int y = 0; y < kIsolinesSize.height; ++y) pixels += coveredIn(image, y).pixels;
    EXPECT_NEAR(pixels, 1.2 * kIsolinesSize.height * std::sqrt(1 + slope * slope),
                0.1 * kExactPx * kIsolinesSize.height)
        << slope;
  }
}

TEST_F(IsolinesTest, AreAsWideFarAway) {
  for (const double distance : {2.0, 7.0, 40.0}) {
    const Image image = drawn(lined(
        kPlane, R"({ "of": "x", "width": 1.7 })",
        fmt::format(R"({{ "eye": [0.01, 0, {}], "look_at": [0.01, 0, 0], "fov_y": "60deg" }})", distance)));
    EXPECT_NEAR(coveredIn(image, kMiddleRow).pixels, 1.7, kExactPx) << distance;
  }
}

TEST_F(IsolinesTest, AreWhereASphereHasThem) {
  // z = 1/2 is seen from +Z as a circle of radius sqrt(3)/2. Within a line z is not linear: at 3650 pixels a
  // metre z'' / 2z' is 6e-4 per pixel, by which a line moves that reaches one pixel far; float's rounding of
  // places is 2e-4 pixels.
  const Image image = drawn(
      lined(R"({ "type": "sphere", "radius": 1 })", R"({ "of": "z", "step": 0.25, "width": 1 })",
            R"({ "type": "orthographic", "height": 0.02, "eye": [0.866, 0, 5], "look_at": [0.866, 0, 0] })"));
  EXPECT_NEAR(coveredIn(image, kMiddleRow).middle, 48.5 + 3650 * (std::sqrt(0.75) - 0.866), 1e-3);
}

// Five lines and fifty in a pixel, a quarter of which they are.
TEST_F(IsolinesTest, ThatAreDenseMakeNoMoire) {
  for (const double perPixel : {5.0, 50.0}) {
    const Image image = drawn(lined(kPlane, fmt::format(R"({{ "of": "x + 0.1y", "step": {}, "width": {} }})",
                                                        0.1 * std::sqrt(1.01) / perPixel, 0.25 / perPixel)));
    for (int y = 0; y < kIsolinesSize.height; ++y)
      for (int x = 0; x < kIsolinesSize.width; ++x)
        // A relative 1e-5 of float's footprint.
        ASSERT_NEAR(colorAt(image, x, y).x, 0.75, 1e-5) << x << " " << y;
  }
}

// Nor do they get brighter where they grow together.
TEST_F(IsolinesTest, AsNearAsTheirWidthCoverAll) {
  const Image image = drawn(lined(kPlane, R"({ "of": "x", "step": 0.1, "width": 1 })"));
  for (int x = 0; x < kIsolinesSize.width; ++x) ASSERT_NEAR(colorAt(image, x, kMiddleRow).x, 0, 1e-5) << x;
}

TEST_F(IsolinesTest, OfAConstantAreNone) {
  // Of a ball of radius 1 the Gaussian curvature is 1, where a line would be, up to rounding.
  for (const char* eye : {"[0, 0, 5]", "[3, 3, 1]"}) {
    const Image image = drawn(lined(
        R"({ "type": "sphere", "radius": 1 })", R"([ { "of": "K", "step": 0.5 }, { "of": "3" } ])",
        fmt::format(R"({{ "type": "orthographic", "height": 1, "eye": {}, "look_at": [0, 0, 0] }})", eye)));
    for (int y = 0; y < kIsolinesSize.height; ++y)
      for (int x = 0; x < kIsolinesSize.width; ++x) ASSERT_EQ(colorAt(image, x, y), Vec3(1)) << x << " " << y;
  }
}

// Looking at a pole: 24 meridians meet in the middle pixel.
TEST_F(IsolinesTest, AtAPoleAreNumbers) {
  const Image image = drawn(lined(
      R"({ "type": "sphere", "radius": 1 })", R"({ "u": 24, "of": "y", "step": 0.1 })",
      R"({ "type": "orthographic", "height": 1.5, "eye": [0, 5, 0], "look_at": [0, 0, 0], "up": [0, 0, 1] })"));
  for (int y = 0; y < kIsolinesSize.height; ++y)
    for (int x = 0; x < kIsolinesSize.width; ++x)
      for (int c = 0; c < 3; ++c)
        ASSERT_TRUE(colorAt(image, x, y)[c] >= 0 && colorAt(image, x, y)[c] <= 1) << x << " " << y;
}

TEST_F(IsolinesTest, AreThereInEveryShading) {
  const Scene scene = lined(kPlane, R"({ "of": "u", "at": 0.013, "width": 1.7, "color": "#00000080" })");
  const double expected = 1.7 * 128 / 255;
  for (const Shading shading :
       {Shading::Exact, Shading::Phong, Shading::Flat, Shading::Gouraud, Shading::Toon})
    // Of triangles (u, v) are interpolated in float.
    EXPECT_NEAR(coveredIn(drawn(scene, {.shading = shading}), kMiddleRow).pixels, expected, 1e-2)
        << nameOf(shading);
  for (const Composition composition : {Composition::Fused, Composition::Deferred})
    EXPECT_NEAR(coveredIn(drawn(scene, {.composition = composition}), kMiddleRow).pixels, expected, kExactPx);
}

TEST_F(IsolinesTest, AreThoseOfTheTruth) {
  const char* const camera = R"({ "eye": [0.4, 1.5, 3], "look_at": [0, 0, 0] })";
  const std::pair<const char*, const char*> cases[] = {
      {R"({ "type": "torus" })", R"({ "u": 28, "v": 14, "width": "1.2px", "color": "#00000080" })"},
      {R"({ "type": "sphere", "radius": 1 })", R"([ { "u": 24, "v": 12 }, { "of": "K", "step": 0.5 } ])"},
      {R"({ "type": "teapot" })", R"({ "u": 64, "v": 8 })"},
      {R"({ "type": "formula", "u": [-1, 1], "v": [-1, 1], "position": ["u", "u*u - v*v", "v"] })",
       R"([ { "of": "K", "step": 0.3, "color": [1, 0, 0] }, { "of": "y", "step": 0.02, "width": 0.4 } ])"},
      {R"({ "type": "formula", "u": [-1, 1], "v": [-1, 1], "position": ["u", "0.3*sin(3u)*v", "v"] })",
       R"a([ { "of": "floor(3u) + v", "step": 0.3 }, { "of": "atan2(v, u)", "step": 0.4 }, { "of": "1/u" } ])a"}};
  for (const auto& [surface, isolines] : cases) {
    SCOPED_TRACE(surface);
    expectTrueColors(takeSnapshot(lined(surface, isolines, camera), 0, kIsolinesSize), 500);
  }
}

}  // namespace
}  // namespace luxo::test
