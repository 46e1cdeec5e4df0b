// SPDX-License-Identifier: Apache-2.0
// Colours by the place, the normal and the curvature of a surface: against closed forms in every pixel, and
// against the reference.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "base/error.h"
#include "scene/scene_builder.h"
#include "scene/scene_reader.h"
#include "support/verified_picture.h"

namespace luxo::test {
namespace {

constexpr PixelSize kSurfaceNamesSize{96, 72};

/// One surface whose colour that is, under ambient light 1.
Scene colored(const std::string& surface, const std::string& color, const std::string& node = "") {
  return buildScene(parseScene(R"({ "luxo": 1, "render": { "size": [96, 72], "ambient": 1, "background": 0 },
      "params": { "wide": { "value": 0.5, "range": [0.1, 1] } },
      "materials": { "m": { "specular": 0, "diffuse": )" +
                                   color + R"( } },
      "surfaces": { "s": )" + surface +
                                   R"( },
      "nodes": [ { "surface": "s", "material": "m")" +
                                   node + R"( } ],
      "camera": { "eye": [0.4, 1.5, 3], "look_at": [0, 0, 0] } })",
                               "scene"));
}

using SurfaceNamesTest = VerifiedPictureTest;

// Also where the poles are, and whatever a node does to it.
TEST_F(SurfaceNamesTest, ABallHasOneCurvature) {
  const Image image = draw(colored(R"({ "type": "sphere", "radius": 0.8 })", R"(["0.32K", "0.4H", "0.4k2"])",
                                   R"(, "rotate": { "axis": [1, 0, 0.3], "angle": "50deg" })"),
                           kSurfaceNamesSize)
                          .image;
  int seen = 0;
  for (int y = 0; y < kSurfaceNamesSize.height; ++y)
    for (int x = 0; x < kSurfaceNamesSize.width; ++x) {
      if (colorAt(image, x, y) == Vec3(0)) continue;
      ++seen;
      // Single precision, in second derivatives: a tenth of a code of 8 bits.
      ASSERT_TRUE(near(colorAt(image, x, y), Vec3(0.5, 0.5, 0.5), 4e-4)) << x << " " << y;
    }
  EXPECT_GT(seen, 1000);
}

TEST_F(SurfaceNamesTest, TheTruthIsOfTheSameColors) {
  for (
      const char* surface :
      {R"({ "type": "torus", "major": 1, "minor": "wide" })", R"({ "type": "klein" })",
       R"({ "type": "teapot", "height": 1 })",
       R"({ "type": "formula", "u": [-1, 1], "v": [-1, 1], "position": ["u", "0.2*abs(mod(5u, 2) - 1) + wide*v*v", "v"] })",
       R"({ "type": "formula", "u": [-1, 1], "v": [-1, 1], "position": ["u", "wide*sin(3u)*v", "v"] })"}) {
    const Scene scene =
        colored(surface, R"c(["0.5 + 0.4*tanh(K)", "0.5 + 0.25*nx + 0.2*y", "0.5 + 0.3*tanh(k1 - k2)"])c");
    SCOPED_TRACE(surface);
    expectTrueColors(takeSnapshot(scene, 0, kSurfaceNamesSize), 500);
  }
}

TEST(SurfaceNames, AParameterOfThatNameIsItself) {
  const Scene scene = buildScene(parseScene(R"({ "luxo": 1, "params": { "K": 0.25 },
      "materials": { "m": { "diffuse": ["K", "K", "K"] } }, "surfaces": { "s": { "type": "teapot" } },
      "nodes": [ { "surface": "s", "material": "m" } ] })",
                                            "scene"));
  EXPECT_EQ(takeSnapshot(scene, 0, kSurfaceNamesSize).materials.back().diffuse, Vec3(0.25));
}

// Of more control points than a shader has room for.
TEST(SurfaceNames, OfTooLargeFormulasAreRefusedWithTheirPlace) {
  std::string points = "[";
  for (int patch = 0; patch < 1500; ++patch) {
    points += patch > 0 ? ", [" : "[";
    for (int i = 0; i < 16; ++i)
      points +=
          fmt::format("{}[{}, {}, {}]", i > 0 ? ", " : "", 3 * patch + i % 4, patch * i % 7, i / 4 + patch);
    points += "]";
  }
  try {
    static_cast<void>(
        colored(R"({ "type": "bezier", "control_points": )" + points + "] }", R"(["K", 0, 0])"));
    FAIL() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::Scene);
    EXPECT_NE(std::string(error.what()).find("20000 are the most"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace luxo::test
