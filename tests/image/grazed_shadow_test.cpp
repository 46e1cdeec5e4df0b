// SPDX-License-Identifier: Apache-2.0
// Exact shadows on what their light grazes: what is off by so little across its rays is off by hundreds of
// times as much there. Against the reference's rays, seen from above and from near.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <utility>

#include "support/meshes.h"
#include "support/verified_picture.h"
#include "surface/library.h"

namespace luxo::test {
namespace {

/// A sun from there.
Node sunFrom(const Vec3& toward) {
  const Vec3 way = unit(toward), axis = glm::cross(Vec3(0, 0, 1), way);
  return {.rotation = Rotation{axis, std::acos(way.z)},
          .light = Light{.type = Light::Type::Directional, .shadow = Light::Shadow::Exact}};
}

/// Of a formula that is no equation.
Surface displacedBall() {
  return surface(
      [](auto u, auto v) {
        auto r = 1.0 + 1e-4 * sin(5.0 * u + v);
        return point(r * cos(v) * cos(u), r * sin(v), -(r * cos(v) * sin(u)));
      },
      {{0, kTau}, {-1.5, 1.5}});
}

/// Where the shadow ends on waves cos(phase) of that slope at 0 of a crest in light that falls by `low` a
/// metre: by phase.
double endOfShadow(double slope, double low) {
  const double first = std::asin(low / slope);  // light touches the crest there
  const auto above = [&](double phase) {
    return slope * (std::cos(first) - std::cos(phase)) - low * (phase - first);
  };
  double in = kPi, out = first + kTau;
  for (int i = 0; i < 60; ++i) (above(0.5 * (in + out)) > 0 ? in : out) = 0.5 * (in + out);
  return in;
}

class GrazedShadowTest : public VerifiedPictureTest {
 protected:
  double from(double low, double high) { return std::uniform_real_distribution(low, high)(random_); }

  void expectTheTruth(Scene scene, double low, double turn, const Vec3& target, double height) {
    scene.add(sunFrom({-1, low, std::tan(turn)}));
    scene.add(Camera{.eye = target + Vec3(0, 2, 0),
                     .lookAt = target,
                     .up = Vec3(0, 0, -1),
                     .projection = Projection::Orthographic,
                     .height = height});
    const Verified found = verified(takeSnapshot(scene, 0, {64, 48}));
    EXPECT_EQ(found.verification.wrong.total(), 0U);
    EXPECT_EQ(found.statistics.error.unconvergedPx, 0U);
  }

  std::mt19937 random_{3};
};

/// Where one ends that is in another's shadow.
TEST_F(GrazedShadowTest, OnWavesAreTheTruth) {
  // Of 200, 13 had pixels in shadow that are lit; these are the first of them.
  constexpr std::array kOnceWrong{18, 35, 44, 47, 49, 61, 69};
  for (int i = 0; i <= kOnceWrong.back(); ++i) {
    const double slope = std::pow(10, from(-3, -1)), low = slope * from(0.3, 0.95), turn = from(-0.5, 0.5),
                 waves = from(2, 12), bend = from(0, 0.2);
    const Vec3 target(endOfShadow(slope, low) / waves - kTau / waves, 0, from(-0.01, 0.01));
    const double height = std::pow(10, from(-2, -0.5));
    if (std::ranges::find(kOnceWrong, i) == kOnceWrong.end()) continue;
    SCOPED_TRACE(i);
    Scene scene;
    scene.add(
        Node{.surface = surface(
                 [=](auto u, auto v) { return point(u, slope / waves * cos(waves * u + bend * v), -v); },
                 {{-2, 2}, {-2, 2}})});
    expectTheTruth(std::move(scene), low, turn, target, height);
  }
}

/// Of a ball, a formula or triangles, which is about an ellipse.
TEST_F(GrazedShadowTest, OnAFloorAreTheTruth) {
  for (int i = 0; i < 8; ++i) {
    SCOPED_TRACE(i);
    const double radius = 0.3, low = std::pow(10, from(-3, -1)), turn = from(-0.5, 0.5), part = from(0, kTau),
                 along = radius / low * (1 + std::cos(part)), beside = radius * std::sin(part);
    Scene scene;
    scene.add(Node{.surface = rectangle(1000, 1000)});
    scene.add(Node{.translation = Vec3(0, radius, 0),
                   .scale = Vec3(radius),
                   .surface = i % 2 == 0 ? icosphere(4) : displacedBall()});
    expectTheTruth(std::move(scene), low, turn, {along, 0, -along * std::tan(turn) + beside},
                   std::pow(10, from(-2, -0.5)));
  }
}

/// However aslant, light that leaves an egg does not come back to it. Without that proof 82 pixels along the
/// terminator are left to rays, and with it 14, most of them near its ends, where u and v meet.
TEST_F(GrazedShadowTest, OnWhatBendsAwayNeedsFewRays) {
  Scene scene;
  scene.add(Node{.surface = revolve([](auto v) {
                   return ProfilePoint{sin(kPi * v) * (1 + 0.3 * v), 1.4 * cos(kPi * v)};
                 })});
  scene.add(Node{.translation = Vec3(6, 2, 1), .light = Light{.shadow = Light::Shadow::Exact}});
  scene.add(Camera{.eye = Vec3(1, 1, 6), .lookAt = Vec3(0), .fovY = 0.7});
  const Verified found = verified(takeSnapshot(scene, 0, {320, 240}));
  EXPECT_EQ(found.verification.wrong.total(), 0U);
  EXPECT_LE(found.statistics.error.shadowRaysPx, 30U);
}

}  // namespace
}  // namespace luxo::test
