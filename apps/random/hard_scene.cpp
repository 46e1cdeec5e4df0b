// SPDX-License-Identifier: Apache-2.0
#include "random/hard_scene.h"

#include <fmt/format.h>

#include <utility>

#include "random/scene_parts.h"
#include "scene/scene_builder.h"
#include "scene/scene_reader.h"

namespace luxo::random {
namespace {

constexpr double kWithShadows = 0.4;
constexpr double kWithGlass = 0.5, kGlassInShadows = 0.4;  // of the others; of these
constexpr std::uint64_t kGlass = 0x676c617373;             // numbers of its own
constexpr double kFourSamples = 1.0 / 6;                   // of the scenes: one costs four of the others

Json offset(Numbers& n, double most) {
  const double x = n.signedBetween(0, most), y = n.signedBetween(0, most);
  return vectorJson(x, y, n.signedBetween(0, most));
}

/// Far from the origin: by the formula itself, where it is one, or by the node.
void moveFar(Json& surface, Json& node, Numbers& n) {
  const Json far = offset(n, n.magnitude(1e3, 1e6));
  if (surface.at("type") != "formula" || n.chance(0.3)) {
    node["translate"] = far;
    return;
  }
  for (std::size_t i = 0; i < 3; ++i)
    surface["position"][i] =
        fmt::format("{}+{}", far[i].get<double>(), surface["position"][i].get<std::string>());
}

void place(Json& node, Numbers& n) {
  if (n.chance(0.8)) node["rotate"] = turned(n);
  if (n.chance(0.5)) {
    const double x = n.magnitude(0.3, 3), y = n.magnitude(0.3, 3), z = n.magnitude(0.3, 3);
    node["scale"] = vectorJson(x, y, n.chance(0.2) ? -z : z);
  }
  if (n.chance(0.5)) node["translate"] = offset(n, 3);
}

/// What happens to the surface beside being of its kind; what that is called.
std::string dress(Json& surface, Json& node, Numbers& n) {
  const double which = n.between(0, 1);
  if (which < 0.1) {
    moveFar(surface, node, n);
    return "+offset";
  }
  if (which < 0.2) {
    const double factor = rounded(n.chance(0.5) ? n.magnitude(1e-6, 1e-2) : n.magnitude(1e2, 1e6));
    node["scale"] = Json::array({factor, factor, factor});
    return factor < 1 ? "+tiny" : "+huge";
  }
  if (which < 0.45) {
    place(node, n);
    return "+placed";
  }
  return "";
}

/// Something simple that runs through it.
void addSecond(Json& json, Numbers& n) {
  constexpr const char* kSimple[] = {"sphere", "rectangle", "torus", "cylinder"};
  json["surfaces"]["second"] = {{"type", n.oneOf(kSimple)}};
  Json node = {{"name", "second"}, {"surface", "second"}, {"material", "m"}};
  place(node, n);
  json["nodes"].push_back(std::move(node));
}

/// A light with an exact shadow: far, near, inside of what there is, or at infinity; at times onto a floor.
/// What that is called.
std::string addShadow(Json& json, const Box& framing, Numbers& n) {
  const Vec3 middle = framing.center(), extent = framing.extent();
  const double size = glm::length(extent);
  const double which = n.between(0, 1);
  Json light = {{"intensity", 0.8}, {"shadow", "exact"}};
  Json node = {{"name", "sun"}};
  const Vec3 way(n.between(-1, 1), n.between(-1, 1), n.between(-1, 1));
  if (which < 0.25) {
    node["rotate"] = turned(n);
    light["type"] = "directional";
  } else {
    const double distance = which < 0.5    ? n.magnitude(1, 30)
                            : which < 0.75 ? n.between(0.5, 1.2)
                                           : n.between(0, 0.5);
    const Vec3 at = middle + distance * (which < 0.5 ? size * unit(way) : extent * way);
    node["translate"] = vectorJson(at.x, at.y, at.z);
  }
  node["light"] = std::move(light);
  json["nodes"].push_back(std::move(node));
  if (n.chance(0.4)) {
    json["surfaces"]["floor"] = {{"type", "rectangle"}, {"size", {rounded(3 * size), rounded(3 * size)}}};
    json["nodes"].push_back(
        {{"name", "floor"},
         {"surface", "floor"},
         {"material", "m"},
         {"translate", vectorJson(middle.x, framing.min.y - 0.1 * n.between(-1, 1) * extent.y, middle.z)}});
  }
  return which < 0.25 ? "+sunlit" : which < 0.75 ? "+lit" : "+lit inside";
}

/// Makes the first node of something that is seen through.
std::string addGlass(Json& json, Numbers& n) {
  Json glass = json["materials"]["m"];
  const double opacity = rounded(n.between(0.1, 0.9));
  const bool patterned = n.chance(0.25);
  if (patterned)
    glass["opacity"] = "0.5+0.5*sin(9u+7v)";
  else
    glass["opacity"] = opacity;
  const double blend = n.between(0, 1);
  if (blend > 0.6) glass["blend"] = blend > 0.8 ? "add" : "multiply";
  json["materials"]["glass"] = glass;
  json["nodes"][0]["material"] = "glass";
  return patterned ? "+glass pattern" : "+glass";
}

}  // namespace

Json turned(Numbers& n) {
  const double x = n.between(-1, 1), y = n.between(-1, 1), z = n.between(-1, 1);
  return {{"axis", vectorJson(x, y, z)}, {"angle", rounded(n.between(0, 6.28))}};
}

bool showsFrontOnly(std::uint64_t seed, std::uint64_t index) {
  constexpr std::uint64_t kOwnNumbers = 0x7369646573;
  return Numbers(seed ^ kOwnNumbers, index).chance(0.3);
}

std::pair<PixelSize, int> formatOf(const HardSceneOptions& options, Numbers& n) {
  const bool four = n.chance(kFourSamples);
  const int part = n.whole(0, 8);
  const int samples = options.samples.value_or(four ? 4 : 1);
  // Shells are as fine as pixels ask for: some of what goes wrong does so in larger pictures alone.
  PixelSize size =
      part < 5 ? PixelSize{96 + 16 * part, 72 + 12 * part} : PixelSize{80 * (part - 2), 60 * (part - 2)};
  if (samples > 1) size = {size.width / 2, size.height / 2};
  return {options.size.value_or(size), samples};
}

std::string_view kindAt(std::uint64_t index) {
  const auto kinds = surfaceKinds();
  return kinds[index % kinds.size()].name;
}

Scene sceneOf(const Json& json) { return buildScene(parseScene(json.dump(1), "random")); }

HardScene hardScene(std::uint64_t seed, std::uint64_t index, const HardSceneOptions& options) {
  Numbers n(seed, index);
  const auto kinds = surfaceKinds();
  Json surface = kinds[index % kinds.size()].make(n);
  Json node = {{"name", "hard"}, {"surface", "hard"}, {"material", "m"}};
  HardScene hard{.kind = std::string(kindAt(index)), .camera = {}, .json = {}};
  hard.kind += dress(surface, node, n);
  const auto [size, samples] = formatOf(options, n);
  hard.json = {{"luxo", 1},
               {"x-random", {{"seed", seed}, {"index", index}, {"kind", hard.kind}}},
               {"render", {{"size", {size.width, size.height}}, {"samples", samples}}},
               {"materials", {{"m", {{"diffuse", {0.7, 0.5, 0.3}}}}}},
               {"surfaces", {{"hard", std::move(surface)}}},
               {"nodes", Json::array({std::move(node)})}};
  if (n.chance(0.9)) hard.json["materials"]["m"]["two_sided"] = true;
  if (showsFrontOnly(seed, index)) {
    hard.json["materials"]["m"]["two_sided"] = false;
    hard.kind += "+front only";
  }
  if (n.chance(0.12)) addSecond(hard.json, n);
  const Snapshot snapshot = takeSnapshot(sceneOf(hard.json), 0, size, Camera{});
  const HardCamera camera = hardCamera(snapshot, n);
  hard.camera = camera.kind;
  // From numbers of its own: scenes stay what they were before there were shadows.
  Numbers ofShadows(~seed, index);
  const Box framing = framingOf(snapshot);
  const bool shadows = ofShadows.chance(kWithShadows) && !framing.empty();
  if (shadows) {
    hard.kind += addShadow(hard.json, framing, ofShadows);
    hard.json["x-random"]["kind"] = hard.kind;
  }
  Numbers ofGlass(seed ^ kGlass, index);
  if (ofGlass.chance(shadows ? kGlassInShadows : kWithGlass)) {
    hard.kind += addGlass(hard.json, ofGlass);
    hard.json["x-random"]["kind"] = hard.kind;
  }
  hard.json["x-random"]["camera"] = camera.kind;
  const Camera seen = cameraOf(camera.json);
  const Vec3 eye = seen.eye.at({}), aside = 0.3 * glm::distance(eye, seen.lookAt.at({})) * seen.up.at({});
  hard.json["nodes"].push_back({{"name", "lamp"},
                                {"translate", vectorJson(eye.x + aside.x, eye.y + aside.y, eye.z + aside.z)},
                                {"light", {{"intensity", 0.9}}}});
  hard.json["camera"] = camera.json;
  return hard;
}

RandomSight randomSight(const Scene& scene, std::uint64_t seed, std::uint64_t index,
                        const HardSceneOptions& options) {
  Numbers n(seed, index);
  const double time = rounded(n.between(0, 10));
  const auto [size, samples] = formatOf(options, n);
  const HardCamera camera = hardCamera(takeSnapshot(scene, time, size, Camera{}), n);
  return {camera.kind, camera.json, time, size, samples};
}

}  // namespace luxo::random
