// SPDX-License-Identifier: Apache-2.0
#include "random/crowd_scene.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "random/scene_parts.h"
#include "surface/catalogue.h"

namespace luxo::random {
namespace {

constexpr double kHalf = 3;  // of the ground that they stand on, about; metres

/// A named surface, one or two metres large, on the ground or above it.
void addSurface(Json& json, int number, Numbers& n) {
  const CatalogueEntry& entry = n.oneOf(catalogue());
  const Surface surface = makeSurface(entry);
  const Box box = surface.framing({});
  const double size = std::max(glm::length(box.extent()), 1e-3);
  const double scale = rounded(n.between(0.8, 2.5) / size);
  const std::string name = std::string(entry.name);
  json["surfaces"][name] = {{"type", name}};
  const bool stands = n.chance(0.5);
  const double height = stands ? -scale * box.min.y : n.between(0, 2.5);
  const double x = n.between(-kHalf, kHalf), z = n.between(-kHalf, kHalf);
  Json node = {{"name", "n" + std::to_string(number)},
               {"surface", name},
               {"material", n.chance(0.3) ? "b" : "a"},
               {"translate", vectorJson(x, height, z)}};
  if (!stands) node["rotate"] = turned(n);
  if (n.chance(0.15)) {
    const double a = scale * n.between(0.4, 1.6), b = scale * n.between(0.4, 1.6);
    node["scale"] = vectorJson(a, stands ? scale : scale * n.between(0.4, 1.6), n.chance(0.3) ? -b : b);
  } else {
    node["scale"] = Json::array({scale, scale, scale});
  }
  json["nodes"].push_back(std::move(node));
}

void addFloor(Json& json, Numbers& n) {
  constexpr const char* kFloors[] = {"rectangle", "rectangle", "disk", "paraboloid"};
  const std::string floor = n.oneOf(kFloors);
  Json& surface = json["surfaces"]["floor"] = {{"type", floor}};
  if (floor == "rectangle") surface["size"] = {16, 16};
  if (floor == "disk") surface["radius"] = 8;
  if (floor == "paraboloid") surface.update({{"focal_length", 6}, {"height", 2.5}});
  Json node = {{"name", "floor"}, {"surface", "floor"}, {"material", "a"}};
  if (floor == "paraboloid") node["translate"] = {0, -0.5, 0};
  if (n.chance(0.2)) node["rotate"] = {{"axis", {1, 0, 0}}, {"angle", rounded(n.signedBetween(0, 0.2))}};
  json["nodes"].push_back(std::move(node));
}

/// What it is called.
std::string addLight(Json& json, int number, int surfaces, Numbers& n) {
  Json light = {{"intensity", rounded(n.between(0.3, 0.9))}, {"shadow", "exact"}};
  Json node = {{"name", "light" + std::to_string(number)}};
  std::string kind;
  const double which = n.between(0, 1);
  const double x = n.between(-1, 1), y = n.between(0.05, 1), z = n.between(-1, 1);
  if (which < 0.3) {
    light["type"] = "directional";
    if (n.chance(0.7)) {
      const bool grazes = n.chance(0.3);
      const double elevation = grazes ? n.magnitude(1e-3, 0.1) : n.between(0.2, 1.5);
      node["rotate"] = Json::array({{{"axis", {0, 1, 0}}, {"angle", rounded(n.between(0, 6.28))}},
                                    {{"axis", {1, 0, 0}}, {"angle", rounded(-elevation)}}});
      kind = grazes ? "low sun" : "sun";
    } else {
      node["rotate"] = turned(n);
      kind = "direction";
    }
  } else if (which < 0.5) {
    const double distance = n.magnitude(8, 1000);
    const Vec3 way = unit(Vec3(x, y, z));
    node["translate"] = vectorJson(distance * way.x, distance * way.y, distance * way.z);
    kind = "far";
  } else if (which < 0.75) {
    node["translate"] = vectorJson(1.5 * kHalf * x, 1 + 5 * y, 1.5 * kHalf * z);
    kind = "near";
  } else if (which < 0.9) {
    // At what is the origin of one of them.
    Json at = json["nodes"][static_cast<std::size_t>(n.whole(0, surfaces - 1))]["translate"];
    if (n.chance(0.7)) at[1] = rounded(at[1].get<double>() + n.between(0, 0.3));
    node["translate"] = std::move(at);
    kind = "inside";
  } else {
    node["translate"] = vectorJson(2 * kHalf * x, n.magnitude(1e-3, 0.3), 2 * kHalf * z);
    kind = "grazing";
  }
  if (n.chance(0.08)) {
    light["radius"] = rounded(which < 0.3 ? n.magnitude(1e-3, 0.2) : n.magnitude(1e-2, 0.5));
    light["shadow_samples"] = n.whole(2, 8);
    kind += " soft";
  }
  if (n.chance(0.25)) {
    Json casters = Json::array();
    for (int i = 0; i < surfaces; ++i)
      if (n.chance(0.5)) casters.push_back("n" + std::to_string(i));
    if (!casters.empty()) light["casters"] = std::move(casters);
  }
  node["light"] = std::move(light);
  json["nodes"].push_back(std::move(node));
  return kind;
}

/// Of some scenes a spot, aimed at something near the middle; from numbers of its own, so that all else of
/// them is what it was before. Whether there is one.
bool addSpot(Json& json, std::uint64_t seed, std::uint64_t index) {
  constexpr std::uint64_t kOwnNumbers = 0x73706f74;
  Numbers n(seed ^ kOwnNumbers, index);
  if (!n.chance(0.15)) return false;
  const double around = n.between(0, kTau), down = n.between(0.1, 1.5), distance = n.magnitude(1, 30);
  const Vec3 way(-std::sin(around) * std::cos(down), -std::sin(down), -std::cos(around) * std::cos(down));
  const Vec3 at = Vec3(n.between(-2, 2), n.between(0, 1), n.between(-2, 2)) - distance * way;
  const double outer = n.magnitude(0.02, 1.57);
  Json light = {{"intensity", 0.7},
                {"shadow", "exact"},
                {"spot", {{"inner", rounded(outer * n.between(0, 0.9))}, {"outer", rounded(outer)}}}};
  json["nodes"].push_back({{"name", "spot"},
                           {"translate", vectorJson(at.x, at.y, at.z)},
                           {"rotate", Json::array({{{"axis", {0, 1, 0}}, {"angle", rounded(around)}},
                                                   {{"axis", {1, 0, 0}}, {"angle", rounded(-down)}}})},
                           {"light", std::move(light)}});
  return true;
}

/// Of some scenes a lamp: a shade with one to three lights in its focus, or beside it, that it alone casts
/// the shadow of; from numbers of its own, too. Whether there is one.
bool addLamp(Json& json, std::uint64_t seed, std::uint64_t index) {
  constexpr std::uint64_t kOwnNumbers = 0x6c616d70;
  Numbers n(seed ^ kOwnNumbers, index);
  if (!n.chance(0.15)) return false;
  const double focalLength = rounded(n.magnitude(0.03, 1)), height = rounded(n.magnitude(0.3, 2));
  json["surfaces"]["shade"] = {{"type", "paraboloid"}, {"focal_length", focalLength}, {"height", height}};
  Json bulbs = Json::array();
  const int lights = n.chance(0.6) ? 1 : n.whole(2, 3);
  for (int i = 0; i < lights; ++i) {
    Json light = {{"intensity", rounded(n.between(0.2, 0.6))},
                  {"shadow", "exact"},
                  {"casters", Json::array({"shade"})}};
    if (n.chance(0.15)) light["spot"] = {{"inner", 0.2}, {"outer", rounded(n.between(0.3, 1.5))}};
    const double off = n.chance(0.2) ? n.magnitude(1e-6, 0.1) : 0;
    bulbs.push_back({{"name", "bulb" + std::to_string(i)},
                     {"translate", {0, focalLength + off, 0}},
                     {"rotate", {{"axis", {1, 0, 0}}, {"angle", rounded(n.between(0, 3.1))}}},
                     {"light", std::move(light)}});
  }
  const double scale = rounded(n.between(0.4, 1.5)), across = n.chance(0.1) ? rounded(1.2 * scale) : scale;
  const double x = n.between(-kHalf, kHalf), y = n.between(0.3, 3), z = n.between(-kHalf, kHalf);
  json["nodes"].push_back({{"name", "shade"},
                           {"surface", "shade"},
                           {"material", n.chance(0.2) ? "b" : "a"},
                           {"translate", vectorJson(x, y, z)},
                           {"rotate", turned(n)},
                           {"scale", {across, scale, scale}},
                           {"children", std::move(bulbs)}});
  return true;
}

/// As people look at a table, mostly.
HardCamera cameraOver(const Json& json, PixelSize size, Numbers& n) {
  if (n.chance(0.35)) return hardCamera(takeSnapshot(sceneOf(json), 0, size, Camera{}), n);
  const double around = n.between(0, kTau), up = n.between(0.05, 1.2), distance = n.between(5, 14);
  const Vec3 eye =
      distance * Vec3(std::cos(around) * std::cos(up), std::sin(up), std::sin(around) * std::cos(up));
  const double x = n.between(-1, 1), y = n.between(0, 1), z = n.between(-1, 1);
  return {"over",
          {{"eye", vectorJson(eye.x, eye.y, eye.z)},
           {"look_at", vectorJson(x, y, z)},
           {"up", {0, 1, 0}},
           {"near", 0.05},
           {"fov_y", rounded(n.between(0.4, 1.1))}}};
}

}  // namespace

HardScene crowdScene(std::uint64_t seed, std::uint64_t index, const HardSceneOptions& options) {
  constexpr std::uint64_t kOwnNumbers = 0x63726f7764;
  Numbers n(seed ^ kOwnNumbers, index);
  const auto [size, samples] = formatOf(options, n);
  HardScene crowd{.kind = std::string(kCrowd), .camera = {}, .json = {}};
  crowd.json = {
      {"luxo", 1},
      {"x-random", {{"seed", seed}, {"index", index}}},
      {"render", {{"size", {size.width, size.height}}, {"samples", samples}}},
      {"materials",
       {{"a", {{"diffuse", {0.7, 0.5, 0.3}}, {"two_sided", true}}}, {"b", {{"diffuse", {0.3, 0.5, 0.7}}}}}},
      {"surfaces", Json::object()},
      {"nodes", Json::array()}};
  if (showsFrontOnly(seed, index)) {
    crowd.json["materials"]["a"]["two_sided"] = false;
    crowd.kind += "+front only";
  }
  const int surfaces = n.whole(3, 12);
  for (int i = 0; i < surfaces; ++i) addSurface(crowd.json, i, n);
  if (n.chance(0.2)) {
    Json& glass = crowd.json["materials"]["b"];
    glass["opacity"] = rounded(n.between(0.2, 0.8));
    if (n.chance(0.4)) glass["blend"] = "multiply";
    crowd.kind += "+glass";
  }
  if (n.chance(0.8)) addFloor(crowd.json, n);
  const int lights = n.chance(0.5) ? 1 : n.whole(2, 4);
  for (int i = 0; i < lights; ++i) crowd.kind += "+" + addLight(crowd.json, i, surfaces, n);
  if (addSpot(crowd.json, seed, index)) crowd.kind += "+spot";
  if (addLamp(crowd.json, seed, index)) crowd.kind += "+lamp";
  const HardCamera camera = cameraOver(crowd.json, size, n);
  crowd.camera = camera.kind;
  crowd.json["camera"] = camera.json;
  crowd.json["x-random"]["kind"] = crowd.kind;
  crowd.json["x-random"]["camera"] = crowd.camera;
  return crowd;
}

}  // namespace luxo::random
