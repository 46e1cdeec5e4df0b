// SPDX-License-Identifier: Apache-2.0
// Spots in pictures: against the formula, written again here in double, against point lights, which they are
// but for their cones, and against the ground truth.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/srgb_curve.h"
#include "scene/light_view.h"
#include "scene/scene_builder.h"
#include "scene/scene_reader.h"
#include "support/verified_picture.h"

namespace luxo::test {
namespace {

constexpr PixelSize kSpotSize{160, 120};
constexpr double kInner = 20, kOuter = 40;  // degrees
const Vec3 kLampPlace(0.5, 4, -0.3);

/// Of a spot at `lamp` that shines down.
double coneAt(const Vec3& point, const Vec3& lamp = kLampPlace, double inner = kInner,
              double outer = kOuter) {
  const double cosine = (lamp.y - point.y) / glm::distance(lamp, point);
  const double part = std::clamp(
      (cosine - std::cos(radians(outer))) / (std::cos(radians(inner)) - std::cos(radians(outer))), 0.0, 1.0);
  return part * part;
}

std::string spotKey(double inner = kInner, double outer = kOuter) {
  return fmt::format(R"(, "spot": {{ "inner": "{}deg", "outer": "{}deg" }})", inner, outer);
}

/// Of a node at kLampPlace whose -Z is downward.
std::string lampWith(const std::string& light) {
  return fmt::format(R"(, {{ "translate": [{}, {}, {}], "rotate": {{ "axis": [1, 0, 0], "angle": "-90deg" }},
                           "light": {{ "intensity": 5, "attenuation": "inverse-square"{} }} }})",
                     kLampPlace.x, kLampPlace.y, kLampPlace.z, light);
}

class SpotPicture : public VerifiedPictureTest {
 protected:
  /// A floor at y = 0, which is node 1, of the material "m", and more nodes.
  [[nodiscard]] static Scene sceneOf(
      const std::string& nodes, const std::string& look = R"("diffuse": [0.6, 0.5, 0.4], "specular": 0.3)",
      double ambient = 0) {
    return buildScene(parseScene(fmt::format(R"_({{ "luxo": 1,
      "render": {{ "ambient": {}, "background": 0 }},
      "materials": {{ "m": {{ "shininess": 20, {} }},
                      "clay": {{ "diffuse": [0.5, 0.6, 0.7], "specular": 0.2 }},
                      "glass": {{ "diffuse": [0.2, 0.3, 0.4], "specular": 0, "opacity": 0.4 }} }},
      "surfaces": {{ "floor": {{ "type": "rectangle", "size": [16, 16], "segments": [4, 4] }},
                     "ball": {{ "type": "sphere", "radius": 0.6 }}, "ring": {{ "type": "torus", "major": 0.8, "minor": 0.25 }},
                     "klein": {{ "type": "klein" }}, "pane": {{ "type": "rectangle", "size": [2, 2] }} }},
      "camera": {{ "eye": [1, 7, 6], "look_at": [0.4, 0, 0], "fov_y": "50deg" }},
      "nodes": [ {{ "name": "floor", "surface": "floor", "material": "m" }}{} ] }})_",
                                             ambient, look, nodes),
                                 "spot"));
  }

  /// Calls with the point and the colour of every pixel that shows the floor; how many these are.
  int forFloor(const Scene& scene, const DrawOptions& options, const auto& check) {
    const Image image = draw(scene, kSpotSize, options).image;
    const Image id = draw(scene, kSpotSize, {.output = Output::Id}).image;
    const CameraModel camera(scene.cameras()[0], kSpotSize);
    int seen = 0;
    for (int y = 0; y < kSpotSize.height; ++y)
      for (int x = 0; x < kSpotSize.width; ++x) {
        if (id.pixel(x, y)[0] != 1) continue;
        const Ray ray = camera.through(centerOf(x, y));
        check(ray.at(*hitPlane(ray, Vec3(0), Vec3(0, 1, 0))), x, y, colorAt(image, x, y));
        ++seen;
      }
    return seen;
  }

  /// Holds a spot's picture against that of a point light: wherever the floor is seen the colour is as much
  /// less as the cone says, but for so many pixels.
  void expectConeOf(const std::string& nodes, const std::string& light, const std::string& spot,
                    const DrawOptions& options = {}, int others = 0) {
    const Image point = draw(sceneOf(nodes + lampWith(light)), kSpotSize, options).image;
    int lit = 0, half = 0, dark = 0, off = 0;
    forFloor(sceneOf(nodes + lampWith(spot + spotKey())), options,
             [&](const Vec3& at, int x, int y, const Vec3& color) {
               const double cone = coneAt(at);
               lit += cone == 1;
               half += cone > 0.1 && cone < 0.9;
               dark += cone == 0;
               // Of light up to 0.3: what single precision leaves of cosines, divided by their difference,
               // 0.17.
               off += !near(color, cone * colorAt(point, x, y), 1e-6);
             });
    EXPECT_GT(lit, 400);
    EXPECT_GT(half, 500);
    EXPECT_GT(dark, 500);
    EXPECT_LE(off, others);
  }
};

TEST_F(SpotPicture, EveryPixelIsTheFormula) {
  const Scene scene =
      sceneOf(lampWith(spotKey()), R"("diffuse": [0.6, 0.5, 0.4], "ambient": 1, "specular": 0.3)", 0.1);
  const Material material{
      .diffuse = {0.6, 0.5, 0.4}, .ambient = Vec3(1), .specular = Vec3(0.3), .shininess = 20};
  const CameraModel camera(scene.cameras()[0], kSpotSize);
  for (const Composition composition : {Composition::Fused, Composition::Deferred})
    for (const Shading shading : {Shading::Exact, Shading::Phong, Shading::Flat}) {
      double worst = 0;
      const int seen = forFloor(scene, {.shading = shading, .composition = composition},
                                [&](const Vec3& at, int, int, const Vec3& color) {
                                  const Shine shine{Vec4(kLampPlace, 1), Vec3(5 * coneAt(at)), true};
                                  const Vec3 expected = blinnPhong(material, Vec3(0.1), {&shine, 1}, at,
                                                                   {0, 1, 0}, camera.towardViewer(at));
                                  const Vec3 off = glm::abs(color - expected);
                                  worst = std::max({worst, off.x, off.y, off.z});
                                });
      EXPECT_GT(seen, 10000) << nameOf(shading);
      EXPECT_LE(worst, tolerance(5e-6, 4e-5)) << nameOf(shading);
    }
}

TEST_F(SpotPicture, OfManyTheFirstIsAsGoodAsTheLast) {
  // More than vertices carry, and spots among others: white ones of every width at one place.
  std::string nodes = R"(, { "translate": [0, 5, 0], "light": { "intensity": 0.1 } })";
  for (int k = 1; k <= 8; ++k)
    nodes += lampWith(spotKey(5 * k - 1, 5 * k) + fmt::format(R"(, "color": {})", 0.1 * k));
  double worst = 0;
  forFloor(
      sceneOf(nodes, R"("diffuse": 1, "specular": 0)"), {}, [&](const Vec3& at, int, int, const Vec3& color) {
        const auto from = [&](const Vec3& place) { return place - at; };
        const double bulb = 0.1 * unit(from({0, 5, 0})).y, d = glm::length(from(kLampPlace));
        double sum = 0;
        for (int k = 1; k <= 8; ++k) sum += 0.1 * k * coneAt(at, kLampPlace, 5 * k - 1, 5 * k);
        worst = std::max(worst, std::abs(color.x - (bulb + 5 * sum * unit(from(kLampPlace)).y / (d * d))));
      });
  // Cosines of 4 and 5 degrees differ by 0.0014, of which the formula keeps all digits.
  EXPECT_LE(worst, tolerance(1e-5, 4e-5));
}

TEST_F(SpotPicture, VerticesOfGouraudShadingAreTheFormula) {
  // A vertex at each multiple of 4 metres, and one right below the middle of the picture.
  for (const char* shadow : {"", R"(, "shadow": "exact", "casters": ["high"])"}) {
    const std::string high =
        R"(, { "name": "high", "surface": "ball", "material": "clay", "translate": [0, 9, 0] })";
    const std::string place =
        R"(, { "translate": [0, 8, 0], "rotate": { "axis": [1, 0, 0], "angle": "-90deg" },
                                     "light": { "intensity": 1)" +
        spotKey(10, 50) + shadow + " } }";
    Scene scene = sceneOf(high + place, R"("diffuse": 1, "specular": 0)");
    const Camera camera{.eye = Vec3(0, 7, 0),
                        .lookAt = Vec3(0),
                        .up = Vec3(0, 0, -1),
                        .projection = Projection::Orthographic,
                        .height = 129.0 / 8};
    const PixelSize size{129, 129};
    const Image image = draw(scene, camera, size, {.shading = Shading::Gouraud}).image;
    const CameraModel model(camera, size);
    for (int j = -1; j <= 1; ++j)
      for (int i = -1; i <= 1; ++i) {
        const Vec3 vertex(4 * i, 0, 4 * j);
        const double cosine = 8 / glm::length(Vec3(0, 8, 0) - vertex);
        const Vec2 pixel = model.pixelOf(vertex);
        ASSERT_EQ(pixel, centerOf(64 + 32 * i, 64 + 32 * j));
        EXPECT_TRUE(near(colorAt(image, 64 + 32 * i, 64 + 32 * j),
                         Vec3(cosine * coneAt(vertex, {0, 8, 0}, 10, 50)), 1e-5))
            << shadow << i << ", " << j;
      }
  }
}

TEST_F(SpotPicture, DrawingsHaveTheirEdgeWhereThatPartOfTheCosineIs) {
  for (const char* shadow : {"", R"(, "shadow": "exact")"}) {
    int bright = 0, dim = 0;
    forFloor(sceneOf(lampWith(spotKey() + std::string(shadow))), {.shading = Shading::Toon},
             [&](const Vec3& at, int x, int y, const Vec3& color) {
               const double cosine = unit(kLampPlace - at).y * coneAt(at);
               if (std::abs(cosine - 0.5) < 0.1) return;  // within two pixels of the edge
               (cosine > 0.5 ? bright : dim) += 1;
               EXPECT_NEAR(color.x, cosine > 0.5 ? 0.6 : 0.3, 1e-5) << shadow << x << ", " << y;
             });
    EXPECT_GT(bright, 500);
    EXPECT_GT(dim, 500);
  }
}

TEST_F(SpotPicture, EveryKindOfShadowIsThePointLightsWithinTheCone) {
  const std::string
      ball = R"(, { "name": "ball", "surface": "ball", "material": "clay", "translate": [0.9, 1.2, 0] })",
      pane = R"(, { "surface": "pane", "material": "glass", "translate": [-0.6, 1, 0.3] })";
  const std::string exact = R"(, "shadow": "exact")",
                    planar = R"(, "shadow": "planar", "shadow_plane": "floor")",
                    map = R"(, "shadow": "map", "map": { "size": 512, "bias": 0.02 })",
                    soft = R"(, "shadow": "exact", "radius": 1e-6, "shadow_samples": 2)";
  expectConeOf(ball, "", "", {.composition = Composition::Fused});
  for (const std::string& casters : {ball, ball + pane}) {
    for (const std::string& shadow : {exact, planar, soft}) {
      SCOPED_TRACE(shadow + casters);
      expectConeOf(casters, shadow, shadow);
    }
    // Texels are a third of a pixel, at the border of a shadow of some 80 pixels.
    SCOPED_TRACE("map" + casters);
    expectConeOf(casters, exact, map, {}, 80);
  }
}

TEST_F(SpotPicture, EveryShadingOfShadowsToo) {
  const std::string ball =
      R"(, { "name": "ball", "surface": "ball", "material": "clay", "translate": [0.9, 1.2, 0] })";
  for (const Shading shading : {Shading::Flat, Shading::Phong})
    expectConeOf(ball, R"(, "shadow": "exact")", R"(, "shadow": "exact")", {.shading = shading});
}

/// Of a lamp amid what casts its shadow, which takes six faces without a cone.
TEST_F(SpotPicture, ADepthMapIsOnePictureOfTheCone) {
  const Box room{Vec3(-5), Vec3(5)};
  SnapshotLight light{.positionWorld = Vec4(1, 2, 0, 1), .cone = SpotCone{{0, -1, 0}, 0.1, radians(50)}};
  const std::vector<View> views = lightViews(light, room, room, 512);
  ASSERT_EQ(views.size(), 1U);
  EXPECT_TRUE(near(views[0].forward(), {0, -1, 0}, 1e-12));
  EXPECT_TRUE(near(views[0].eye, {1, 2, 0}, 1e-12));
  EXPECT_NEAR(views[0].halfExtent.x, std::tan(radians(50)) * (1 + 2 / 512.0), 1e-12);
  light.cone->outer = radians(64);
  EXPECT_EQ(lightViews(light, room, room, 512).size(), 6U);
  // What is narrower than the cone, and all before the light, is shown as of any light.
  light.positionWorld = Vec4(0, 50, 0, 1);
  light.cone->outer = radians(60);
  const std::vector<View> far = lightViews(light, room, room, 512);
  ASSERT_EQ(far.size(), 1U);
  EXPECT_LT(far[0].halfExtent.x, 0.2);
}

TEST_F(SpotPicture, TheLessonsPixelHasItsLight) {
  const Vec3 toEye = unit(Vec3(1, 7, 6) - Vec3(0.4, 0, 0));  // along the camera's axis
  for (const char* shadow : {"", R"(, "shadow": "exact", "casters": ["high"])"}) {
    const Scene scene =
        sceneOf(R"(, { "name": "high", "surface": "ball", "material": "clay", "translate": [0, 9, 0] })" +
                    lampWith(spotKey() + std::string(shadow)),
                R"("diffuse": 1, "shading": "lesson")");
    double worst = 0;
    forFloor(scene, {}, [&](const Vec3& at, int, int, const Vec3& color) {
      const Vec3 way = kLampPlace - at, l = unit(way), r = 2 * l.y * Vec3(0, 1, 0) - l;
      const double arriving = 5 * coneAt(at) / glm::dot(way, way);
      const double code =
          20.0 / 255 + arriving * (1.2 * l.y + 0.6 * std::pow(std::max(glm::dot(r, toEye), 0.0), 20));
      worst = std::max(worst, std::abs(color.x - linearFromSrgb(std::min(code, 1.0))));
    });
    EXPECT_LE(worst, tolerance(1e-5, 4e-5)) << shadow;
  }
}

TEST_F(SpotPicture, TheWidestIsThePointLightOnItsFrontHalf) {
  const std::string bodies = R"(, { "surface": "ring", "material": "clay", "translate": [1.5, 4.4, -0.6] },
                                  { "surface": "klein", "material": "clay", "translate": [-1, 2, 0] })";
  const auto shown = [&](const std::string& spot) {
    return draw(sceneOf(bodies + lampWith(R"(, "shadow": "exact")" + spot), R"("diffuse": 0.5)", 0.1),
                kSpotSize);
  };
  const Scene scene = sceneOf(bodies + lampWith(""));
  const Image point = shown("").image, spot = shown(spotKey(89.9, 90)).image,
              place = draw(scene, kSpotSize, {.output = Output::Position}).image,
              dark = draw(sceneOf(bodies, R"("diffuse": 0.5)", 0.1), kSpotSize).image;
  int front = 0, behind = 0;
  for (int y = 0; y < kSpotSize.height; ++y)
    for (int x = 0; x < kSpotSize.width; ++x) {
      const Vec3 toLamp = kLampPlace - colorAt(place, x, y);
      const double elevation = std::asin(toLamp.y / glm::length(toLamp)) * 180 / kPi;
      if (elevation > 0 && elevation < 0.11) continue;
      (elevation > 0 ? front : behind) += 1;
      EXPECT_TRUE(near(colorAt(spot, x, y), colorAt(elevation > 0 ? point : dark, x, y), 1e-6))
          << x << ", " << y;
    }
  EXPECT_GT(front, 10000);
  EXPECT_GT(behind, 100);
}

TEST_F(SpotPicture, FromFarAwayItIsAsSharp) {
  // Circles of 1 and 2 metres around the origin, from a million metres above.
  constexpr double kFar = 1e6;
  const std::string light =
      fmt::format(R"_(, {{ "translate": [0, {0}, 0], "rotate": {{ "axis": [1, 0, 0], "angle": "-90deg" }},
             "light": {{ "spot": {{ "inner": "atan(1/{0})", "outer": "atan(2/{0})" }} }} }})_",
                  kFar);
  double worst = 0;
  forFloor(sceneOf(light, R"("diffuse": 1, "specular": 0)"), {},
           [&](const Vec3& at, int, int, const Vec3& color) {
             const double part = std::clamp((4 - at.x * at.x - at.z * at.z) / 3, 0.0, 1.0);
             worst = std::max(worst, std::abs(color.x - part * part));
           });
  EXPECT_LE(worst, 1e-5);
}

/// Of what stands before, behind and through each other in the light of three spots, one without a shadow.
TEST_F(SpotPicture, IsTheTruth) {
  const Scene scene = sceneOf(R"(, { "surface": "ball", "material": "clay", "translate": [0.9, 1.2, 0] },
    { "surface": "ring", "material": "clay", "translate": [-0.8, 0.8, 0.5], "rotate": { "axis": [1, 0, 1], "angle": 0.6 } },
    { "surface": "klein", "material": "clay", "translate": [2.4, 1, -1.5], "scale": [0.6, 0.6, 0.6] },
    { "surface": "pane", "material": "glass", "translate": [-0.4, 2, -0.5] },
    { "translate": [-3, 3, 2], "rotate": [ { "axis": [0, 1, 0], "angle": "-60deg" }, { "axis": [1, 0, 0], "angle": "-40deg" } ],
      "light": { "color": [0.2, 0.5, 1], "spot": { "inner": "10deg", "outer": "25deg" }, "shadow": "exact" } },
    { "translate": [3, 1, 3], "rotate": { "axis": [0, 1, 0], "angle": "40deg" },
      "light": { "color": [1, 0.3, 0.2], "spot": { "outer": "30deg" } } })" +
                                  lampWith(spotKey() + R"(, "shadow": "exact")"),
                              R"("diffuse": [0.6, 0.5, 0.4])", 0.05);
  const Verified found = expectTheTruth(takeSnapshot(scene, 0, {240, 180}), 30000);
  EXPECT_EQ(found.verification.wrong.total(), 0U);
}

TEST_F(SpotPicture, LightsThatReachNothingAreLeftOut) {
  // 40 lamps in a row, each over a ball: more than may light one.
  std::string nodes;
  for (int k = 0; k < 40; ++k)
    nodes += fmt::format(
        R"(, {{ "translate": [{0}, 1, 0], "surface": "ball", "material": "clay", "scale": [0.2, 0.2, 0.2] }},
      {{ "translate": [{0}, 2, 0], "rotate": {{ "axis": [1, 0, 0], "angle": "-90deg" }},
         "light": {{ "intensity": 0.5, "color": [{1}, 0.5, 0.3], "spot": {{ "inner": 0.1, "outer": 0.2 }} }} }})",
        0.4 * (k - 20), 0.02 * k);
  const auto scene = [&](int lamps) {
    std::string some = nodes;
    if (lamps < 40)
      some.resize(some.find(fmt::format(R"(, {{ "translate": [{}, 1, 0])", 0.4 * (lamps - 20))));
    Scene all = buildScene(parseScene(R"({ "luxo": 1, "materials": { "clay": {} },
      "surfaces": { "ball": { "type": "sphere" } },
      "camera": { "eye": [0, 4, 9], "fov_y": "60deg" }, "nodes": [ {} )" +
                                          some + " ] }",
                                      "row"));
    return all;
  };
  const DrawOptions options{.composition = Composition::Fused},
      keeps{.composition = Composition::Fused, .skips = {.lights = false}};
  const Picture all = draw(scene(40), kSpotSize, options);
  EXPECT_GE(all.statistics.count.culledLights, 40U * 36);
  EXPECT_EQ(all.statistics.count.deferred, 0U);
  const Picture kept = draw(scene(40), kSpotSize, keeps);
  EXPECT_EQ(kept.statistics.count.deferred, 1U) << "for all of them no set has room";
  // What a found texel rounds, 2e-6 of light, a penumbra of a tenth of a radian has tenfold.
  EXPECT_LE(largestDifference(all.image, kept.image), 2e-5);
  EXPECT_TRUE(sameBytes(draw(scene(30), kSpotSize, options).image, draw(scene(30), kSpotSize, keeps).image));
}

/// As green where a condition holds that a material's shader finds of light 0, as red where not.
std::shared_ptr<const MaterialShader> asking(const std::string& file, const std::string& text) {
  return std::make_shared<const MaterialShader>(MaterialShader{{{file, text}}});
}

TEST_F(SpotPicture, ShadersAreGivenItsLight) {
  const auto shown = [&](const std::shared_ptr<const MaterialShader>& shader, const std::string& spot) {
    Scene scene;
    Scene lit = sceneOf(lampWith(spot));
    Material material = lit[MaterialId{1}].at(0);
    material.shader = shader;
    const MaterialId own = lit.add(material);
    Node floor = lit[NodeId{0}];
    floor.material = own;
    lit.set(NodeId{0}, floor);
    return lit;
  };
  const auto radiance = asking("a.frag", "vec4 material(Point p) { return vec4(light(0).radiance, 1.0); }");
  forFloor(shown(radiance, spotKey()), {}, [&](const Vec3& at, int, int, const Vec3& color) {
    const Vec3 way = kLampPlace - at;
    EXPECT_TRUE(near(color, Vec3(5 * coneAt(at) / glm::dot(way, way)), 1e-5));
  });
  const auto course =
      asking("b.frag", "void main() { gl_FragColor = vec4(gl_LightSource[0].diffuse.rgb, 1.0); }");
  forFloor(shown(course, spotKey()), {}, [&](const Vec3& at, int, int, const Vec3& color) {
    EXPECT_TRUE(near(color, Vec3(5 * coneAt(at)), 1e-5));
  });
  // The cone as the language has it: in eye space, whose axes the view's matrix has; of no spot all ways.
  const auto cone = [](const char* condition) {
    return asking("c.frag", fmt::format("void main() {{ vec3 down = gl_NormalMatrix * vec3(0, -1, 0);\n"
                                        "gl_FragColor = {} ? vec4(0, 1, 0, 1) : vec4(1, 0, 0, 1); }}",
                                        condition));
  };
  const auto expectGreen = [&](const char* condition, const std::string& spot) {
    const int seen = forFloor(
        shown(cone(condition), spot), {},
        [&](const Vec3&, int, int, const Vec3& color) { ASSERT_EQ(color, Vec3(0, 1, 0)) << condition; });
    EXPECT_GT(seen, 10000);
  };
  expectGreen(
      "length(gl_LightSource[0].spotDirection - down) < 1e-5 && gl_LightSource[0].spotExponent == 0.0 && "
      "abs(gl_LightSource[0].spotCutoff - 40.0) < 1e-4 && "
      "abs(gl_LightSource[0].spotCosCutoff - cos(radians(40.0))) < 1e-6 && gl_LightSource[1].spotCutoff == "
      "180.0",
      spotKey());
  expectGreen("gl_LightSource[0].spotCutoff == 180.0 && gl_LightSource[0].spotCosCutoff == -1.0", "");
}

}  // namespace
}  // namespace luxo::test
