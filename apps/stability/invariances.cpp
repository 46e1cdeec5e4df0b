// SPDX-License-Identifier: Apache-2.0
// ST-16 to 18: what must not show in a picture: the unit of length, where the world's origin is, the age of
// the clock.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "luxo_grandpa/lamp.h"
#include "scene/scene_builder.h"
#include "scene/scene_reader.h"
#include "stability/cases.h"
#include "stability/pixels.h"
#include "surface/library.h"

namespace luxo {
namespace {

// ST-16 -----------------------------------------------------------------------------------------------------

template <class T>
Animated<T> times(double factor, Animated<T> value) {
  return [factor, v = std::move(value)](const Moment& moment) { return factor * v.at(moment); };
}

/// The same scene in another unit of length: what hangs on the world grows, and with it the camera, its near
/// plane, and by the square what light has to travel.
Scene inUnits(Scene scene, double scale) {
  for (std::uint32_t i = 0; i < scene.nodes().size(); ++i) {
    Node node = scene[NodeId{i}];
    if (!node.parent.valid()) {
      node.translation = times(scale, node.translation);
      node.scale = times(scale, node.scale);
    }
    if (node.light && node.light->attenuation == Light::Attenuation::InverseSquare)
      node.light->intensity = times(scale * scale, node.light->intensity);
    scene.set(NodeId{i}, node);
  }
  Camera camera = scene[CameraId{0}];
  camera.eye = times(scale, camera.eye);
  camera.lookAt = times(scale, camera.lookAt);
  camera.near = times(scale, camera.near);
  scene.set(CameraId{0}, camera);
  return scene;
}

/// A ball, a ring and a floor made in another unit: the surfaces themselves are large or small.
Scene builtInUnits(double scale) {
  Scene scene;
  scene.set(RenderSettings{.ambient = Vec3(0.1)});
  const MaterialId red = scene.add(Material{.diffuse = {0.5, 0.1, 0.1}, .specular = Vec3(0.6)});
  const auto place = [&](const Vec3& at, const Surface& surface) {
    scene.add(Node{.translation = scale * at,
                   .rotation = Rotation{{1, 0, 0.5}, 0.8},
                   .surface = surface,
                   .material = red});
  };
  place({-1, 0.1, 0}, sphere(0.8 * scale));
  place({1, 0, 0.2}, torus(0.7 * scale, 0.3 * scale));
  place({0, -0.2, -1}, rectangle(6 * scale, 4 * scale));
  scene.add(Node{
      .translation = scale * Vec3(-2, 4, 5),
      .light = Light{.intensity = 40 * scale * scale, .attenuation = Light::Attenuation::InverseSquare}});
  scene.add(Node{.rotation = Rotation{{1, 0.5, 0}, -0.8},
                 .light = Light{.type = Light::Type::Directional, .intensity = 0.3}});
  scene.add(Camera{.eye = scale * Vec3(0.5, 1.5, 4.5), .near = 0.1 * scale});
  return scene;
}

/// The largest part of a picture that a unit of 2^k changes, k from -most to most.
template <class Draw>
Measurement unitsOf(StressContext& context, const std::string& what, int most, const Draw& draw) {
  const Image expected = draw(1.0);
  std::int64_t worst = 0;
  int worstPower = 0, powers = 0;
  const int step = context.of(1, 13);
  for (int k = -most; k <= most; k += step) {
    const std::int64_t differing = differingPixels(draw(std::ldexp(1.0, k)), expected);
    if (differing > 0) ++powers;
    if (differing > worst) worstPower = k;
    worst = std::max(worst, differing);
  }
  std::string where;
  if (worst > 0) where = fmt::format(" ({} units, most at 2^{})", powers, worstPower);
  return none(fmt::format("pixels of {} that differ{}", what, where), worst, "pixels");
}

std::vector<Measurement> units(StressContext& context) {
  const Scene lamp = luxoGrandpa();
  const auto picture = [&](const Scene& scene, double time) {
    return context.draw(takeSnapshot(scene, time, context.size())).image;
  };
  // Surfaces have lengths from 1e-12 to 1e12.
  return {unitsOf(context, "the lamp", 40, [&](double scale) { return picture(inUnits(lamp, scale), 9.5); }),
          unitsOf(context, "small and large surfaces", 37,
                  [&](double scale) { return picture(builtInUnits(scale), 0); })};
}

// ST-17 -----------------------------------------------------------------------------------------------------

const Vec3 kOnEarth(6.371e6, -6.371e6, 6.371e6);
const Vec3 kAroundTheSun(1.496e11, 1.496e11, -1.496e11);

/// All coordinates are multiples of 1/64 m, which doubles hold at 1.496e11 m: the scene can be moved there
/// and back without loss.
Scene sceneAt(const Vec3& origin) {
  Scene scene;
  scene.set(RenderSettings{.ambient = Vec3(0.1)});
  const MaterialId red = scene.add(Material{.diffuse = {0.5, 0.1, 0.1}, .specular = Vec3(0.6)});
  const auto place = [&](const Vec3& at, const Rotation& turn, const Surface& surface) {
    scene.add(Node{.translation = origin + at, .rotation = turn, .surface = surface, .material = red});
  };
  place({-1.25, 0.125, 0}, {}, sphere(0.8));
  place({1, 0, 0.25}, {{1, 0, 0.5}, 0.8}, torus(0.7, 0.3));
  place({0, -1, -0.5}, {{1, 2, 0}, 0.2}, rectangle(6, 4));
  place({0, 0, 1.5}, {{1, 0, 0}, -0.4}, cone(0.3, 0, 0.8));
  scene.add(Node{.translation = origin + Vec3(-2, 4, 5),
                 .light = Light{.intensity = 40, .attenuation = Light::Attenuation::InverseSquare}});
  scene.add(Camera{.eye = origin + Vec3(0.5, 1.5, 4.5), .lookAt = origin + Vec3(0, 0, 0)});
  return scene;
}

/// What is left of a snapshot when places in the world are single precision.
Snapshot roundedToFloat(Snapshot snapshot) {
  const auto rounded = [](const Vec3& v) { return Vec3(Vec3f(v)); };
  for (SnapshotNode& node : snapshot.nodes) {
    node.worldFromObject.translation = rounded(node.worldFromObject.translation);
    node.boundsWorld = transformBounds(node.worldFromObject, node.boundsObject);
  }
  for (SnapshotLight& light : snapshot.lights)
    light.positionWorld = Vec4(rounded(Vec3(light.positionWorld)), light.positionWorld.w);
  snapshot.view.eye = rounded(snapshot.view.eye);
  return snapshot;
}

template <class Prepare>
std::vector<Measurement> farAway(StressContext& context, const Prepare& prepare) {
  const auto picture = [&](const Vec3& origin) {
    return context.draw(prepare(takeSnapshot(sceneAt(origin), 0, context.size()))).image;
  };
  const Image here = picture(Vec3(0));
  return {
      none("pixels that differ 6.371e6 m away", differingPixels(picture(kOnEarth), here), "pixels"),
      none("pixels that differ 1.496e11 m away", differingPixels(picture(kAroundTheSun), here), "pixels")};
}

std::vector<Measurement> faraway(StressContext& context) {
  return farAway(context, [](Snapshot snapshot) { return snapshot; });
}

std::vector<Measurement> farawayInFloat(StressContext& context) { return farAway(context, roundedToFloat); }

// ST-18 -----------------------------------------------------------------------------------------------------

/// A flag whose waves pass `turns` times, an expression of t.
Scene flagScene(const std::string& turns) {
  return buildScene(parseScene(fmt::format(R"json({{
    "luxo": 1,
    "materials": {{ "cloth": {{ "diffuse": [0.7, 0.2, 0.1], "specular": 0.4 }} }},
    "surfaces": {{ "flag": {{ "type": "flag", "phase": "tau*({})" }} }},
    "nodes": [
      {{ "translate": [-1.5, -1, 0], "surface": "flag", "material": "cloth" }},
      {{ "translate": [3, 4, 5], "light": {{ "intensity": 1 }} }} ],
    "camera": {{ "eye": [0.6, 0.4, 3.4], "look_at": [0, 0, 0] }} }})json",
                                           turns),
                               "flag"));
}

/// Clocks of 1e3, 1e6 and 1e9 s, with fractions that doubles hold.
constexpr double kClocks[] = {1e3 + 0.25, 1e6 + 0.625, 1e9 + 0.8125};

/// `rate * time` without its whole turns: the exact product, reduced before it is rounded.
double exactTurns(double rate, double time) {
  const double high = rate * time, low = std::fma(rate, time, -high);
  const long double fraction = static_cast<long double>(std::fmod(high, 1.0)) + low;
  return static_cast<double>(fraction - std::floor(fraction));
}

std::vector<Measurement> oldClock(StressContext& context) {
  constexpr double kPeriod = 3, kDepth = 0.2;  // of the flag's waves, metres
  const Scene rational = flagScene("mod(t, 3)/3"), irrational = flagScene("mod(0.4714045207910317*t, 1)");
  const double rate = 0.4714045207910317;  // sqrt(2) / 3 turns a second
  const auto picture = [&](double time) {
    return context.draw(takeSnapshot(rational, time, context.size())).image;
  };
  std::vector<Measurement> result;
  for (const double clock : kClocks) {
    result.push_back(none(fmt::format("pixels that differ from t mod 3 s at {:.0e} s", clock),
                          differingPixels(picture(clock), picture(std::fmod(clock, kPeriod))), "pixels"));
  }
  for (const double clock : kClocks) {
    const Snapshot snapshot = takeSnapshot(irrational, clock, context.size());
    // The device gets the phase as a float; a point moves by no more than the depth times the phase's error.
    const double phase = static_cast<float>(snapshot.nodes.front().parameters.back());
    const double error = std::abs(std::remainder(phase - kTau * exactTurns(rate, clock), kTau));
    const double nearest = 3.4 - 1.5 - kDepth;  // metres before the eye, at least
    result.push_back(atMost(fmt::format("displacement at sqrt(2)/3 turns a second at {:.0e} s", clock),
                            kDepth * error * snapshot.view.pixelsPerUnit / nearest, 1e-4, "px"));
  }
  result.push_back(atLeast("pixels that differ half a period later",
                           differingPixels(picture(1e3), picture(1e3 + 1.5)), 1000, "pixels"));
  return result;
}

}  // namespace

std::vector<StressCase> invarianceCases() {
  return {{.id = "ST-16", .title = "the unit of length, 2^-40 to 2^40 metres", .run = units},
          {.id = "ST-17", .title = "a scene far from the origin", .run = faraway, .canary = farawayInFloat},
          {.id = "ST-18", .title = "a flag under a clock of up to 1e9 s", .run = oldClock}};
}

}  // namespace luxo
