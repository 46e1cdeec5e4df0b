// SPDX-License-Identifier: Apache-2.0
#include "mesh/model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace luxo {
namespace {

Vec4 turnAboutZ(double angle) { return {0, 0, std::sin(angle / 2), std::cos(angle / 2)}; }

TEST(Keyframes, AreTheirValuesAtTheirTimesAndBeyond) {
  const Keyframes keys{.times = {1, 3}, .values = {{0, 0, 0, 0}, {4, 2, -2, 0}}};
  EXPECT_EQ(keys.at(0, false), Vec4(0));
  EXPECT_EQ(keys.at(1, false), Vec4(0));
  EXPECT_EQ(keys.at(2.5, false), Vec4(3, 1.5, -1.5, 0));
  EXPECT_EQ(keys.at(3, false), Vec4(4, 2, -2, 0));
  EXPECT_EQ(keys.at(9, false), Vec4(4, 2, -2, 0));
}

TEST(Keyframes, StepsKeepAValueUntilTheNext) {
  const Keyframes keys{
      .interpolation = Keyframes::Interpolation::Step, .times = {0, 1}, .values = {Vec4(1), Vec4(2)}};
  EXPECT_EQ(keys.at(0.999, false), Vec4(1));
  EXPECT_EQ(keys.at(1, false), Vec4(2));
}

TEST(Keyframes, CubicSplinesAreTheirCubic) {
  // x(t) = t^3 - 2t on [1, 3]: a Hermite spline with its derivative 3t^2 - 2 at the ends is that cubic.
  const auto cubic = [](double t) { return t * t * t - 2 * t; };
  const auto slope = [](double t) { return 3 * t * t - 2; };
  const Keyframes keys{
      .interpolation = Keyframes::Interpolation::CubicSpline,
      .times = {1, 3},
      .values = {Vec4(99), Vec4(cubic(1)), Vec4(slope(1)), Vec4(slope(3)), Vec4(cubic(3)), Vec4(99)}};
  for (double t = 1; t <= 3; t += 0.125) EXPECT_NEAR(keys.at(t, false).x, cubic(t), 1e-13);
}

TEST(Keyframes, RotationsTurnEvenlyAndTheShorterWay) {
  const Keyframes keys{.times = {0, 1}, .values = {turnAboutZ(0.25), -turnAboutZ(1.75)}};
  for (double t = 0; t <= 1; t += 0.125)
    EXPECT_NEAR(std::abs(glm::dot(keys.at(t, true), turnAboutZ(0.25 + 1.5 * t))), 1, 1e-14);
}

TEST(ModelNode, ScalesThenTurnsThenMoves) {
  ModelNode node{.translation = {1, 2, 3}, .rotation = turnAboutZ(kPi / 2), .scale = {2, 3, 4}};
  EXPECT_LT(glm::distance(transformPoint(node.parentFromNodeAt(0), {1, 1, 1}), Vec3(1 - 3, 2 + 2, 3 + 4)),
            1e-14);
  EXPECT_FALSE(node.moves());
  node.scaleKeys = Keyframes{.times = {0, 2}, .values = {Vec4(1), Vec4(3)}};
  EXPECT_TRUE(node.moves());
  EXPECT_LT(glm::distance(transformPoint(node.parentFromNodeAt(1), {1, 0, 0}), Vec3(1, 2 + 2, 3)), 1e-14);
}

TEST(ModelNode, AreWhereTheirAncestorsTakeThem) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> some(-1, 1);
  Model model;
  for (std::uint32_t i = 0; i < 50; ++i) {
    ModelNode node{.parent = i == 0 ? kNone : std::uint32_t(random() % i)};
    node.translation = {some(random), some(random), some(random)};
    node.rotation = turnAboutZ(3 * some(random));
    node.scale = {1 + 0.5 * some(random), 1, -1};
    if (i % 7 == 0) node.translationKeys = Keyframes{.times = {0, 1}, .values = {Vec4(0), Vec4(1)}};
    model.nodes.push_back(node);
  }
  for (const double time : {0.0, 0.5}) {
    const std::vector<Transform> places = worldFromNodesAt(model, time);
    for (std::uint32_t i = 0; i < model.nodes.size(); ++i) {
      // A point goes up the tree, parent by parent.
      Vec3 point(1, 2, 3);
      for (std::uint32_t k = i; k != kNone; k = model.nodes[k].parent)
        point = transformPoint(model.nodes[k].parentFromNodeAt(time), point);
      EXPECT_LT(glm::distance(transformPoint(places[i], Vec3(1, 2, 3)), point), 1e-9) << i;
      EXPECT_EQ(places[i].linear, worldFromNodeAt(model, i, time).linear);
      EXPECT_EQ(places[i].translation, worldFromNodeAt(model, i, time).translation);
    }
  }
}

TEST(ModelNode, HangAsDeepAsTheyLike) {
  Model model;
  for (std::uint32_t i = 0; i < 1'000'000; ++i)
    model.nodes.push_back({.parent = i == 0 ? kNone : i - 1, .translation = {1, 0, 0}});
  EXPECT_EQ(worldFromNodeAt(model, 999'999).translation, Vec3(1e6, 0, 0));
  EXPECT_EQ(worldFromNodesAt(model).back().translation, Vec3(1e6, 0, 0));
}

}  // namespace
}  // namespace luxo
