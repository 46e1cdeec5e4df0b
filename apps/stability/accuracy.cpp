// SPDX-License-Identifier: Apache-2.0
// ST-08 to 10: how far the points that are shown lie from where they are shown; near, far and edge-on.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "base/stopwatch.h"
#include "reference/caster.h"
#include "stability/cases.h"
#include "stability/pictures.h"
#include "surface/equation.h"
#include "surface/library.h"

namespace luxo {
namespace {

constexpr double kExactPx = 1e-3;

Image draw(StressContext& context, const Snapshot& snapshot, Output output) {
  return context.draw(snapshot, {.output = output}).image;
}

// ST-08 -----------------------------------------------------------------------------------------------------

/// A torus and a flag, each alone: a closed surface with an outline inside the picture, an open one that
/// fills it.
std::vector<Snapshot> subjects(PixelSize size) {
  return {takeSnapshot(sceneOf(torus(1, 0.4)), 0, size, {.eye = Vec3(1, 2, 2.5)}),
          takeSnapshot(sceneOf(flag()), 0, size, {.eye = Vec3(0.9, 0.7, 3), .lookAt = Vec3(1.4, 1, 0)})};
}

double positionError(StressContext& context, const Snapshot& snapshot, DrawOptions options) {
  const auto output = [&](Output wanted) {
    options.output = wanted;
    return context.renderer().render(snapshot, options).image;
  };
  return positionErrorPx(snapshot, output(Output::Id), output(Output::Uv));
}

/// The largest difference between what the shader says of a pixel's point and how far, across or down, the
/// point it shows is from the pixel's centre, worked out again in double. Of a formula that is the point at
/// its parameters; of an equation the point itself, and parameters are what is rounded of its angles.
double residualError(StressContext& context, const Snapshot& snapshot) {
  const SnapshotNode& node = snapshot.nodes.front();
  const bool byEquation = equationOf(node.surface, 0, node.parameters).has_value();
  const Image id = draw(context, snapshot, Output::Id), residual = draw(context, snapshot, Output::Residual);
  const Image found = draw(context, snapshot, byEquation ? Output::Position : Output::Uv);
  double worst = 0;
  for (int y = 0; y < id.height(); ++y)
    for (int x = 0; x < id.width(); ++x) {
      if (id.pixel(x, y)[0] == 0) continue;
      const auto at = found.pixel(x, y);
      const Vec3 point =
          byEquation ? colorAt(found, x, y) : node.surface.position(at[0], at[1], node.parameters);
      const Vec2 off = glm::abs(pixelOf(snapshot.view, point) - centerOf(x, y));
      worst = std::max(worst, std::abs(std::max(off.x, off.y) - double(residual.pixel(x, y)[0])));
    }
  return worst;
}

std::vector<Measurement> parametricAccuracy(StressContext& context) {
  std::vector<Measurement> measurements;
  double exact = 0, told = 0;
  std::array<double, 3> meshes{};
  constexpr std::array<double, 3> kTolerances{1, 0.5, 0.1};
  for (const Snapshot& snapshot : subjects(context.size())) {
    for (std::size_t i = 0; i < kTolerances.size(); ++i)
      meshes[i] = std::max(
          meshes[i],
          positionError(context, snapshot, {.shading = Shading::Phong, .tolerancePx = kTolerances[i]}));
    exact = std::max(exact, positionError(context, snapshot, {.shading = context.shading()}));
    told = std::max(told, residualError(context, snapshot));
  }
  for (std::size_t i = 0; i < kTolerances.size(); ++i)
    measurements.push_back(
        atMost(fmt::format("meshes of tolerance {} px", kTolerances[i]), meshes[i], kTolerances[i], "px"));
  measurements.push_back(atMost("exact shading", exact, kExactPx, "px"));
  measurements.push_back(atMost("residual against double", told, 2e-4, "px"));
  return measurements;
}

// ST-09 -----------------------------------------------------------------------------------------------------

/// A view of the torus around a point of it, as a telescope would have it: the middle of a picture of 1024
/// pixels and 40 degrees, magnified.
Snapshot throughTelescope(const Vec3& eye, const Vec3& target, double zoom, int side) {
  const double pixelsPerUnit = 512 / std::tan(radians(20)) * zoom;
  return takeSnapshot(sceneOf(torus(1, 0.4)), 0, {side, side},
                      {.eye = eye, .lookAt = target, .fovY = fovOf(side, pixelsPerUnit)});
}

/// Pixels whose coverage is wrong and stays so within 0.01 px.
double wrongCoverage(const Snapshot& snapshot, const Image& id) {
  const reference::Caster caster(snapshot);
  return misclassified(
      id, [&](const Vec2& pixel) { return !caster.look(caster.rayThrough(pixel.x, pixel.y)).hits.empty(); },
      0.01);
}

std::vector<Measurement> zoomLadder(StressContext& context) {
  const int side = context.of(256, 64);
  const Vec3 eye(4, 0, 0);
  const Vec3 facing(1.4, 0, 0);
  // Where a ray from the eye touches the front of the tube: cos = minor / distance from the tube's centre.
  const double cosine = 0.4 / (eye.x - 1);
  const Vec3 outline = Vec3(1, 0, 0) + 0.4 * Vec3(cosine, std::sqrt(1 - cosine * cosine), 0);
  std::vector<Measurement> measurements;
  for (int decade = 0; decade <= 6; decade += context.of(1, 2)) {
    const double zoom = std::pow(10, decade);
    const Snapshot near = throughTelescope(eye, facing, zoom, side);
    const double error = positionError(context, near, {.shading = context.shading()});
    // The parameters that are read back are floats: Su is 2 pi 1.4 m, half an ulp of a parameter below 1 is
    // 2^-25, and the other half the threshold leaves to the shader.
    const double pixelsPerMetre = near.view.pixelsPerUnit / (eye.x - facing.x);
    measurements.push_back(atMost(fmt::format("zoom {:.0e}: position from the parameters read back", zoom),
                                  error, std::max(kExactPx, std::exp2(-24) * kTau * 1.4 * pixelsPerMetre),
                                  "px"));
    const FrameError told = context.draw(near).statistics.error;
    const double residual = told.residualMaxPx.value_or(std::numeric_limits<double>::infinity());
    measurements.push_back(
        atMost(fmt::format("zoom {:.0e}: residual", zoom), residual, zoom < 1e6 ? kExactPx : 0.01, "px"));
    measurements.push_back(none(fmt::format("zoom {:.0e}: pixels unconverged", zoom),
                                static_cast<double>(told.unconvergedPx), "pixels"));
    const Snapshot edge = throughTelescope(eye, outline, zoom, side);
    measurements.push_back(none(fmt::format("zoom {:.0e}: outline wrong beyond 0.01 px", zoom),
                                wrongCoverage(edge, draw(context, edge, Output::Id)), "pixels"));
  }
  return measurements;
}

// ST-10 -----------------------------------------------------------------------------------------------------

/// The corners of a plate of 2 x 2 m, 5 m before the eye, turned about the view's horizontal axis until it is
/// seen at `grazing` radians.
std::array<Vec3, 4> corners(double grazing) {
  std::array<Vec3, 4> corners;
  const Vec3 along(0, std::sin(grazing), -std::cos(grazing));
  const std::pair<double, double> signs[] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  for (int k = 0; k < 4; ++k) corners[k] = Vec3(signs[k].first, 0, 0) + signs[k].second * along;
  return corners;
}

Scene plateAt(double grazing) {
  Scene scene = sceneOf(rectangle(2, 2));
  Node node = scene[NodeId{0}];
  node.rotation = Rotation{{1, 0, 0}, grazing};
  scene.set(NodeId{0}, node);
  return scene;
}

struct Polygon {
  std::array<Vec2, 4> corners;

  [[nodiscard]] double area() const {
    double twice = 0;
    for (int k = 0; k < 4; ++k) {
      const Vec2 a = corners[k], b = corners[(k + 1) % 4];
      twice += a.x * b.y - a.y * b.x;
    }
    return std::abs(twice) / 2;
  }
  [[nodiscard]] double perimeter() const {
    double sum = 0;
    for (int k = 0; k < 4; ++k) sum += glm::length(corners[(k + 1) % 4] - corners[k]);
    return sum;
  }
};

struct Grazing {
  double covered = 0, allowed = 0;  ///< pixels
  double nans = 0;
};

// The mean count of covered pixels over all places of the raster is the covered area.
Grazing seenAt(StressContext& context, double grazing) {
  constexpr int kShifts = 16;
  constexpr PixelSize kSize{256, 256};  // what is counted does not depend on it
  // Slanted in the picture: along a row of pixels all centres would be on the same side of it.
  Snapshot snapshot = takeSnapshot(plateAt(grazing), 0, kSize, {.eye = Vec3(0, 0, 5), .up = Vec3(0.3, 1, 0)});
  Polygon polygon;
  const auto places = corners(grazing);
  for (int k = 0; k < 4; ++k) polygon.corners[k] = pixelOf(snapshot.view, places[k]);
  Grazing seen{.allowed = polygon.area() + polygon.perimeter() / 256};
  for (int i = 0; i < kShifts * kShifts; ++i) {
    snapshot.view = sampledAt(snapshot.view, (Vec2(i % kShifts, i / kShifts) + 0.5) / double(kShifts) - 0.5);
    const Image color = draw(context, snapshot, Output::Color);
    seen.nans += nanCount(color);
    seen.covered += kSize.width * kSize.height - emptyCount(draw(context, snapshot, Output::Id));
  }
  seen.covered /= kShifts * kShifts;
  return seen;
}

double medianMilliseconds(StressContext& context, const Snapshot& snapshot) {
  std::vector<double> times;
  for (int i = 0; i < 15; ++i) {
    const Stopwatch watch;
    static_cast<void>(context.draw(snapshot));
    times.push_back(watch.milliseconds());
  }
  std::ranges::sort(times);
  return times[times.size() / 2];
}

std::vector<Measurement> edgeOn(StressContext& context) {
  std::vector<Measurement> measurements;
  for (const auto& [name, grazing] :
       {std::pair("edge-on", 0.0), std::pair("at 89.999 degrees", radians(0.001))}) {
    const Grazing seen = seenAt(context, grazing);
    measurements.push_back(none(fmt::format("{}: NaN samples", name), seen.nans));
    measurements.push_back(atMost(fmt::format("{}: pixels covered, of area + perimeter / 256", name),
                                  seen.covered, seen.allowed, "pixels"));
    if (context.options().quick) continue;  // a shared machine's clock proves nothing
    const PixelSize size = context.size();
    const Camera camera{.eye = Vec3(0, 0, 5)};
    const double usual = medianMilliseconds(context, takeSnapshot(plateAt(kPi / 2), 0, size, camera));
    const double grazed = medianMilliseconds(context, takeSnapshot(plateAt(grazing), 0, size, camera));
    measurements.push_back(
        atMost(fmt::format("{}: time of a frame, of a frontal one", name), grazed / usual, 2));
  }
  return measurements;
}

}  // namespace

std::vector<StressCase> accuracyCases() {
  return {{"ST-08", "the point at a pixel's parameters projects to the pixel", parametricAccuracy},
          {"ST-09", "a zoom onto a torus, to a million times", zoomLadder},
          {"ST-10", "a plate seen edge-on", edgeOn}};
}

}  // namespace luxo
