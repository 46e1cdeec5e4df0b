// SPDX-License-Identifier: Apache-2.0
#include "pixel_inspection.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "base/error.h"
#include "base/srgb_curve.h"
#include "base/suggestion.h"
#include "cull/cull.h"
#include "draw/draw_list.h"
#include "draw/renderer.h"
#include "gpu/context.h"
#include "mesh/triangle_mesh.h"
#include "option_values.h"
#include "reference/explained_pixel.h"
#include "scene/scene_keys.h"
#include "surface/surface_triangles.h"

namespace luxo {
namespace {

using Json = nlohmann::ordered_json;

/// JSON has no infinity.
Json numberJson(double value) { return std::isfinite(value) ? Json(value) : Json(); }
Json vectorJson(const Vec2& v) { return {numberJson(v.x), numberJson(v.y)}; }
Json vectorJson(const Vec3& v) { return {numberJson(v.x), numberJson(v.y), numberJson(v.z)}; }
Json vectorJson(const Vec4& v) {
  return {numberJson(v.x), numberJson(v.y), numberJson(v.z), numberJson(v.w)};
}

Mat4 matrixOf(const Transform& t) {
  Mat4 m(1);
  for (int column = 0; column < 3; ++column) m[column] = Vec4(t.linear[column], 0);
  m[3] = Vec4(t.translation, 1);
  return m;
}

Json rowsJson(const Mat4& m) {
  Json rows = Json::array();
  for (int row = 0; row < 4; ++row) rows.push_back({m[0][row], m[1][row], m[2][row], m[3][row]});
  return rows;
}

Json codesJson(const Vec3& linear) {
  Json codes = Json::array();
  for (int i = 0; i < 3; ++i)
    codes.push_back(int(std::floor(255 * srgbFromLinear(std::clamp(linear[i], 0.0, 1.0)) + 0.5)));
  return codes;
}

class Inspector {
 public:
  explicit Inspector(const ViewedScene& viewed, const std::string& device)
      : scene_(viewed.scene),
        device_(device),
        settings_(viewed.settings),
        snapshot_(takeSnapshot(scene_, settings_.time, settings_.size, viewed.camera)) {}

  Json pixel(const std::string& name, int x, int y) const {
    const ExplainedPixel why = explainPixel(snapshot_, {x + 0.5, y + 0.5});
    Json json = header(name);
    json["pixel"] = {{"x", x}, {"y", y}};
    json["ray"] = {{"origin", vectorJson(why.origin)}, {"direction", vectorJson(why.direction)}};
    json["color"] = colorJson(why, x, y);
    json["certified"] = why.certified;
    json["points"] = Json::array();
    for (const PointOnRay& point : why.points) json["points"].push_back(pointJson(point));
    if (!why.points.empty()) {
      const PointOnRay& first = why.points[0];
      json["vertex"] = stationsJson(first.node, first.positionObject);
      json["pipeline"] = pipelineJson(first.node);
    }
    return json;
  }

  Json vertex(const std::string& name, const std::string& text) const {
    const std::size_t colon = text.rfind(':');
    const std::string hint = "as in --vertex ball:0.5,0.25, a point by (u, v), or --vertex model:17";
    if (colon == std::string::npos || colon == 0)
      throw Error(ErrorKind::Usage, fmt::format("--vertex '{}': not NODE:U,V", text), hint);
    const std::uint32_t node = nodeNamed(text.substr(0, colon));
    const SnapshotNode& of = snapshot_.nodes[node];
    const std::string place = text.substr(colon + 1);
    Json json = header(name);
    json["node"] = nameOf(of.id);
    json["number"] = of.number;
    Vec3 position(0), normal(0);
    if (const SurfaceTriangles* triangles = of.surface.triangles()) {
      const TriangleMesh& mesh = triangles->mesh;
      const auto index = finiteNumber(place);
      if (!index || *index < 0 || *index != std::floor(*index) || *index >= double(mesh.positions().size()))
        throw Error(ErrorKind::Usage, fmt::format("--vertex '{}': no vertex of {}", text, of.surface.name()),
                    fmt::format("it has {}, from 0", mesh.positions().size()));
      json["index"] = std::uint32_t(*index);
      position = mesh.point(std::uint32_t(*index));
      normal = Vec3(mesh.normals()[std::uint32_t(*index)]);
    } else {
      const std::size_t comma = place.find(',');
      const auto u = finiteNumber(place.substr(0, comma));
      const auto v =
          comma == std::string::npos ? std::nullopt : finiteNumber(std::string_view(place).substr(comma + 1));
      if (!u || !v) throw Error(ErrorKind::Usage, fmt::format("--vertex '{}': not NODE:U,V", text), hint);
      const Domain& domain = of.surface.domain();
      if (!domain.contains(*u, *v))
        throw Error(ErrorKind::Usage, fmt::format("--vertex '{}': no point of {}", text, of.surface.name()),
                    fmt::format("u is from {} to {}, v from {} to {}", domain.u.lo, domain.u.hi, domain.v.lo,
                                domain.v.hi));
      json["uv"] = {*u, *v};
      position = of.surface.position(*u, *v, of.parameters);
      normal = of.surface.normal(*u, *v, of.parameters);
    }
    json["vertex"] = stationsJson(node, position);
    json["vertex"]["normal_model"] = vectorJson(normal);
    json["vertex"]["normal_world"] = vectorJson(unit(normalMatrix(of.worldFromObject.linear) * normal));
    json["pipeline"] = pipelineJson(node);
    return json;
  }

 private:
  /// The reference runs no shader: where one lights what is seen, the picture is asked.
  Json colorJson(const ExplainedPixel& why, int x, int y) const {
    Vec3 color = why.color;
    if (std::ranges::any_of(why.points, [&](const PointOnRay& point) { return isLitByShader(point); })) {
      gpu::Context context({.device = device_});
      DrawOptions options = drawOptions(settings_);
      options.samples = 1;
      const Image image = Renderer(context).render(snapshot_, options).image;
      for (int i = 0; i < 3; ++i) color[i] = image.pixel(x, y)[static_cast<std::size_t>(i)];
    }
    return {{"linear", vectorJson(color)}, {"srgb8", codesJson(color)}};
  }

  bool isLitByShader(const PointOnRay& point) const {
    return point.seen && materialOf(point.node).shader != nullptr;
  }

  Json header(const std::string& name) const {
    return {{"luxo", LUXO_VERSION},
            {"inspect", 1},
            {"scene", name},
            {"time", settings_.time},
            {"size", {settings_.size.width, settings_.size.height}}};
  }

  std::string nameOf(NodeId id) const {
    return scene_[id].name.empty() ? scene_.shownName(id) : scene_[id].name;
  }

  std::uint32_t nodeNamed(const std::string& name) const {
    std::vector<std::string> names;
    for (std::uint32_t i = 0; i < snapshot_.nodes.size(); ++i) {
      const SnapshotNode& node = snapshot_.nodes[i];
      names.push_back(nameOf(node.id));
      if (names.back() == name || std::to_string(node.number) == name) return i;
    }
    throw Error(
        ErrorKind::Usage, fmt::format("--vertex: the scene shows no surface of a node '{}'", name),
        names.empty() ? "it shows none" : didYouMean(name, names, fmt::format("it has {}", listed(names))));
  }

  const Material& materialOf(std::uint32_t node) const {
    return snapshot_.materials[snapshot_.nodes[node].material.index];
  }

  Json lightJson(const LightOnPoint& light) const {
    const bool directional = !std::isfinite(light.distance);
    return {{"node", nameOf(light.light)},
            {"type", scene_[light.light].light->spot ? "spot"
                     : directional                   ? "directional"
                                                     : "point"},
            {"toward", vectorJson(light.toward)},
            {"distance", numberJson(light.distance)},
            {"cosine", light.cosine},
            {"state", !light.faces                  ? "behind the surface"
                      : light.cone == 0             ? "outside its cone"
                      : light.visibility == Vec3(1) ? "seen"
                      : light.visibility == Vec3(0) ? "in shadow"
                                                    : "partly in shadow"},
            {"cone", light.cone},
            {"points", light.points},
            {"has_shadow", light.shadows},
            {"visibility", vectorJson(light.visibility)},
            {"radiance", vectorJson(light.radiance)},
            {"arriving", vectorJson(light.arriving)},
            {"unshadowed", vectorJson(light.unshadowed)},
            {"share", vectorJson(light.share)},
            {"certified", light.certified}};
  }

  static Json curvatureJson(const std::optional<PrincipalCurvatures>& k) {
    if (!k) return nullptr;
    return {{"gaussian", k->gaussian},
            {"mean", k->mean},
            {"k1", k->k1},
            {"k2", k->k2},
            {"direction1", vectorJson(k->direction1)},
            {"direction2", vectorJson(k->direction2)}};
  }

  Json pointJson(const PointOnRay& point) const {
    const SnapshotNode& node = snapshot_.nodes[point.node];
    Json json = {{"node", nameOf(node.id)},
                 {"number", node.number},
                 {"surface", node.surface.name()},
                 {"material", materialOf(point.node).name},
                 {"seen", point.seen},
                 {"front", point.front},
                 {"uv", vectorJson(point.parameters)},
                 {"position", vectorJson(point.position)},
                 {"depth", point.depth},
                 {"distance", point.distance},
                 {"normal", vectorJson(point.outward)},
                 {"normal_lit", vectorJson(point.lit)},
                 {"curvature", curvatureJson(point.curvature)},
                 {"residual_px", point.residualPx ? Json(*point.residualPx) : Json()},
                 {"certified", point.certified}};
    if (!point.seen) return json;
    json["lights"] = Json::array();
    for (const LightOnPoint& light : point.lights) json["lights"].push_back(lightJson(light));
    if (isLitByShader(point)) {
      // What of that a shader makes of it nobody else knows.
      for (Json& light : json["lights"]) {
        light.erase("unshadowed");
        light.erase("share");
      }
      json["shader"] = materialOf(point.node).shader->files.front().name;
      return json;
    }
    json["diffuse"] = vectorJson(point.diffuse);
    json["opacity"] = point.opacity;
    json["ambient"] = vectorJson(point.ambient);
    json["reflected"] = vectorJson(point.reflected);
    return json;
  }

  Json stationsJson(std::uint32_t node, const Vec3& model) const {
    const View& view = snapshot_.view;
    const Transform& worldFromModel = snapshot_.nodes[node].worldFromObject;
    const Vec3 world = transformPoint(worldFromModel, model), camera = eyeFromWorldPoint(view, world);
    const Vec4 clip = view.clipFromEye * Vec4(camera, 1);
    const bool before = clip.w > 0;
    const Vec3 ndc = before ? Vec3(clip) / clip.w : Vec3(0);
    const bool inside = before && std::abs(ndc.x) <= 1 && std::abs(ndc.y) <= 1 && ndc.z >= 0 && ndc.z <= 1;
    return {{"model", vectorJson(model)},
            {"world_from_model", rowsJson(matrixOf(worldFromModel))},
            {"world", vectorJson(world)},
            {"camera_from_world", rowsJson(matrixOf({view.eyeFromWorld, -(view.eyeFromWorld * view.eye)}))},
            {"camera", vectorJson(camera)},
            {"clip_from_camera", rowsJson(view.clipFromEye)},
            {"clip", vectorJson(clip)},
            {"ndc", before ? vectorJson(ndc) : Json()},
            {"screen", before ? vectorJson(pixelFromEye(view, camera)) : Json()},
            {"in_view", inside}};
  }

  Json pipelineJson(std::uint32_t node) const {
    const DrawOptions options = drawOptions(settings_);
    const SnapshotNode& of = snapshot_.nodes[node];
    const Material& material = materialOf(node);
    const VisibleList visible =
        cull(snapshot_,
             {.tolerancePx = options.tolerancePx, .samples = options.samples, .shading = options.shading});
    const VisibleNode* found = nullptr;
    for (const auto* list : {&visible.opaque, &visible.transparent})
      for (const VisibleNode& one : *list)
        if (one.node == node) found = &one;
    if (material.invisible()) return {{"drawn", "no: its opacity is 0"}};
    if (!found) return {{"drawn", "no: it is outside of the picture, or covers no sample of it"}};
    const bool through = seenThrough(snapshot_, of, options);
    const bool perspective = snapshot_.view.perspective();
    return {
        {"drawn", "yes"},
        {"geometry", geometryWords(of, through, options)},
        {"transform",
         "clip = clip_from_camera * camera_from_world * world_from_model * point: column vectors, in "
         "double; floats are relative to the eye"},
        {"faces", facesWords(*found)},
        {"depth", fmt::format("reversed: 1 at the near plane, {} m before the eye, 0 {}; cleared to 0, the "
                              "greater one stays, 32-bit float; {}",
                              snapshot_.view.near,
                              perspective ? std::string("infinitely far away")
                                          : fmt::format("at {} m", snapshot_.view.far),
                              through ? "compared, not written" : "compared and written")},
        {"blend", blendWords(material, through)},
        {"light", material.shader
                      ? fmt::format("the shader {}, in every pixel", material.shader->files.front().name)
                      : lightWords(material.shadingIn(options.shading))},
        {"output",
         fmt::format(
             "scene-linear, {} a pixel; encoded as sRGB once, at the end, by luxo",
             options.samples == 1 ? "1 sample" : fmt::format("the mean of {} samples", options.samples))}};
  }

  std::string geometryWords(const SnapshotNode& node, bool through, const DrawOptions& options) const {
    if (node.surface.isPolygonal()) return "a model's triangles, as they are";
    if (through ? findsLayers(snapshot_, node, options) : findsSurface(snapshot_, node, options))
      return "a formula: every pixel finds the point of it that its ray meets";
    return fmt::format("triangles within {} px of the formula", options.tolerancePx);
  }

  static std::string facesWords(const VisibleNode& node) {
    const std::string front = node.mirrored
                                  ? "front faces are clockwise on the screen, as its transform mirrors"
                                  : "front faces are counter-clockwise on the screen, seen from outside";
    return front + (node.hideBackFaces       ? "; back faces are not shown: two_sided is \"no\""
                    : node.closedFromOutside ? "; back faces are behind front ones"
                    : node.twoSided          ? "; both are shown, the normal turns toward the viewer"
                                             : "; both are shown, with the outward normal");
  }

  std::string blendWords(const Material& material, bool through) const {
    if (!through) return "off: opaque";
    const std::string_view mode = keys::kBlends[static_cast<std::size_t>(material.blend)];
    const char* behind = material.blend == Blend::Over  ? "(1 - opacity) of what is behind"
                         : material.blend == Blend::Add ? "all of what is behind"
                                                        : "(1 - opacity) * diffuse of what is behind";
    return fmt::format(
        "{}: opacity of its own light, and {}; {}", mode, behind,
        snapshot_.blendOrder == BlendOrder::Exact ? "by depth in every pixel" : "in the order of the nodes");
  }

  static std::string lightWords(Shading shading) {
    switch (shading) {
      case Shading::Exact:
        return "exact: Blinn's half vector, in every pixel, at the point and the normal of the surface "
               "itself";
      case Shading::Phong:
        return "phong: Blinn's half vector, in every pixel, with the interpolated normal";
      case Shading::Gouraud:
        return "gouraud: Blinn's half vector at vertices, colours interpolated";
      case Shading::Flat:
        return "flat: Blinn's half vector in every pixel, one normal a triangle";
      case Shading::Toon:
        return "toon: two steps of the diffuse colour, and outlines";
      default:
        return fmt::format("none: a view of {}", luxo::nameOf(shading));
    }
  }

  const Scene& scene_;
  std::string device_;
  const RenderSettings& settings_;
  Snapshot snapshot_;
};

// --- as text

std::string numberText(const Json& number) {
  return number.is_null() ? "infinite" : fmt::format("{:.7g}", number.get<double>());
}

std::string listText(const Json& numbers) {
  if (numbers.is_null()) return "none";
  std::vector<std::string> texts;
  for (const Json& number : numbers) texts.push_back(numberText(number));
  return fmt::format("({})", fmt::join(texts, ", "));
}

std::string text(const Json& value) { return value.get<std::string>(); }

std::string headerText(const Json& json) {
  return fmt::format("{} at {} s, {} x {} pixels\n", text(json["scene"]), numberText(json["time"]),
                     json["size"][0].get<int>(), json["size"][1].get<int>());
}

std::string line(const char* what, const std::string& said) {
  return fmt::format("    {:<12} {}\n", what, said);
}

std::string lightText(const Json& light) {
  const bool shines = light["state"] != "behind the surface" && light["state"] != "outside its cone";
  std::string said = fmt::format("{}, {}", text(light["node"]), text(light["state"]));
  if (light["points"] != 1) said += fmt::format(", {} points", light["points"].get<std::uint32_t>());
  if (!light["distance"].is_null()) said += fmt::format(", {} m away", numberText(light["distance"]));
  said += fmt::format(", cosine {}", numberText(light["cosine"]));
  if (shines && light["type"] == "spot") said += fmt::format(", cone {}", numberText(light["cone"]));
  if (shines && light.contains("share"))
    said += fmt::format(": adds {} of {}", listText(light["share"]), listText(light["unshadowed"]));
  else if (shines)
    said += fmt::format(": {} arrives of {}", listText(light["arriving"]), listText(light["radiance"]));
  return line("light", said);
}

std::string pointText(const Json& point) {
  const bool seen = point["seen"].get<bool>();
  std::string said =
      fmt::format("  {} ({}, {}), {} side, {} m deep{}\n", text(point["node"]), text(point["surface"]),
                  text(point["material"]), point["front"].get<bool>() ? "outer" : "inner",
                  numberText(point["depth"]), seen ? "" : ", behind");
  said += line("(u, v)", listText(point["uv"]));
  said += line("position", listText(point["position"]));
  said += line("normal", fmt::format("{}, lit {}", listText(point["normal"]), listText(point["normal_lit"])));
  if (const Json& k = point["curvature"]; !k.is_null())
    said +=
        line("curvature", fmt::format("K {}, H {}, k1 {} along {}, k2 {} along {}", numberText(k["gaussian"]),
                                      numberText(k["mean"]), numberText(k["k1"]), listText(k["direction1"]),
                                      numberText(k["k2"]), listText(k["direction2"])));
  if (const Json& residual = point["residual_px"]; !residual.is_null())
    said += line("residual", fmt::format("{:.2g} px{}", residual.get<double>(),
                                         point["certified"].get<bool>() ? ", proven" : ", not proven"));
  if (!seen) return said;
  const bool byShader = point.contains("shader");
  if (byShader) {
    said += line("shader", text(point["shader"]));
  } else {
    said += line("colour", fmt::format("diffuse {}, opacity {}", listText(point["diffuse"]),
                                       numberText(point["opacity"])));
    said += line("ambient", listText(point["ambient"]));
  }
  for (const Json& light : point["lights"]) said += lightText(light);
  return said +
         line("reflected", byShader ? "as the shader decides, of what arrives: the pixel's colour is its own"
                                    : listText(point["reflected"]));
}

std::string stationsText(const Json& v) {
  std::string said = "\n  vertex\n";
  for (const char* station : {"model", "world", "camera", "clip", "ndc", "screen"})
    said += line(station, listText(v[station]));
  if (v.contains("normal_model"))
    said += line("normal", fmt::format("{} in the model, {} in the world", listText(v["normal_model"]),
                                       listText(v["normal_world"])));
  return said + line("in view", v["in_view"].get<bool>() ? "yes" : "no");
}

std::string pipelineText(const Json& pipeline) {
  std::string said = "\n  pipeline\n";
  for (const auto& [key, words] : pipeline.items()) said += line(key.c_str(), text(words));
  return said;
}

}  // namespace

Json inspectPixel(const std::string& name, const ViewedScene& viewed, const std::string& device, int x,
                  int y) {
  return Inspector(viewed, device).pixel(name, x, y);
}

Json inspectVertex(const std::string& name, const ViewedScene& viewed, const std::string& vertex) {
  return Inspector(viewed, {}).vertex(name, vertex);
}

std::string pixelText(const Json& json) {
  std::string said =
      headerText(json) + fmt::format("  pixel {},{}: linear {}, sRGB {}{}\n", json["pixel"]["x"].get<int>(),
                                     json["pixel"]["y"].get<int>(), listText(json["color"]["linear"]),
                                     json["color"]["srgb8"].dump(),
                                     json["certified"].get<bool>() ? "" : ", not proven");
  if (json["points"].empty()) return said + "  nothing is there: the background\n";
  for (const Json& point : json["points"]) said += fmt::format("\n{}", pointText(point));
  return said + stationsText(json["vertex"]) + pipelineText(json["pipeline"]);
}

std::string vertexText(const Json& json) {
  return headerText(json) +
         fmt::format("  {} (number {}) at {}\n", text(json["node"]), json["number"].get<std::uint32_t>(),
                     json.contains("uv") ? fmt::format("(u, v) {}", listText(json["uv"]))
                                         : fmt::format("vertex {}", json["index"].get<std::uint32_t>())) +
         stationsText(json["vertex"]) + pipelineText(json["pipeline"]);
}

}  // namespace luxo
