// SPDX-License-Identifier: Apache-2.0
#include "shell/shell_cache.h"

#include <gtest/gtest.h>

#include <limits>

#include "surface/library.h"
#include "tessellate/mesh_cache.h"

namespace luxo {
namespace {

const Vec3 kThin(0);
constexpr double kAny = std::numeric_limits<double>::infinity();

TEST(ShellCache, ALevelIsOneShell) {
  ShellCache cache;
  const Surface ball = sphere(1);
  const auto shell = cache.get(ball, {}, 0.01, kThin, kAny);
  EXPECT_EQ(cache.made(), 1u);
  EXPECT_EQ(cache.get(ball, {}, toleranceLevel(0.01), kThin, kAny), shell);
  EXPECT_EQ(cache.made(), 1u);
  EXPECT_NE(cache.get(ball, {}, 0.02, kThin, kAny), shell);
  EXPECT_EQ(cache.made(), 2u);
  const Shell made = *makeShell(ball, {}, CurvatureMap(ball, {}), {.tolerance = toleranceLevel(0.01)});
  EXPECT_EQ(shell->positions, made.positions);
  EXPECT_EQ(shell->indices, made.indices);
}

TEST(ShellCache, ForgetsBeyondItsBudgetWhatNobodyHolds) {
  const Surface ball = sphere(1);
  ShellCache cache(1);  // so that the last one asked for remains
  const auto ask = [&](double tolerance) { return cache.get(ball, {}, tolerance, kThin, kAny); };
  static_cast<void>(ask(0.01));
  static_cast<void>(ask(0.01));
  EXPECT_EQ(cache.made(), 1u);
  static_cast<void>(ask(0.1));
  const auto held = ask(0.01);
  EXPECT_EQ(cache.made(), 3u);
  static_cast<void>(ask(0.1));
  EXPECT_EQ(ask(0.01), held);
  EXPECT_EQ(cache.made(), 4u);
}

TEST(ShellCache, AShellOfTooManyTrianglesIsNotMade) {
  ShellCache cache;
  const Surface ball = sphere(1);
  const auto most = static_cast<double>(cache.get(ball, {}, 0.01, kThin, kAny)->triangleCount());
  EXPECT_EQ(cache.get(ball, {}, 0.01, kThin, most - 1), nullptr) << "although it is there";
  ShellCache another;
  EXPECT_EQ(another.get(ball, {}, 0.001, kThin, most), nullptr);
  EXPECT_EQ(another.get(ball, {}, 0.001, kThin, 0.5 * most), nullptr);
  EXPECT_EQ(another.made(), 0u);
  EXPECT_NE(another.get(ball, {}, 0.001, kThin, kAny), nullptr);
}

/// A rectangle has walls, which are counted once they are there.
TEST(ShellCache, TheAnswerIsTheSameEachTime) {
  const Surface sheet =
      surface([](auto u, auto v) { return point(u, v, 0.1 * sin(u * v)); }, {{-1, 1}, {-1, 1}});
  ShellCache whole;
  const auto triangles = static_cast<int>(whole.get(sheet, {}, 0.01, kThin, kAny)->triangleCount());
  int made = 0;
  for (int most = 1; most <= triangles; ++most) {
    ShellCache cache;
    const bool given = cache.get(sheet, {}, 0.01, kThin, most) != nullptr;
    made += static_cast<int>(cache.made());
    EXPECT_EQ(given, most == triangles) << most;
    EXPECT_EQ(cache.get(sheet, {}, 0.01, kThin, most) != nullptr, given) << most;
  }
  EXPECT_GT(made, 1) << "no shell turns out larger than it was counted";
}

TEST(ShellCache, AnInterruptedShellIsMadeWhenItIsAskedForAgain) {
  ShellCache cache;
  const Surface ball = sphere(1), ring = torus(1, 0.4);
  int asked = 0;
  cache.setInterruption([&] { return ++asked == 1; });
  EXPECT_EQ(cache.get(ball, {}, 0.001, kThin, kAny), nullptr);
  EXPECT_TRUE(cache.interrupted());
  EXPECT_EQ(cache.get(ring, {}, 0.001, kThin, kAny), nullptr) << "all others of the picture wait, too";
  EXPECT_EQ(asked, 1);
  cache.resume();
  EXPECT_NE(cache.get(ball, {}, 0.001, kThin, kAny), nullptr);
  EXPECT_FALSE(cache.interrupted());
  cache.setInterruption([] { return true; });
  EXPECT_NE(cache.get(ball, {}, 0.001, kThin, kAny), nullptr) << "it is there";
  EXPECT_FALSE(cache.interrupted());
}

}  // namespace
}  // namespace luxo
