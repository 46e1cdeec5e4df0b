// SPDX-License-Identifier: Apache-2.0
// What must not change a picture: mirrors, culling and every other skip, the order of siblings, the way a
// moment was reached, a whole period.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include "image/compare.h"
#include "luxo_grandpa/lamp.h"
#include "scenes/primitives.h"
#include "support/picture.h"
#include "surface/catalogue.h"

namespace luxo::test {
namespace {

using Invariance = PictureTest;

constexpr PixelSize kInvarianceSize{320, 180};

/// Closed and open surfaces, hierarchy, transparency, both kinds of light; mirrored in x or not.
Scene mixedScene(double mirror, double opacity = 0.4) {
  Scene scene;
  scene.set(RenderSettings{.background = {0.1, 0.1, 0.2}, .ambient = Vec3(0.2)});
  const MaterialId shiny = scene.add(Material{.diffuse = {0.6, 0.3, 0.1}, .specular = Vec3(0.5)});
  const MaterialId oneSided = scene.add(Material{.diffuse = {0.1, 0.5, 0.3}, .twoSided = TwoSided::No});
  const MaterialId glass = scene.add(Material{.diffuse = {0.2, 0.3, 0.7}, .opacity = opacity});
  const NodeId root = scene.add(Node{.scale = Vec3(mirror, 1, 1)});
  const auto place = [&](Vec3 at, Rotation turn, Surface surface, MaterialId material) {
    scene.add(Node{.parent = root,
                   .translation = at,
                   .rotation = turn,
                   .surface = std::move(surface),
                   .material = material});
  };
  place({-2.2, 0.3, 0}, {{1, 2, 0}, 0.7}, torus(0.8, 0.3), shiny);
  place({0.3, 0, -1}, {}, sphere(0.9), shiny);
  place({2, -0.8, 0}, {{1, 0, 1}, 0.6}, paraboloid(0.2, 1.4), shiny);
  place({-0.5, -1, 1}, {{0, 1, 0}, 1}, cone(0.6, 0, 1.1), oneSided);
  place({1.2, 0.4, 1.2}, {}, sphere(0.5), glass);
  place({0, -1.1, 0}, {}, rectangle(8, 5), oneSided);
  scene.add(Node{.parent = root, .translation = Vec3(-2, 4, 3), .light = Light{.intensity = 0.7}});
  scene.add(Node{.parent = root,
                 .rotation = Rotation{{1, 0.5, 0}, -0.8},
                 .light = Light{.type = Light::Type::Directional, .intensity = 0.3}});
  scene.add(Camera{.eye = Vec3(mirror * 1.5, 2, 6), .lookAt = Vec3(mirror * 0.2, 0, 0), .fovY = radians(40)});
  return scene;
}

/// Pixels with a neighbour that shows another node, or the same one with a normal 45 degrees away: contours.
std::vector<bool> contours(const Image& ids, const Image& normals) {
  std::vector<bool> found(static_cast<std::size_t>(ids.width() * ids.height()));
  for (int y = 0; y < ids.height(); ++y)
    for (int x = 0; x < ids.width(); ++x)
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
          const int nx = std::clamp(x + dx, 0, ids.width() - 1), ny = std::clamp(y + dy, 0, ids.height() - 1);
          if (ids.pixel(nx, ny)[0] != ids.pixel(x, y)[0] ||
              glm::dot(colorAt(normals, nx, ny), colorAt(normals, x, y)) < 0.7)
            found[static_cast<std::size_t>(y * ids.width() + x)] = true;
        }
  return found;
}

TEST_F(Invariance, MirroredSceneIsTheMirroredPicture) {
  const Scene original = mixedScene(1, 1), mirrored = mixedScene(-1, 1);
  const Image ids = flippedLeftRight(draw(original, kInvarianceSize, {.output = Output::Id}).image);
  const Image normals = flippedLeftRight(draw(original, kInvarianceSize, {.output = Output::Normal}).image);
  const std::vector<bool> contour = contours(ids, normals);
  const auto contourPixels = std::count(contour.begin(), contour.end(), true);
  for (const Shading shading : {Shading::Exact, Shading::Phong, Shading::Flat, Shading::Gouraud}) {
    const Image expected = flippedLeftRight(draw(original, kInvarianceSize, {.shading = shading}).image);
    const Image image = draw(mirrored, kInvarianceSize, {.shading = shading}).image;
    int wrong = 0, moved = 0;
    for (int y = 0; y < kInvarianceSize.height; ++y)
      for (int x = 0; x < kInvarianceSize.width; ++x) {
        if (near(colorAt(image, x, y), colorAt(expected, x, y), 1.0 / 255)) continue;
        // Single precision rounds the two differently; samples that near an edge may change sides.
        const bool onContour = contour[static_cast<std::size_t>(y * kInvarianceSize.width + x)];
        ++(onContour || shading == Shading::Flat ? moved : wrong);
      }
    EXPECT_EQ(wrong, 0) << nameOf(shading);
    // Within 1/128 px of an edge lies one in 64 of the pixels that an edge crosses; facets have edges
    // everywhere.
    EXPECT_LE(moved, (shading == Shading::Flat ? 4 : 1) * contourPixels / 64) << nameOf(shading);
  }
}

class InvarianceOf : public PictureTest, public testing::WithParamInterface<Shading> {};

INSTANTIATE_TEST_SUITE_P(Shadings, InvarianceOf, testing::Values(Shading::Exact, Shading::Phong),
                         [](const auto& shading) { return std::string(nameOf(shading.param)); });

TEST_P(InvarianceOf, NoSkipChangesABit) {
  struct Subject {
    const char* name;
    Scene scene;
    double time;
  };
  for (const Subject& subject : {Subject{"lamp", luxoGrandpa(), 21}, Subject{"lamp upward", luxoGrandpa(), 0},
                                 Subject{"primitives", primitives(), 0.3}, Subject{"mixed", mixedScene(1), 0},
                                 Subject{"mirrored", mixedScene(-1), 0}})
    for (const int samples : {1, 4}) {
      const DrawOptions all{.shading = GetParam(), .samples = samples};
      const Image expected = draw(subject.scene, kInvarianceSize, all, subject.time).image;
      const auto check = [&](const char* what, const DrawOptions& options) {
        const Image shown = draw(subject.scene, kInvarianceSize, options, subject.time).image;
        // Another number of lights is another program, whose sums a GPU may order and fuse in its own way.
        const double most = options.skips.lights ? 0 : tolerance(0, 1e-7);
        EXPECT_TRUE(most == 0 ? sameBytes(shown, expected) : nearEverywhere(shown, expected, most))
            << subject.name << ", " << samples << " samples, without " << what;
      };
      const auto without = [&](const char* what, bool Skips::*skip) {
        DrawOptions options = all;
        options.skips.*skip = false;
        check(what, options);
      };
      without("frustum", &Skips::frustum);
      without("small", &Skips::small);
      without("lights", &Skips::lights);
      without("unchanged", &Skips::unchanged);
      without("passes", &Skips::passes);
      if (GetParam() == Shading::Exact) {
        // Where hidden sides are lost rays find the pixel, to 1e-4 px: colours change by less than a
        // hundredth of that, but change. Within rounding of the silhouette a pixel may show the hidden side.
        for (const auto skip : {&Skips::backface, &Skips::hidden}) {
          DrawOptions options = all;
          options.skips.*skip = false;
          const Image image = draw(subject.scene, kInvarianceSize, options, subject.time).image;
          const int changed = differingPixels(image, expected, 1e-5);
          EXPECT_LE(changed, skip == &Skips::backface ? 2 : 0)
              << subject.name << ", " << samples << " samples";
        }
        continue;
      }
      without("backface", &Skips::backface);
      DrawOptions none = all;
      none.skips = Skips::none();
      check("any skip", none);
      if (samples == 1 && std::string_view(subject.name) != "mixed" &&
          std::string_view(subject.name) != "mirrored") {
        DrawOptions uncut = all;
        uncut.cullBackFaces = false;  // all here is closed or two-sided: there is nothing else to see
        check("culling of back faces", uncut);
      }
    }
}

// Where patches meet at a silhouette, or end before something else, what lies behind is seen close by; where
// one ends in corners that are narrower than its slab, faces of that cross.
TEST_F(Invariance, WhatIsHiddenIsHiddenFromAnywhere) {
  std::mt19937 random(5);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const auto somewhere = [&] { return Vec3(between(-1, 1), between(-1, 1), between(-1, 1)); };
  for (const char* name : {"teapot", "scherk"}) {
    Scene scene;
    scene.set(RenderSettings{.ambient = Vec3(0.2)});
    const MaterialId china = scene.add(Material{.diffuse = {0.2, 0.4, 0.7}});
    scene.add(Node{.surface = makeSurface(name), .material = china});
    for (int i = 0; i < 12; ++i)
      scene.add(Node{.translation = Vec3(0, 1.5, 0) + 2.0 * somewhere(),
                     .rotation = Rotation{glm::normalize(somewhere()), between(0, 6)},
                     .scale = Vec3(0.15),
                     .surface = makeSurface(name),
                     .material = china});
    scene.add(Node{.surface = disk(5), .material = china});
    scene.add(Node{.translation = Vec3(-6, 8, 6), .light = Light{.intensity = 0.8}});
    for (int i = 0; i < 12; ++i) {
      const Vec3 at = Vec3(0, 1.2, 0) + 2.0 * somewhere(), from = glm::normalize(somewhere());
      const double distance = between(5, 20);
      const Camera camera{.eye = at + distance * from,
                          .lookAt = at,
                          .up = Vec3(0, 1, 0.01),
                          .projection = i % 3 == 2 ? Projection::Orthographic : Projection::Perspective,
                          .height = 0.7 * distance};
      DrawOptions options{.shading = Shading::Exact};
      const Image seen = draw(scene, camera, {400, 300}, options).image;
      options.skips.hidden = false;
      const Image expected = draw(scene, camera, {400, 300}, options).image;
      const int changed = differingPixels(seen, expected, 1e-3);
      EXPECT_EQ(changed, 0) << name << ", camera " << i;
    }
  }
}

TEST_F(Invariance, SkipsDoSkip) {
  // Or the test above would compare nothing: a ball behind the eye, one too small, one-sided faces, a light
  // below.
  Scene scene = mixedScene(1);
  scene.add(Node{.translation = Vec3(0, 0, 60), .surface = sphere(1)});
  scene.add(Node{.translation = Vec3(0.31, 1.3, -1), .surface = sphere(1e-5)});
  const FrameCounts with = draw(scene, kInvarianceSize).statistics.count;
  EXPECT_GE(with.culledFrustum, 1u);
  EXPECT_GE(with.culledSmall, 1u);
  EXPECT_EQ(with.nodes, with.drawn + with.culledFrustum + with.culledSmall + with.culledBackface);
  const FrameCounts without = draw(scene, kInvarianceSize, {.skips = Skips::none()}).statistics.count;
  EXPECT_EQ(without.drawn, without.nodes);
  EXPECT_EQ(without.nodes, with.nodes);
}

TEST_F(Invariance, LightThatCannotReachIsNotEvaluated) {
  // At t = 0 the shade opens upward: its light reaches nothing but the shade.
  const Picture with = draw(luxoGrandpa(), kInvarianceSize, {}, 0);
  DrawOptions all;
  all.skips.lights = false;
  const Picture without = draw(luxoGrandpa(), kInvarianceSize, all, 0);
  EXPECT_GE(with.statistics.count.culledLights, 5u);
  EXPECT_EQ(without.statistics.count.culledLights, 0u);
  // Another number of lights is another program, whose sums a GPU may order and fuse in its own way.
  const double most = tolerance(0, 1e-7);
  EXPECT_TRUE(most == 0 ? sameBytes(with.image, without.image)
                        : nearEverywhere(with.image, without.image, most));
}

TEST_F(Invariance, OrderOfSiblingsDoesNotMatter) {
  const auto build = [](const std::vector<int>& order) {
    Scene scene;
    scene.set(RenderSettings{.ambient = Vec3(0.1)});
    const NodeId root = scene.add(Node{.rotation = Rotation{{0, 1, 0}, 0.3}});
    for (const int i : order) {
      const Vec3 at(1.1 * (i % 4) - 1.7, 0.9 * (i / 4 % 3) - 0.9, 0.4 * (i % 3) - 0.1 * i);
      if (i < 14)
        scene.add(Node{.parent = root,
                       .translation = at,
                       .surface = i % 3 == 0   ? torus(0.5, 0.2)
                                  : i % 3 == 1 ? sphere(0.55)
                                               : rectangle(0.9, 0.9),
                       .material = scene.add(Material{.diffuse = {0.1 * (i % 7), 0.5, 1 - 0.07 * i},
                                                      .opacity = i >= 8 ? 0.3 + 0.05 * i : 1.0})});
      else
        scene.add(Node{.parent = root,
                       .translation = Vec3(2 * (i - 16), 3, 4),
                       .light = Light{.color = Vec3(0.3, 0.1 * (i - 13), 0.2), .intensity = 0.6}});
    }
    scene.add(Camera{.eye = Vec3(0.5, 1, 6)});
    return scene;
  };
  std::vector<int> order(19);
  std::iota(order.begin(), order.end(), 0);
  const Image expected = draw(build(order), kInvarianceSize).image;
  std::uint64_t state = 7;
  for (int round = 0; round < 8; ++round) {
    for (std::size_t i = order.size(); i > 1; --i) {  // Fisher and Yates, from a linear congruence
      state = state * 6364136223846793005u + 1442695040888963407u;
      std::swap(order[i - 1], order[(state >> 33) % i]);
    }
    EXPECT_TRUE(sameBytes(draw(build(order), kInvarianceSize).image, expected)) << "round " << round;
  }
}

TEST_F(Invariance, SeekingIsStepping) {
  const Scene lamp = luxoGrandpa();
  Image stepped;
  for (int frame = 0; frame <= 72; ++frame) stepped = draw(lamp, kInvarianceSize, {}, frame / 24.0).image;
  Renderer fresh(context());
  EXPECT_TRUE(sameBytes(fresh.render(takeSnapshot(lamp, 3, kInvarianceSize)).image, stepped));
}

TEST_F(Invariance, AWholePeriodLaterItIsTheSame) {
  for (const double t : {0.0, 3.0, 9.5, 21.0}) {
    const Image now = draw(luxoGrandpa(), kInvarianceSize, {}, t).image;
    const Image later = draw(luxoGrandpa(), kInvarianceSize, {}, t + 8 * kPi).image;
    EXPECT_LE(compare(now, later, ComparisonSpace::Srgb8).max, 1.0 / 255 + 1e-9) << t;
  }
}

TEST_F(Invariance, EveryRunIsTheSame) {
  const Snapshot snapshot = takeSnapshot(luxoGrandpa(), 9.5, kInvarianceSize);
  const Image expected = renderer().render(snapshot).image;
  EXPECT_TRUE(sameBytes(renderer().render(snapshot).image, expected)) << "read again";
  EXPECT_TRUE(sameBytes(renderer().render(snapshot, {.skips = {.unchanged = false}}).image, expected));
  Renderer fresh(context());
  EXPECT_TRUE(sameBytes(fresh.render(snapshot).image, expected));
  Renderer elsewhere;
  EXPECT_TRUE(sameBytes(elsewhere.render(snapshot).image, expected));
}

}  // namespace
}  // namespace luxo::test
