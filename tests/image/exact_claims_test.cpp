// SPDX-License-Identifier: Apache-2.0
// Exact pictures of what shells, searches and skips found hardest to prove, every pixel held against
// certified rays: nothing is missing, no other layer is seen, and what is not found is counted.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>

#include "reference/reference.h"
#include "scene/scene_builder.h"
#include "scene/scene_reader.h"
#include "support/verified_picture.h"
#include "surface/catalogue.h"

namespace luxo::test {
namespace {

class ExactClaims : public VerifiedPictureTest {
 protected:
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  int upTo(int most) { return std::uniform_int_distribution<int>(0, most)(random_); }
  Vec3 somewhere() { return {between(-1, 1), between(-1, 1), between(-1, 1)}; }

  /// `camera`: its members but the place.
  static Snapshot snapshotOf(const std::string& surface, const Vec3& eye, const Vec3& lookAt,
                             const std::string& camera, PixelSize size) {
    const std::string text = fmt::format(
        R"({{ "luxo": 1, "surfaces": {{ "s": {} }}, "nodes": [{{ "surface": "s" }}],
              "camera": {{ "eye": [{:.6f}, {:.6f}, {:.6f}], "look_at": [{:.6f}, {:.6f}, {:.6f}],
                           "up": [0.1, 1, 0.05], {} }} }})",
        surface, eye.x, eye.y, eye.z, lookAt.x, lookAt.y, lookAt.z, camera);
    return takeSnapshot(buildScene(parseScene(text, "claims")), 0, size);
  }

  /// Nothing is wrong that is not counted, and at most `lost` pixels are.
  void expectNoneSilentlyWrong(const Snapshot& snapshot, std::uint64_t lost = 0) {
    const Verified found = verified(snapshot);
    EXPECT_EQ(found.verification.coverage.beyond, 0U)
        << "missing " << found.verification.coverage.missing << ", extra "
        << found.verification.coverage.extra << ", of another layer "
        << found.verification.coverage.wrongLayer;
    EXPECT_LE(found.verification.positionPx.max, 1e-3 + found.verification.positionPx.floor);
    EXPECT_LE(found.statistics.error.unconvergedPx, lost);
    seen_ += found.verification.coverage.both;
  }

  std::mt19937 random_{17};
  std::uint64_t seen_ = 0;
};

// A closed surface that passes through itself: a figure of eight with unequal loops, led around an axis. Seen
// from outside, its smaller loop shows its inner side.
TEST_F(ExactClaims, WhatPassesThroughItselfShowsItsInnerSide) {
  for (int round = 0; round < 3; ++round) {
    SCOPED_TRACE(round);
    const std::string radius =
        fmt::format("(1.5+{:.3f}*sin(v)+0.1*sin({}*u))", between(0.4, 0.7), 1 + upTo(2));
    const std::string surface = fmt::format(
        R"json({{ "type": "formula", "u": [0, "tau"], "v": [0, "tau"],
                  "position": ["{0}*cos(u)", "(0.4+{1:.3f}*sin(v))*sin(2*v)", "{0}*sin(u)"] }})json",
        radius, between(0.1, 0.3));
    expectNoneSilentlyWrong(snapshotOf(surface, between(4, 6) * glm::normalize(somewhere()),
                                       0.2 * somewhere(), R"("fov_y": 0.8)", {96, 72}));
  }
  EXPECT_GT(seen_, 3000U);
}

// What is hidden may be lost by its search: then a ray tells whether the point that is shown is the first,
// and it stays. So what may be left out changes no bit, but where the point itself is found once more.
TEST_F(ExactClaims, SkipsChangeNothingThatIsSeen) {
  int changed = 0;
  for (const char* name : {"torus", "klein", "supertoroid", "torus_knot", "teapot", "superellipsoid"})
    for (int round = 0; round < 3; ++round) {
      SCOPED_TRACE(fmt::format("{}, camera {}", name, round));
      Scene scene;
      scene.set(RenderSettings{.ambient = Vec3(0.2)});
      const MaterialId china = scene.add(Material{.diffuse = {0.2, 0.4, 0.7}});
      const Surface surface = makeSurface(name);
      const Box box = surface.framing({});
      const double size = glm::length(box.extent());
      scene.add(Node{.surface = surface, .material = china});
      scene.add(Node{.translation = 0.2 * size * somewhere(), .surface = surface, .material = china});
      scene.add(Node{.translation = Vec3(-3, 4, 3) * size, .light = Light{.intensity = 0.8}});
      const Camera camera{
          .eye = 0.5 * (box.min + box.max) + between(1, 2) * size * glm::normalize(somewhere()),
          .lookAt = 0.5 * (box.min + box.max),
          .up = Vec3(0, 1, 0.01),
          .projection = round == 2 ? Projection::Orthographic : Projection::Perspective,
          .height = 1.2 * size};
      const Image all = draw(scene, camera, {200, 150}, {.shading = Shading::Exact}).image;
      for (const auto skip : {&Skips::backface, &Skips::hidden}) {
        DrawOptions options{.shading = Shading::Exact};
        options.skips.*skip = false;
        const Image image = draw(scene, camera, {200, 150}, options).image;
        double most = 0;
        for (int y = 0; y < 150; ++y)
          for (int x = 0; x < 200; ++x) {
            const Vec3 difference = glm::abs(Vec3(colorAt(image, x, y)) - Vec3(colorAt(all, x, y)));
            const double largest = std::max({difference.x, difference.y, difference.z});
            most = std::max(most, largest);
            changed += largest > 0;
          }
        EXPECT_LE(most, 1e-6) << (skip == &Skips::hidden ? "hidden" : "backface");
      }
    }
  EXPECT_LE(changed, 10);  // of a million pixels
}

// Rolls of up to 40 turns: as u is large, the next float is farther away than a search's tolerance; and cells
// run along all of v, a hundred times as long on the screen as they are wide.
TEST_F(ExactClaims, EveryTurnOfARollIsFound) {
  const auto roll = [](double last) {
    return fmt::format(
        R"json({{ "type": "formula", "u": [0, {:.5f}], "v": [-1, 1], "let": {{ "r": "0.1+0.04*u" }},
                                 "position": ["r*cos(u)", "v", "r*sin(u)"] }})json",
        last);
  };
  for (const int turns : {2, 10, 40}) {
    SCOPED_TRACE(fmt::format("{} turns", turns));
    const double last = 6.283185 * turns, size = 0.1 + 0.04 * last;
    expectNoneSilentlyWrong(snapshotOf(roll(last), between(1.3, 3.5) * size * glm::normalize(somewhere()),
                                       0.3 * size * somewhere(), R"("fov_y": 0.7, "near": 0.1)", {80, 60}));
  }
  expectNoneSilentlyWrong(
      snapshotOf(roll(25), {-1.5, 0.5, -1.5}, {0, 0.5, 0}, R"("fov_y": 0.7, "near": 0.1)", {200, 150}));
  EXPECT_GT(seen_, 30000U);
}

// A twisted sheet that passes by the eye: its shell is as fine as its nearest part asks for, and where it is
// seen along itself, far away, slabs and triangles are narrower than corners move on the raster's grid. One
// picture in thirty lost a pixel of it.
TEST_F(ExactClaims, WhatIsNarrowerThanTheRasterIsFound) {
  const std::string sheet = R"json({ "type": "formula",
    "position": ["3.4*(u - 0.5)", "2.6*v", "0.35*sin(tau*u*1.5 + 1.766)*(1 - 0.4*v)"] })json";
  for (int k = 0; k < 100; ++k) {
    SCOPED_TRACE(k);
    expectNoneSilentlyWrong(snapshotOf(sheet, {-2.427245, 0.404099, 3.235674},
                                       Vec3(-1.42133, 1.094901, 3.443243) + 0.05 * somewhere(),
                                       R"("fov_y": 1.78349, "near": 0.00288)", {48, 36}));
  }
}

// Where fields of view are wide the cells beside the eye are drawn out over the picture.
TEST_F(ExactClaims, WideFieldsOfViewLoseNothing) {
  for (const char* name : {"mobius", "torus", "klein_figure8", "helicoid"})
    for (const double degrees : {120.0, 150.0, 168.0}) {
      SCOPED_TRACE(fmt::format("{}, {} degrees", name, degrees));
      const std::string surface = fmt::format(R"({{ "type": "{}" }})", name);
      expectNoneSilentlyWrong(
          snapshotOf(surface, between(0.3, 1.2) * glm::normalize(somewhere()), 0.4 * somewhere(),
                     fmt::format(R"("fov_y": "{}deg", "near": 0.002)", degrees), {64, 48}));
    }
  // The corner of the picture where a band's edge passes by the eye.
  expectNoneSilentlyWrong(snapshotOf(R"({ "type": "mobius" })",
                                     {-0.7837820994921212, -0.4079133567389381, 0.3739436105444005},
                                     {-0.09645262392090785, 0.038712582178241486, 0.22585756389536035},
                                     R"("fov_y": "150deg", "near": 0.0011927493704842506)", {320, 240}));
  EXPECT_GT(seen_, 20000U);
}

}  // namespace
}  // namespace luxo::test
