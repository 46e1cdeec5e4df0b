// SPDX-License-Identifier: Apache-2.0
// Lines on surfaces: as wide as is said, where mathematics has them, and as the reference has them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "formula/expression.h"
#include "image/image.h"
#include "image/texture.h"
#include "scene/scene_builder.h"
#include "scene/scene_reader.h"
#include "support/meshes.h"
#include "support/random_scene.h"
#include "support/verified_picture.h"
#include "surface/library.h"

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

/// The first material of a scene.
Material materialOf(const Scene& scene) {
  const Snapshot snapshot = takeSnapshot(scene, 0, kIsolinesSize);
  return snapshot.materials[snapshot.nodes[0].material.index];
}

Material linedWith(const std::string& isolines, Material rest = {}) {
  const Material lines = materialOf(lined(kPlane, isolines));
  rest.isolines = lines.isolines;
  rest.isolineParameters = lines.isolineParameters;
  return rest;
}

TextureMap mapOf(const Image& image, TextureFilter filter = TextureFilter::Trilinear) {
  TextureMap map{.texture = std::make_shared<const Texture>(makeTexture(image, "test"))};
  map.filter = filter;
  return map;
}

/// Of noise, with alphas: from 0 to 1.
Image noise(std::mt19937& random, int size) {
  std::vector<float> samples(static_cast<std::size_t>(4 * size * size));
  for (float& sample : samples) sample = std::uniform_real_distribution<float>(0, 1)(random);
  return {size, size, 4, std::move(samples)};
}

/// A ring and a plate of that material under a lamp, and a ball that casts its shadow on them.
Scene litScene(const Material& material) {
  Scene scene;
  scene.set(RenderSettings{.background = Vec3(0), .ambient = Vec3(0.2)});
  const MaterialId id = scene.add(material);
  scene.add(Node{.surface = torus(0.8, 0.35), .material = id});
  scene.add(Node{.translation = Vec3(0, -0.5, 0), .surface = rectangle(4, 4), .material = id});
  const NodeId ball = scene.add(Node{.translation = Vec3(0.5, 1, 0.5), .surface = sphere(0.25)});
  scene.add(Node{.translation = Vec3(1.5, 3, 1.5),
                 .light = Light{.intensity = 0.8, .shadow = Light::Shadow::Exact, .casters = {ball}}});
  scene.add(Camera{.eye = Vec3(1, 2, 3), .lookAt = Vec3(0)});
  return scene;
}

// What covers a part of a pixel is so much of the surface's own light, and for the rest that of a material of
// the lines' colour.
TEST_F(IsolinesTest, LieOverMapsFormulasAndShaders) {
  std::mt19937 random(7);
  const Vec3 lineColor(0.9, 0.1, 0.3);
  const std::string grid =
      R"({ "of": "3u + v", "step": 0.3, "width": 2.5, "color": [0.9, 0.1, 0.3], "opacity": 0.7 })";
  const Material base{.diffuse = Vec3(0.2, 0.7, 0.5), .specular = Vec3(0.3)};
  Material mapped = base, varied = base, shaded = base;
  mapped.map = mapOf(noise(random, 16));
  varied.diffusePattern =
      pattern([](auto u, auto v) { return point(0.5 + 0.4 * sin(9 * u), 0.3, 0.4 + 0.2 * v); });
  shaded.shader = shaderOf("vec4 material(Point p) { return vec4(0.5 + 0.5 * sin(7.0 * p.object), 1.0); }");
  Material ofLines = base;
  ofLines.diffuse = lineColor;
  for (const Material& material : {base, mapped, varied, shaded})
    for (const Shading shading :
         {Shading::Exact, Shading::Phong, Shading::Flat, Shading::Gouraud, Shading::Toon}) {
      if (material.shader && material.shadingIn(shading) != shading) continue;
      SCOPED_TRACE(testing::Message() << nameOf(shading) << (material.shader ? " by a shader" : ""));
      const auto picture = [&](const Material& m) { return drawn(litScene(m), {.shading = shading}); };
      const Image shown = picture(linedWith(grid, material)), without = picture(material),
                  lines = picture(ofLines);
      int covered = 0, beside = 0;
      for (int y = 0; y < kIsolinesSize.height; ++y)
        for (int x = 0; x < kIsolinesSize.width; ++x) {
          const Vec3 a = colorAt(without, x, y), b = colorAt(lines, x, y), c = colorAt(shown, x, y);
          // How much they cover is the same in all three components.
          const Vec3 way = b - a;
          const double part = glm::dot(c - a, way) / std::max(glm::dot(way, way), 1e-12);
          const bool differs = glm::length(way) > 0.05;
          covered += differs && part > 0.3;
          beside +=
              glm::length(c - a - part * way) > 2e-5 || (differs && (part < -1e-3 || part > 0.7 + 1e-3));
        }
      EXPECT_GT(covered, 500);
      EXPECT_EQ(beside, 0);
    }
}

TEST_F(IsolinesTest, OfTheLessonAreThoseOfTheTruth) {
  Material material =
      linedWith(R"({ "u": 24, "v": 12, "width": 2, "color": [0.9, 0.1, 0.3], "opacity": 0.7 })",
                {.diffuse = Vec3(0.2, 0.7, 0.5), .lesson = true});
  expectTrueColors(takeSnapshot(litScene(material), 0, kIsolinesSize), 500);
}

/// A sheet that faces the viewer at a distance, with lines of constant u or v.
struct Sheet {
  double z;
  Vec3 color, line;
  double opacity, width, at;
  bool alongU;
  Blend blend;

  /// What of the square of a pixel its line covers, at that place.
  [[nodiscard]] double covered(double x, double y) const {
    constexpr double kPerPixel = 0.1;
    const LineField field{.level = (alongU ? x : y) - at, .repeats = false};
    return lineCoverage(field, alongU ? Vec2(kPerPixel, 0) : Vec2(0, -kPerPixel), width);
  }
};

// In every pixel, against the layers put together in double: who is opaque by a number, a formula, a map or a
// shader.
TEST_F(IsolinesTest, OnWhatIsSeenThroughAreAsOpaqueAsItIs) {
  const Vec3 ground(0.3, 0.6, 0.9);
  const Sheet sheets[] = {{1, {0.8, 0.2, 0.1}, {0.1, 0.9, 0.2}, 0.75, 3.3, 0.12, true, Blend::Over},
                          {2, {0.5, 0.9, 0.4}, {0.9, 0.1, 0.8}, 0.25, 1.7, -0.4, false, Blend::Multiply},
                          {3, {0.2, 0.3, 0.1}, {0, 0, 0}, 0.5, 2.2, 0.533, true, Blend::Add},
                          {4, {0.9, 0.9, 0.7}, {0.2, 0.1, 0.5}, 0.5, 5.0, 0.77, true, Blend::Over}};
  const std::string places[] = {"a number", "a formula", "a map", "a shader"};
  for (std::size_t kind = 0; kind < std::size(places); ++kind)
    for (const Shading shading :
         {Shading::Exact, Shading::Phong, Shading::Flat, Shading::Gouraud, Shading::Toon}) {
      SCOPED_TRACE(fmt::format("{} {}", places[kind], nameOf(shading)));
      const bool drawing = shading == Shading::Toon && kind != 3;  // half as bright without lights
      Scene scene;
      scene.set(plainSettings(ground));
      for (const Sheet& sheet : sheets) {
        Material material = linedWith(
            fmt::format(R"({{ "of": "{}", "at": {}, "width": {}, "color": [{}, {}, {}] }})",
                        sheet.alongU ? "u" : "v", sheet.at, sheet.width, sheet.line.x, sheet.line.y,
                        sheet.line.z),
            {.diffuse = sheet.color, .specular = Vec3(0), .opacity = sheet.opacity, .blend = sheet.blend});
        const float alpha = static_cast<float>(sheet.opacity);
        if (kind > 0) material.opacity = 1;
        if (kind == 1) {
          Graph graph;
          material.diffusePattern = Pattern(graph,
                                            std::array<Expr, 4>{sheet.color.x, sheet.color.y, sheet.color.z,
                                                                sheet.opacity + 1e-12 * graph.variable(0)},
                                            0);
        }
        if (kind == 2) {
          material.map = mapOf(Image(1, 1, 4, {1, 1, 1, alpha}));
          material.mapOpacity = true;
        }
        if (kind == 3)
          material.shader =
              shaderOf(fmt::format("#pragma luxo opacity\n"
                                   "vec4 material(Point p) {{ return vec4({}, {}, {}, {}); }}",
                                   sheet.color.x, sheet.color.y, sheet.color.z, sheet.opacity));
        const double z = sheet.z;
        scene.add(
            Node{.surface = surface([z](auto u, auto v) { return point(u, v, z); }, {{-60, 60}, {-50, 50}}),
                 .material = scene.add(material)});
      }
      const Camera camera{
          .eye = Vec3(0, 0, 9), .lookAt = Vec3(0), .projection = Projection::Orthographic, .height = 7.3};
      const Image shown = draw(scene, camera, kIsolinesSize, {.shading = shading}).image;
      double worst = 0;
      for (int y = 0; y < kIsolinesSize.height; ++y)
        for (int x = 0; x < kIsolinesSize.width; ++x) {
          Vec3 color = ground;
          for (const Sheet& sheet : sheets) {
            const double part = sheet.covered(0.1 * (x - kIsolinesSize.width / 2), 0.1 * (kMiddleRow - y));
            const Vec3 own = glm::mix(sheet.color, sheet.line, part);
            const Vec3 through = sheet.blend == Blend::Add        ? Vec3(1)
                                 : sheet.blend == Blend::Multiply ? (1 - sheet.opacity) * own
                                                                  : Vec3(1 - sheet.opacity);
            color = sheet.opacity * (drawing ? 0.5 : 1.0) * own + through * color;
          }
          for (int c = 0; c < 3; ++c) worst = std::max(worst, std::abs(color[c] - colorAt(shown, x, y)[c]));
        }
      // Of triangles (u, v) are interpolated in float.
      EXPECT_LE(worst, shading == Shading::Exact ? kExactPx : 1e-2);
    }
}

// Of holes there are none, and what is not cut out has them.
TEST_F(IsolinesTest, AreCutOutWithTheirSurface) {
  Material material = linedWith(R"({ "u": 6, "v": 6, "width": 3, "color": [1, 0, 0] })",
                                {.diffuse = Vec3(0, 0, 1), .specular = Vec3(0)});
  // Left of the middle it is a hole.
  material.map = mapOf(Image(2, 1, 4, {1, 1, 1, 0.2f, 1, 1, 1, 0.9f}), TextureFilter::Nearest);
  material.mapOpacity = true;
  material.cutoff = 0.5;
  Material uncut = material;
  uncut.mapOpacity = false;
  uncut.cutoff = 0;
  const auto picture = [&](const Material& m) {
    Scene scene;
    scene.set(plainSettings(Vec3(0, 1, 0)));
    scene.add(plate(Vec3(0), {6, 6}, scene.add(m)));
    return draw(scene, Camera{.eye = Vec3(0.1, 0.3, 9), .lookAt = Vec3(0)}, kIsolinesSize).image;
  };
  const Image shown = picture(material), whole = picture(uncut);
  int red = 0;
  for (int y = 0; y < kIsolinesSize.height; ++y)
    for (int x = 0; x < kIsolinesSize.width; ++x) {
      if (std::abs(x - 48) <= 1) continue;
      const Vec3 color = colorAt(shown, x, y);
      EXPECT_TRUE(near(color, x < 48 ? Vec3(0, 1, 0) : colorAt(whole, x, y), tolerance(1e-6, 6e-4)))
          << x << " " << y;
      red += color.x > 0.9;
    }
  EXPECT_GT(red, 30);
}

/// Things of all kinds, with lines or without, under some lights.
class LinedScene : RandomScene {
 public:
  explicit LinedScene(std::uint32_t seed) : RandomScene(seed) {}

  Scene scene() {
    Scene scene = emptyScene();
    scene.add(
        Node{.translation = Vec3(0, -1.3, 0), .surface = rectangle(8, 8), .material = scene.add(material())});
    for (int i = 0; i < 4; ++i)
      scene.add(Node{.translation = 0.8 * direction(),
                     .rotation = Rotation{glm::normalize(direction() + Vec3(0, 1e-3, 0)), 6 * any()},
                     .scale = Vec3(0.5 + 0.5 * any(), 0.5 + 0.5 * any(), 0.7),
                     .surface = surface(),
                     .material = scene.add(material())});
    for (int i = 0; i < 2; ++i)
      scene.add(Node{
          .translation = above(),
          .light = Light{.intensity = 0.5, .shadow = i == 0 ? Light::Shadow::Exact : Light::Shadow::None}});
    scene.add(camera());
    return scene;
  }

 private:
  Surface surface() {
    switch (int(6 * any())) {
      case 0:
        return icosphere(1);
      case 1:
        return meshOf(torus(0.8, 0.3), 2e-2);
      case 2:
        return torus(0.8, 0.3);
      case 3:
        return rectangle(2, 2);
      case 4:
        return sphere(0.9);
      default:
        return luxo::surface([](auto u, auto v) { return point(u, 0.4 * sin(3 * u) * v, v); },
                             {{-1, 1}, {-1, 1}});
    }
  }

  Material material() {
    Material material{.diffuse = Vec3(0.9, 0.6 + 0.4 * any(), 0.9), .specular = Vec3(any() < 0.5 ? 0 : 0.2)};
    if (any() < 0.4) {
      material.map = mapOf(noise(random_, 8));
      material.mapOpacity = any() < 0.5;
      if (material.mapOpacity && any() < 0.4) material.cutoff = 0.2 + 0.5 * any();
    } else if (any() < 0.4) {
      Graph graph;
      const Expr u = graph.variable(0), v = graph.variable(1);
      material.diffusePattern =
          Pattern(graph, std::array{0.5 + 0.4 * sin(5 * u), Expr(0.7), 0.5 + 0.4 * cos(4 * v)}, 0);
    }
    if (material.cutoff == 0 && any() < 0.5) {
      material.opacity = 0.3 + 0.5 * any();
      if (any() < 0.4) material.blend = any() < 0.5 ? Blend::Multiply : Blend::Add;
    }
    if (any() < 0.25) return material;
    const char* const kinds[] = {
        R"({{ "of": "u", "step": {}, "width": {}, "color": [0.1, 0.2, {}] }})",
        R"a({{ "of": "v + 0.3*sin(4u)", "step": {}, "width": {}, "color": [0.9, 0, {}] }})a",
        R"([ {{ "of": "u*v", "step": {}, "width": {}, "opacity": {} }}, {{ "of": "v" }} ])"};
    return linedWith(
        fmt::format(fmt::runtime(kinds[int(3 * any())]), 0.05 + 0.2 * any(), 0.5 + 3 * any(), any()),
        material);
  }
};

TEST_F(IsolinesTest, OfRandomScenesAreTheTruthInEveryPixel) {
  std::uint64_t layers = 0;
  for (std::uint32_t seed = 0; seed < 4; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const Verified found = verified(takeSnapshot(LinedScene(seed).scene(), 0, kIsolinesSize));
    const Verification& v = found.verification;
    EXPECT_EQ(v.wrong.total(), v.wrong.light)
        << v.wrong.hitMiss << " hit or miss, " << v.wrong.layer << " layer, " << v.wrong.point << " point";
    EXPECT_LE(double(v.wrong.light), tolerance(0, 1e-3) * double(v.coverage.both));
    EXPECT_EQ(v.nanPixels, 0U);
    EXPECT_EQ(found.statistics.error.unconvergedPx, 0U);
    EXPECT_EQ(found.statistics.error.auditFailedPx, 0U);
    EXPECT_EQ(found.statistics.error.uncertifiedPx, 0U);
    layers += found.statistics.count.layerPoints;
  }
  EXPECT_GT(layers, 10'000U);
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
