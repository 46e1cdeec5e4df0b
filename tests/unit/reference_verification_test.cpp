// SPDX-License-Identifier: Apache-2.0
// Pictures that are wrong by known amounts, and what verify() says of them.
#include "reference/verification.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>

#include "base/error.h"
#include "image/srgb.h"
#include "reference/silhouette.h"
#include "surface/library.h"

namespace luxo {
namespace {

constexpr PixelSize kVerifiedSize{80, 60};
constexpr double kHeight = 3;  // metres in the picture
constexpr double kPixel = kHeight / kVerifiedSize.height;
constexpr double kRadiusPx = 1 / kPixel;  // of the unit sphere in the middle of the picture

/// Seen along -Z without perspective, moved to the right by some pixels.
Camera straightOn(double rightPx = 0) {
  const Vec3 offset(rightPx * kPixel, 0, 0);
  return {.eye = Vec3(0, 0, 5) + offset,
          .lookAt = offset,
          .near = 0.5,
          .projection = Projection::Orthographic,
          .height = kHeight};
}

Scene sceneOf(const Surface& surface) {
  Scene scene;
  scene.set(RenderSettings{.size = kVerifiedSize, .background = {0.1, 0.2, 0.3}, .ambient = Vec3(0.3)});
  scene.add(Node{.surface = surface,
                 .material = scene.add(Material{.diffuse = Vec3(0.5), .twoSided = TwoSided::Yes})});
  scene.add(straightOn());
  return scene;
}

template <class ValueOf>
Image imageOf(const ReferencePicture& truth, int channels, const ValueOf& valueOf) {
  Image image(truth.color.width(), truth.color.height(), channels);
  for (std::size_t i = 0; i < truth.depth.size(); ++i)
    for (int c = 0; c < channels; ++c)
      image.samples()[i * static_cast<std::size_t>(channels) + static_cast<std::size_t>(c)] =
          static_cast<float>(Vec3(valueOf(i))[c]);
  return image;
}

/// What a faultless renderer would hand out.
MeasuredPicture roundedTo32Bits(const ReferencePicture& truth) {
  return {.color = truth.color,
          .depth = imageOf(truth, 1, [&](std::size_t i) { return Vec3(truth.depth[i]); }),
          .position = imageOf(truth, 3, [&](std::size_t i) { return truth.position[i]; }),
          .normal = imageOf(truth, 3, [&](std::size_t i) { return truth.normal[i]; }),
          .uv = imageOf(truth, 3, [&](std::size_t i) { return Vec3(truth.parameters[i], 0); }),
          .id = imageOf(truth, 1, [&](std::size_t i) { return Vec3(truth.number[i]); })};
}

std::size_t indexOf(int x, int y) { return static_cast<std::size_t>(y * kVerifiedSize.width + x); }

/// Of a pixel's centre from the centre of the picture.
double radiusPx(int x, int y) {
  return std::hypot(x + 0.5 - 0.5 * kVerifiedSize.width, y + 0.5 - 0.5 * kVerifiedSize.height);
}

class VerifySphere : public testing::Test {
 protected:
  Snapshot snapshot = takeSnapshot(sceneOf(sphere(1)), 0, kVerifiedSize);
  ReferencePicture truth = castPicture(snapshot);
  MeasuredPicture measured = roundedTo32Bits(truth);

  [[nodiscard]] Verification judged(const VerificationOptions& options = {}) const {
    return verify(snapshot, truth, measured, options);
  }
};

TEST_F(VerifySphere, TheTruthItselfIsWrongByItsRoundingOnly) {
  const Verification v = judged();
  EXPECT_EQ(v.coverage.compared, 80U * 60U);
  EXPECT_EQ(v.coverage.covered, truth.hits);
  EXPECT_EQ(v.coverage.both, truth.hits);
  EXPECT_EQ(v.coverage.mismatches(), 0U);
  EXPECT_EQ(v.coverage.undecided, 0U);
  EXPECT_EQ(v.coverage.farthestPx, 0);
  for (const ErrorSpread* spread :
       {&v.positionPx, &v.parameterPx, &v.pointPx, &v.depthUlp, &v.normalDegrees}) {
    EXPECT_EQ(spread->pixels, truth.hits);
    EXPECT_EQ(spread->max, spread->floor);
    EXPECT_GT(spread->max, 0);
  }
  // u and v below 1 are rounded by up to 2^-25; they move the point by 2 pi and pi times that on 20 pixels.
  EXPECT_LT(v.positionPx.max, kRadiusPx * 3 * kPi * 0x1p-25);
  EXPECT_TRUE(std::isinf(v.color.psnrLinear));
  EXPECT_EQ(v.color.differing8, 0U);
  EXPECT_EQ(v.color.flipMax, 0);
  EXPECT_EQ(v.nanPixels, 0U);
}

// The picture of a camera that stands a quarter of a pixel beside: every point is off by that much, and a
// pixel is on the wrong side only where the silhouette passes within a quarter of a pixel.
TEST_F(VerifySphere, AShiftOfAQuarterPixelIsMeasured) {
  constexpr double kShift = 0.25;
  measured =
      roundedTo32Bits(castPicture(takeSnapshot(sceneOf(sphere(1)), 0, kVerifiedSize, straightOn(kShift))));
  const Verification v = judged();
  EXPECT_NEAR(v.positionPx.rms, kShift, 1e-5);
  EXPECT_NEAR(v.positionPx.p99, kShift, 1e-5);
  EXPECT_NEAR(v.positionPx.max, kShift, 1e-5);
  EXPECT_GT(v.coverage.missing, 0U);
  EXPECT_GT(v.coverage.extra, 0U);
  EXPECT_EQ(v.coverage.wrongLayer, 0U);
  double farthest = 0;
  std::uint64_t beyond = 0;
  for (int y = 0; y < kVerifiedSize.height; ++y)
    for (int x = 0; x < kVerifiedSize.width; ++x) {
      const bool covered = radiusPx(x, y) < kRadiusPx;
      if (covered == (std::hypot(x + 0.5 - 40 + kShift, y + 0.5 - 30) < kRadiusPx)) {
        EXPECT_FALSE(std::isinf(v.positionMap.pixel(x, y)[0]));
        continue;
      }
      EXPECT_TRUE(std::isinf(v.positionMap.pixel(x, y)[0])) << x << ',' << y;
      const double distance = std::abs(radiusPx(x, y) - kRadiusPx);
      farthest = std::max(farthest, distance);
      beyond += distance > kSilhouettePx ? 1 : 0;
    }
  EXPECT_GE(v.coverage.farthestPx, farthest - 1e-6);
  EXPECT_LE(v.coverage.farthestPx, farthest * 1.01 + 1e-4);
  EXPECT_EQ(v.coverage.beyond, beyond);
  ASSERT_FALSE(v.coverage.worst.empty());
  EXPECT_NEAR(v.coverage.worst[0].error, v.coverage.farthestPx, 1e-6);
}

TEST_F(VerifySphere, NormalsTurnedByHalfADegreeAreMeasured) {
  const double angle = radians(0.5);
  measured.normal = imageOf(truth, 3, [&](std::size_t i) {
    const Vec3 n = truth.normal[i], across = unit(glm::cross(n, Vec3(1, 2, 3)));
    return std::cos(angle) * n + std::sin(angle) * across;
  });
  const Verification v = judged();
  // A unit vector of floats is off by up to 6e-8 rad per component: 1e-5 degrees.
  EXPECT_NEAR(v.normalDegrees.rms, 0.5, 1e-5);
  EXPECT_NEAR(v.normalDegrees.p999, 0.5, 1e-5);
  EXPECT_NEAR(v.normalDegrees.max, 0.5, 1e-5);
  EXPECT_LT(v.normalDegreesInside.pixels, v.normalDegrees.pixels);
  EXPECT_GT(v.normalDegreesInside.pixels, v.normalDegrees.pixels * 8 / 10);
}

// Along a unit sphere's circle of latitude a step of u turns by 2 pi times as much.
TEST_F(VerifySphere, OnePixelsParametersAreFoundAndNamed) {
  const float step = 0.001F;
  const std::size_t i = indexOf(43, 30);
  measured.uv.samples()[3 * i] += step;
  const Verification v = judged({.worst = 2});
  const Vec3 n = truth.normal[i];
  const double inSpace = kTau * step * std::hypot(n.x, n.z) / kPixel;
  EXPECT_NEAR(v.parameterPx.max, inSpace, 1e-4 * inSpace);
  // On the screen only what is not along the view ray counts: the tangent is (n.z, 0, -n.x) of n's
  // horizontal.
  const double onScreen = kTau * step * n.z / kPixel;
  EXPECT_NEAR(v.positionPx.max, onScreen, 1e-3 * onScreen);
  EXPECT_LT(v.positionPx.p999, 1e-4);
  ASSERT_EQ(v.positionPx.worst.size(), 2U);
  const Offence& worst = v.positionPx.worst[0];
  EXPECT_EQ(worst.x, 43);
  EXPECT_EQ(worst.y, 30);
  EXPECT_EQ(worst.measuredNode, 1U);
  EXPECT_EQ(worst.error, v.positionPx.max);
  EXPECT_NEAR(worst.measuredParameters.x - worst.trueParameters.x, step, 1e-6);
  EXPECT_EQ(v.pointPx.max, v.pointPx.floor) << "the other outputs are as they were";
}

TEST(Verify, ATexturesColourIsWrongBeyondACode) {
  Scene scene = sceneOf(sphere(1));
  Image squares(8, 8, 1);
  for (int i = 0; i < 64; ++i)
    squares.samples()[static_cast<std::size_t>(i)] = (i + i / 8) % 2 != 0 ? 0.9f : 0.2f;
  scene.add(Node{.surface = sphere(1.1),
                 .material = scene.add(Material{
                     .diffuse = Vec3(1),
                     .map = {.texture = std::make_shared<const Texture>(makeTexture(squares, "squares"))}})});
  const Snapshot snapshot = takeSnapshot(scene, 0, kVerifiedSize);
  const ReferencePicture truth = castPicture(snapshot);
  MeasuredPicture measured = roundedTo32Bits(truth);
  const auto wrongWith = [&](float more) {
    measured.color = truth.color;
    for (const int x : {35, 40, 45}) measured.color.pixel(x, 30)[1] += more;
    return verify(snapshot, truth, measured).wrong;
  };
  EXPECT_EQ(wrongWith(0).total(), 0U);
  EXPECT_EQ(wrongWith(0.5f / 255).total(), 0U);
  EXPECT_EQ(wrongWith(1.5f / 255).light, 3U);
}

// With no shadow and no texture to blame: a side that is lit for the other, say.
TEST_F(VerifySphere, AColourThatNothingNearbyHasIsWrongBeyondACode) {
  for (const float more : {0.5f / 255, 1.5f / 255, -1.5f / 255}) {
    measured.color = truth.color;
    for (float& channel : measured.color.pixel(40, 30)) channel += more;
    const WrongPixels wrong = judged().wrong;
    const bool isWrong = std::abs(more) > 1.0f / 255;
    EXPECT_EQ(wrong.total(), isWrong ? 1U : 0U) << more;
    EXPECT_EQ(wrong.color, isWrong ? 1U : 0U) << more;
    EXPECT_EQ(judged({.colors = false}).wrong.total(), 0U);
    // Of meshes the truth knows no colour.
    EXPECT_EQ(judged({.shading = Shading::Phong}).wrong.total(), 0U);
  }
}

TEST_F(VerifySphere, ADroppedPixelIsMissingAsFarAsTheSilhouetteIs) {
  const int x = 40, y = 12;  // 17.5 px above the middle
  measured.id.samples()[indexOf(x, y)] = 0;
  const Verification v = judged();
  EXPECT_EQ(v.coverage.missing, 1U);
  EXPECT_EQ(v.coverage.mismatches(), 1U);
  EXPECT_EQ(v.coverage.beyond, 1U);
  const double distance = kRadiusPx - radiusPx(x, y);
  ASSERT_LT(distance, 4);
  EXPECT_NEAR(v.coverage.farthestPx, distance, 0.01 * distance);
  EXPECT_EQ(v.coverage.worst[0].mismatch, Mismatch::Missing);
  EXPECT_EQ(v.coverage.worst[0].x, x);
  EXPECT_EQ(v.positionPx.pixels, truth.hits - 1);
  EXPECT_TRUE(std::isinf(v.positionMap.pixel(x, y)[0]));

  measured.id.samples()[indexOf(40, 30)] = 0;  // in the middle: no silhouette near
  EXPECT_EQ(judged().coverage.farthestPx, 4);
  EXPECT_EQ(judged({.farthestPx = 2.5}).coverage.farthestPx, 2.5);
  const Verification counted = judged({.silhouettes = false});
  EXPECT_EQ(counted.coverage.missing, 2U);
  EXPECT_EQ(counted.coverage.farthestPx, 0);
  EXPECT_EQ(counted.coverage.beyond, 0U);
}

TEST_F(VerifySphere, ASpeckOutsideIsExtra) {
  const int x = 40, y = 8;
  measured.id.samples()[indexOf(x, y)] = 1;
  const Verification v = judged();
  EXPECT_EQ(v.coverage.extra, 1U);
  EXPECT_EQ(v.coverage.mismatches(), 1U);
  const double distance = radiusPx(x, y) - kRadiusPx;
  ASSERT_GT(distance, 1);
  EXPECT_NEAR(v.coverage.farthestPx, distance, 0.01 * distance);
}

// The inside of the far half, as if the near one had been lost: no place in the picture shows that.
TEST_F(VerifySphere, TheFarSideIsAnotherLayer) {
  Camera cut = straightOn();
  cut.near = 5.0;
  measured = roundedTo32Bits(castPicture(takeSnapshot(sceneOf(sphere(1)), 0, kVerifiedSize, cut)));
  const Verification v = judged();
  EXPECT_EQ(v.coverage.both, 0U);
  EXPECT_EQ(v.coverage.wrongLayer, truth.hits);
  EXPECT_EQ(v.coverage.mismatches(), truth.hits);
  EXPECT_EQ(v.coverage.farthestPx, 4);
  EXPECT_EQ(v.positionPx.pixels, 0U);
}

// x = u^3 - u seen along y = u: the upper sheet, u > 1/sqrt(3), ends in a fold at x = -2 / sqrt(27); beyond
// it the lower one is seen.
TEST(Verify, TheDistanceOfAWrongLayerIsThatOfItsFold) {
  Scene scene =
      sceneOf(surface([](auto u, auto v) { return point(u * u * u - u, u, v); }, {{-1.5, 1.5}, {-1, 1}}));
  const Camera above{.eye = Vec3(0, 5, 0),
                     .lookAt = Vec3(0),
                     .up = Vec3(0, 0, -1),
                     .projection = Projection::Orthographic,
                     .height = kHeight};
  const Snapshot snapshot = takeSnapshot(scene, 0, kVerifiedSize, above);
  const ReferencePicture truth = castPicture(snapshot);
  MeasuredPicture measured = roundedTo32Bits(truth);
  EXPECT_EQ(verify(snapshot, truth, measured).coverage.mismatches(), 0U);

  const int y = 30;
  const double fold = 40 - 2 / std::sqrt(27.0) / kPixel;  // pixels
  const int x = static_cast<int>(std::floor(fold)) + 2;
  const double sheetX = (x + 0.5 - 40) * kPixel;
  double lower = -1.2;  // the root below the fold, by Newton
  for (int k = 0; k < 30; ++k) lower -= (lower * lower * lower - lower - sheetX) / (3 * lower * lower - 1);
  ASSERT_GT(truth.parameters[indexOf(x, y)].x, 0);
  measured.uv.pixel(x, y)[0] = static_cast<float>(lower);
  const Verification v = verify(snapshot, truth, measured);
  EXPECT_EQ(v.coverage.wrongLayer, 1U);
  EXPECT_EQ(v.coverage.mismatches(), 1U);
  EXPECT_NEAR(v.coverage.farthestPx, x + 0.5 - fold, 0.01 * (x + 0.5 - fold));
}

/// Mismatches of a picture that shows the lower of two sheets, `apart` metres below the upper one.
std::uint64_t mismatchesOfTheLower(double apart, const Camera& above) {
  Scene scene = sceneOf(rectangle(1, 1));
  scene.add(Node{.translation = Vec3(0, -apart, 0), .surface = rectangle(1, 1)});
  const Snapshot snapshot = takeSnapshot(scene, 0, kVerifiedSize, above);
  const ReferencePicture truth = castPicture(snapshot);
  MeasuredPicture measured = roundedTo32Bits(truth);
  for (float& number : measured.id.samples())
    if (number == 1) number = 2;
  return verify(snapshot, truth, measured).coverage.mismatches();
}

TEST(Verify, LayersThatTouchWithinAPointsToleranceAreOne) {
  const Camera above{.eye = Vec3(0, 5, 0),
                     .lookAt = Vec3(0),
                     .up = Vec3(0, 0, -1),
                     .projection = Projection::Orthographic,
                     .height = kHeight};
  EXPECT_EQ(mismatchesOfTheLower(0.9 * kPointPx * kPixel, above), 0U);
  EXPECT_EQ(mismatchesOfTheLower(1.1 * kPointPx * kPixel, above), 400U);  // 1 metre, 20 pixels
}

// A float of the depth buffer is 2^-24 to 2^-23 of it: 6e-5 to 1.2e-4 m at 1000 m, where a thousandth of a
// pixel is 5e-5 m.
TEST(Verify, LayersThatTheDepthBufferDoesNotTellApartAreOne) {
  const Camera above{
      .eye = Vec3(0, 1000, 0), .lookAt = Vec3(0), .up = Vec3(0, 0, -1), .fovY = kHeight / 1000, .near = 0.1};
  EXPECT_EQ(mismatchesOfTheLower(2 * 0x1p-24 * 1000, above), 0U);
  EXPECT_GT(mismatchesOfTheLower(5 * 0x1p-24 * 1000, above), 390U);
}

// A big and a small ball: a pixel of the small one that shows the big one is as wrong as it is far from the
// small one's edge.
TEST(Verify, AnotherNodeIsAMismatch) {
  Scene scene = sceneOf(sphere(1));
  scene.add(Node{.translation = Vec3(0, 0, 2), .surface = sphere(0.3)});
  const Snapshot snapshot = takeSnapshot(scene, 0, kVerifiedSize);
  const ReferencePicture truth = castPicture(snapshot);
  MeasuredPicture measured = roundedTo32Bits(truth);
  const int x = 40, y = 26;
  ASSERT_EQ(truth.number[indexOf(x, y)], 2U);
  measured.id.pixel(x, y)[0] = 1;
  const Verification v = verify(snapshot, truth, measured);
  EXPECT_EQ(v.coverage.wrongNode, 1U);
  const double distance = 0.3 / kPixel - radiusPx(x, y);
  EXPECT_NEAR(v.coverage.farthestPx, distance, 0.01 * distance);
  EXPECT_EQ(v.coverage.worst[0].measuredNode, 1U);
  EXPECT_EQ(v.coverage.worst[0].trueNode, 2U);

  measured.id.pixel(x, y)[0] = 77;  // no such node
  EXPECT_EQ(verify(snapshot, truth, measured).coverage.farthestPx, 4);
}

// At depth 4 with the near plane at 0.5 the buffer holds 1/8, whose last place is 2^-26: 2^-26 * 4^2 / 0.5
// metres.
TEST(Verify, DepthIsMeasuredInUnitsOfTheReversedBuffer) {
  Scene scene = sceneOf(rectangle(20, 20));
  const Snapshot snapshot =
      takeSnapshot(scene, 0, kVerifiedSize, Camera{.eye = Vec3(0, 4, 0), .lookAt = Vec3(0), .near = 0.5});
  const ReferencePicture truth = castPicture(snapshot);
  MeasuredPicture measured = roundedTo32Bits(truth);
  const double ulp = 0x1p-26 * 16 / 0.5;
  const float middle = measured.depth.pixel(40, 30)[0];
  ASSERT_NEAR(middle, 4, 1e-6);
  measured.depth.pixel(40, 30)[0] = static_cast<float>(middle + 3 * ulp);
  // The float of the truth may be half of its own last place, 2^-22, off: 2^-22 / 2^-21 = 1/2.
  EXPECT_NEAR(verify(snapshot, truth, measured).depthUlp.max, 3, 0.5);
  EXPECT_LE(verify(snapshot, truth, roundedTo32Bits(truth)).depthUlp.max, 1);
}

TEST_F(VerifySphere, LightIsMeasuredWhereThereIsNoSilhouette) {
  for (float& sample : measured.color.samples()) sample += 0.01F;
  const Verification v = judged();
  EXPECT_NEAR(v.color.psnrLinear, 40, 1e-4);  // -20 log10(0.01)
  EXPECT_LT(v.color.psnrSrgb, v.color.psnrLinear) << "the curve is steep where it is dark";
  EXPECT_EQ(v.color.differing8, 80U * 60U);
  EXPECT_NEAR(v.color.differing8Part, 80.0 * 60 / static_cast<double>(truth.hits), 1e-12);
  EXPECT_NEAR(v.color.difference.max, 0.01, 1e-7);
  EXPECT_GT(v.color.flipMean, 0);

  // Wrong at silhouettes alone: the picture is, its light is not.
  measured = roundedTo32Bits(truth);
  std::uint64_t changed = 0;
  for (int y = 0; y < kVerifiedSize.height; ++y)
    for (int x = 0; x < kVerifiedSize.width; ++x)
      if (std::abs(radiusPx(x, y) - kRadiusPx + 0.3) < 0.3) measured.color.pixel(x, y)[0] = 1, ++changed;
  const Verification edges = judged();
  EXPECT_TRUE(std::isinf(edges.color.psnrLinear));
  EXPECT_EQ(edges.color.differing8, changed);
}

// Two pixels across are all silhouette.
TEST(Verify, WithNoPixelOffTheSilhouettesNoLightIsWrong) {
  const Scene scene = sceneOf(cylinder(0.03, 2));
  const Snapshot snapshot = takeSnapshot(scene, 0, kVerifiedSize);
  const ReferencePicture truth = castPicture(snapshot);
  const Verification v = verify(snapshot, truth, roundedTo32Bits(truth));
  EXPECT_GT(v.coverage.both, 0U);
  EXPECT_EQ(v.color.pixels, 0U);
  EXPECT_TRUE(std::isinf(v.color.psnrLinear) && v.color.psnrLinear > 0);
}

TEST_F(VerifySphere, WhatIsNotANumberIsNeverRight) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  measured.uv.pixel(40, 30)[0] = nan;
  measured.normal.pixel(41, 30)[1] = nan;
  measured.color.pixel(42, 30)[2] = nan;
  const Verification v = judged();
  EXPECT_EQ(v.nanPixels, 3U);
  EXPECT_EQ(v.coverage.wrongLayer, 1U);
  EXPECT_TRUE(std::isinf(v.normalDegrees.max));
  EXPECT_FALSE(std::isinf(v.normalDegrees.p99));
  EXPECT_TRUE(std::isinf(v.color.difference.max));
}

TEST_F(VerifySphere, ChosenPixelsAreJudgedAsInTheWholePicture) {
  measured =
      roundedTo32Bits(castPicture(takeSnapshot(sceneOf(sphere(1)), 0, kVerifiedSize, straightOn(0.1))));
  const std::vector<std::uint32_t> chosen = spreadPixels(kVerifiedSize, 500);
  const ReferencePicture part = castPicture(snapshot, {.pixels = withNeighbours(kVerifiedSize, chosen)});
  EXPECT_LT(part.hits + part.misses, truth.hits + truth.misses);
  const Verification whole = judged();
  const Verification some = verify(snapshot, part, measured, {.pixels = chosen});
  EXPECT_EQ(some.coverage.compared, chosen.size());
  EXPECT_NEAR(some.positionPx.max, 0.1, 1e-5);
  EXPECT_FALSE(some.color.flipMean.has_value());
  for (const std::uint32_t i : chosen)
    EXPECT_EQ(some.positionMap.samples()[i], whole.positionMap.samples()[i]);
}

TEST_F(VerifySphere, ThreadsChangeNothing) {
  measured =
      roundedTo32Bits(castPicture(takeSnapshot(sceneOf(sphere(1)), 0, kVerifiedSize, straightOn(0.3))));
  const Verification one = judged({.threads = 1}), two = judged({.threads = 2});
  EXPECT_EQ(one.positionPx.rms, two.positionPx.rms);
  EXPECT_EQ(one.coverage.farthestPx, two.coverage.farthestPx);
  EXPECT_EQ(one.color.psnrSrgb, two.color.psnrSrgb);
}

TEST_F(VerifySphere, RefusesPicturesOfAnotherSize) {
  measured.uv = Image(kVerifiedSize.width, kVerifiedSize.height + 1, 3);
  EXPECT_THROW(static_cast<void>(judged()), Error);
  measured.uv = Image();
  EXPECT_THROW(static_cast<void>(judged()), Error) << "needed";
  measured = roundedTo32Bits(truth);
  measured.depth = Image();
  EXPECT_EQ(judged().depthUlp.pixels, 0U) << "not needed";
}

TEST(SpreadPixels, FillTheQuartersEvenlyAndAreAscending) {
  const std::vector<std::uint32_t> pixels = spreadPixels({200, 100}, 1000);
  EXPECT_LE(pixels.size(), 1000U);
  EXPECT_GT(pixels.size(), 950U) << "few fall on the same pixel";
  EXPECT_TRUE(std::is_sorted(pixels.begin(), pixels.end()));
  int counts[4] = {};
  for (const std::uint32_t p : pixels) ++counts[(p % 200 < 100 ? 0 : 1) + (p / 200 < 50 ? 0 : 2)];
  for (const int count : counts) EXPECT_NEAR(count, 250, 15);
  EXPECT_EQ(spreadPixels({20, 10}, 1'000'000'000).size(), 200U);
}

TEST(ErrorHeat, ShowsDecadesMismatchesAndALegend) {
  Image map(300, 4, 1);
  std::ranges::fill(map.samples(), -1.0F);
  map.pixel(0, 0)[0] = 1e-5F;
  map.pixel(1, 0)[0] = 1e-2F;
  map.pixel(2, 0)[0] = 7;
  map.pixel(10, 2)[0] = std::numeric_limits<float>::infinity();
  const Image heat = errorHeat(map);
  EXPECT_EQ(heat.width(), 300);
  EXPECT_GT(heat.height(), 4 + 10);
  const auto lightness = [&](int x, int y) {
    return std::midpoint(heat.pixel(x, y)[0], heat.pixel(x, y)[1]);
  };
  EXPECT_LT(lightness(0, 0), lightness(1, 0));
  EXPECT_LT(lightness(1, 0), lightness(2, 0));
  EXPECT_EQ(heat.pixel(10, 2)[1], 1) << "white";
  EXPECT_EQ(heat.pixel(11, 3)[0], 1) << "in a red frame";
  EXPECT_EQ(heat.pixel(11, 3)[1], 0);
  EXPECT_LT(lightness(60, 5), lightness(240, 5)) << "the ramp of the legend";
}

}  // namespace
}  // namespace luxo
