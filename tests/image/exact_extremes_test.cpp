// SPDX-License-Identifier: Apache-2.0
// Exact shading where a search has a hard time: the eye on a surface and inside its shell, surfaces seen from
// inside, holes in formulas, poles at the silhouette. Pictures are finite, and right wherever the answer is
// known.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "support/verified_picture.h"
#include "surface/catalogue.h"

namespace luxo::test {
namespace {

using ExactExtremes = VerifiedPictureTest;

constexpr PixelSize kExactExtremesSize{128, 96};
const Vec3 kShown(0, 1, 0);

Scene glowingScene(Surface surface) {
  Scene scene;
  scene.set(plainSettings());
  scene.add(Node{.surface = std::move(surface), .material = scene.add(glowing(kShown))});
  return scene;
}

/// Whether the pixel shows the surface; anything but the surface's colour and the background's is a failure.
bool shows(const Image& color, int x, int y) {
  const Vec3 c = colorAt(color, x, y);
  const bool green = near(c, kShown, 1e-6);
  EXPECT_TRUE(green || c == Vec3(0)) << x << ", " << y;
  return green;
}

/// Depth of every pixel against that of the first hit beyond the near plane; none: nothing may be shown.
/// `relative` bounds what single precision makes of it.
template <class DepthAt>
void expectDepths(const Image& depth, double relative, const DepthAt& depthAt) {
  for (int y = 0; y < kExactExtremesSize.height; ++y)
    for (int x = 0; x < kExactExtremesSize.width; ++x) {
      const std::optional<double> known = depthAt(centerOf(x, y));
      const double shown = depth.pixel(x, y)[0];
      const double wanted = known.value_or(std::numeric_limits<double>::infinity());
      ASSERT_TRUE(shown == wanted || std::abs(shown - wanted) <= relative * wanted)
          << x << ", " << y << " shows " << shown << " for " << wanted;
    }
}

TEST_F(ExactExtremes, EyeOnABall) {
  const Camera inward{.eye = Vec3(0, 0, 1), .lookAt = Vec3(0), .fovY = radians(60)};
  const Camera outward{.eye = Vec3(0, 0, 1), .lookAt = Vec3(0, 0, 2), .fovY = radians(60)};
  const Scene scene = glowingScene(sphere(1));
  // A chord from the pole is 2 cos(angle) long, and the angle is at most 36 degrees.
  expectDepths(draw(scene, inward, kExactExtremesSize, {.output = Output::Depth}).image, 1e-5,
               [&](const Vec2& pixel) {
                 const Vec3 d = CameraModel(inward, kExactExtremesSize).through(pixel).direction;
                 return std::optional(2 / glm::dot(d, d));
               });
  const Image color = draw(scene, inward, kExactExtremesSize).image;
  const Image nothing = draw(scene, outward, kExactExtremesSize).image;
  for (int y = 0; y < kExactExtremesSize.height; ++y)
    for (int x = 0; x < kExactExtremesSize.width; ++x) {
      ASSERT_TRUE(shows(color, x, y)) << x << ", " << y;
      ASSERT_FALSE(shows(nothing, x, y)) << x << ", " << y;
    }
}

TEST_F(ExactExtremes, EyeInsideTheShell) {
  const Scene scene = glowingScene(sphere(1));
  for (const double height : {0.05, 4e-3, 1e-3, 2e-4, -2e-4, -1e-3, -0.05}) {
    SCOPED_TRACE(height);
    const Camera camera{.eye = Vec3(0, 0, 1 + height), .lookAt = Vec3(0), .fovY = radians(60), .near = 1e-5};
    const CameraModel model(camera, kExactExtremesSize);
    const Picture depth = draw(scene, camera, kExactExtremesSize, {.output = Output::Depth});
    // Points are sums of floats up to 1, each rounded by 2^-24; seen from `height` above them that counts.
    const double relative = 1e-5 + 8 * 0x1p-24 / std::abs(height);
    expectDepths(depth.image, relative, [&](const Vec2& pixel) {
      const auto [first, second] = *hitSphere(model.through(pixel), Vec3(0), 1);
      return std::optional(first > 0 ? first : second);
    });
    EXPECT_TRUE(allFinite(draw(scene, camera, kExactExtremesSize).image));
  }
}

// Along the horizon a ray dips into the ball by less than the shell is thick.
TEST_F(ExactExtremes, HorizonFromInsideTheShell) {
  const Scene scene = glowingScene(sphere(1));
  const Camera camera{.eye = Vec3(0, 0, 1 + 2e-4),
                      .lookAt = Vec3(1, 0, 1 - 2e-2),
                      .up = Vec3(0, 0, 1),
                      .fovY = radians(8),
                      .near = 1e-5};
  const CameraModel model(camera, kExactExtremesSize);
  const Picture picture = draw(scene, camera, kExactExtremesSize);
  int covered = 0;
  for (int y = 0; y < kExactExtremesSize.height; ++y)
    for (int x = 0; x < kExactExtremesSize.width; ++x) {
      const auto roots = hitSphere(model.through(centerOf(x, y)), Vec3(0), 1);
      const bool hit = roots && roots->first > 0;
      ASSERT_EQ(shows(picture.image, x, y), hit) << x << ", " << y;
      covered += hit;
    }
  EXPECT_GT(covered, 1000);
  EXPECT_LT(covered, kExactExtremesSize.width * kExactExtremesSize.height - 1000);
}

TEST_F(ExactExtremes, TubeSeenFromInside) {
  const Scene scene = glowingScene(torus(1, 0.4));
  for (const Vec3& lookAt : {Vec3(1, 0, -1), Vec3(2, 0, 0), Vec3(1, 1, 0.1), Vec3(0, 0, 0)}) {
    const Camera camera{
        .eye = Vec3(1, 0, 0), .lookAt = lookAt, .up = Vec3(0.1, 0.9, 0.2), .fovY = radians(70)};
    const Picture picture = draw(scene, camera, kExactExtremesSize);
    for (int y = 0; y < kExactExtremesSize.height; ++y)
      for (int x = 0; x < kExactExtremesSize.width; ++x)
        ASSERT_TRUE(shows(picture.image, x, y)) << x << ", " << y;
    EXPECT_EQ(picture.statistics.error.unconvergedPx, 0u);
  }
}

TEST_F(ExactExtremes, PolesAtTheSilhouette) {
  const Scene scene = glowingScene(sphere(1));
  // Along the equator, with the poles at the outline's top and bottom, on a pixel's centre and off it.
  for (const double shift : {0.0, 0.003, 0.4}) {
    const Camera camera{.eye = Vec3(shift, 0, 5),
                        .lookAt = Vec3(shift, 0, 0),
                        .projection = Projection::Orthographic,
                        .height = 96 / 40.0};
    const CameraModel model(camera, kExactExtremesSize);
    const auto inside = [&](const Vec2& p) { return hitSphere(model.through(p), Vec3(0), 1).has_value(); };
    const Picture picture = draw(scene, camera, kExactExtremesSize);
    for (int y = 0; y < kExactExtremesSize.height; ++y)
      for (int x = 0; x < kExactExtremesSize.width; ++x)
        if (const auto known = settled(inside, centerOf(x, y), 0.01)) {
          ASSERT_EQ(shows(picture.image, x, y), *known) << x << ", " << y << ", shift " << shift;
        }
    // A ray that touches the outline in a pole meets a point with neither a slope nor a direction of u.
    EXPECT_LE(picture.statistics.error.unconvergedPx, 2u) << "there are two poles";
  }
}

TEST_F(ExactExtremes, FormulasWithHoles) {
  // A hemisphere as a graph: no value outside the unit circle, and no slope on it.
  const Surface dome =
      surface([](auto u, auto v) { return point(u, sqrt(1 - u * u - v * v), v); }, {{-1, 1}, {-1, 1}});
  // Infinite in the middle, and nothing to the left of it.
  const Surface pole = surface([](auto u, auto v) { return point(u, 0.1 / u, v); }, {{-1, 1}, {-1, 1}});
  const Surface half = surface([](auto u, auto v) { return point(u, 0.1 * log(u), v); }, {{-1, 1}, {-1, 1}});
  const Camera above{.eye = Vec3(0, 5, 0),
                     .lookAt = Vec3(0),
                     .up = Vec3(0, 0, -1),
                     .projection = Projection::Orthographic,
                     .height = 2.4};
  const CameraModel model(above, kExactExtremesSize);
  for (const Surface& surface : {dome, pole, half})
    for (const Camera& camera : {above, Camera{.eye = Vec3(1.5, 2, 3)}, Camera{.eye = Vec3(0, 0, 0.2)}})
      EXPECT_TRUE(allFinite(draw(glowingScene(surface), camera, kExactExtremesSize).image));

  const auto nowhere = [](auto u, auto v) { return point(u, sqrt(-1 - u * u), v); };
  EXPECT_THROW(draw(glowingScene(surface(nowhere, {{-1, 1}, {-1, 1}})), above, kExactExtremesSize), Error);

  const Image image = draw(glowingScene(dome), above, kExactExtremesSize).image,
              poles = draw(glowingScene(pole), above, kExactExtremesSize).image,
              halves = draw(glowingScene(half), above, kExactExtremesSize).image;
  for (int y = 0; y < kExactExtremesSize.height; ++y)
    for (int x = 0; x < kExactExtremesSize.width; ++x) {
      const Vec3 p = model.through(centerOf(x, y)).origin;
      const double radius = std::hypot(p.x, p.z);
      const bool shown = shows(image, x, y);
      ASSERT_TRUE(radius < 0.9 ? shown : radius < 1.001 || !shown) << x << ", " << y;
      // Both sides of the line where one is infinite, and one side of where the other ends.
      const bool inside = std::abs(p.x) < 0.99 && std::abs(p.z) < 0.99;
      if (inside && std::abs(p.x) > 0.05) {
        ASSERT_TRUE(shows(poles, x, y)) << x << ", " << y;
        ASSERT_EQ(shows(halves, x, y), p.x > 0) << x << ", " << y;
      }
    }
}

/// At a point of every named surface, looking along it, at it and away from it: the truth is seen.
TEST_F(ExactExtremes, EyeOnNamedSurfaces) {
  constexpr PixelSize kSmall{48, 36};
  std::uint64_t hits = 0, views = 0;
  for (const CatalogueEntry& entry : catalogue()) {
    Scene scene;
    scene.add(Node{.surface = makeSurface(entry.name)});
    addLight(scene, {.position = {3, 4, 5, 1}});
    const Surface& surface = scene.nodes()[0].node.surface;
    const Domain& domain = surface.domain();
    const Vec2 middle(domain.u.lo + 0.3 * domain.u.width(), domain.v.lo + 0.6 * domain.v.width());
    const Vec3 eye = surface.position(middle.x, middle.y);
    for (const Vec3& along : {Vec3(1, 0.1, 0.2), Vec3(-0.1, -1, 0.3), Vec3(0.2, 0.3, -1)}) {
      SCOPED_TRACE(entry.name);
      const Camera camera{.eye = eye, .lookAt = eye + along, .near = 1e-4};
      const Verified found = verified(takeSnapshot(scene, 0, kSmall, camera));
      const Verification& verification = found.verification;
      EXPECT_EQ(verification.nanPixels, 0U);
      EXPECT_EQ(verification.wrong.pixels.size(), 0U);
      EXPECT_LT(found.statistics.error.residualMaxPx.value_or(0), 1);
      hits += verification.coverage.both;
      ++views;
    }
  }
  // Of some surfaces nothing is seen from where they are looked away from.
  EXPECT_GT(hits, views * kSmall.width * kSmall.height / 4);
}

/// A torus whose formula is as much flattened as `undone` makes round again.
Surface flattenedTorus(const Vec3& undone) {
  return surface(
      [=](auto u, auto v) {
        const auto ring = 1 + 0.4 * cos(kTau * v);
        return point(ring * cos(kTau * u) / undone.x, 0.4 * sin(kTau * v) / undone.y,
                     -(ring * sin(kTau * u)) / undone.z);
      },
      {});
}

// The shell is as fine as that of what is seen, whatever shares of its proportions are the formula's and the
// transform's.
TEST_F(ExactExtremes, ScalesThatUndoTheFormulas) {
  const Camera camera{.eye = Vec3(2.2, 2.6, 2.9), .fovY = radians(40)};
  const auto shown = [&](const Vec3& undone, Output output) {
    Scene scene;
    scene.set(plainSettings());
    scene.add(Node{.rotation = Rotation{{1, 0, 0}, 0.3}, .scale = undone, .surface = flattenedTorus(undone)});
    return draw(scene, camera, kExactExtremesSize, {.output = output});
  };
  // Searched for by its formula, as those below: a torus by its equation has a coarser shell.
  const Picture round = shown(Vec3(1, 1, 1.01), Output::Normal);
  EXPECT_GT(std::ranges::count_if(round.image.samples(), [](float number) { return number != 0; }), 1000);
  for (const Vec3& undone : {Vec3(1e-6, 1, 1e6), Vec3(1e4, 1e-5, 3)}) {
    const Picture uneven = shown(undone, Output::Normal);
    // A factor of two is left of the scale, along either direction; GPUs are given what is hidden, too.
    EXPECT_LE(static_cast<double>(uneven.statistics.count.triangles),
              tolerance(4, 6) * static_cast<double>(round.statistics.count.triangles));
    EXPECT_LE(uneven.statistics.error.resolvedByRaysPx, 4U);
    EXPECT_EQ(uneven.statistics.error.unconvergedPx, 0U);
    // Where a ray grazes, a thousandth of a pixel turns the normal by this.
    for (int y = 0; y < kExactExtremesSize.height; ++y)
      for (int x = 0; x < kExactExtremesSize.width; ++x)
        EXPECT_TRUE(near(colorAt(uneven.image, x, y), colorAt(round.image, x, y), 2e-4)) << x << ", " << y;
  }
}

// Whether a surface is closed is found at time 0, whenever and at whatever scale it is first seen: a closed
// one shows its outside alone, and one that opens later is dark within.
TEST_F(ExactExtremes, ScalesThatUndoAFormulaThatOpensInTime) {
  const Camera camera{.eye = Vec3(2.2, 2.6, 2.9), .fovY = radians(40)};
  const auto shown = [&](const Vec3& undone, double time) {
    Scene scene;
    scene.set(plainSettings());
    const auto formula = [undone](auto u, auto v, auto turn) {
      const auto ring = 1 + 0.4 * cos(kTau * v);
      return point(ring * cos(turn * u) / undone.x, 0.4 * sin(kTau * v) / undone.y,
                   -(ring * sin(turn * u)) / undone.z);
    };
    const Animated<double> turn([](double t) { return kTau * (1 - 0.5 * t); });
    scene.add(Node{.scale = undone, .surface = surface(formula, {}, {}, turn)});
    scene.add(Node{.translation = Vec3(3, 5, 4), .light = Light{}});
    Renderer fresh(context());
    return fresh.render(takeSnapshot(scene, time, kExactExtremesSize, camera), {}).image;
  };
  for (const double time : {0.0, 0.7}) {
    const Image round = shown(Vec3(1), time), uneven = shown(Vec3(1e-6, 1, 1), time);
    const int different = differingPixels(uneven, round, 2e-4);
    EXPECT_LE(different, 4) << "at " << time;  // on the outline
  }
}

}  // namespace
}  // namespace luxo::test
