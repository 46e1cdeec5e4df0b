// SPDX-License-Identifier: Apache-2.0
// ST-01 to 04: where a parameterisation has no tangent plane of its own.
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "reference/caster.h"
#include "stability/cases.h"
#include "stability/pictures.h"
#include "surface/bezier.h"
#include "surface/library.h"
#include "surface/teapot.h"

namespace luxo {
namespace {

constexpr double kMaxDegrees = 0.01;

/// Pixels of a picture of an odd side have one centre in the very middle, where the singular point is; an
/// even one has none.
std::vector<PixelSize> oddAndEven(const StressContext& context) {
  const PixelSize even = context.size();
  return {even, {even.width - 1, even.height - 1}};
}

/// The outputs of a scene with one node, seen by a camera.
struct Outputs {
  Snapshot snapshot;
  Image color, normal, id;

  Outputs(StressContext& context, const Scene& scene, const Camera& camera, PixelSize size)
      : snapshot(takeSnapshot(scene, 0, size, camera)),
        color(context.draw(snapshot).image),
        normal(context.draw(snapshot, {.output = Output::Normal}).image),
        id(context.draw(snapshot, {.output = Output::Id}).image) {}

  [[nodiscard]] double nans() const { return nanCount(color) + nanCount(normal); }
};

/// Calls visit(x, y, distance) for the pixels whose centres are from `least` to `most` from the middle.
template <class Visit>
void forEachAround(PixelSize size, double least, double most, const Visit& visit) {
  const Vec2 middle = Vec2(size.width, size.height) / 2.0;
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      const double distance = glm::length(centerOf(x, y) - middle);
      if (distance >= least && distance <= most) visit(x, y, distance);
    }
}

/// Largest, NaN counting as infinite.
void raise(double& worst, double value) {
  if (!(value <= worst)) worst = std::isnan(value) ? std::numeric_limits<double>::infinity() : value;
}

// ST-01. The unit sphere's normal is its own point.
std::vector<Measurement> spherePoles(StressContext& context) {
  const Scene scene = sceneOf(sphere(1));
  double worst = 0, nans = 0;
  for (const PixelSize size : oddAndEven(context))
    for (const double side : {1.0, -1.0}) {
      const Outputs out(context, scene, {.eye = Vec3(0, 4 * side, 0)}, size);
      nans += out.nans();
      forEachAround(size, 0, 3, [&](int x, int y, double) {
        const PixelRay ray = rayThrough(out.snapshot.view, centerOf(x, y));
        const double a = glm::dot(ray.direction, ray.direction), b = glm::dot(ray.origin, ray.direction);
        const Vec3 truth = ray.at((-b - std::sqrt(b * b - a * (glm::dot(ray.origin, ray.origin) - 1))) / a);
        raise(worst, degreesBetween(colorAt(out.normal, x, y), truth));
      });
    }
  return {atMost("normals within 3 px of the poles", worst, kMaxDegrees, "deg"), none("NaN samples", nans)};
}

// ST-02. From above the apex a cone's normal depends on the direction around the middle alone, and its
// outline is a circle.
std::vector<Measurement> coneApex(StressContext& context) {
  constexpr double kConeHeight = 2, kEye = 6;
  const Scene scene = sceneOf(cone(1, 0, kConeHeight));
  double worst = 0, nans = 0, wrong = 0;
  for (const PixelSize size : oddAndEven(context)) {
    const Outputs out(context, scene, {.eye = Vec3(0, kEye, 0)}, size);
    const double outline = out.snapshot.view.pixelsPerUnit / kEye;
    nans += out.nans();
    // The last pixel before the outline may lie on either side of it.
    forEachAround(size, 1, outline - 0.01, [&](int x, int y, double) {
      const Vec3 d = rayThrough(out.snapshot.view, centerOf(x, y)).direction;
      const Vec3 truth = Vec3(0, 1, 0) + kConeHeight * unit(Vec3(d.x, 0, d.z));
      raise(worst, degreesBetween(colorAt(out.normal, x, y), truth));
    });
    forEachAround(size, 0, size.width, [&](int x, int y, double distance) {
      const bool covered = out.id.pixel(x, y)[0] != 0;
      if (covered ? distance > outline + 0.01 : distance < outline - 0.01) ++wrong;
    });
  }
  return {atMost("normals from 1 px off the apex", worst, kMaxDegrees, "deg"), none("NaN samples", nans),
          none("coverage wrong beyond 0.01 px", wrong, "pixels")};
}

/// Pixels darker than nine tenths of the darkest of their neighbours where the surface is not as dark.
double darkPixels(const Image& color, const reference::Caster& caster) {
  const auto shown = [&](int x, int y) { return colorAt(color, x, y).y; };
  const auto truth = [&](int x, int y) {
    const reference::Ray ray = caster.rayThrough(x + 0.5, y + 0.5);
    bool certified = true;
    return caster.color(ray, caster.look(ray), certified).y;
  };
  const auto isDark = [](const auto& shadeAt, int x, int y) {
    double least = std::numeric_limits<double>::infinity();
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx)
        if (dx != 0 || dy != 0) least = std::min<double>(least, shadeAt(x + dx, y + dy));
    return !(shadeAt(x, y) >= 0.9 * least);
  };
  double count = 0;
  for (int y = 1; y + 1 < color.height(); ++y)
    for (int x = 1; x + 1 < color.width(); ++x)
      if (isDark(shown, x, y) && !isDark(truth, x, y)) ++count;
  return count;
}

// ST-03. The top of the knob and the middle of the bottom, from close by.
std::vector<Measurement> teapotCollapses(StressContext& context) {
  constexpr double kPixelsPerMetre = 2e3, kDistance = 1;
  Scene scene;
  scene.add(Node{.surface = teapot(), .material = scene.add(Material{.specular = Vec3(0)})});
  const NodeId lamp = scene.add(Node{.light = Light{}});
  double worst = 0, nans = 0, dark = 0, empty = 0;
  for (const PixelSize size : oddAndEven(context))
    for (const double side : {1.0, -1.0}) {
      const double height = side > 0 ? kTeapotHeight : 0;
      const Vec3 eye(0, height + side * kDistance, 0);
      scene.set(lamp, Node{.translation = eye, .light = Light{}});
      const Camera camera{
          .eye = eye, .lookAt = Vec3(0, height, 0), .fovY = fovOf(size.height, kPixelsPerMetre * kDistance)};
      const Outputs out(context, scene, camera, size);
      nans += out.nans();
      empty += emptyCount(out.id);
      const reference::Caster caster(out.snapshot);
      dark += darkPixels(out.color, caster);
      forEachAround(size, 0, 1, [&](int x, int y, double distance) {
        const auto sight = caster.look(caster.rayThrough(x + 0.5, y + 0.5));
        const Vec3 truth = distance == 0 ? Vec3(0, side, 0) : sight.hits.at(0).normal;
        raise(worst, degreesBetween(colorAt(out.normal, x, y), truth));
      });
    }
  return {atMost("normals at the collapsed rows", worst, kMaxDegrees, "deg"), none("NaN samples", nans),
          none("pixels darker than 0.9 of their neighbours", dark, "pixels"), none("holes", empty, "pixels")};
}

/// A patch whose Su and Suv vanish at (0, 0), where z = 0 is its tangent plane all the same.
BezierPatch pinchedPatch() {
  BezierPatch patch;
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i) patch[4 * j + i] = {i, j, i == 3 || j == 3 ? 0.6 : 0.0};
  patch[1] = patch[0];  // Su = 3 (P10 - P00)
  patch[5] = patch[4];  // Suv = 9 (P11 - P10 - P01 + P00)
  return patch;
}

// ST-04
std::vector<Measurement> pinchedCorner(StressContext& context) {
  const Scene scene = sceneOf(bezier({pinchedPatch()}));
  const PixelSize size = oddAndEven(context)[1];
  const Camera camera{.eye = Vec3(0, 0, 5), .lookAt = Vec3(0)};
  const Outputs out(context, scene, camera, size);
  const FrameError error = context.draw(out.snapshot).statistics.error;
  const reference::Caster caster(out.snapshot);
  double worst = 0, notFinite = 0;
  forEachAround(size, 0.5, 12, [&](int x, int y, double) {
    if (out.id.pixel(x, y)[0] == 0) return;
    const auto sight = caster.look(caster.rayThrough(x + 0.5, y + 0.5));
    if (!sight.hits.empty())
      raise(worst, degreesBetween(colorAt(out.normal, x, y), sight.hits.front().normal));
  });
  for (const float sample : out.normal.samples())
    if (!std::isfinite(sample)) ++notFinite;
  return {none("samples of the normal that are not finite", notFinite),
          atLeast("pixels flagged: unconverged or uncertified",
                  static_cast<double>(error.unconvergedPx + error.uncertifiedPx), 1),
          atMost("normals around the corner", worst, 0.1, "deg")};
}

}  // namespace

std::vector<StressCase> parameterisationCases() {
  return {{"ST-01", "a sphere seen down its poles", spherePoles},
          {"ST-02", "a cone seen down its apex", coneApex},
          {"ST-03", "the teapot's collapsed rows", teapotCollapses},
          {"ST-04", "a Bezier corner where Su and Suv vanish", pinchedCorner}};
}

}  // namespace luxo
