// SPDX-License-Identifier: Apache-2.0
// ST-19 to 21: eyes inside of things, and things that reach past the eye and far out of the picture.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "reference/caster.h"
#include "stability/cases.h"
#include "stability/pictures.h"
#include "surface/library.h"

namespace luxo {
namespace {

// ST-19 -----------------------------------------------------------------------------------------------------

/// In units of the last place of a reversed depth buffer in float, near / z.
double depthUlps(double measured, double truth, double near) {
  const double ulp = std::ldexp(1.0, std::ilogb(near / truth) - 23);
  return std::abs(near / measured - near / truth) / ulp;
}

struct Inside {
  double empty = 0, nans = 0, ulps = 0;
};

Inside seenFromInside(StressContext& context, const Surface& surface, const Camera& camera) {
  const Snapshot snapshot = takeSnapshot(sceneOf(surface), 0, context.size(), camera);
  const Image depth = context.draw(snapshot, {.output = Output::Depth}).image;
  Inside seen;
  seen.empty = emptyCount(context.draw(snapshot, {.output = Output::Id}).image);
  seen.nans = nanCount(context.draw(snapshot).image) + nanCount(depth);
  const reference::Caster caster(snapshot);
  // Every eighth pixel each way: depths are smooth, rays take their time.
  for (int y = 4; y < depth.height(); y += 8)
    for (int x = 4; x < depth.width(); x += 8) {
      const auto sight = caster.look(caster.rayThrough(x + 0.5, y + 0.5));
      if (sight.hits.empty()) continue;
      const double truth = glm::dot(sight.hits.front().position - snapshot.view.eye, snapshot.view.forward());
      const double ulps = depthUlps(depth.pixel(x, y)[0], truth, snapshot.view.near);
      if (!(ulps <= seen.ulps)) seen.ulps = ulps;
    }
  return seen;
}

std::vector<Measurement> eyeInside(StressContext& context) {
  std::vector<Measurement> measurements;
  const auto add = [&](const char* name, const Surface& surface, const Camera& camera) {
    const Inside seen = seenFromInside(context, surface, camera);
    measurements.push_back(none(fmt::format("{}: pixels not covered", name), seen.empty, "pixels"));
    measurements.push_back(none(fmt::format("{}: NaN samples", name), seen.nans));
    measurements.push_back(atMost(fmt::format("{}: depth", name), seen.ulps, 4, "ulp"));
  };
  add("in a sphere", sphere(1), {.eye = Vec3(0.3, -0.2, 0.1), .lookAt = Vec3(1, 0.5, 0.7)});
  add("in a torus' tube", torus(1, 0.4),
      {.eye = Vec3(1.05, 0.1, 0), .lookAt = Vec3(0.9, 0, -1), .near = 0.05});
  return measurements;
}

// ST-20 -----------------------------------------------------------------------------------------------------

struct Plate {
  Vec3 center{0};
  Mat3 turn{1};  ///< normal: its +Y
  Vec2 size{1};

  [[nodiscard]] bool holds(const PixelRay& ray, double nearest) const {
    const double slope = glm::dot(ray.direction, turn[1]);
    if (slope == 0) return false;
    const double depth = glm::dot(center - ray.origin, turn[1]) / slope;
    if (depth < nearest) return false;
    const Vec3 q = ray.at(depth) - center;
    return std::abs(glm::dot(q, turn[0])) <= size.x / 2 && std::abs(glm::dot(q, turn[2])) <= size.y / 2;
  }
};

Scene sceneOf(const Plate& plate, const Rotation& rotation) {
  Scene scene = sceneOf(rectangle(plate.size.x, plate.size.y));
  Node node = scene[NodeId{0}];
  node.translation = plate.center;
  node.rotation = rotation;
  scene.set(NodeId{0}, node);
  return scene;
}

/// A plate that reaches past the eye, which is at the origin and looks along -Z.
std::pair<Plate, Rotation> anyPlate(std::mt19937& random) {
  const auto number = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  for (;;) {
    const Rotation rotation{unit(Vec3(number(-1, 1), number(-1, 1), number(-1, 1))), number(0, kTau)};
    const Plate plate{Vec3(number(-1, 1), number(-1, 1), number(-1, 1)),
                      luxo::rotation(rotation.axis, rotation.angle),
                      {number(3, 9), number(3, 9)}};
    const double offEye = std::abs(glm::dot(plate.center, plate.turn[1]));
    if (offEye > 0.1 && offEye < 1) return {plate, rotation};
  }
}

double wrongPlates(StressContext& context, Shading shading, int count) {
  std::mt19937 random(20);  // NOLINT: the same numbers every time
  double wrong = 0;
  for (int i = 0; i < count; ++i) {
    const auto [plate, rotation] = anyPlate(random);
    const Camera camera{.eye = Vec3(0), .lookAt = Vec3(0, 0, -1), .fovY = radians(90)};
    const Snapshot snapshot = takeSnapshot(sceneOf(plate, rotation), 0, context.size(), camera);
    const Image id = context.renderer().render(snapshot, {.shading = shading, .output = Output::Id}).image;
    wrong += misclassified(
        id,
        [&, &plate = plate](const Vec2& pixel) { return plate.holds(rayThrough(snapshot.view, pixel), 0.1); },
        kSnapPx);
  }
  return wrong;
}

std::vector<Measurement> pastTheEye(StressContext& context) {
  const int plates = context.of(30, 10);
  return {
      none("triangles: pixels wrong beyond 1/128 px", wrongPlates(context, Shading::Flat, plates), "pixels"),
      none(fmt::format("{}: pixels wrong beyond 1/128 px", nameOf(context.shading())),
           wrongPlates(context, context.shading(), plates), "pixels")};
}

// ST-21 -----------------------------------------------------------------------------------------------------

/// The half plane on one side of a line that leaves the picture's middle `offset` pixels aside, as a plate of
/// a certain size in pixels. The camera shows a metre as a pixel.
double halfPlane(StressContext& context, Shading shading, double angle, double offset, double side) {
  const Mat3 inPlane = rotation({0, 0, 1}, angle);
  const Vec3 center = inPlane * Vec3(side / 2 + offset, 0, 0);
  // The plate's normal +Y to the viewer, then turned in the picture's plane.
  const Mat3 facing = rotation({1, 0, 0}, kPi / 2);
  const Plate plate{center, inPlane * facing, {side, side}};
  Scene scene;
  scene.set(plainSettings());
  const NodeId turned = scene.add(Node{.rotation = Rotation{{0, 0, 1}, angle}});
  scene.add(Node{.parent = turned,
                 .translation = Vec3(side / 2 + offset, 0, 0),
                 .rotation = Rotation{{1, 0, 0}, kPi / 2},
                 .surface = rectangle(side, side)});
  const PixelSize size = context.size();
  const Camera camera{
      .eye = Vec3(0, 0, 5), .projection = Projection::Orthographic, .height = double(size.height)};
  const Snapshot snapshot = takeSnapshot(scene, 0, size, camera);
  const Image id = context.renderer().render(snapshot, {.shading = shading, .output = Output::Id}).image;
  return misclassified(
      id, [&, &plate = plate](const Vec2& pixel) { return plate.holds(rayThrough(snapshot.view, pixel), 0); },
      kSnapPx);
}

std::vector<Measurement> guardBand(StressContext& context) {
  std::vector<Measurement> measurements;
  for (const Shading shading : {Shading::Flat, context.shading()})
    for (const auto& [name, angle] : {std::pair("upright", 0.0), std::pair("slanted", 0.5)}) {
      double clipped = 0, far = 0;
      for (const double offset : {0.1, 17.3, -100.7}) {
        clipped += halfPlane(context, shading, angle, offset, std::exp2(11));
        far += halfPlane(context, shading, angle, offset, std::exp2(21));
      }
      measurements.push_back(
          none(fmt::format("{}, {}, vertices to 2^10 px: wrong beyond 1/128 px", nameOf(shading), name),
               clipped, "pixels"));
      measurements.push_back(
          none(fmt::format("{}, {}, vertices to 2^20 px: wrong beyond 1/128 px", nameOf(shading), name), far,
               "pixels"));
    }
  return measurements;
}

}  // namespace

std::vector<StressCase> rasterisationCases() {
  return {{"ST-19", "the eye inside of a sphere and of a torus", eyeInside},
          {"ST-20", "plates that reach past the eye", pastTheEye},
          {"ST-21", "vertices a million pixels away", guardBand}};
}

}  // namespace luxo
