// SPDX-License-Identifier: Apache-2.0
// Patterns as values: what they are worth, when they are equal, and what materials must give them.
#include "scene/pattern.h"

#include <cmath>

#include "scene_test_support.h"

namespace luxo {
namespace {

using test::expectSceneError;

Pattern checker(double squares) {
  return pattern([=](auto u, auto v) {
    const Expr square = mod(floor(squares * u) + floor(squares * v), 2);
    return point(square, mix(0.9, 0.1, square), 0.5);
  });
}

TEST(Pattern, HasTheColorOfItsFormulas) {
  EXPECT_EQ(checker(8).colorAt(0.05, 0.05), Vec3(0, 0.9, 0.5));
  EXPECT_EQ(checker(8).colorAt(0.2, 0.05).x, 1);
  const Pattern p = pattern<2>([](auto u, auto v, auto a, auto b) { return point(a * u, b * v, a + b); });
  EXPECT_EQ(p.parameterCount(), 2u);
  EXPECT_EQ(p.colorAt(0.5, 0.25, std::array{3.0, 4.0}), Vec3(1.5, 1, 7));
}

TEST(Pattern, IsBlackWhereItHasNoValue) {
  const Pattern p = pattern([](auto u, auto v) { return point(sqrt(u), 1 / v, u - 5); });
  EXPECT_EQ(p.colorAt(-1, 0), Vec3(0, 0, 0));
  EXPECT_EQ(p.colorAt(4, 2), Vec3(2, 0.5, 0));
}

TEST(Pattern, SaysWhereItIsCut) {
  const Domain square{{-1, 1}, {-1, 1}};
  const auto cut = [&](const auto& formula) { return pattern(formula).whereCut(square, {}); };
  EXPECT_FALSE(cut([](auto u, auto v) { return point(u, v, 1e18); })) << "negative is black, as everywhere";
  EXPECT_FALSE(cut([](auto u, auto v) { return point(sqrt(1 - u * u), v, 0); }))
      << "bounds cannot tell, points can";
  const auto left = cut([](auto u, auto v) { return point(sqrt(u), v, 0); });
  ASSERT_TRUE(left);
  EXPECT_EQ(left->u, Interval(-1, -1 / 32.0));
  EXPECT_EQ(left->v, square.v);
  const auto pole = cut([](auto u, auto v) { return point(0, 1 / v, u); });
  ASSERT_TRUE(pole);
  EXPECT_EQ(pole->v, Interval(0));
  const auto large = cut([](auto u, auto v) { return point(0, 2e18 * u, v); });
  ASSERT_TRUE(large);
  EXPECT_EQ(large->u, Interval(17 / 32.0, 1));
}

TEST(Pattern, ComparesByContent) {
  EXPECT_FALSE(Pattern().valid());
  EXPECT_EQ(Pattern(), Pattern());
  EXPECT_EQ(checker(8), checker(8));
  EXPECT_NE(checker(8), checker(9));
  EXPECT_NE(checker(8), Pattern());
  EXPECT_TRUE(checker(8) < checker(9) || checker(9) < checker(8));
  Graph graph;
  const std::array color{graph.variable(0), graph.variable(1), Expr(0)};
  EXPECT_NE(Pattern(graph, color, 0), Pattern(graph, color, 1)) << "another number of parameters";
}

TEST(Pattern, TakesAsManyFiniteParametersAsItHas) {
  const Pattern p = pattern<1>([](auto u, auto v, auto a) { return point(u, v, a); });
  Scene scene;
  expectSceneError([&] { scene.add(Material{.name = "tiles", .diffusePattern = p}); },
                   {"tiles", "parameters", "1"});
  expectSceneError([&] { scene.add(Material{.diffusePattern = p, .patternParameters = {1, 2}}); }, {"2"});
  expectSceneError([&] { scene.add(Material{.diffusePattern = p, .patternParameters = {NAN}}); }, {"finite"});
  expectSceneError([&] { scene.add(Material{.patternParameters = {1}}); }, {"parameters"});
  EXPECT_TRUE(scene.add(Material{.diffusePattern = p, .patternParameters = {1}}).valid());
}

TEST(Pattern, ValuesMakeTwoMomentsDiffer) {
  const Pattern p = pattern<1>([](auto u, auto v, auto a) { return point(u, v, a); });
  Scene scene;
  const MaterialId id = scene.add(Animated<Material>(
      [=](double t) { return Material{.diffusePattern = p, .patternParameters = {std::floor(t)}}; }));
  scene.add(Node{.surface = sphere(1), .material = id});
  const auto at = [&](double t) { return takeSnapshot(scene, t, {100, 100}); };
  EXPECT_TRUE(at(1) == at(1.5));
  EXPECT_FALSE(at(1) == at(2));
  EXPECT_FALSE(at(1).materials == at(2).materials);
}

}  // namespace
}  // namespace luxo
