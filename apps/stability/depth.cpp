// SPDX-License-Identifier: Apache-2.0
// ST-25 to 27: what hides what, and what is thinner than a pixel.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "reference/caster.h"
#include "stability/cases.h"
#include "stability/pictures.h"
#include "surface/library.h"

namespace luxo {
namespace {

// ST-25 -----------------------------------------------------------------------------------------------------

/// A plate that fills the picture at that depth, tilted about the horizontal axis. It faces the eye, which is
/// at the origin and looks along -Z.
Node plate(double depth, double tilt, MaterialId material) {
  return {.translation = Vec3(0, 0, -depth),
          .rotation = Rotation{{1, 0, 0}, kPi / 2 + tilt},
          .scale = Vec3(depth),
          .surface = rectangle(4, 4),
          .material = material};
}

/// Pixels that do not show the nearer one of two plates.
double wrongWinners(StressContext& context, double depth, double gap, double tilt) {
  Scene scene;
  scene.set(plainSettings());
  const MaterialId red = scene.add(glowing({1, 0, 0})), green = scene.add(glowing({0, 1, 0}));
  scene.add(plate(depth + gap, tilt, green));
  scene.add(plate(depth, tilt, red));
  const Image image = context.draw(scene, {.eye = Vec3(0), .lookAt = Vec3(0, 0, -1)});
  double wrong = 0;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x)
      if (colorAt(image, x, y) != Vec3(1, 0, 0)) ++wrong;
  return wrong;
}

std::vector<Measurement> depthLadder(StressContext& context) {
  const double f = context.size().height / (2 * std::tan(radians(20)));
  double frontal = 0, slanted = 0;
  for (int step = 0; step <= 12; ++step) {
    const double z = std::pow(10, step / 2.0), gap = 16 * std::exp2(-23) * z;
    frontal += wrongWinners(context, z, gap, 0);
    // A vertex that the raster moves by 1/512 px moves the depth of a plate of 45 degrees by z / (512 f).
    slanted += wrongWinners(context, z, std::max(gap, 4 * z / (512 * f)), kPi / 4);
  }
  return {none("frontal plates, 1 to 1e6 m: pixels of the farther one", frontal, "pixels"),
          none("plates at 45 degrees: pixels of the farther one", slanted, "pixels")};
}

// ST-26 -----------------------------------------------------------------------------------------------------

std::vector<Measurement> interpenetration(StressContext& context) {
  Scene scene;
  scene.add(Node{.surface = torus(1, 0.4)});
  scene.add(Node{.translation = Vec3(0.1, 0.05, 0.2), .surface = sphere(0.95)});
  const Camera camera{.eye = Vec3(1, 2.2, 2.6)};
  const Snapshot snapshot = takeSnapshot(scene, 0, context.size(), camera);
  const Image id = context.draw(snapshot, {.output = Output::Id}).image;
  const reference::Caster caster(snapshot);
  const auto numberAt = [&](const Vec2& pixel) -> float {
    const auto sight = caster.look(caster.rayThrough(pixel.x, pixel.y));
    return sight.hits.empty() ? 0 : static_cast<float>(snapshot.nodes[sight.hits.front().node].number);
  };
  double wrong = 0;
  for (int y = 0; y < id.height(); ++y)
    for (int x = 0; x < id.width(); ++x) {
      const float shown = id.pixel(x, y)[0];
      const auto isShown = [&](const Vec2& pixel) { return numberAt(pixel) == shown; };
      if (!couldBe(true, isShown, centerOf(x, y), 0.02)) ++wrong;
    }
  return {none("pixels of the other surface beyond 0.02 px of the border", wrong, "pixels")};
}

// ST-27 -----------------------------------------------------------------------------------------------------

/// The longest stretch of a circle around the picture's middle, in pixels along it, that no pixel within a
/// pixel of it shows anything of.
double longestGap(const Image& image, double radius) {
  const Vec2 middle = Vec2(image.width(), image.height()) / 2.0;
  const int steps = static_cast<int>(kTau * radius * 4);
  const auto seen = [&](const Vec2& place) {
    const int x = static_cast<int>(place.x), y = static_cast<int>(place.y);
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx)
        if (image.pixel(x + dx, y + dy)[0] > 0 && glm::length(centerOf(x + dx, y + dy) - place) <= 1)
          return true;
    return false;
  };
  int gap = 0, longest = 0;
  for (int i = 0; i < 2 * steps; ++i) {  // twice around: a gap may pass the start
    const double angle = kTau * i / steps;
    gap = seen(middle + radius * Vec2(std::cos(angle), std::sin(angle))) ? 0 : gap + 1;
    longest = std::max(longest, std::min(gap, steps));
  }
  return kTau * radius * longest / steps;
}

std::vector<Measurement> thinTorus(StressContext& context) {
  constexpr double kMajor = 1;
  const PixelSize size = context.size();
  // As wide in small pictures: where the tube is narrower than 256 samples lie apart, the samples have gaps.
  const double minor = 1e-4 * 1024 / size.height;
  const Camera camera{.eye = Vec3(0, 5, 0), .projection = Projection::Orthographic, .height = 2.5 * kMajor};
  const Snapshot snapshot = takeSnapshot(sceneOf(torus(kMajor, minor)), 0, size, camera);
  const Image image = context.draw(snapshot, {.samples = 256}).image;
  double energy = 0;
  for (const float sample : image.samples()) energy += sample / 3;
  const double scale = snapshot.view.pixelsPerUnit;
  const double area = 4 * kPi * kMajor * minor * scale * scale;
  return {atMost("light of the picture over that of the area, off by", std::abs(energy / area - 1), 0.02),
          atMost("longest gap", longestGap(image, kMajor * scale), 2, "px"),
          none("NaN samples", nanCount(image))};
}

}  // namespace

std::vector<StressCase> depthCases() {
  return {{"ST-25", "plates a few units of depth apart, from 1 to 1e6 m", depthLadder},
          {"ST-26", "where a sphere and a torus pass through each other", interpenetration},
          {"ST-27", "a torus of a tube of 1/12 pixel", thinTorus}};
}

}  // namespace luxo
