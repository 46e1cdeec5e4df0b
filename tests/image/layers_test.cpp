// SPDX-License-Identifier: Apache-2.0
// What is seen through: against formulas, against the reference's rays, and against itself in another order.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "draw/layer_lists.h"
#include "reference/caster.h"
#include "scene/scene_builder.h"
#include "scene/scene_reader.h"
#include "support/meshes.h"
#include "support/verified_picture.h"
#include "surface/surface.h"

namespace luxo::test {
namespace {

class LayersTest : public VerifiedPictureTest {
 protected:
  [[nodiscard]] static Scene sceneOf(const std::string& nodes, const std::string& render = "") {
    return buildScene(parseScene(R"_({ "luxo": 1,
      "render": { )_" + render + R"_( "ambient": [0.1, 0.1, 0.1], "background": [0.05, 0.1, 0.2] },
      "textures": { "squares": { "checker": [[1, 0, 0], [0, 0, 1]] }, "tiles": { "checker": [[0, 1, 0], [1, 1, 0]] } },
      "materials": { "lamp": { "diffuse": [0.2, 0.2, 0.2], "opacity": 0.5, "glow_map": "squares" },
                     "lantern": { "diffuse": [0.2, 0.2, 0.2], "opacity": 0.5, "glow_map": "tiles" },
                     "glass": { "diffuse": [0.2, 0.5, 0.8], "opacity": 0.35, "specular": 0.8, "shininess": 80 },
                     "red": { "diffuse": [0.9, 0.2, 0.1], "opacity": 0.5 },
                     "stained": { "diffuse": [0.9, 0.6, 0.2], "opacity": 0.2, "blend": "multiply" },
                     "glow": { "diffuse": [0.1, 0.5, 0.2], "opacity": 0.6, "blend": "add" },
                     "nothing": { "opacity": 0 }, "no glow": { "opacity": 0, "blend": "add" },
                     "nothing by formula": { "opacity": "0*u" },
                     "faint": { "opacity": 0.0009 }, "less faint": { "opacity": 0.001 },
                     "faint by formula": { "opacity": "if(u < 9, 0.0009, v)" },
                     "tiles": { "diffuse": [0.8, 0.7, 0.3], "opacity": "if(mod(2u, 1) < 0.5, 0, if(mod(2v, 1) < 0.5, 0, 0.7))" },
                     "coarse glass": { "diffuse": [0.2, 0.5, 0.8], "opacity": 0.5, "shading": "phong" },
                     "waves": { "diffuse": [0.8, "u", 0.2], "opacity": "0.5+0.5*sin(8*u)" },
                     "checks": { "diffuse": ["0.3+0.4*mod(floor(2u)+floor(2v),2)", 0.5, 0.4] } },
      "surfaces": { "floor": { "type": "rectangle", "size": [12, 12] }, "sheet": { "type": "rectangle", "size": [2, 2] },
                    "torus": { "type": "torus", "major": 1.3, "minor": 0.45 }, "ball": { "type": "sphere", "radius": 1 },
                    "klein": { "type": "klein" }, "teapot": { "type": "teapot" }, "mobius": { "type": "mobius" } },
      "camera": { "eye": [4, 3, 6], "look_at": [0, 0, 0], "fov_y": "40deg" },
      "nodes": [ { "translate": [4, 8, 6], "light": {} },
                 { "surface": "floor", "material": "checks", "translate": [0, -1.6, 0] }, )_" +
                                     nodes + "] }",
                                 "layers"));
  }

  [[nodiscard]] static std::string node(const std::string& surface, const std::string& material,
                                        const std::string& more = "") {
    return R"({ "surface": ")" + surface + R"(", "material": ")" + material + R"(")" + more + " }";
  }
};

constexpr PixelSize kLayersSize{240, 180};

std::string twelveSheets(LayersTest*) {
  const char* materials[] = {"glass", "red", "stained", "glow"};
  std::string nodes;
  for (int i = 0; i < 12; ++i)
    nodes += std::string(i == 0 ? "" : ", ") + R"({ "surface": "sheet", "material": ")" + materials[i % 4] +
             R"(", "rotate": { "axis": [1, 0, 0], "angle": ")" + std::to_string(15 * i) + R"(deg" } })";
  return nodes;
}

std::string stackedSheets(LayersTest*) {
  const char* materials[] = {"glass", "red", "stained", "glow"};
  std::string nodes;
  for (int i = 0; i < 12; ++i)
    nodes += std::string(i == 0 ? "" : ", ") + R"({ "surface": "sheet", "material": ")" + materials[i % 4] +
             R"(", "translate": [0, )" + std::to_string(0.12 * i - 0.7) + ", 0] }";
  return nodes;
}

TEST_F(LayersTest, AreTheTruth) {
  const std::vector<std::string> scenes{
      node("klein", "glass"), node("teapot", "glass", R"(, "translate": [0, -1.6, 0])"),
      node("torus", "glass") + ", " +
          node("torus", "red",
               R"(, "rotate": { "axis": [1, 0, 0], "angle": 1.2 }, "translate": [0.4, 0, 0])"),
      twelveSheets(this), stackedSheets(this),
      // Modes, an opacity that is a formula, something opaque within, a surface with one side.
      node("ball", "stained", R"(, "translate": [-1.5, 0, 0])") + ", " + node("ball", "glow") + ", " +
          node("ball", "waves", R"(, "translate": [1.5, 0, 0])") + ", " +
          node("ball", "checks", R"(, "scale": [0.5, 0.5, 0.5])") + ", " + node("mobius", "red")};
  for (const std::string& nodes : scenes) {
    SCOPED_TRACE(nodes);
    const Snapshot snapshot = takeSnapshot(sceneOf(nodes), 0, kLayersSize);
    const Verified found = verified(snapshot);
    EXPECT_EQ(found.verification.wrong.total(), 0U);
    EXPECT_EQ(found.statistics.error.auditFailedPx, 0U);
    EXPECT_EQ(found.statistics.error.unconvergedPx, 0U);
    EXPECT_GT(found.statistics.count.layerPoints, 2000U);
    // Measured: 7e-5 of the pixels are left to rays.
    EXPECT_LE(found.statistics.error.resolvedByRaysPx, 60U);
  }
}

/// What has opacity 0 everywhere is in no picture, of whatever.
TEST_F(LayersTest, NothingIsShownOfWhatIsInvisible) {
  const std::string other = node("ball", "red", R"(, "translate": [2, 0, 0])");
  for (const char* material : {"nothing", "no glow", "nothing by formula"}) {
    SCOPED_TRACE(material);
    const Scene with = sceneOf(other + ", " + node("ball", material, R"(, "translate": [0, 0.5, 0])"));
    const Snapshot seen = takeSnapshot(with, 0, kLayersSize),
                   alone = takeSnapshot(sceneOf(other), 0, kLayersSize);
    EXPECT_EQ(verified(seen).verification.wrong.total(), 0U);
    for (const Shading shading : {Shading::Exact, Shading::Phong, Shading::Wireframe, Shading::Id})
      for (const Output output : {Output::Color, Output::Id, Output::Depth, Output::Certificate}) {
        const Picture picture = renderer().render(seen, {.shading = shading, .output = output});
        EXPECT_TRUE(
            sameBytes(picture.image, renderer().render(alone, {.shading = shading, .output = output}).image))
            << nameOf(shading) << ", output " << static_cast<int>(output);
        EXPECT_EQ(picture.statistics.error.auditFailedPx, 0U);
      }
  }
}

/// Numbers of the geometry are those of the nearest point that something is seen of.
TEST_F(LayersTest, GeometryIsThatBehindHoles) {
  const Snapshot snapshot = takeSnapshot(
      sceneOf(node("torus", "tiles") + ", " + node("sheet", "tiles", R"(, "translate": [0, 0.6, 0.5])") +
              ", " + node("ball", "tiles", R"(, "scale": [0.8, 0.8, 0.8], "translate": [0.5, 0, 0])") + ", " +
              node("klein", "glass", R"(, "scale": [0.2, 0.2, 0.2], "translate": [-1.5, 0.5, 0])")),
      0, kLayersSize);
  const Verified found = verified(snapshot);  // of all outputs
  EXPECT_EQ(found.verification.wrong.total(), 0U);
  EXPECT_EQ(found.statistics.error.unconvergedPx, 0U);
  const ReferencePicture truth = castPicture(snapshot);
  for (const Shading shading :
       {Shading::Exact, Shading::Phong, Shading::Flat, Shading::Gouraud, Shading::Toon}) {
    const Image ids =
        renderer().render(snapshot, {.shading = shading, .output = Output::Id, .tolerancePx = 0.05}).image;
    int different = 0;
    std::array<int, 7> shown{};
    for (int y = 0; y < kLayersSize.height; ++y)
      for (int x = 0; x < kLayersSize.width; ++x) {
        const auto id = static_cast<std::uint32_t>(ids.pixel(x, y)[0]);
        ++shown.at(id);
        different += id != truth.number[static_cast<std::size_t>(y * kLayersSize.width + x)];
      }
    // Outlines and edges of tiles, some 3,000 px long, move by up to 0.05 px, and u and v between vertices.
    EXPECT_LE(different, shading == Shading::Exact ? 1 : 150) << nameOf(shading);
    for (const std::size_t node : {2U, 3U, 4U, 5U, 6U})
      EXPECT_GT(shown[node], 30) << nameOf(shading) << " " << node;
  }
}

/// Whether an opacity is a number or a formula: below kLeastShown what is behind is the geometry, and the
/// light of both is the same.
TEST_F(LayersTest, ANumberIsAsOpaqueAsItsFormula) {
  const auto snapshotOf = [&](const std::string& material) {
    return takeSnapshot(sceneOf(R"({ "translate": [2, 9, 1], "light": { "shadow": "exact" } }, )" +
                                node("torus", material) + ", " + node("ball", "glass")),
                        0, kLayersSize);
  };
  const Snapshot number = snapshotOf("faint"), formula = snapshotOf("faint by formula");
  for (const Shading shading : {Shading::Exact, Shading::Phong, Shading::Gouraud, Shading::Toon})
    for (const Output output : {Output::Color, Output::Id, Output::Depth, Output::Certificate}) {
      const DrawOptions options{.shading = shading, .output = output};
      EXPECT_TRUE(
          sameBytes(renderer().render(number, options).image, renderer().render(formula, options).image))
          << nameOf(shading) << ", output " << static_cast<int>(output);
    }
  EXPECT_EQ(verified(number).verification.wrong.total(), 0U);
  const ReferencePicture truth = castPicture(number), same = castPicture(formula);
  EXPECT_TRUE(sameBytes(truth.color, same.color));
  EXPECT_EQ(truth.number, same.number);
  constexpr std::uint32_t kTorus = 4;
  EXPECT_EQ(std::ranges::count(truth.number, kTorus), 0);
  EXPECT_GT(std::ranges::count(castPicture(snapshotOf("less faint")).number, kTorus), 1000);
}

/// That of the worst point which is seen, and of what is behind where they are all certain.
TEST_F(LayersTest, CertificatesAreOfTheWorstLayer) {
  const auto seenIn = [&](const std::string& nodes) {
    const Image image = draw(sceneOf(nodes), kLayersSize, {.output = Output::Certificate}).image;
    std::array<int, 4> pixels{};
    for (int y = 0; y < image.height(); ++y)
      for (int x = 0; x < image.width(); ++x) ++pixels.at(static_cast<std::size_t>(image.pixel(x, y)[0]));
    return pixels;
  };
  const std::string ball = node("ball", "glass"), within = R"(, "scale": [0.9, 0.9, 0.9])";
  const auto exact = seenIn(ball), mesh = seenIn(node("ball", "coarse glass")),
             both = seenIn(ball + ", " + node("ball", "coarse glass", within)),
             holes = seenIn(node("ball", "tiles") + ", " + node("ball", "coarse glass", within));
  EXPECT_EQ(exact[3], 0);
  EXPECT_GT(exact[0], 0) << "the background";
  EXPECT_GT(exact[1], 10000);
  EXPECT_GT(mesh[3], 3000);
  // Nine tenths wide, within.
  EXPECT_NEAR(both[3], 0.81 * mesh[3], 0.01 * mesh[3]);
  EXPECT_EQ(holes[3], both[3]);
}

/// Llvmpipe ends loops, and tells nobody, after 65,535 rounds: some 3,000 points of a pixel are sorted in as
/// many. What is not blended then is counted.
TEST_F(LayersTest, WhatADevicesLoopsDoNotReachIsCounted) {
  constexpr double kOpacity = 0.001;
  for (const std::uint32_t count : {1000U, 6000U}) {
    MeshArrays arrays;
    for (std::uint32_t i = 0; i < count; ++i) {
      for (const Vec2& at : {Vec2(-1, -1), Vec2(1, -1), Vec2(1, 1), Vec2(-1, 1)})
        arrays.positions.emplace_back(at.x, at.y, -1e-4 * i);
      for (const std::uint32_t corner : {0U, 1U, 2U, 0U, 2U, 3U}) arrays.indices.push_back(4 * i + corner);
    }
    Scene scene;
    scene.set(RenderSettings{.background = Vec3(0), .ambient = Vec3(1)});
    scene.add(
        Node{.surface = triangleMesh(std::move(arrays), "stack"),
             .material = scene.add(Material{
                 .diffuse = Vec3(1), .specular = Vec3(0), .opacity = kOpacity, .twoSided = TwoSided::Yes})});
    const Snapshot snapshot =
        takeSnapshot(scene, 0, {8, 6}, Camera{.eye = Vec3(0, 0, 3), .lookAt = Vec3(0), .fovY = 0.3});
    const Picture picture = renderer().render(snapshot, {.shading = Shading::Phong});
    const FrameError& error = picture.statistics.error;
    const double expected = 1 - std::pow(1 - kOpacity, count);
    const bool isRight = near(colorAt(picture.image, 4, 3), Vec3(expected), 1e-4);
    EXPECT_TRUE(count == 1000 ? isRight : isRight || error.layersMissing > 0) << count;
    EXPECT_TRUE(!isRight || error.layersMissing == 0) << count;
    EXPECT_EQ(error.unconvergedPx, error.layersMissing) << count;
  }
}

/// A pixel in the middle of a sheet, over the background: known in closed form.
TEST_F(LayersTest, ModesAreWhatTheySay) {
  const auto through = [&](const std::string& material) {
    const Scene scene = buildScene(parseScene(R"_({ "luxo": 1,
      "render": { "ambient": [1, 1, 1], "background": [0.5, 0.25, 0.125] },
      "materials": { "m": { "diffuse": [0.25, 0.5, 1], "ambient": [0.5, 0.5, 0.5], "specular": 0, )_" +
                                                  material + R"_( } },
      "surfaces": { "sheet": { "type": "rectangle", "size": [2, 2] } },
      "camera": { "eye": [0, 5, 0.5] }, "nodes": [ { "surface": "sheet", "material": "m" } ] })_",
                                              "modes"));
    for (const Shading shading : {Shading::Exact, Shading::Phong, Shading::Flat, Shading::Gouraud}) {
      const Vec3 color = colorAt(draw(scene, {32, 32}, {.shading = shading}).image, 16, 16);
      const Vec3 truth = colorAt(castPicture(takeSnapshot(scene, 0, {32, 32})).color, 16, 16);
      EXPECT_TRUE(near(color, truth, 1e-6)) << nameOf(shading);
    }
    return colorAt(draw(scene, {32, 32}).image, 16, 16);
  };
  EXPECT_TRUE(near(through(R"("opacity": 0.25)"), {0.5, 0.3125, 0.21875}, 1e-6));
  EXPECT_TRUE(near(through(R"("opacity": 0.25, "blend": "add")"), {0.625, 0.375, 0.25}, 1e-6));
  // Stained: three quarters of what is behind, times the diffuse colour.
  EXPECT_TRUE(near(through(R"("opacity": 0.25, "blend": "multiply")"), {0.21875, 0.21875, 0.21875}, 1e-6));
  EXPECT_TRUE(near(through(R"("opacity": 0, "blend": "multiply")"), {0.125, 0.125, 0.125}, 1e-6));
  EXPECT_TRUE(near(through(R"("opacity": 1, "blend": "add")"), {1, 0.75, 0.625}, 1e-6));
  EXPECT_TRUE(near(through(R"("opacity": 1, "blend": "multiply")"), {0.5, 0.5, 0.5}, 1e-6));
  EXPECT_TRUE(near(through(R"("opacity": "u*0+0.25")"), {0.5, 0.3125, 0.21875}, 1e-6));
  EXPECT_TRUE(near(through(R"_("opacity": "if(u < 2, 0.25, v)")_"), {0.5, 0.3125, 0.21875}, 1e-6));
  EXPECT_TRUE(near(through(R"("opacity": "-u*u")"), {0.5, 0.25, 0.125}, 1e-6)) << "cut off at 0";
  EXPECT_TRUE(near(through(R"_("opacity": "sqrt(-1-u*u)")_"), {0.5, 0.25, 0.125}, 1e-6))
      << "without a value nothing is seen of it";
}

/// Nothing comes through 1 - opacity = 0 of it, white or not: it is drawn, and casts its shadow, as what is
/// opaque.
TEST_F(LayersTest, MultiplyOfOpacityOneIsOpaque) {
  const auto pictureOf = [&](const std::string& blend) {
    return draw(
        buildScene(parseScene(
            R"_({ "luxo": 1, "materials": { "m": { "diffuse": [1, 1, 1], "opacity": 1, )_" + blend + R"_( } },
      "surfaces": { "ball": { "type": "sphere" }, "floor": { "type": "rectangle", "size": [6, 6] } },
      "camera": { "eye": [1, 5, 5] },
      "nodes": [ { "surface": "ball", "material": "m", "translate": [0, 1.5, 0] }, { "surface": "floor" },
                 { "translate": [-1, 5, 1], "light": { "shadow": "exact" } } ] })_",
            "multiply")),
        {64, 48});
  };
  const Picture opaque = pictureOf(R"("blend": "over")"), multiplied = pictureOf(R"("blend": "multiply")"),
                added = pictureOf(R"("blend": "add")");
  EXPECT_TRUE(sameBytes(multiplied.image, opaque.image));
  EXPECT_EQ(multiplied.statistics.count.layerPoints, 0U);
  EXPECT_EQ(multiplied.statistics.count.passes, opaque.statistics.count.passes);
  EXPECT_GT(added.statistics.count.layerPoints, 0U) << "what is behind comes through all of it";
}

TEST_F(LayersTest, OrderOfNodesChangesNoByte) {
  std::vector<std::string> nodes{
      node("torus", "glass"), node("torus", "red", R"(, "rotate": { "axis": [1, 0, 0], "angle": 1.2 })"),
      node("ball", "stained", R"(, "translate": [1, 0, 0])"),
      // Twice the same sheet: of two points in one place neither is in front.
      node("sheet", "red"), node("sheet", "glass"), node("ball", "lamp", R"(, "translate": [-2, 0, 0])"),
      node("ball", "lantern", R"(, "translate": [-2, 0, 0])")};
  const auto shown = [&] {
    std::string all;
    for (const std::string& one : nodes) all += (all.empty() ? "" : ", ") + one;
    return draw(sceneOf(all), kLayersSize).image;
  };
  std::ranges::sort(nodes);
  const Image expected = shown();
  for (int i = 0; i < 5; ++i) {
    std::ranges::rotate(nodes, nodes.begin() + 1);
    EXPECT_TRUE(sameBytes(shown(), expected)) << i;
  }
  std::ranges::reverse(nodes);
  EXPECT_TRUE(sameBytes(shown(), expected));
}

TEST_F(LayersTest, NorDoesItThroughAnyCamera) {
  // Surfaces that are the same but for what they are made of, and one within another.
  std::vector<std::string> nodes{node("torus", "glass"),
                                 node("torus", "stained"),
                                 node("ball", "glow"),
                                 node("ball", "red"),
                                 node("sheet", "waves"),
                                 node("sheet", "glass"),
                                 node("klein", "red", R"(, "scale": [0.3, 0.3, 0.3])")};
  std::vector<Camera> cameras;
  for (const Vec3& eye : {Vec3(0, 5, 0), Vec3(0.2, 0.1, 0), Vec3(-3, 0, 0.1), Vec3(300, 200, 100)})
    cameras.push_back({.eye = eye,
                       .lookAt = Vec3(0.01, 0, -0.02),
                       .fovY = glm::length(eye) > 9 ? 0.01 : 0.9,
                       .near = 0.01});
  cameras.push_back({.eye = Vec3(3, 0, 4), .projection = Projection::Orthographic, .height = 4.0});
  std::vector<std::string> sorted = nodes;
  std::ranges::sort(sorted);
  const auto sceneOfAll = [](const std::vector<std::string>& of) {
    std::string all;
    for (const std::string& one : of) all += (all.empty() ? "" : ", ") + one;
    return sceneOf(all);
  };
  for (const Camera& camera : cameras) {
    const Picture expected = draw(sceneOfAll(sorted), camera, {80, 60});
    EXPECT_GT(expected.statistics.count.layerPoints, 500U);
    std::ranges::rotate(nodes, nodes.begin() + 2);
    EXPECT_TRUE(sameBytes(draw(sceneOfAll(nodes), camera, {80, 60}).image, expected.image));
    std::ranges::reverse(nodes);
    EXPECT_TRUE(sameBytes(draw(sceneOfAll(nodes), camera, {80, 60}).image, expected.image));
  }
}

/// The lecture's demonstration: each over all before it, wherever it is.
TEST_F(LayersTest, GivenOrderIsWhatIsGiven) {
  const std::string near = node("sheet", "red", R"(, "translate": [0, 0.2, 0])"),
                    far = node("sheet", "glass");
  const auto middle = [&](const std::string& nodes, const std::string& order) {
    const Scene scene = sceneOf(nodes, R"("blend_order": ")" + order + R"(",)");
    const Vec3 shown = colorAt(draw(scene, kLayersSize).image, 120, 86);
    EXPECT_TRUE(
        test::near(shown, colorAt(castPicture(takeSnapshot(scene, 0, kLayersSize)).color, 120, 86), 1e-4));
    return shown;
  };
  const Vec3 right = middle(far + ", " + near, "exact");
  EXPECT_EQ(right, middle(near + ", " + far, "exact"));
  EXPECT_TRUE(test::near(right, middle(far + ", " + near, "given"), 1e-4));
  EXPECT_GT(glm::distance(right, middle(near + ", " + far, "given")), 0.05);
}

constexpr const char* kShadowingLight =
    R"(, { "translate": [1, 5, 1], "light": { "intensity": 0.7, "shadow": "exact", "casters": ["caster"] } })";

TEST_F(LayersTest, GivenOrderHasShadowsModesAndFormulas) {
  std::vector<std::string> nodes{
      node("torus", "glass"),
      node("ball", "stained", R"(, "translate": [0.8, 0, 0])"),
      node("mobius", "waves"),
      node("klein", "red", R"(, "scale": [0.3, 0.3, 0.3])"),
      node("sheet", "glow"),
      node("ball", "checks",
           R"(, "scale": [0.4, 0.4, 0.4], "translate": [0.3, 1.6, 0.3], "name": "caster")")};
  for (int turn = 0; turn < 2; ++turn) {
    std::string all;
    for (const std::string& one : nodes) all += (all.empty() ? "" : ", ") + one;
    const Verified found =
        verified(takeSnapshot(sceneOf(all + kShadowingLight, R"("blend_order": "given",)"), 0, {160, 120}));
    EXPECT_EQ(found.verification.wrong.total(), 0U);
    EXPECT_EQ(found.statistics.error.unconvergedPx, 0U);
    EXPECT_GT(found.statistics.count.shadowPasses, 0U);
    EXPECT_GT(found.statistics.count.layerPoints, 5000U);
    std::ranges::reverse(nodes);
  }
}

/// Sheets one above the other, from the lowest on, are in the order of their depth.
TEST_F(LayersTest, GivenOrderIsTheSameInEveryShading) {
  const std::string low = node("sheet", "glass"),
                    high = node("sheet", "red", R"(, "translate": [0, 0.4, 0])"),
                    caster =
                        ", " +
                        node(
                            "ball", "checks",
                            R"(, "scale": [0.4, 0.4, 0.4], "translate": [0.3, 1.6, 0.3], "name": "caster")") +
                        kShadowingLight;
  for (const Shading shading :
       {Shading::Exact, Shading::Phong, Shading::Flat, Shading::Gouraud, Shading::Toon}) {
    const auto shown = [&](const std::string& nodes, const std::string& order) {
      return draw(sceneOf(nodes, R"("blend_order": ")" + order + R"(",)"), {80, 60}, {.shading = shading})
          .image;
    };
    const Image exact = shown(low + ", " + high + caster, "exact");
    EXPECT_TRUE(sameBytes(shown(low + ", " + high + caster, "given"), exact)) << nameOf(shading);
    EXPECT_FALSE(sameBytes(shown(high + ", " + low + caster, "given"), exact)) << nameOf(shading);
  }
}

TEST_F(LayersTest, ManySamplesAreTheirMean) {
  const Scene scene = sceneOf(node("torus", "glass") + ", " + node("mobius", "waves"));
  const Image four = draw(scene, kLayersSize, {.samples = 4}).image;
  std::vector<Vec3> mean(static_cast<std::size_t>(kLayersSize.width * kLayersSize.height), Vec3(0));
  for (const Vec2& offset : samplePattern(4)) {
    Snapshot snapshot = takeSnapshot(scene, 0, kLayersSize);
    snapshot.view = sampledAt(snapshot.view, offset);
    const Image one = renderer().render(snapshot, {}).image;
    for (std::size_t i = 0; i < mean.size(); ++i)
      mean[i] += 0.25 * colorAt(one, static_cast<int>(i) % kLayersSize.width,
                                static_cast<int>(i) / kLayersSize.width);
  }
  for (std::size_t i = 0; i < mean.size(); ++i)
    ASSERT_TRUE(
        near(colorAt(four, static_cast<int>(i) % kLayersSize.width, static_cast<int>(i) / kLayersSize.width),
             mean[i], 1e-6));
}

/// Meshes show the same layers as searches, but where they are off by the tolerance.
TEST_F(LayersTest, MeshesShowTheSameLayers) {
  const Scene scene = sceneOf(node("torus", "glass") + ", " +
                              node("torus", "red", R"(, "rotate": { "axis": [1, 0, 0], "angle": 1.2 })"));
  const Image exact = draw(scene, kLayersSize).image;
  const Image mesh = draw(scene, kLayersSize, {.shading = Shading::Phong, .tolerancePx = 0.05}).image;
  const int different = differingPixels(exact, mesh, 0.03);
  // Outlines, about 1,000 px long, move by up to 0.05 px.
  EXPECT_LT(different, 120);
}

Scene withCube(const TriangleMesh& mesh, const std::vector<Light>& lights) {
  Scene scene;
  scene.set(RenderSettings{.background = Vec3(0.1, 0.2, 0.4), .ambient = Vec3(0.5)});
  const MaterialId glass = scene.add(Material{.diffuse = Vec3(0.8, 0.4, 0.2), .opacity = 0.5});
  scene.add(Node{.rotation = Rotation{{0.3, 1, 0}, 0.6}, .surface = mesh, .material = glass});
  double x = -4;
  for (const Light& light : lights) scene.add(Node{.translation = Vec3(x += 2, 5, 4), .light = light});
  scene.add(Camera{.eye = Vec3(0, 1, 6)});
  return scene;
}

/// Of triangles that are drawn again to be lit no point goes without, whatever else is in its pixel: not even
/// where parameters, and depths, do not tell them apart. In ambient light alone all look alike.
TEST_F(LayersTest, EveryPointOfTrianglesThatAreDrawnAgainIsLit) {
  for (const std::uint32_t times : {1U, 2U})
    for (const bool parameters : {true, false}) {
      const Image image =
          draw(withCube(repeatedCube(times, parameters), {}), kLayersSize, {.shading = Shading::Gouraud})
              .image;
      const Vec3 background(0.1, 0.2, 0.4), light = 0.5 * Vec3(0.8, 0.4, 0.2);
      const double through = std::pow(0.5, 2 * times);
      int covered = 0;
      for (int y = 0; y < kLayersSize.height; ++y)
        for (int x = 0; x < kLayersSize.width; ++x) {
          const Vec3 color = colorAt(image, x, y);
          if (near(color, background, 1e-6)) continue;
          ++covered;
          ASSERT_TRUE(near(color, (1 - through) * light + through * background, 1e-6)) << x << ", " << y;
        }
      EXPECT_GT(covered, 5000);
    }
}

/// Which points there are does not depend on parameters that nothing asks for; in many lights, too, some of
/// which a shadow keeps, and at many samples.
TEST_F(LayersTest, ParametersDoNotMatterToTrianglesThatAreDrawnAgain) {
  const Light plain{.intensity = 0.4}, exact{.intensity = 0.4, .shadow = Light::Shadow::Exact};
  for (const Shading shading : {Shading::Gouraud, Shading::Toon})
    for (const auto& lights : {std::vector<Light>{plain, plain},
                               {exact, plain, exact},
                               {plain, exact, plain, plain, exact, plain, plain, exact, plain, plain}})
      for (const int samples : {1, 4}) {
        const DrawOptions options{.shading = shading, .samples = samples};
        const Image told = draw(withCube(repeatedCube(1, true), lights), kLayersSize, options).image,
                    untold = draw(withCube(repeatedCube(1, false), lights), kLayersSize, options).image;
        EXPECT_TRUE(sameBytes(told, untold))
            << nameOf(shading) << ", " << lights.size() << " lights, " << samples << " samples";
      }
}

TEST_F(LayersTest, ShadowsFallOnEveryLayer) {
  const Scene scene =
      sceneOf(node("ball", "checks",
                   R"(, "scale": [0.4, 0.4, 0.4], "translate": [0.3, 1.6, 0.3], "name": "caster")") +
              ", " + node("torus", "glass") + ", " + node("mobius", "waves") + kShadowingLight);
  const Verified found = verified(takeSnapshot(scene, 0, kLayersSize));
  EXPECT_EQ(found.verification.wrong.total(), 0U);
  EXPECT_GT(found.statistics.count.shadowPasses, 0U);
  const Image without = draw(scene, kLayersSize, {.shadows = ShadowKinds::None}).image;
  EXPECT_FALSE(sameBytes(without, draw(scene, kLayersSize).image));
}

/// A plane without end is left to rays, which find it before glass that is listed by then.
TEST_F(LayersTest, NoneIsLeftWhereRaysFindWhatIsBefore) {
  Scene scene = sceneOf(node("torus", "glass") + ", " + node("ball", "red"));
  const Surface wall =
      surface([](auto u, auto v) { return point(u / (1 - u * u), v / (1 - v * v), 1.8 + 0 * u); },
              {{-1, 1}, {-1, 1}});
  scene.add(Node{.surface = wall, .material = scene.add(Material{.diffuse = Vec3(0.4)})});
  const Picture picture =
      renderer().render(takeSnapshot(scene, 0, {64, 48}), {.audit = {.extent = AuditExtent::All}});
  EXPECT_GT(picture.statistics.error.resolvedByRaysPx, 1000U);
  EXPECT_EQ(picture.statistics.error.auditFailedPx, 0U);
  EXPECT_EQ(picture.statistics.error.unconvergedPx, 0U);
}

TEST_F(LayersTest, RoomGrowsUntilAllAreThere) {
  // 200 sheets are more than the two points for each pixel that there is room for at first.
  std::string nodes;
  for (int i = 0; i < 200; ++i)
    nodes += std::string(i == 0 ? "" : ", ") +
             node("floor", "waves", R"(, "translate": [0, )" + std::to_string(-1.5 + 0.005 * i) + ", 0]");
  const Picture picture = draw(sceneOf(nodes), {64, 48});
  EXPECT_EQ(picture.statistics.error.layersMissing, 0U);
  EXPECT_GT(picture.statistics.count.layerPoints, 2U * 64 * 48);
  EXPECT_EQ(picture.statistics.error.unconvergedPx, 0U);
  EXPECT_EQ(picture.statistics.error.auditFailedPx, 0U);
}

TEST_F(LayersTest, BandsTakeTurnsWhereThereIsNoRoomForAll) {
  // 60 layers in three of four pixels are more than fit into what a device binds at once.
  std::string nodes;
  for (int i = 0; i < 60; ++i)
    nodes += std::string(i == 0 ? "" : ", ") +
             node("floor", i % 2 == 0 ? "glass" : "red",
                  R"(, "translate": [0, )" + std::to_string(-1.5 + 0.01 * i) + ", 0]");
  const Scene scene = sceneOf(nodes);
  constexpr PixelSize kLarge{320, 240};
  const Picture picture = draw(scene, kLarge);
  EXPECT_GT(picture.statistics.count.layerPoints, kMaxLayerBytes / sizeof(shared::LayerPoint));
  // Without room, with it in four bands, and with what rays have found: 3 passes a band.
  EXPECT_LE(picture.statistics.count.passes, 40U);
  EXPECT_EQ(picture.statistics.error.layersMissing, 0U);
  EXPECT_EQ(picture.statistics.error.unconvergedPx, 0U);
  EXPECT_EQ(picture.statistics.error.auditFailedPx, 0U);
  // Row by row against the reference.
  const Snapshot snapshot = takeSnapshot(scene, 0, kLarge);
  const reference::Caster truth(snapshot);
  for (int y = 0; y < kLarge.height; ++y) {
    const reference::Ray ray = truth.rayThrough(160.5, y + 0.5);
    bool certified = true;
    ASSERT_TRUE(near(colorAt(picture.image, 160, y), truth.color(ray, truth.look(ray), certified), 1e-4))
        << y;
  }
}

/// Where eyes and surfaces meet: defined, finite, right or told.
TEST_F(LayersTest, FromInsideAndFromNear) {
  for (const char* eye :
       {"0, 0, 0", "1, 0, 0", "0.9999999, 0, 0", "0, -1.6, 0", "1e5, 1e5, 1e5", "1.3, 0, 0.1"}) {
    SCOPED_TRACE(eye);
    const Scene scene = buildScene(
        parseScene(std::string(R"({ "luxo": 1, "materials": { "glass": { "opacity": 0.5 } },
          "surfaces": { "ball": { "type": "sphere", "radius": 1 }, "torus": { "type": "torus", "major": 1.3, "minor": 0.45 } },
          "nodes": [ { "surface": "ball", "material": "glass" }, { "surface": "torus", "material": "glass" },
                     { "translate": [4, 8, 6], "light": {} } ],
          "camera": { "eye": [)") +
                       eye + R"(], "look_at": [0.2, 0.1, -1], "near": 0.001, "fov_y": "70deg" } })",
                   "inside"));
    const Verified found = verified(takeSnapshot(scene, 0, {80, 60}));
    EXPECT_EQ(found.statistics.error.nonfinitePx, 0U);
    EXPECT_LE(found.verification.wrong.total(),
              found.statistics.error.unconvergedPx + found.statistics.error.uncertifiedPx);
  }
}

}  // namespace
}  // namespace luxo::test
