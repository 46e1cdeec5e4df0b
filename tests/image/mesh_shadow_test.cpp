// SPDX-License-Identifier: Apache-2.0
// Shadows on meshes: of every pixel the light ray starts at the surface's own point S(u, v), not at the mesh,
// however coarse that is.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "reference/caster.h"
#include "reference/reference.h"
#include "reference/verification.h"
#include "scene/scene_builder.h"
#include "scene/scene_reader.h"
#include "support/meshes.h"
#include "support/picture.h"

namespace luxo::test {
namespace {

constexpr PixelSize kMeshShadowSize{160, 120};
constexpr double kCoarsePx = 4;

const std::string kTorus = R"({ "type": "torus", "major": 1, "minor": 0.4 })";
const std::string kTeapot = R"({ "type": "teapot" })";
/// Not known as an equation, bent in all ways.
const std::string kWaves = R"_({ "type": "formula", "u": [0, "tau"], "v": [0, "tau"],
  "let": { "r": "0.4*(1 + 0.3*cos(5u - 2v))", "ring": "1 + r*cos(v)" },
  "position": ["ring*cos(u)", "r*sin(v)", "-ring*sin(u)"] })_";

class MeshShadowTest : public PictureTest {
 protected:
  /// A body on a floor, which it touches, and a sun: with shadows, without, or dark.
  enum class Sun { Shadows, Shines, Dark };
  [[nodiscard]] static Scene sceneOf(const std::string& body, Sun sun = Sun::Shadows,
                                     const std::string& more = "") {
    const std::string intensity = sun == Sun::Dark ? "0" : "0.9",
                      shadow = sun == Sun::Shadows ? R"(, "shadow": "exact")" : "";
    return buildScene(parseScene(R"_({ "luxo": 1,
      "render": { "ambient": [0.1, 0.1, 0.1], "background": [0, 0, 0] },
      "materials": { "body": { "diffuse": [0.7, 0.6, 0.5], "specular": 0.3 },
                     "exact": { "diffuse": [0.5, 0.6, 0.7], "specular": 0, "shading": "exact" },
                     "pane": { "diffuse": [0.2, 0.6, 0.3], "specular": 0, "opacity": 0.5, "shading": "exact" },
                     "floor": { "diffuse": [0.6, 0.6, 0.6], "specular": 0 } },
      "surfaces": { "floor": { "type": "rectangle", "size": [20, 20] }, "body": )_" +
                                     body + R"_(, "ball": { "type": "sphere", "radius": 0.5 } },
      "camera": { "eye": [3.5, 4, 5], "look_at": [0, 0.4, 0], "fov_y": "42deg" },
      "nodes": [ { "surface": "floor", "material": "floor" },
                 { "surface": "body", "material": "body", "translate": [0, )_" +
                                     (body == kTeapot ? "0" : "0.4") + R"_(, 0] },
                 { "translate": [4, 2.4, 0.5], "light": { "intensity": )_" +
                                     intensity + shadow + " } }" + more + "] }",
                                 "mesh_shadow"));
  }

  /// A ball on a dome of 300 m in low sun, and where its shadow ends there.
  [[nodiscard]] static Scene sceneOfADome(Sun sun) {
    const std::string intensity = sun == Sun::Dark ? "0" : "0.9",
                      shadow = sun == Sun::Shadows ? R"(, "shadow": "exact", "casters": ["ball"])" : "";
    return buildScene(parseScene(R"_({ "luxo": 1,
      "render": { "ambient": [0.1, 0.1, 0.1], "background": [0, 0, 0] },
      "surfaces": {
        "dome": { "type": "formula", "u": [-5, 5], "v": [-5, 5],
                  "position": ["u", "sqrt(90000 - u^2 - v^2) - 300", "-v"] },
        "ball": { "type": "sphere", "radius": 0.1 } },
      "camera": { "type": "orthographic", "eye": [4.75, 2, 0], "look_at": [4.75, 0, 0], "up": [0, 0, -1],
                  "height": 0.05 },
      "nodes": [ { "surface": "dome" }, { "name": "ball", "surface": "ball", "translate": [0, 0.1, 0] },
                 { "rotate": { "axis": [-0.05, -1, 0], "angle": "90deg" },
                   "light": { "type": "directional", "intensity": )_" +
                                     intensity + shadow + " } } ] }",
                                 "dome"));
  }

  [[nodiscard]] Image colors(const Scene& scene, Shading shading) {
    return draw(scene, kMeshShadowSize, {.shading = shading, .tolerancePx = kCoarsePx}).image;
  }

  /// How many pixels of a picture are in another light, by `luxo verify`.
  struct JudgedLights {
    std::uint64_t shown, withoutShadows, inShadow;
  };
  [[nodiscard]] JudgedLights judge(const std::string& body, const std::string& more, Shading shading) {
    constexpr PixelSize kSmall{80, 60};
    const auto show = [&](Output output, Sun sun = Sun::Shadows) {
      return renderer()
          .render(takeSnapshot(sceneOf(body, sun, more), 0, kSmall),
                  {.shading = shading, .output = output, .tolerancePx = kCoarsePx})
          .image;
    };
    MeasuredPicture measured{.color = show(Output::Color),
                             .depth = {},
                             .position = show(Output::Position),
                             .normal = show(Output::Normal),
                             .uv = show(Output::Uv),
                             .id = show(Output::Id),
                             .dark = show(Output::Color, Sun::Dark),
                             .alone = {show(Output::Color, Sun::Shines)}};
    const Snapshot snapshot = takeSnapshot(sceneOf(body, Sun::Shadows, more), 0, kSmall);
    const ReferencePicture truth = castPicture(snapshot, {.shading = shading});
    const auto wrong = [&] {
      return verify(snapshot, truth, measured,
                    {.shading = shading, .boundPx = kCoarsePx, .worst = 0, .flip = false})
          .wrong.light;
    };
    JudgedLights judged{.shown = wrong()};
    measured.color = measured.alone[0];
    judged.withoutShadows = wrong();
    measured.color = measured.dark;
    judged.inShadow = wrong();
    return judged;
  }

  /// Whether the light is seen from a point of a node, and from those a little beside it in the same way.
  [[nodiscard]] static std::optional<bool> sees(const reference::Caster& caster, std::uint32_t node,
                                                const Vec2& parameters, const Vec2& pixel) {
    const reference::Ray ray = caster.rayThrough(pixel.x, pixel.y);
    std::optional<bool> all;
    for (const double du : {0.0, -2e-6, 2e-6})
      for (const double dv : {0.0, -2e-6, 2e-6}) {
        const auto hit = caster.pointAt(node, parameters + Vec2(du, dv), ray);
        bool certified = true;
        if (!hit) return std::nullopt;
        const bool seen = caster.reaching(0, *hit, certified) != Vec3(0);
        if (!certified || (all && *all != seen)) return std::nullopt;
        all = seen;
      }
    return all;
  }

  struct Counts {
    int lit = 0, onFloor = 0, onBody = 0, unsure = 0;
  };
  /// All pixels of floor and body are as without shadows, or as in the dark, as their own points see the
  /// light.
  template <class SceneIn>
  Counts expectTheirOwn(const SceneIn& sceneIn, Shading shading) {
    const Scene scene = sceneIn(Sun::Shadows);
    const Picture picture = draw(scene, kMeshShadowSize, {.shading = shading, .tolerancePx = kCoarsePx});
    const Image bright = colors(sceneIn(Sun::Shines), shading), dark = colors(sceneIn(Sun::Dark), shading);
    DrawOptions geometry{.shading = shading, .output = Output::Id, .tolerancePx = kCoarsePx};
    const Image id = draw(scene, kMeshShadowSize, geometry).image;
    geometry.output = Output::Uv;
    const Image uv = draw(scene, kMeshShadowSize, geometry).image;
    const Snapshot snapshot = takeSnapshot(scene, 0, kMeshShadowSize);
    const reference::Caster caster(snapshot);
    Counts counts;
    for (int y = 0; y < kMeshShadowSize.height; ++y)
      for (int x = 0; x < kMeshShadowSize.width; ++x) {
        const float number = id.pixel(x, y)[0];
        if (number == 0) continue;
        const auto node = static_cast<std::uint32_t>(number) - 1;
        const Vec3 all = colorAt(bright, x, y), none = colorAt(dark, x, y);
        if (near(all, none, 1e-3)) continue;
        const auto seen = sees(caster, node, Vec2(uv.pixel(x, y)[0], uv.pixel(x, y)[1]), centerOf(x, y));
        counts.unsure += !seen;
        if (!seen) continue;
        EXPECT_TRUE(near(colorAt(picture.image, x, y), *seen ? all : none, 1e-4))
            << x << ", " << y << " of node " << node << (*seen ? " lit" : " in shadow") << " in "
            << nameOf(shading);
        ++(*seen ? counts.lit : node == 0 ? counts.onFloor : counts.onBody);
      }
    EXPECT_EQ(picture.statistics.error.unconvergedPx, 0U);
    EXPECT_EQ(picture.statistics.error.uncertifiedPx, 0U);
    return counts;
  }
};

TEST_F(MeshShadowTest, StartAtTheSurfacesOwnPoints) {
  for (const std::string& body : {kTorus, kWaves})
    for (const Shading shading : {Shading::Flat, Shading::Phong}) {
      const Counts counts = expectTheirOwn([&](Sun sun) { return sceneOf(body, sun); }, shading);
      EXPECT_GT(counts.lit, 5'000);
      EXPECT_GT(counts.onFloor, 300);
      EXPECT_GT(counts.onBody, 30);
      EXPECT_LT(counts.unsure, 20);
    }
}

TEST_F(MeshShadowTest, OfATeapotOnATableTouchIt) {
  const Counts counts = expectTheirOwn([](Sun sun) { return sceneOf(kTeapot, sun); }, Shading::Phong);
  EXPECT_GT(counts.onFloor, 300);
  EXPECT_GT(counts.onBody, 30);
  EXPECT_LT(counts.unsure, 20);
}

/// Floats leave the dome's points some hundredths of a millimetre off it; a pixel is 0.4 mm, and light falls
/// in 29 times as long as it is high.
TEST_F(MeshShadowTest, AreRightWhereFloatsLoseThePoints) {
  for (const Shading shading : {Shading::Flat, Shading::Phong}) {
    const Counts counts = expectTheirOwn([](Sun sun) { return sceneOfADome(sun); }, shading);
    EXPECT_GT(counts.lit, 3'000);
    EXPECT_GT(counts.onFloor, 3'000);
    EXPECT_LT(counts.unsure, 20);
  }
}

/// A picture of a scene of this body, and of those things, judged; then as if nothing had a shadow, and as if
/// all were in shadow.
TEST_F(MeshShadowTest, VerifyHoldsThemAgainstThePointsShown) {
  // Of what is behind glass, and the glass, colours are judged; of all else lights, as without it.
  const std::string none,
      pane = R"(, { "surface": "ball", "material": "pane", "translate": [-1.6, 0.6, 1.2] })";
  for (const auto& [body, more] : {std::pair(kWaves, none), {kTorus, pane}})
    for (const Shading shading : {Shading::Phong, Shading::Flat, Shading::Gouraud, Shading::Toon}) {
      SCOPED_TRACE(std::string(nameOf(shading)) + more);
      const JudgedLights judged = judge(body, more, shading);
      EXPECT_EQ(judged.shown, 0U);
      // A drawing has light where it falls in steeply alone.
      EXPECT_GT(judged.withoutShadows, shading == Shading::Toon ? 10U : 60U);
      EXPECT_GT(judged.inShadow, 1000U);
    }
}

/// The eye sees the mesh before the ball, and the ball's own points beside it.
TEST_F(MeshShadowTest, StandBesideExactSurfaces) {
  const std::string ball = R"(, { "surface": "ball", "material": "exact", "translate": [-1.2, 0.5, -0.6] })";
  const Scene scene = sceneOf(kTorus, Sun::Shadows, ball);
  const Picture picture =
      draw(scene, kMeshShadowSize, {.shading = Shading::Phong, .audit = {AuditExtent::All}});
  EXPECT_EQ(picture.statistics.error.unconvergedPx, 0U);
  EXPECT_EQ(picture.statistics.error.auditFailedPx, 0U);
}

/// Nine lights are more than one draw interpolates: of triangles that are as near in a pixel, as all are of a
/// model that has them twice, one gets the light of each.
TEST_F(MeshShadowTest, TrianglesThatAreThereTwiceAreLitOnce) {
  const auto withCube = [](std::uint32_t times) {
    Scene scene;
    scene.add(Node{.rotation = Rotation{{0.3, 1, 0}, 0.6},
                   .surface = repeatedCube(times, true),
                   .material = scene.add(Material{.diffuse = Vec3(0.8, 0.4, 0.2)})});
    for (int i = 0; i < 9; ++i)
      scene.add(Node{.translation = Vec3(i - 4, 5, 4),
                     .light = Light{.intensity = 0.1,
                                    .shadow = i % 4 == 0 ? Light::Shadow::Exact : Light::Shadow::None}});
    scene.add(Camera{.eye = Vec3(0, 1, 6)});
    return scene;
  };
  for (const Shading shading : {Shading::Gouraud, Shading::Toon, Shading::Phong})
    EXPECT_TRUE(sameBytes(draw(withCube(1), kMeshShadowSize, {.shading = shading}).image,
                          draw(withCube(2), kMeshShadowSize, {.shading = shading}).image))
        << nameOf(shading);
}

}  // namespace
}  // namespace luxo::test
