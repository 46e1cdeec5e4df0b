// SPDX-License-Identifier: Apache-2.0
// How far surfaces are from the planes of triangles: on which side, and that it is proven.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "shell/shell.h"
#include "shell/shell_frame.h"
#include "shell/shell_heights.h"
#include "surface/catalogue.h"
#include "surface/library.h"

namespace luxo {
namespace {

/// A surface and the mesh under its shell, within `part` of its size.
struct Framed {
  Framed(const Surface& of, double part) : surface(of), map(of, {}) {
    const double size = glm::length(of.framing({}).extent());
    blocks = planBlocks(surface, {}, map, {.tolerance = part * size});
    std::ranges::stable_sort(blocks, {}, &Block::patch);
    for (std::uint32_t patch = 0; patch < surface.patchCount(); ++patch)
      patches.push_back(readPatch(surface, patch, {}, size));
  }

  [[nodiscard]] ShellFrame frame(ShellLook& look) const { return {surface, {}, map, blocks, patches, look}; }

  Surface surface;
  CurvatureMap map;
  std::vector<Block> blocks;
  std::vector<ShellPatch> patches;
};

TEST(ShellHeights, HoldTheSurface) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> part(0, 1);
  for (const char* name : {"teapot", "torus", "flag", "klein", "dini", "scherk", "sphere", "cone"}) {
    SCOPED_TRACE(name);
    const Framed framed(makeSurface(name), 0.02);
    ShellLook look(framed.surface, {}, framed.patches);
    const ShellFrame frame = framed.frame(look);
    const ShellHeights& heights = frame.heights();
    for (std::size_t t = 0; t < frame.mesh().triangleCount(); ++t) {
      const auto corners = frame.corners(t);
      double a = part(random), b = part(random);
      if (a + b > 1) a = 1 - a, b = 1 - b;
      const std::vector<Vec2>& uv = frame.mesh().parameters;
      const Vec2 at = a * uv[corners[0]] + b * uv[corners[1]] + (1 - a - b) * uv[corners[2]];
      const Vec3 point = framed.surface.position(frame.patchOf(corners[0]), at.x, at.y);
      const double height = glm::dot(frame.facet(t), point - frame.mesh().positions[corners[0]]);
      const double rounding = 1e-12 * frame.size();
      ASSERT_LE(height, heights.above[t] + rounding) << t;
      ASSERT_LE(-height, heights.below[t] + rounding) << t;
    }
  }
}

TEST(ShellHeights, OfABallAreOutside) {
  // Chords of a ball are inside of it, all. What is left of the deviation is a sixteenth.
  const Framed framed(sphere(1), 0.01);
  ShellLook look(framed.surface, {}, framed.patches);
  const ShellFrame frame = framed.frame(look);
  for (std::size_t t = 0; t < frame.mesh().triangleCount(); ++t) {
    const auto corners = frame.corners(t);
    const double sagitta = 1 - glm::dot(frame.facet(t), frame.mesh().positions[corners[0]]);
    EXPECT_GE(frame.heights().above[t], sagitta);
    EXPECT_LE(frame.heights().above[t], sagitta + frame.bound(t) / 16 + 1e-12);
    EXPECT_LE(frame.heights().below[t], frame.bound(t) / 16 + 1e-12);
  }
}

TEST(ShellHeights, WhatSlidesInItsPlaneHasNone) {
  // A plate whose parameters run unevenly: all of its deviation is along it.
  const Surface plate = surface(
      [](auto u, auto v) { return point(u + 0.4 * u * u, 0.0 * u, -(v + 0.4 * v * v)); }, {{-1, 1}, {-1, 1}});
  const Framed framed(plate, 0.01);
  ShellLook look(framed.surface, {}, framed.patches);
  const ShellFrame frame = framed.frame(look);
  EXPECT_GT(frame.mesh().bound, 1e-3);
  for (std::size_t t = 0; t < frame.mesh().triangleCount(); ++t) {
    EXPECT_LE(frame.heights().above[t], frame.bound(t) / 16 + 1e-12);
    EXPECT_LE(frame.heights().below[t], frame.bound(t) / 16 + 1e-12);
  }
}

TEST(ShellHeights, ASecondLookSeesTheSame) {
  const Framed coarse(makeSurface("teapot"), 0.02), fine(makeSurface("teapot"), 0.01);
  ShellLook look(coarse.surface, {}, coarse.patches), fresh(coarse.surface, {}, coarse.patches);
  (void)coarse.frame(look);
  const ShellHeights again = fine.frame(look).heights(), once = fine.frame(fresh).heights();
  EXPECT_EQ(again.above, once.above);
  EXPECT_EQ(again.below, once.below);
  EXPECT_EQ(again.beyond, once.beyond);
  EXPECT_EQ(again.within, once.within);
  EXPECT_EQ(again.alike, once.alike);
}

/// A plate whose points slide to and fro along it, `waves` times, by `slide`, and rise as they do, the more
/// the larger u is: a cell may have a whole wave, and stands over, or under, many others.
Surface sliding(double waves, double slide) {
  return surface(
      [=](auto u, auto v) {
        const auto wave = sin((kTau * waves) * u);
        return point(u + slide * wave, 0.1 * u * wave, -v);
      },
      {{0, 1}, {0, 1}});
}

Framed oneWaveACell(std::uint32_t waves, double slide) {
  Framed framed(sliding(waves, slide), 1);
  Block all{.patch = 0, .tile = {}, .segments = {waves, 1}};
  all.bound = framed.map.over(0, all.tile).deviation(1.0 / waves, 1);
  framed.blocks = {all};
  return framed;
}

// A point that is over another triangle raises that one's height, however many triangles are between.
TEST(ShellHeights, StraysAreFollowed) {
  const Framed framed = oneWaveACell(256, 0.1);
  ShellLook look(framed.surface, {}, framed.patches);
  const ShellFrame frame = framed.frame(look);
  const ShellHeights& heights = frame.heights();
  EXPECT_TRUE(heights.unfollowed.empty());
  const auto at = [&](std::size_t t, std::size_t k) {
    return frame.mesh().positions[frame.corners(t)[k % 3]];
  };
  const auto isOver = [&](const Vec3& point, std::size_t t) {
    for (std::size_t k = 0; k < 3; ++k)
      if (glm::dot(glm::cross(frame.facet(t), at(t, k + 1) - at(t, k)), point - at(t, k)) <= 0) return false;
    return true;
  };
  std::size_t far = 0;
  for (std::size_t t = 0; t < frame.mesh().triangleCount(); ++t)
    for (int i = 1; i < 4; ++i) {
      const std::vector<Vec2>& uv = frame.mesh().parameters;
      const auto corners = frame.corners(t);
      const Vec2 place = 0.25 * (uv[corners[0]] * (1.0 * i) + uv[corners[1]] * (3.0 - i) + uv[corners[2]]);
      const Vec3 point = framed.surface.position(0, place.x, place.y);
      for (std::size_t o = 0; o < frame.mesh().triangleCount(); ++o) {
        if (!isOver(point, o)) continue;
        const double height = glm::dot(frame.facet(o), point - at(o, 0));
        ASSERT_LE(height + frame.bound(t) / 16, heights.above[o] + 1e-12) << t << " over " << o;
        ASSERT_LE(-height + frame.bound(t) / 16, heights.below[o] + 1e-12) << t << " under " << o;
        far += std::max(t, o) - std::min(t, o) > 32 ? 1 : 0;
      }
    }
  EXPECT_GT(far, 100U);
}

// What is over more than can be followed is nowhere left out silently: the shell is not proven, and boxes
// hold it, in which rays look.
TEST(ShellHeights, WhatIsNotFollowedIsTold) {
  const Framed framed = oneWaveACell(512, 0.4);
  ShellLook look(framed.surface, {}, framed.patches);
  const ShellFrame frame = framed.frame(look);
  ASSERT_FALSE(frame.heights().unfollowed.empty());
  const std::optional<Shell> shell =
      makeShell(framed.surface, {}, framed.map, {.tolerance = 1.01 * frame.mesh().bound});
  ASSERT_TRUE(shell.has_value());
  EXPECT_FALSE(shell->proven);
  ASSERT_FALSE(shell->pinches.empty());
  const auto isHeld = [&](const Vec3& point) {
    return std::ranges::any_of(shell->pinches, [&](const Box& pinch) { return pinch.contains(point); });
  };
  for (const std::size_t t : frame.heights().unfollowed) {
    Vec2 middle(0);
    for (const std::uint32_t v : frame.corners(t)) middle += frame.mesh().parameters[v] / 3.0;
    EXPECT_TRUE(isHeld(framed.surface.position(0, middle.x, middle.y))) << t;
  }
}

TEST(ShellHeights, TellWhereACellHoldsAFold) {
  // The profile of the teapot's knob turns back within a cell as large as the knob.
  const auto least = [](double part) {
    const Framed framed(makeSurface("teapot"), part);
    ShellLook look(framed.surface, {}, framed.patches);
    const ShellFrame frame = framed.frame(look);
    return *std::ranges::min_element(frame.heights().alike);
  };
  EXPECT_LT(least(0.02), std::cos(1.0));
  EXPECT_GT(least(0.0002), std::cos(1.0));
}

}  // namespace
}  // namespace luxo
