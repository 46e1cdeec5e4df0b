// SPDX-License-Identifier: Apache-2.0
#include "scene_inspection.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "cull/cull.h"
#include "draw/draw_list.h"
#include "draw/renderer.h"
#include "scene/scene_keys.h"
#include "scene/snapshot.h"
#include "surface/surface_triangles.h"

namespace luxo {
namespace {

using Json = nlohmann::ordered_json;

/// JSON has no infinity.
Json numberJson(double value) { return std::isfinite(value) ? Json(value) : Json(); }

Json mapJson(const ShadowMapThen& map) {
  return {{"size", map.size},
          {"bias", map.bias},
          {"slope_bias", map.slopeBias},
          {"normal_offset", map.normalOffset},
          {"pcf", map.pcf},
          {"receiver_plane", map.receiverPlane}};
}

Json vectorJson(const Vec3& v) { return {numberJson(v.x), numberJson(v.y), numberJson(v.z)}; }

Json boxJson(const Box& box) {
  if (box.empty()) return nullptr;
  return {{"min", vectorJson(box.min)}, {"max", vectorJson(box.max)}};
}

Json intervalJson(const Interval& range) { return {range.lo, range.hi}; }

/// Everything that is asked of a scene at one moment.
class Inspector {
 public:
  Inspector(const ViewedScene& viewed, std::vector<std::string> warnings)
      : scene_(viewed.scene),
        settings_(viewed.settings),
        values_(scene_.parametersAt(settings_.time)),
        moment_(settings_.time, values_),
        camera_(viewed.camera),
        snapshot_(takeSnapshot(scene_, settings_.time, settings_.size, viewed.camera)),
        warnings_(std::move(warnings)) {
    for (const SnapshotNode& node : snapshot_.nodes) shown_[node.id.index] = &node;
  }

  Json inspect(const std::string& name) {
    Json json = {{"luxo", LUXO_VERSION},
                 {"inspect", 1},
                 {"scene", name},
                 {"time", settings_.time},
                 {"size", {settings_.size.width, settings_.size.height}},
                 {"shading", nameOf(settings_.shading)},
                 {"count", countsJson()},
                 {"picture", pictureJson()},
                 {"bounds", boxJson(boundsOfAll())},
                 {"parameters", parametersJson()},
                 {"nodes", nodesJson()},
                 {"surfaces", surfacesJson()},
                 {"materials", materialsJson()},
                 {"lights", lightsJson()},
                 {"cameras", camerasJson()}};
    json["warnings"] = warnings_;
    return json;
  }

 private:
  [[nodiscard]] Json countsJson() const {
    std::size_t nodes = 0, surfaces = 0, lights = 0;
    for (const Scene::Entry& entry : scene_.nodes()) {
      if (entry.removed) continue;
      ++nodes;
      surfaces += entry.node.surface.valid() ? 1 : 0;
      lights += entry.node.light ? 1 : 0;
    }
    return {{"nodes", nodes},
            {"shown", snapshot_.nodes.size()},
            {"with_surface", surfaces},
            {"surfaces", distinctSurfaces().size()},
            {"materials", scene_.materials().size() - 1},
            {"lights", lights},
            {"cameras", scene_.cameras().size()},
            {"parameters", scene_.parameters().size()}};
  }

  /// What a picture would be made of.
  [[nodiscard]] Json pictureJson() {
    DrawOptions options = drawOptions(settings_);
    const VisibleList visible =
        cull(snapshot_,
             {.tolerancePx = options.tolerancePx, .samples = options.samples, .shading = options.shading});
    options.samples = 1;  // shadows, and what is seen through, are found for one point of each pixel
    Geometry geometry;
    const DrawList list = listDraws(snapshot_, visible, options, geometry);
    std::uint64_t triangles = 0;
    for (const auto* batches : {&list.opaque, &list.transparent, &list.layers.meshes})
      for (const DrawBatch& batch : *batches) triangles += batch.indexCount / 3 * batch.instanceCount;
    if (!std::isfinite(list.boundPx)) warnings_.push_back("the error of the picture has no proven bound");
    return {{"tolerance_px", options.tolerancePx},
            {"bound_px", numberJson(list.boundPx)},
            {"drawn", visible.counts.drawn},
            {"draw_calls", list.opaque.size() + list.transparent.size() + list.layers.meshes.size() +
                               list.layers.searches.size()},
            {"triangles", triangles}};
  }

  [[nodiscard]] Box boundsOfAll() const {
    Box box;
    for (const SnapshotNode& node : snapshot_.nodes) box.add(node.boundsWorld);
    return box;
  }

  [[nodiscard]] Json parametersJson() const {
    Json list = Json::array();
    for (std::size_t i = 0; i < values_.size(); ++i) {
      const Parameter& parameter = scene_.parameters()[i];
      list.push_back({{"name", parameter.name},
                      {"label", parameter.labelOrName()},
                      {"value", values_[i]},
                      {"range", parameter.range ? intervalJson(*parameter.range) : Json()},
                      {"step", parameter.step ? Json(*parameter.step) : Json()},
                      {"moves", parameter.value.movesWithTime()}});
    }
    return list;
  }

  /// Nodes with their depths, each before what hangs on it, and that before the next.
  [[nodiscard]] std::vector<std::pair<std::uint32_t, int>> tree() const {
    const auto& nodes = scene_.nodes();
    std::vector<std::vector<std::uint32_t>> below(nodes.size());
    std::vector<std::pair<std::uint32_t, int>> open, all;  // open: the next one is the last
    for (auto i = static_cast<std::uint32_t>(nodes.size()); i-- > 0;) {
      if (nodes[i].removed) continue;
      if (const NodeId parent = nodes[i].node.parent; parent.valid())
        below[parent.index].push_back(i);
      else
        open.emplace_back(i, 0);
    }
    while (!open.empty()) {
      const auto [node, depth] = open.back();
      open.pop_back();
      all.emplace_back(node, depth);
      for (const std::uint32_t child : below[node]) open.emplace_back(child, depth + 1);
    }
    return all;
  }

  /// In file order, models' below their nodes; `depth` is that in the tree.
  [[nodiscard]] Json nodesJson() const {
    Json list = Json::array();
    for (const auto& [i, depth] : tree()) {
      const auto& [node, removed, bounds] = scene_.nodes()[i];
      const auto shown = shown_.find(i);
      list.push_back({{"name", node.name},
                      {"depth", depth},
                      {"surface", node.surface.valid() ? Json(node.surface.name()) : Json()},
                      {"material", node.surface.valid() ? Json(materialName(node.material)) : Json()},
                      {"light", node.light.has_value()},
                      {"shown", shown != shown_.end() || (!node.surface.valid() && node.visible.at(moment_))},
                      {"bounds", shown != shown_.end() ? boxJson(shown->second->boundsWorld) : Json()}});
    }
    return list;
  }

  [[nodiscard]] std::string materialName(MaterialId id) const { return scene_[id].at(moment_).name; }

  [[nodiscard]] std::vector<const Surface*> distinctSurfaces() const {
    std::vector<const Surface*> surfaces;
    std::set<const void*> known;
    for (const Scene::Entry& entry : scene_.nodes())
      if (!entry.removed && entry.node.surface.valid() && known.insert(entry.node.surface.identity()).second)
        surfaces.push_back(&entry.node.surface);
    return surfaces;
  }

  [[nodiscard]] Json surfacesJson() {
    Json list = Json::array();
    for (const Surface* surface : distinctSurfaces()) {
      if (const SurfaceTriangles* triangles = surface->triangles()) {
        list.push_back(meshJson(*surface, *triangles));
        continue;
      }
      const Topology& topology = surface->topology();
      std::set<const SurfaceFunction*> functions;
      std::size_t position = 0, second = 0;
      for (const Patch& patch : surface->patches())
        if (functions.insert(patch.function.get()).second) {
          position += patch.function->position.stepCount();
          second += patch.function->second.stepCount();
        }
      list.push_back({{"name", surface->name()},
                      {"patches", surface->patchCount()},
                      {"formulas", functions.size()},
                      {"operations", position},
                      {"second_derivative_operations", second},
                      {"closed", topology.closed},
                      {"orientable", topology.orientable},
                      {"euler_characteristic", topology.eulerCharacteristic},
                      {"u", intervalJson(surface->domain().u)},
                      {"v", intervalJson(surface->domain().v)}});
      if (!topology.orientable)
        warnings_.push_back(fmt::format("surface '{}' has one side only: it is lit from wherever it is seen",
                                        surface->name()));
    }
    return list;
  }

  [[nodiscard]] static Json meshJson(const Surface& surface, const SurfaceTriangles& triangles) {
    const MeshEdges& edges = triangles.mesh.edges();
    return {{"name", surface.name()},
            {"triangles", triangles.count},
            {"vertices", triangles.mesh.positions().size()},
            {"closed", surface.closed()},
            {"border_edges", edges.border},
            {"turned_edges", edges.turned},
            {"non_manifold_edges", edges.nonManifold},
            {"dropped_triangles", triangles.mesh.dropped()},
            {"u", intervalJson(surface.domain().u)},
            {"v", intervalJson(surface.domain().v)}};
  }

  [[nodiscard]] Json materialsJson() const {
    Json list = Json::array();
    for (std::size_t i = 1; i < scene_.materials().size(); ++i) {
      const Material material = scene_.materials()[i].at(moment_);
      list.push_back({{"name", material.name},
                      {"diffuse", vectorJson(material.diffuse)},
                      {"ambient", vectorJson(material.ambientOrDiffuse())},
                      {"specular", vectorJson(material.specular)},
                      {"shininess", material.shininess},
                      {"opacity", material.opacity},
                      {"blend", keys::kBlends[static_cast<std::size_t>(material.blend)]}});
    }
    return list;
  }

  [[nodiscard]] static Json coneJson(const SpotCone& cone) {
    constexpr double kDegrees = 180 / kPi;
    return {{"axis", vectorJson(cone.axis)},
            {"inner_degrees", cone.inner * kDegrees},
            {"outer_degrees", cone.outer * kDegrees}};
  }

  [[nodiscard]] Json lightsJson() const {
    Json list = Json::array();
    // As the scene has them: one with a radius is one light.
    for (const SnapshotLight& light :
         takeSnapshot(scene_, settings_.time, settings_.size, camera_, 1).lights) {
      const std::string attenuation =
          light.attenuation == Light::Attenuation::InverseSquare ? "inverse-square" : "none";
      list.push_back(
          {{"node", scene_[light.id].name},
           {"type", light.cone            ? "spot"
                    : light.directional() ? "directional"
                                          : "point"},
           {light.directional() ? "toward_light" : "position", vectorJson(Vec3(light.positionWorld))},
           {"radiance", vectorJson(light.radiance)},
           {"attenuation", attenuation},
           {"cone", light.cone ? coneJson(*light.cone) : Json()},
           {"shadow", light.hasShadow()},
           {"shadow_kind", keys::kShadows.at(static_cast<std::size_t>(scene_[light.id].light->shadow))},
           {"radius", scene_[light.id].light->radius.at(moment_)},
           {"shadow_samples", scene_[light.id].light->shadowSamples},
           {"map", light.map ? mapJson(*light.map) : Json()}});
    }
    return list;
  }

  [[nodiscard]] Json camerasJson() const {
    Json list = Json::array();
    for (const Camera& camera : scene_.cameras()) {
      const bool perspective = camera.projection == Projection::Perspective;
      list.push_back({{"name", camera.name},
                      {"type", perspective ? "perspective" : "orthographic"},
                      {"eye", vectorJson(camera.eye.at(moment_))},
                      {"look_at", vectorJson(camera.lookAt.at(moment_))},
                      {perspective ? "fov_y_degrees" : "height",
                       perspective ? camera.fovY.at(moment_) * (180 / kPi) : camera.height.at(moment_)}});
    }
    return list;
  }

  const Scene& scene_;
  const RenderSettings& settings_;
  std::vector<double> values_;
  Moment moment_;
  CameraId camera_;
  Snapshot snapshot_;
  std::map<std::uint32_t, const SnapshotNode*> shown_;
  std::vector<std::string> warnings_;
};

// --- as text
// ---------------------------------------------------------------------------------------------------

std::string numberText(const Json& number) {
  return number.is_null() ? "infinite" : fmt::format("{:.6g}", number.get<double>());
}

std::string listText(const Json& numbers) {
  std::vector<std::string> texts;
  for (const Json& number : numbers) texts.push_back(numberText(number));
  return fmt::format("({})", fmt::join(texts, ", "));
}

std::string boundsText(const Json& box) {
  if (box.is_null()) return {};
  return fmt::format("{} to {}", listText(box["min"]), listText(box["max"]));
}

std::string textOf(const Json& value, const char* otherwise = "") {
  return value.is_null() ? otherwise : value.get<std::string>();
}

std::string counted(const Json& count, const char* thing) {
  return fmt::format("{} {}{}", count.get<std::uint64_t>(), thing, count == 1 ? "" : "s");
}

std::string header(const Json& json) {
  const Json &count = json["count"], &picture = json["picture"];
  std::string text = fmt::format("{} at {} s\n", json["scene"].get<std::string>(), numberText(json["time"]));
  text += fmt::format("  {}, {} shown, {}, {}, {}, {}, {}\n", counted(count["nodes"], "node"),
                      count["shown"].get<std::uint64_t>(), counted(count["surfaces"], "surface"),
                      counted(count["materials"], "material"), counted(count["lights"], "light"),
                      counted(count["cameras"], "camera"), counted(count["parameters"], "parameter"));
  if (!json["bounds"].is_null()) text += fmt::format("  from {} metres\n", boundsText(json["bounds"]));
  return text + fmt::format("  {} in {} x {} pixels within {} px, proven bound {} px\n",
                            counted(picture["triangles"], "triangle"), json["size"][0].get<int>(),
                            json["size"][1].get<int>(), numberText(picture["tolerance_px"]),
                            numberText(picture["bound_px"]));
}

std::string nodeText(const Json& node) {
  const std::string name = node["name"].get<std::string>();
  std::string text =
      fmt::format("  {:{}}{:<20}", "", 2 * node["depth"].get<int>(), name.empty() ? "-" : name);
  if (!node["surface"].is_null())
    text += fmt::format(" {}, {}", textOf(node["surface"]), textOf(node["material"]));
  if (node["light"].get<bool>()) text += " light";
  if (!node["shown"].get<bool>()) text += " hidden";
  return text + (node["bounds"].is_null() ? "\n" : fmt::format("  {}\n", boundsText(node["bounds"])));
}

std::string surfaceText(const Json& surface) {
  if (surface.contains("triangles"))
    return fmt::format("  {:<20} {} mesh, {}, {}\n", textOf(surface["name"]),
                       surface["closed"].get<bool>() ? "closed" : "open",
                       counted(surface["triangles"], "triangle"),
                       counted(surface["border_edges"], "border edge"));
  const char* kind = surface["closed"].get<bool>()       ? "closed"
                     : surface["orientable"].get<bool>() ? "open"
                                                         : "one-sided";
  return fmt::format("  {:<20} {}, u {} v {}, {}, {}\n", textOf(surface["name"]), kind,
                     listText(surface["u"]), listText(surface["v"]),
                     counted(surface["patches"], surface["patches"] == 1 ? "patch" : "patche"),
                     counted(surface["operations"], "operation"));
}

std::string parameterText(const Json& parameter) {
  std::string text =
      fmt::format("  {:<20} {}", parameter["name"].get<std::string>(), numberText(parameter["value"]));
  if (!parameter["range"].is_null()) text += fmt::format(", range {}", listText(parameter["range"]));
  if (!parameter["step"].is_null()) text += fmt::format(", step {}", numberText(parameter["step"]));
  if (parameter["moves"].get<bool>()) text += ", moves with time";
  if (parameter["label"] != parameter["name"]) text += fmt::format(", \"{}\"", textOf(parameter["label"]));
  return text + "\n";
}

std::string lightText(const Json& light) {
  const bool point = light["type"] != "directional";
  std::string shadow =
      light["shadow"].get<bool>() ? fmt::format(", {} shadow", textOf(light["shadow_kind"])) : "";
  if (light["shadow"].get<bool>() && light["radius"] != 0)
    shadow += fmt::format(", radius {} by {} samples", numberText(light["radius"]),
                          light["shadow_samples"].get<std::uint32_t>());
  if (const Json& map = light["map"]; !map.is_null())
    shadow += fmt::format(
        ", map of {} texels, bias {}, slope {}, normal offset {}, pcf {}{}", map["size"].get<std::uint32_t>(),
        numberText(map["bias"]), numberText(map["slope_bias"]), numberText(map["normal_offset"]),
        map["pcf"].get<std::uint32_t>(), map["receiver_plane"].get<bool>() ? ", receiver plane" : "");
  std::string cone;
  if (const Json& spot = light["cone"]; !spot.is_null())
    cone = fmt::format(", cone along {} from {} to {} degrees", listText(spot["axis"]),
                       numberText(spot["inner_degrees"]), numberText(spot["outer_degrees"]));
  return fmt::format("  {:<20} {}, {} {}, radiance {}, attenuation {}{}{}\n", textOf(light["node"]),
                     textOf(light["type"]), point ? "at" : "toward",
                     listText(light[point ? "position" : "toward_light"]), listText(light["radiance"]),
                     textOf(light["attenuation"]), cone, shadow);
}

std::string cameraText(const Json& camera) {
  const bool perspective = camera["type"] == "perspective";
  return fmt::format("  {:<20} {}, eye {}, look_at {}, {} {}\n", textOf(camera["name"]),
                     textOf(camera["type"]), listText(camera["eye"]), listText(camera["look_at"]),
                     perspective ? "fov_y degrees" : "height",
                     numberText(camera[perspective ? "fov_y_degrees" : "height"]));
}

template <class Line>
std::string section(const Json& json, const char* name, const Line& line) {
  if (json[name].empty()) return {};
  std::string text = fmt::format("\n{}\n", name);
  for (const Json& entry : json[name]) text += line(entry);
  return text;
}

}  // namespace

Json inspectScene(const std::string& name, const ViewedScene& viewed, std::vector<std::string> warnings) {
  return Inspector(viewed, std::move(warnings)).inspect(name);
}

std::string inspectionText(const Json& inspection) {
  return header(inspection) + section(inspection, "nodes", nodeText) +
         section(inspection, "surfaces", surfaceText) + section(inspection, "parameters", parameterText) +
         section(inspection, "lights", lightText) + section(inspection, "cameras", cameraText) +
         section(inspection, "warnings", [](const Json& warning) { return "  " + textOf(warning) + "\n"; });
}

}  // namespace luxo
