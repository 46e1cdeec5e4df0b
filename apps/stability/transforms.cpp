// SPDX-License-Identifier: Apache-2.0
// ST-11 to 15: what transforms do to normals, coverage and, after a million frames, to pictures.
#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>

#include "reference/caster.h"
#include "scene/scene_builder.h"
#include "scene/scene_reader.h"
#include "stability/cases.h"
#include "stability/pictures.h"
#include "surface/library.h"

namespace luxo {
namespace {

/// Radians; right for small and large angles alike.
double angleBetween(const Vec3& a, const Vec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

NodeId addLight(Scene& scene, const Vec3& position, double intensity = 1) {
  return scene.add(Node{.translation = position, .light = Light{.intensity = intensity}});
}

// ST-11 -----------------------------------------------------------------------------------------------------

const Vec3 kUneven(1e-6, 1, 1e6);

/// What uneven scale makes of an object's normal, in long double: the cofactors of a diagonal matrix.
Vec3 scaledNormal(const Vec3& n) {
  using Wide = glm::vec<3, long double>;
  const Wide scaled = Wide(n) / Wide(kUneven);
  return Vec3(scaled / glm::length(scaled));
}

/// Objects' normals that the scale takes all over the sphere, as a renderer has them: rounded.
template <class Number>
double largestNormalError(int count) {
  using Vector = glm::vec<3, Number>;
  std::mt19937 random(11);  // NOLINT: the same numbers every time
  std::normal_distribution<double> gauss;
  const Mat3 matrix = normalMatrix(Mat3(kUneven.x, 0, 0, 0, kUneven.y, 0, 0, 0, kUneven.z));
  const glm::mat<3, 3, Number> single(matrix / 1e6);  // as the device gets it: largest entry 1
  double largest = 0;
  for (int i = 0; i < count; ++i) {
    const Vec3 seen(gauss(random), gauss(random), gauss(random));
    const Vector n(unit(kUneven * seen));
    largest = std::max(largest, angleBetween(unit(Vec3(single * n)), scaledNormal(Vec3(n))));
  }
  return largest;
}

/// A torus that uneven scale makes round: what it is drawn from is a million million times longer than thick.
Surface flattenedTorus() {
  return surface(
      [](auto u, auto v) {
        const auto ring = 1 + 0.4 * cos(kTau * v);
        return point(ring * cos(kTau * u) / kUneven.x, 0.4 * sin(kTau * v) / kUneven.y,
                     -(ring * sin(kTau * u)) / kUneven.z);
      },
      {}, {.name = "flattened torus"});
}

Vec3 torusNormal(double u, double v) {
  return {std::cos(kTau * v) * std::cos(kTau * u), std::sin(kTau * v),
          -std::cos(kTau * v) * std::sin(kTau * u)};
}

/// The plane that uneven scale makes of what spans it, with this normal.
Surface flattenedPlate(const Vec3& normal) {
  const Vec3 a = unit(glm::cross(normal, Vec3(0.3, -0.2, 1))), b = glm::cross(normal, a);
  const Vec3 p = a / kUneven, q = b / kUneven;
  return surface(
      [=](auto u, auto v) {
        const auto s = u - 0.5, t = v - 0.5;
        return point(p.x * s + q.x * t, p.y * s + q.y * t, p.z * s + q.z * t);
      },
      {}, {.name = "flattened plate"});
}

struct NormalErrors {
  double largest = 0;
  std::int64_t pixels = 0, notFinite = 0;
  double farthest = 0;  ///< of the points shown, from the pixels that show them, px
};

template <class TrueNormal>
NormalErrors normalsOf(StressContext& context, const Surface& surface, const TrueNormal& trueNormal) {
  Scene scene;
  scene.add(Node{.scale = kUneven, .surface = surface, .segments = Segments{64, 32}});
  const Camera camera{.eye = Vec3(2.2, 2.6, 2.9), .fovY = radians(40)};
  const Image normals = context.draw(scene, camera, Output::Normal);
  const Image parameters = context.draw(scene, camera, Output::Uv);
  const View view = viewAt(camera, 0, context.size());
  NormalErrors errors{.notFinite = samplesNotFinite(normals) + samplesNotFinite(parameters)};
  for (int y = 0; y < normals.height(); ++y)
    for (int x = 0; x < normals.width(); ++x) {
      const Vec3 n = colorAt(normals, x, y);
      if (n == Vec3(0)) continue;
      const auto uv = parameters.pixel(x, y);
      Vec3 truth = trueNormal(uv[0], uv[1]);
      if (glm::dot(truth, n) < 0 && !surface.closed()) truth = -truth;
      errors.largest = std::max(errors.largest, angleBetween(n, truth));
      const Vec2 shown = pixelOf(view, kUneven * surface.position(uv[0], uv[1]));
      errors.farthest = std::max(errors.farthest, glm::distance(shown, centerOf(x, y)));
      ++errors.pixels;
    }
  return errors;
}

std::vector<Measurement> unevenScale(StressContext& context) {
  constexpr double kMaxError = 1e-5;
  const int count = context.of(1000000, 100000);
  std::vector<Measurement> result = {
      atMost("normals by the matrix in double", largestNormalError<double>(count), kMaxError, "rad"),
      atMost("normals by the matrix in float", largestNormalError<float>(count), kMaxError, "rad")};
  const auto add = [&](const std::string& what, const NormalErrors& errors) {
    result.push_back(atMost("normals of " + what, errors.largest, kMaxError, "rad"));
    result.push_back(atMost("points of " + what + " from their pixels", errors.farthest, 0.01, "px"));
    result.push_back(none("samples of " + what + " that are not finite", errors.notFinite, "samples"));
    result.push_back(atLeast("pixels of " + what, errors.pixels, context.of(20000, 1000), "pixels"));
  };
  add("a torus", normalsOf(context, flattenedTorus(), torusNormal));
  for (const Vec3& axis : {Vec3(1, 1, 1), Vec3(1e-3, 1, 1), Vec3(1, 1e-3, 1)}) {
    const Vec3 normal = unit(axis);
    add("a plate", normalsOf(context, flattenedPlate(normal), [&](double, double) { return normal; }));
  }
  return result;
}

// ST-12 -----------------------------------------------------------------------------------------------------

/// Closed and open surfaces, hierarchy, transparency, both kinds of light; mirrored in x or not.
Scene mixedScene(double mirror) {
  Scene scene;
  scene.set(RenderSettings{.background = {0.1, 0.1, 0.2}, .ambient = Vec3(0.2)});
  const MaterialId shiny = scene.add(Material{.diffuse = {0.6, 0.3, 0.1}, .specular = Vec3(0.5)});
  const MaterialId oneSided = scene.add(Material{.diffuse = {0.1, 0.5, 0.3}, .twoSided = TwoSided::No});
  const MaterialId glass = scene.add(Material{.diffuse = {0.2, 0.3, 0.7}, .opacity = 0.4});
  const NodeId root = scene.add(Node{.scale = Vec3(mirror, 1, 1)});
  const auto place = [&](Vec3 at, Rotation turn, Surface surface, MaterialId material) {
    scene.add(Node{.parent = root,
                   .translation = at,
                   .rotation = turn,
                   .surface = std::move(surface),
                   .material = material});
  };
  place({-2.2, 0.3, 0}, {{1, 2, 0}, 0.7}, torus(0.8, 0.3), shiny);
  place({0.3, 0, -1}, {}, sphere(0.9), shiny);
  place({2, -0.8, 0}, {{1, 0, 1}, 0.6}, paraboloid(0.2, 1.4), shiny);
  place({-0.5, -1, 1}, {{0, 1, 0}, 1}, cone(0.6, 0, 1.1), oneSided);
  place({1.2, 0.4, 1.2}, {}, sphere(0.5), glass);
  place({0, -1.1, 0}, {}, rectangle(8, 5), oneSided);
  scene.add(Node{.parent = root, .translation = Vec3(-2, 4, 3), .light = Light{.intensity = 0.7}});
  scene.add(Node{.parent = root,
                 .rotation = Rotation{{1, 0.5, 0}, -0.8},
                 .light = Light{.type = Light::Type::Directional, .intensity = 0.3}});
  scene.add(Camera{.eye = Vec3(mirror * 1.5, 2, 6), .lookAt = Vec3(mirror * 0.2, 0, 0), .fovY = radians(40)});
  return scene;
}

std::vector<Measurement> mirror(StressContext& context) {
  const Snapshot original = takeSnapshot(mixedScene(1), 0, context.size());
  const Snapshot mirrored = takeSnapshot(mixedScene(-1), 0, context.size());
  const Image expected = flippedLeftRight(context.draw(original).image);
  const Image image = context.draw(mirrored).image;
  const reference::Caster caster(mirrored);
  int wrong = 0;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x)
      wrong += codeDifference(image, expected, x, y) > 1 && !nearEdge(caster, x, y, kSnapPx);
  return {none("pixels off by more than 1 of 255, farther than 1/128 px from an edge", wrong, "pixels"),
          none("samples that are not finite", samplesNotFinite(image), "samples")};
}

// ST-13 -----------------------------------------------------------------------------------------------------

/// Pixels on which a flattened thing is missing, or is where it should not be.
struct Flattened {
  std::int64_t cracks = 0, beyond = 0, tilted = 0, seen = 0, notFinite = 0;
};

/// `inside` says of a point of the plane z = 0 whether it belongs to the thing; pixels closer than 0.01 px to
/// its border may be either.
template <class Inside>
Flattened flatten(StressContext& context, const Surface& surface, const Rotation& turn,
                  const Inside& inside) {
  constexpr double kBorderPx = 0.01;
  Scene scene;
  scene.set(RenderSettings{.background = Vec3(0), .ambient = Vec3(0.1)});
  const NodeId flat = scene.add(Node{.scale = Vec3(1, 1, 0)});
  scene.add(Node{.parent = flat, .rotation = turn, .surface = surface});
  addLight(scene, {1, 2, 4});
  scene.add(Camera{.eye = Vec3(0.4, 0.7, 4), .lookAt = Vec3(0.05, 0, 0), .fovY = radians(40)});
  const Snapshot snapshot = takeSnapshot(scene, 0, context.size());
  const Image ids = context.draw(snapshot, {.output = Output::Id}).image;
  const Image normals = context.draw(snapshot, {.output = Output::Normal}).image;
  const Image colors = context.draw(snapshot).image;
  const reference::Caster caster(snapshot);
  const auto holds = [&](double px, double py) {
    const reference::Ray ray = caster.rayThrough(px, py);
    const Vec3 p = ray.origin - ray.origin.z / ray.direction.z * ray.direction;
    return inside(Vec2(p.x, p.y));
  };
  Flattened found{.notFinite = samplesNotFinite(normals) + samplesNotFinite(colors)};
  for (int y = 0; y < ids.height(); ++y)
    for (int x = 0; x < ids.width(); ++x) {
      const bool covered = ids.pixel(x, y)[0] != 0, expected = holds(x + 0.5, y + 0.5);
      found.seen += covered;
      if (covered) {
        const Vec3 n = colorAt(normals, x, y);
        found.tilted += n.x != 0 || n.y != 0 || !(std::abs(std::abs(n.z) - 1) <= 2e-7);
      }
      if (covered == expected) continue;
      bool border = false;
      for (int k = 0; k < 16 && !border; ++k)
        border = holds(x + 0.5 + kBorderPx * std::cos(kTau * k / 16),
                       y + 0.5 + kBorderPx * std::sin(kTau * k / 16)) != expected;
      if (!border) ++(expected ? found.cracks : found.beyond);
    }
  return found;
}

std::vector<Measurement> singularScale(StressContext& context) {
  const Rotation towardZ{{1, 0, 0}, radians(90)};  // the axis from +Y to +Z
  const auto inDisk = [](const Vec2& p) { return glm::length(p) <= 1; };
  const auto inRing = [](const Vec2& p) { return std::abs(glm::length(p) - 0.8) <= 0.3; };
  struct Subject {
    std::string name;
    Flattened found;
  };
  const Subject subjects[] = {{"disk", flatten(context, disk(1), towardZ, inDisk)},
                              {"sphere", flatten(context, sphere(1), {}, inDisk)},
                              {"torus", flatten(context, torus(0.8, 0.3), towardZ, inRing)}};
  std::vector<Measurement> result;
  for (const auto& [name, found] : subjects) {
    result.push_back(none(name + ": samples that are not finite", found.notFinite, "samples"));
    result.push_back(none(name + ": pixels whose normal is not +z or -z", found.tilted, "pixels"));
    result.push_back(none(name + ": holes", found.cracks, "pixels"));
    result.push_back(none(name + ": pixels beyond its border", found.beyond, "pixels"));
    result.push_back(atLeast(name + ": pixels seen", found.seen, context.of(100000, 6000), "pixels"));
  }
  return result;
}

// ST-14 -----------------------------------------------------------------------------------------------------

constexpr double kFramesPerSecond = 25;
constexpr int kFrames = 1000000;  // 10,000 whole turns of 4 seconds

/// A block that turns once in four seconds, as a scene file says it: whole turns are taken off exactly.
Scene spinningScene() {
  return buildScene(parseScene(R"({
    "luxo": 1,
    "surfaces": { "ring": { "type": "torus", "major": 0.8, "minor": 0.3 } },
    "nodes": [
      { "name": "spun", "rotate": { "axis": [1, 5, 2], "angle": "tau*mod(t, 4)/4" }, "surface": "ring" },
      { "translate": [3, 4, 5], "light": { "intensity": 1 } } ],
    "camera": { "eye": [0, 1, 3.5], "look_at": [0, 0, 0] } })",
                               "spin"));
}

double orthogonalityError(const Mat3& rotation) {
  const Mat3 product = glm::transpose(rotation) * rotation - Mat3(1);
  double largest = 0;
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row) largest = std::max(largest, std::abs(product[column][row]));
  return largest;
}

std::vector<Measurement> spinForLong(StressContext& context) {
  const Scene scene = spinningScene();
  const Animated<Rotation>& turn = scene[*scene.findNode("spun")].rotation;
  double worst = 0;
  for (int frame = 0; frame <= kFrames; ++frame) {
    const auto [axis, angle] = turn.at(frame / kFramesPerSecond);
    worst = std::max(worst, orthogonalityError(rotation(axis, angle)));
  }
  const auto frame = [&](int number) {
    return context.draw(takeSnapshot(scene, number / kFramesPerSecond, context.size())).image;
  };
  const Image first = frame(0);
  return {atMost("orthogonality of a million matrices", worst, 1e-12),
          none("pixels that differ after a million frames", differingPixels(frame(kFrames), first), "pixels"),
          atLeast("pixels that differ half a turn earlier", differingPixels(frame(kFrames - 50), first), 1000,
                  "pixels")};
}

// ST-15 -----------------------------------------------------------------------------------------------------

/// A ring at the end of 64 levels, M and M^-1 in turn, each a rotation and an uneven scale; or at no level.
Scene deepScene(int levels) {
  std::mt19937 random(15);  // NOLINT: the same numbers every time
  std::uniform_real_distribution<double> exponent(-1, 1), coordinate(-1, 1), angle(-kPi, kPi);
  Scene scene;
  scene.set(RenderSettings{.ambient = Vec3(0.1)});
  NodeId parent;
  for (int level = 0; level < levels; level += 2) {
    const Rotation turn{{coordinate(random), coordinate(random), coordinate(random)}, angle(random)};
    const Vec3 scale(std::pow(10, exponent(random)), std::pow(10, exponent(random)),
                     std::pow(10, exponent(random)));
    parent = scene.add(Node{.parent = parent, .rotation = turn, .scale = scale});
    // S^-1, then R^-1: as one node they would be in the wrong order.
    parent = scene.add(Node{.parent = parent, .scale = 1.0 / scale});
    parent = scene.add(Node{.parent = parent, .rotation = Rotation{turn.axis, -turn.angle}});
  }
  scene.add(Node{.name = "end", .parent = parent, .surface = torus(0.8, 0.3)});
  addLight(scene, {3, 4, 5});
  scene.add(Camera{.eye = Vec3(0.3, 2.5, 2.8)});
  return scene;
}

std::vector<Measurement> deepHierarchy(StressContext& context) {
  const Snapshot deep = takeSnapshot(deepScene(64), 0, context.size());
  const Snapshot shallow = takeSnapshot(deepScene(0), 0, context.size());
  const Transform& end = deep.nodes.front().worldFromObject;
  double error = glm::length(end.translation);
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row)
      error = std::max(error, std::abs(end.linear[column][row] - (row == column ? 1 : 0)));
  const Image image = context.draw(deep).image, expected = context.draw(shallow).image;
  return {atMost("distance from the identity after 64 levels", error, 1e-12),
          none("pixels that differ", differingPixels(image, expected), "pixels")};
}

}  // namespace

std::vector<StressCase> transformCases() {
  return {{.id = "ST-11", .title = "normals under scale by 1e-6, 1, 1e6", .run = unevenScale},
          {.id = "ST-12", .title = "a mirrored scene is the mirrored picture", .run = mirror},
          {.id = "ST-13", .title = "scale by 0 along z", .run = singularScale},
          {.id = "ST-14", .title = "whole turns for a million frames", .run = spinForLong},
          {.id = "ST-15", .title = "64 levels of a matrix and its inverse", .run = deepHierarchy}};
}

}  // namespace luxo
