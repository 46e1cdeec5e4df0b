// SPDX-License-Identifier: Apache-2.0
// ST-35 to 38: shadows of a ball on a plane, whose border is a conic, and of convex bodies, which have none
// of their own. Canaries: depth maps and flattened meshes.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "reference/silhouette.h"
#include "stability/cases.h"
#include "stability/pictures.h"
#include "surface/catalogue.h"
#include "surface/library.h"
#include "surface/surface.h"

namespace luxo {
namespace {

/// A ball of radius 1 and a wall, which receives its shadow. World space.
struct BallAndWall {
  Vec3 ball{0};
  Vec3 wall{0}, normal{0, 1, 0};
  double wallSize = 40;
  Rotation wallTurned{{0, 1, 0}, 0.0};   ///< the rectangle's normal is +Y before
  Vec4 light{0, 0, 0, 1};                ///< w = 0: the unit direction toward it
  Rotation lightTurned{{0, 1, 0}, 0.0};  ///< of that: it shines along -Z before
  Camera camera;

  /// Whether the light sees a point, past the ball.
  [[nodiscard]] bool lit(const Vec3& point) const {
    const Vec3 toLight = Vec3(light) - light.w * point;
    const double distance = glm::length(toLight);
    const Vec3 way = toLight / distance, from = point - ball;
    const double aside = glm::length(glm::cross(from, way));
    if (aside >= 1) return true;
    const double nearest = -glm::dot(from, way) - std::sqrt((1 - aside) * (1 + aside));
    return nearest < 0 || (light.w != 0 && nearest > distance);
  }

  [[nodiscard]] bool litAt(const View& view, const Vec2& pixel) const {
    const PixelRay ray = rayThrough(view, pixel);
    return lit(ray.at(glm::dot(wall - ray.origin, normal) / glm::dot(ray.direction, normal)));
  }

  [[nodiscard]] Scene scene(Light bulb) const {
    Scene scene;
    scene.set(RenderSettings{.background = Vec3(0), .ambient = Vec3(0)});
    const NodeId on = scene.add(Node{.name = "wall",
                                     .translation = wall,
                                     .rotation = wallTurned,
                                     .surface = rectangle(wallSize, wallSize)});
    bulb.casters = {scene.add(Node{.name = "ball", .translation = ball, .surface = sphere(1)})};
    bulb.type = light.w == 0 ? Light::Type::Directional : Light::Type::Point;
    if (bulb.shadow == Light::Shadow::Planar) bulb.shadowPlane = on;
    scene.add(
        Node{.translation = light.w == 0 ? Vec3(0) : Vec3(light), .rotation = lightTurned, .light = bulb});
    scene.add(camera);
    return scene;
  }
};

/// What a picture says of the wall.
struct Border {
  std::int64_t lit = 0, dark = 0;            ///< pixels, in truth
  double farthestLit = 0, farthestDark = 0;  ///< px from the border, of those that are so and should not be
  Image image;

  [[nodiscard]] double farthest() const { return std::max(farthestLit, farthestDark); }
};

constexpr double kFarthestPx = 4;  ///< what is farther off is as wrong

Border borderOf(StressContext& context, const BallAndWall& setting, const Light& bulb, int gridSize = 64) {
  const Snapshot snapshot = takeSnapshot(setting.scene(bulb), 0, context.size());
  const Image ids = context.draw(snapshot, {.output = Output::Id}).image;
  Border border{.image = context.draw(snapshot, {.shadowGridSize = gridSize}).image};
  for (int y = 0; y < ids.height(); ++y)
    for (int x = 0; x < ids.width(); ++x) {
      if (ids.pixel(x, y)[0] != 1) continue;
      const bool expected = setting.litAt(snapshot.view, centerOf(x, y)),
                 shown = border.image.pixel(x, y)[0] > 0;
      ++(expected ? border.lit : border.dark);
      if (shown == expected) continue;
      double& farthest = shown ? border.farthestLit : border.farthestDark;
      farthest = std::max(
          farthest,
          reference::distanceTo([&](const Vec2& at) { return setting.litAt(snapshot.view, at) == shown; },
                                centerOf(x, y), kFarthestPx));
    }
  return border;
}

Light exactly() {
  Light light;
  light.shadow = Light::Shadow::Exact;
  return light;
}

Light byMap(std::uint32_t size, double bias) {
  Light light;
  light.shadow = Light::Shadow::Map;
  light.map.size = size;
  light.map.bias = bias;
  return light;
}

std::vector<Measurement> pixelsOf(StressContext& context, const std::string& name, const Border& border) {
  return {
      atLeast(name + ": lit pixels", static_cast<double>(border.lit), context.of(30000, 2000), "pixels"),
      atLeast(name + ": dark pixels", static_cast<double>(border.dark), context.of(30000, 2000), "pixels")};
}

// ST-35 -----------------------------------------------------------------------------------------------------

std::vector<Measurement> conics(StressContext& context, const auto& lightOf) {
  constexpr double kMaxPx = 0.02;
  const BallAndWall setting{
      .ball = {0, 1.4, 0},
      .light = {-2, 5, 1.5, 1},
      .camera = {.eye = Vec3(2, 6, 5), .lookAt = Vec3(0.4, 0.2, 0), .fovY = radians(45)}};
  std::vector<Measurement> result;
  Image first;
  for (const int size : context.options().quick ? std::vector{32, 300, 4096}
                                                : std::vector{32, 64, 128, 256, 512, 1024, 2048, 4096}) {
    const std::string name = fmt::format("map of {} texels", size);
    Border border = borderOf(context, setting, lightOf(size), size);
    result.push_back(atMost(name + ": farthest misclassified pixel", border.farthest(), kMaxPx, "px"));
    if (first.empty()) {
      std::ranges::copy(pixelsOf(context, name, border), std::back_inserter(result));
      first = std::move(border.image);
    } else {
      result.push_back(none(name + ": pixels that differ from those of the smallest map",
                            static_cast<double>(differingPixels(first, border.image)), "pixels"));
    }
  }
  return result;
}

// ST-36 -----------------------------------------------------------------------------------------------------

/// Convex bodies; of the ball alone the shaders know that it is.
std::vector<std::pair<std::string, Surface>> convexBodies() {
  const Surface egg = surface(
      [](auto u, auto v) {
        const auto wide = (1 + 0.2 * sin(v)) * cos(v);
        return point(wide * cos(u), 1.3 * sin(v), -(wide * sin(u)));
      },
      {{0, kTau}, {-kPi / 2, kPi / 2}});
  return {{"sphere", sphere(1)},
          {"rounded box", makeSurface("superellipsoid")},
          {"pointed body", makeSurface("superellipsoid", {{"exponents", {1.5, 1.0}}})},
          {"egg", egg}};
}

/// Directions of light, so many at once: each adds as much where it is seen.
std::vector<Measurement> acne(StressContext& context, int directions, const Light& light) {
  constexpr int kAtOnce = 25;
  // Of 25 lights of radiance 1: what single precision leaves of their sum, a few ulp of 16.
  constexpr double kRounding = 3e-5;
  std::vector<Measurement> result;
  for (const auto& [name, body] : convexBodies()) {
    std::mt19937 random(36);  // NOLINT: the same numbers every time
    const auto number = [&](double low, double high) {
      return std::uniform_real_distribution<double>(low, high)(random);
    };
    double dark = 0, lit = 0;
    for (int done = 0; done < directions; done += kAtOnce) {
      Scene scene;
      scene.set(RenderSettings{.background = Vec3(0), .ambient = Vec3(0)});
      scene.add(Node{.surface = body});
      Light sun = light;
      sun.type = Light::Type::Directional;
      for (int i = 0; i < kAtOnce; ++i)
        scene.add(Node{
            .rotation = Rotation{unit(Vec3(number(-1, 1), number(-1, 1), number(-1, 1))), number(0, kTau)},
            .light = sun});
      const Vec3 eye = 6.0 * unit(Vec3(number(-1, 1), number(-1, 1), number(-1, 1)));
      scene.add(Camera{.eye = eye, .lookAt = Vec3(0), .fovY = radians(28)});
      const Snapshot snapshot = takeSnapshot(scene, 0, {context.of(256, 64), context.of(256, 64)});
      const Image shown = context.draw(snapshot).image,
                  without = context
                                .draw(snapshot,
                                      {.composition = Composition::Deferred, .shadows = ShadowKinds::None})
                                .image;
      for (int y = 0; y < shown.height(); ++y)
        for (int x = 0; x < shown.width(); ++x) {
          lit += without.pixel(x, y)[0] > 0 ? 1 : 0;
          dark += shown.pixel(x, y)[0] < without.pixel(x, y)[0] - kRounding ? 1 : 0;
        }
    }
    result.push_back(none(name + ": lit pixels in shadow", dark, "pixels"));
    result.push_back(atLeast(name + ": lit pixels", lit, 10.0 * directions, "pixels"));
  }
  return result;
}

// ST-37 -----------------------------------------------------------------------------------------------------

/// A ball that stands on a floor in the light of a low sun: all around the place where it does is dark.
std::vector<Measurement> contact(StressContext& context, const Light& light) {
  constexpr double kMaxPx = 0.05;
  std::vector<Measurement> result;
  for (const double metres : {6.0, 1.0, 0.05}) {  // of the picture's height
    const double elevation = 0.5;
    const Vec3 eye(1.2, 0.5, 3);
    const BallAndWall setting{
        .ball = {0, 1, 0},
        .light = {0, std::sin(elevation), std::cos(elevation), 0},
        .lightTurned = {{1, 0, 0}, -elevation},
        .camera = {.eye = eye, .lookAt = Vec3(0), .fovY = 2 * std::atan(0.5 * metres / glm::length(eye))}};
    const Border border = borderOf(context, setting, light);
    const std::string name = fmt::format("{} m", metres);
    result.push_back(atMost(name + ": farthest lit pixel of the shadow", border.farthestLit, kMaxPx, "px"));
    result.push_back(atMost(name + ": farthest dark pixel beside it", border.farthestDark, kMaxPx, "px"));
    result.push_back(atLeast(name + ": dark pixels", static_cast<double>(border.dark),
                             metres < 6 ? context.of(30000, 2000) : context.of(3000, 200), "pixels"));
  }
  return result;
}

// ST-38 -----------------------------------------------------------------------------------------------------

/// From a light so near to its outline a ball covers nearly half of all directions; a thousand metres on an
/// error of a micrometre at the ball is a metre, a pixel and more.
std::vector<Measurement> magnified(StressContext& context, const Light& light) {
  constexpr double kMaxPx = 0.1, kNear = 1e-3, kFar = 1e3;
  const BallAndWall setting{
      .wall = {kFar, 0, 0},
      .normal = {-1, 0, 0},
      .wallSize = 4000,
      .wallTurned = {{0, 0, 1}, kPi / 2},
      .light = {0, std::hypot(1, kNear), 0, 1},
      .camera = {.eye = Vec3(kFar - 900, 300, 700), .lookAt = Vec3(kFar, 0, 0), .fovY = radians(45)}};
  const Border border = borderOf(context, setting, light);
  std::vector<Measurement> result{atMost("farthest misclassified pixel", border.farthest(), kMaxPx, "px")};
  std::ranges::copy(pixelsOf(context, "wall", border), std::back_inserter(result));
  return result;
}

}  // namespace

std::vector<StressCase> shadowCases() {
  Light flattened;
  flattened.shadow = Light::Shadow::Planar;
  return {{.id = "ST-35",
           .title = "a ball's shadow on a plane, with maps of all sizes",
           .run = [](StressContext& context) { return conics(context, [](int) { return exactly(); }); },
           .canary =
               [](StressContext& context) {
                 return conics(context,
                               [](int size) { return byMap(static_cast<std::uint32_t>(size), 0.02); });
               }},
          {.id = "ST-36",
           .title = "convex bodies in a thousand lights",
           .run = [](StressContext& context) { return acne(context, context.of(1000, 100), exactly()); },
           .canary = [](StressContext& context) { return acne(context, 50, byMap(256, 0)); }},
          {.id = "ST-37",
           .title = "a ball on a floor, where they touch",
           .run = [](StressContext& context) { return contact(context, exactly()); },
           .canary = [](StressContext& context) { return contact(context, byMap(2048, 0.05)); }},
          {.id = "ST-38",
           .title = "a light beside a ball's outline, and a wall far away",
           .run = [](StressContext& context) { return magnified(context, exactly()); },
           .canary = [flattened](StressContext& context) { return magnified(context, flattened); }}};
}

}  // namespace luxo
