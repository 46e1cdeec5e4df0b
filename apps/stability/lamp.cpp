// SPDX-License-Identifier: Apache-2.0
// ST-34: the border of the lamp's light on planes, against the conic in closed form.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "stability/cases.h"
#include "stability/pictures.h"
#include "surface/library.h"

namespace luxo {
namespace {

constexpr double kFocalLength = 0.2, kHeight = 1.8;
constexpr double kCosRim = (kHeight - kFocalLength) / (kHeight + kFocalLength);  // 0.8

/// A shade that opens upward under a ceiling, whose middle is above its vertex. World = shade's space.
struct Ceiling {
  std::string name;
  Vec3 middle{0, 5, 0};
  Vec3 tiltAxis{1, 0, 0};
  double tilt = 0;  ///< radians

  [[nodiscard]] Vec3 normal() const { return rotation(tiltAxis, tilt) * Vec3(0, 1, 0); }

  /// Whether the rim lets the light through to a point.
  [[nodiscard]] static bool lit(const Vec3& point) {
    const Vec3 fromFocus = point - Vec3(0, kFocalLength, 0);
    return fromFocus.y >= kCosRim * glm::length(fromFocus);
  }

  /// The ray along the rim's cone, met by the plane: a point of the conic.
  [[nodiscard]] Vec3 border(double angle) const {
    const double sine = std::sqrt(1 - kCosRim * kCosRim);
    const Vec3 along(sine * std::cos(angle), kCosRim, sine * std::sin(angle)), focus(0, kFocalLength, 0);
    return focus + glm::dot(middle - focus, normal()) / glm::dot(along, normal()) * along;
  }
};

Scene sceneUnder(const Ceiling& ceiling, Light::Shadow shadow) {
  Scene scene;
  scene.set(RenderSettings{.background = Vec3(0), .ambient = Vec3(0)});
  const NodeId shade = scene.add(Node{.name = "shade", .surface = paraboloid(kFocalLength, kHeight)});
  scene.add(Node{.name = "ceiling",
                 .translation = ceiling.middle,
                 .rotation = Rotation{ceiling.tiltAxis, ceiling.tilt},
                 .surface = rectangle(30, 30)});
  Light bulb;
  bulb.intensity = 50.0;
  bulb.attenuation = Light::Attenuation::InverseSquare;
  bulb.shadow = shadow;
  bulb.casters = {shade};
  scene.add(Node{.parent = shade, .translation = Vec3(0, kFocalLength, 0), .light = bulb});
  scene.add(Camera{.eye = Vec3(6, 0.5, 7), .lookAt = Vec3(0, 4.7, 0), .fovY = radians(55)});
  return scene;
}

/// Pixels from a place in the picture to the nearest of the conic.
double distanceToBorder(const Ceiling& ceiling, const View& view, const Vec2& pixel) {
  constexpr int kPieces = 20000;  // a third of a pixel long, and 1e-5 px off the curve
  double least = std::numeric_limits<double>::infinity();
  std::optional<Vec2> last;
  for (int k = 0; k <= kPieces; ++k) {
    const Vec3 point = ceiling.border(kTau * k / kPieces);
    if (eyeFromWorldPoint(view, point).z > -view.near) {
      last.reset();
      continue;
    }
    const Vec2 here = pixelOf(view, point);
    if (last) {
      const Vec2 along = here - *last;
      const double s = glm::clamp(glm::dot(pixel - *last, along) / glm::dot(along, along), 0.0, 1.0);
      least = std::min(least, glm::distance(pixel, *last + s * along));
    }
    last = here;
  }
  return least;
}

std::vector<Measurement> rims(StressContext& context, Light::Shadow shadow) {
  constexpr double kMaxPx = 0.01;
  const Ceiling ceilings[] = {{.name = "circle on a perpendicular plane"},
                              {.name = "ellipse on a tilted plane", .tiltAxis = {1, 0, -0.4}, .tilt = -0.45}};
  std::vector<Measurement> result;
  for (const Ceiling& ceiling : ceilings) {
    const Scene scene = sceneUnder(ceiling, shadow);
    const Snapshot snapshot = takeSnapshot(scene, 0, context.size());
    const auto number = static_cast<float>(
        std::ranges::find(snapshot.nodes, *scene.findNode("ceiling"), &SnapshotNode::id)->number);
    const Image ids = context.draw(snapshot, {.output = Output::Id}).image;
    const Image image = context.draw(snapshot).image;
    std::int64_t lit = 0, dark = 0, wrong = 0;
    double farthest = 0;
    for (int y = 0; y < ids.height(); ++y)
      for (int x = 0; x < ids.width(); ++x) {
        if (ids.pixel(x, y)[0] != number) continue;
        const PixelRay ray = rayThrough(snapshot.view, centerOf(x, y));
        const Vec3 normal = ceiling.normal();
        const bool expected = Ceiling::lit(
            ray.at(glm::dot(ceiling.middle - ray.origin, normal) / glm::dot(ray.direction, normal)));
        ++(expected ? lit : dark);
        if ((image.pixel(x, y)[0] > 0) == expected) continue;
        const double distance = distanceToBorder(ceiling, snapshot.view, centerOf(x, y));
        farthest = std::max(farthest, distance);
        wrong += distance > kMaxPx;
      }
    result.push_back(none(ceiling.name + ": pixels misclassified farther than 0.01 px", wrong, "pixels"));
    result.push_back(atMost(ceiling.name + ": farthest misclassified pixel", farthest, kMaxPx, "px"));
    result.push_back(atLeast(ceiling.name + ": lit pixels", lit, context.of(30000, 2000), "pixels"));
    result.push_back(atLeast(ceiling.name + ": dark pixels", dark, context.of(30000, 2000), "pixels"));
  }
  return result;
}

}  // namespace

std::vector<StressCase> lampCases() {
  return {{.id = "ST-34",
           .title = "the lamp's rim on planes",
           .run = [](StressContext& context) { return rims(context, Light::Shadow::Exact); },
           .canary = [](StressContext& context) { return rims(context, Light::Shadow::Map); }}};
}

}  // namespace luxo
