// SPDX-License-Identifier: Apache-2.0
#include "scene/scene_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "base/assert.h"
#include "base/srgb_curve.h"
#include "mesh/triangle_mesh.h"
#include "scene/json_writer.h"
#include "scene/scene_keys.h"

namespace luxo {
namespace {

JsonText written(const Quantity& quantity) {
  if (quantity.isFormula()) return JsonText::string(quantity.formula());
  return JsonText::number(quantity.number());
}

JsonText written(std::span<const Quantity> quantities) {
  JsonText array = JsonText::array();
  for (const Quantity& quantity : quantities) array.add(written(quantity));
  return array;
}

/// The 8-bit code of a linear value that is exactly one; -1 for another.
int exactCode(const Quantity& quantity) {
  if (quantity.isFormula() || !(quantity.number() >= 0 && quantity.number() <= 1)) return -1;
  const int code = static_cast<int>(std::lround(255 * srgbFromLinear(quantity.number())));
  return Quantity(linearFromSrgb(code / 255.0)) == quantity ? code : -1;
}

/// "#rrggbb" for what was written so (0 and 1 alone could be either), one number for a gray.
JsonText writtenColor(const Quantity3& color) {
  if (color[0] == color[1] && color[1] == color[2]) return written(color[0]);
  int codes[3];
  bool hex = true, between = false;
  for (std::size_t i = 0; i < 3; ++i) {
    codes[i] = exactCode(color[i]);
    hex = hex && codes[i] >= 0;
    between = between || (codes[i] > 0 && codes[i] < 255);
  }
  if (hex && between)
    return JsonText::string(fmt::format("#{:02x}{:02x}{:02x}", codes[0], codes[1], codes[2]));
  return written(color);
}

JsonText written(const std::vector<LetDesc>& let) {
  JsonText object = JsonText::object();
  for (const LetDesc& entry : let) object.add(entry.name.text, written(entry.value));
  return object;
}

template <class Enum>
JsonText written(Enum word, std::span<const std::string_view> names) {
  return JsonText::string(names[static_cast<std::size_t>(word)]);
}

/// The members of an object that differ from their defaults.
class Members {
 public:
  template <class T>
  void add(std::string_view key, const T& value, const T& usual) {
    if (!(value == usual)) object_.add(key, written(value));
  }
  void addColor(std::string_view key, const Quantity3& value, const Quantity3& usual) {
    if (!(value == usual)) object_.add(key, writtenColor(value));
  }
  template <class Enum>
  void addWord(std::string_view key, Enum value, Enum usual, std::span<const std::string_view> names) {
    if (value != usual) object_.add(key, written(value, names));
  }
  void put(std::string_view key, JsonText value) { object_.add(key, std::move(value)); }

  [[nodiscard]] JsonText take() { return std::move(object_); }

 private:
  JsonText object_ = JsonText::object();
};

JsonText written(const OcclusionDesc& occlusion) {
  const OcclusionDesc usual;
  Members members;
  members.addWord("method", occlusion.method, usual.method, keys::kOcclusionMethods);
  members.put("radius", written(occlusion.radius));
  return members.take();
}

JsonText written(const RenderDesc& render) {
  const RenderDesc usual;
  Members members;
  members.add("size", render.size, usual.size);
  members.add("time", render.time, usual.time);
  members.add("fps", render.fps, usual.fps);
  members.add("samples", render.samples, usual.samples);
  members.add("tolerance", render.tolerance, usual.tolerance);
  members.addWord("shading", render.shading, usual.shading, kShadingNames);
  if (render.hiddenLines) members.put("hidden_lines", JsonText::boolean(true));
  members.addWord("blend_order", render.blendOrder, usual.blendOrder, keys::kBlendOrders);
  members.addColor("background", render.background, usual.background);
  members.addColor("ambient", render.ambient, usual.ambient);
  if (render.ambientOcclusion != usual.ambientOcclusion)
    members.put("ambient_occlusion", written(render.ambientOcclusion));
  return members.take();
}

JsonText written(const ParameterDesc& parameter) {
  if (!parameter.range && !parameter.step && parameter.label.empty()) return written(parameter.value);
  Members members;
  members.put("value", written(parameter.value));
  if (parameter.range) members.put("range", written(*parameter.range));
  if (parameter.step) members.put("step", written(*parameter.step));
  if (!parameter.label.empty()) members.put("label", JsonText::string(parameter.label));
  return members.take();
}

JsonText written(const TextureDesc& texture) {
  const TextureDesc usual;
  Members members;
  if (!texture.file.empty()) members.put("file", JsonText::string(texture.file.text));
  if (texture.checker) {
    JsonText colors = JsonText::array();
    for (const Quantity3& color : *texture.checker) colors.add(writtenColor(color));
    members.put("checker", std::move(colors));
  }
  members.add("squares", texture.squares, usual.squares);
  if (texture.color) members.put("color", writtenColor(*texture.color));
  members.addWord("wrap", texture.wrap, usual.wrap, keys::kWraps);
  members.addWord("filter", texture.filter, usual.filter, keys::kFilters);
  members.add("anisotropy", texture.anisotropy, usual.anisotropy);
  if (texture.data) members.put("data", JsonText::boolean(true));
  return members.take();
}

/// `space`: what a map of normals says beside.
JsonText writtenPlaced(const MapDesc& map, NormalSpace space = NormalSpace::Tangent) {
  const MapDesc usual{.texture = map.texture};
  Members members;
  members.put("texture", JsonText::string(map.texture.text));
  members.add("offset", map.offset, usual.offset);
  members.add("scale", map.scale, usual.scale);
  members.add("rotate", map.rotate, usual.rotate);
  if (map.alpha) members.put("alpha", JsonText::boolean(true));
  members.addWord("space", space, NormalSpace::Tangent, keys::kNormalSpaces);
  return members.take();
}

/// A name, or, where there is more to say, an object.
JsonText written(const MapDesc& map, NormalSpace space = NormalSpace::Tangent) {
  const bool isName = map == MapDesc{.texture = map.texture} && space == NormalSpace::Tangent;
  return isName ? JsonText::string(map.texture.text) : writtenPlaced(map, space);
}

JsonText writtenTruth(const Quantity& value) { return JsonText::boolean(value.number() != 0); }

JsonText written(const std::vector<UniformDesc>& uniforms) {
  const auto writtenOne = [](const UniformDesc& uniform) {
    if (uniform.map) return writtenPlaced(*uniform.map);
    if (!uniform.truth)
      return uniform.values.size() == 1 ? written(uniform.values[0]) : written(uniform.values);
    if (uniform.values.size() == 1) return writtenTruth(uniform.values[0]);
    JsonText truths = JsonText::array();
    for (const Quantity& value : uniform.values) truths.add(writtenTruth(value));
    return truths;
  };
  Members members;
  for (const UniformDesc& uniform : uniforms) members.put(uniform.name.text, writtenOne(uniform));
  return members.take();
}

JsonText written(const IsolinesDesc& isolines) {
  const IsolinesDesc usual;
  Members members;
  for (const auto& [key, value] : {std::pair("of", &isolines.of), {"step", &isolines.step}})
    if (*value) members.put(key, written(**value));
  members.add("at", isolines.at, usual.at);
  for (const auto& [key, value] : {std::pair("u", &isolines.u), {"v", &isolines.v}})
    if (*value) members.put(key, written(**value));
  members.add("width", isolines.width, usual.width);
  members.addColor("color", isolines.color, usual.color);
  members.add("opacity", isolines.opacity, usual.opacity);
  return members.take();
}

JsonText written(const std::vector<IsolinesDesc>& isolines) {
  JsonText array = JsonText::array();
  for (const IsolinesDesc& one : isolines) array.add(written(one));
  return array;
}

JsonText written(const MaterialDesc& material) {
  const MaterialDesc usual;
  Members members;
  if (!material.let.empty()) members.put("let", written(material.let));
  if (material.ambient) members.put("ambient", writtenColor(*material.ambient));
  members.addColor("diffuse", material.diffuse, material.map ? repeated(1) : usual.diffuse);
  members.addColor("specular", material.specular, material.specularMap ? repeated(1) : usual.specular);
  members.add("shininess", material.shininess, usual.shininess);
  members.add("opacity", material.opacity, usual.opacity);
  members.add("cutoff", material.cutoff, usual.cutoff);
  members.add("displacement", material.displacement, usual.displacement);
  members.addWord("blend", material.blend, usual.blend, keys::kBlends);
  if (material.twoSided != TwoSided::Auto)
    members.put("two_sided", JsonText::boolean(material.twoSided == TwoSided::Yes));
  if (material.shading) members.put("shading", JsonText::string(nameOf(*material.shading)));
  if (material.lesson) members.put("shading", JsonText::string(std::string(keys::kMaterialShadings.back())));
  if (material.lectureSpecular) members.put("lecture_specular", JsonText::boolean(true));
  if (material.map) members.put("map", written(*material.map));
  if (material.normalMap)
    members.put("normal_map", written(material.normalMap->map, material.normalMap->space));
  if (material.specularMap) members.put("specular_map", written(*material.specularMap));
  if (material.glowMap) members.put("glow_map", written(*material.glowMap));
  if (material.isolines.size() == 1) members.put("isolines", written(material.isolines[0]));
  if (material.isolines.size() > 1) members.put("isolines", written(material.isolines));
  if (!material.shader.empty()) members.put("shader", JsonText::string(material.shader.text));
  if (!material.vertex.empty()) members.put("vertex", JsonText::string(material.vertex.text));
  if (!material.uniforms.empty()) members.put("uniforms", written(material.uniforms));
  return members.take();
}

JsonText written(const ClothBallDesc& ball) {
  const ClothBallDesc usual;
  Members members;
  members.put("radius", written(ball.radius));
  members.add("center", ball.center, usual.center);
  members.add("friction", ball.friction, usual.friction);
  return members.take();
}

struct ShapeWriter {
  Members& members;

  void operator()(std::monostate) const { LUXO_REQUIRE(false && "a surface has a shape"); }
  void operator()(const NamedShape& shape) const {
    members.put("type", JsonText::string(shape.type.text));
    for (const NamedShape::Argument& argument : shape.arguments)
      members.put(argument.name.text,
                  argument.values.size() == 1 ? written(argument.values[0]) : written(argument.values));
  }
  void operator()(const FormulaShape& shape) const {
    members.put("type", JsonText::string("formula"));
    putRanges(shape);
    if (shape.closed) {
      JsonText closed = JsonText::array();
      for (const bool direction : *shape.closed) closed.add(JsonText::boolean(direction));
      members.put("closed", std::move(closed));
    }
    putLet(shape.let);
    members.put("position", written(shape.position));
  }
  void operator()(const RevolveShape& shape) const {
    members.put("type", JsonText::string("revolve"));
    putRanges(shape);
    putLet(shape.let);
    members.put("radius", written(shape.radius));
    members.put("height", written(shape.height));
  }
  void operator()(const TubeShape& shape) const {
    members.put("type", JsonText::string("tube"));
    members.add("u", shape.u, QuantityPair{0, 1});
    putLet(shape.let);
    members.put("curve", written(shape.curve));
    members.put("radius", written(shape.radius));
  }
  void operator()(const BezierShape& shape) const {
    members.put("type", JsonText::string("bezier"));
    JsonText points = JsonText::array();
    for (const Quantity3& point : shape.points) points.add(written(point));
    members.put("control_points", std::move(points));
    JsonText patches = JsonText::array();
    for (const auto& patch : shape.patches) {
      JsonText indices = JsonText::array();
      for (const std::uint32_t index : patch) indices.add(JsonText::number(index));
      patches.add(std::move(indices));
    }
    members.put("patches", std::move(patches));
  }
  void operator()(const MeshShape& shape) const {
    members.put("type", JsonText::string("mesh"));
    members.put("file", JsonText::string(shape.file.text));
    members.addWord("normals", shape.normals, NormalRule::Given, keys::kNormalRules);
    members.add("crease", shape.crease, MeshShape{}.crease);
  }
  void operator()(const ClothShape& shape) const {
    const ClothShape usual;
    members.put("type", JsonText::string("cloth"));
    members.add("cells", shape.cells, usual.cells);
    members.add("size", shape.size, usual.size);
    members.add("density", shape.density, usual.density);
    members.add("stretch", shape.stretch, usual.stretch);
    members.add("shear", shape.shear, usual.shear);
    members.add("bend", shape.bend, usual.bend);
    members.add("damping", shape.damping, usual.damping);
    members.add("gravity", shape.gravity, usual.gravity);
    members.add("step", shape.step, usual.step);
    if (!shape.pins.empty()) {
      JsonText pins = JsonText::array();
      for (const ClothPinDesc& pin : shape.pins)
        pins.add(pin.name.empty() ? written(pin.point) : JsonText::string(pin.name.text));
      members.put("pins", std::move(pins));
    }
    if (shape.ball) members.put("ball", written(*shape.ball));
  }

 private:
  template <class Shape>
  void putRanges(const Shape& shape) const {
    members.add("u", shape.u, QuantityPair{0, 1});
    members.add("v", shape.v, QuantityPair{0, 1});
  }
  void putLet(const std::vector<LetDesc>& let) const {
    if (!let.empty()) members.put("let", written(let));
  }
};

JsonText written(const SurfaceDesc& surface) {
  Members members;
  std::visit(ShapeWriter{members}, surface.shape);
  if (surface.segments) members.put("segments", written(*surface.segments));
  return members.take();
}

JsonText written(const RotationDesc& rotation) {
  Members members;
  members.put("axis", written(rotation.axis));
  members.put("angle", written(rotation.angle));
  return members.take();
}

JsonText written(const std::vector<RotationDesc>& rotations) {
  if (rotations.size() == 1) return written(rotations[0]);
  JsonText array = JsonText::array();
  for (const RotationDesc& rotation : rotations) array.add(written(rotation));
  return array;
}

JsonText written(const ShadowMapDesc& map) {
  const ShadowMapDesc usual;
  Members members;
  members.add("size", map.size, usual.size);
  members.add("bias", map.bias, usual.bias);
  members.add("slope_bias", map.slopeBias, usual.slopeBias);
  members.add("normal_offset", map.normalOffset, usual.normalOffset);
  members.add("pcf", map.pcf, usual.pcf);
  if (map.receiverPlane) members.put("receiver_plane", JsonText::boolean(true));
  return members.take();
}

JsonText written(const SpotDesc& spot) {
  const SpotDesc usual;
  Members members;
  members.add("inner", spot.inner, usual.inner);
  members.add("outer", spot.outer, usual.outer);
  return members.take();
}

JsonText written(const LightDesc& light) {
  const LightDesc usual;
  Members members;
  members.put("type", written(light.type, keys::kLightTypes));
  members.addColor("color", light.color, usual.color);
  members.add("intensity", light.intensity, usual.intensity);
  members.addWord("attenuation", light.attenuation, usual.attenuation, keys::kAttenuations);
  if (light.spot) members.put("spot", written(*light.spot));
  members.addWord("shadow", light.shadow, usual.shadow, keys::kShadows);
  members.add("radius", light.radius, usual.radius);
  members.add("shadow_samples", light.shadowSamples, usual.shadowSamples);
  if (light.map != usual.map) members.put("map", written(light.map));
  if (!light.shadowPlane.empty()) members.put("shadow_plane", JsonText::string(light.shadowPlane.text));
  if (light.casters) {
    JsonText casters = JsonText::array();
    for (const FileName& name : *light.casters) casters.add(JsonText::string(name.text));
    members.put("casters", std::move(casters));
  }
  return members.take();
}

/// A node without its children.
Members written(const NodeDesc& node) {
  const NodeDesc usual;
  Members members;
  if (!node.name.empty()) members.put("name", JsonText::string(node.name.text));
  members.add("translate", node.translate, usual.translate);
  if (!node.rotate.empty()) members.put("rotate", written(node.rotate));
  members.add("scale", node.scale, usual.scale);
  members.add("visible", node.visible, usual.visible);
  if (!node.surface.empty()) members.put("surface", JsonText::string(node.surface.text));
  if (!node.material.empty()) members.put("material", JsonText::string(node.material.text));
  if (!node.model.empty()) members.put("model", JsonText::string(node.model.text));
  if (node.light) members.put("light", written(*node.light));
  return members;
}

/// The hierarchy from a list in depth-first order. Takes no recursion, so it takes any depth.
JsonText written(const std::vector<NodeDesc>& nodes) {
  struct Open {
    std::uint32_t node;
    Members members;
    JsonText children = JsonText::array();
  };
  JsonText roots = JsonText::array();
  std::vector<Open> open;
  const auto close = [&] {
    Open last = std::move(open.back());
    open.pop_back();
    if (last.children.size() > 0) last.members.put("children", std::move(last.children));
    (open.empty() ? roots : open.back().children).add(last.members.take());
  };
  for (std::uint32_t i = 0; i < nodes.size(); ++i) {
    while (!open.empty() && open.back().node != nodes[i].parent) close();
    LUXO_REQUIRE(nodes[i].parent == kNoParent || !open.empty());  // depth first
    open.push_back({i, written(nodes[i])});
  }
  while (!open.empty()) close();
  return roots;
}

JsonText written(const CameraDesc& camera) {
  const CameraDesc usual;
  Members members;
  members.add("eye", camera.eye, usual.eye);
  members.add("look_at", camera.lookAt, usual.lookAt);
  members.add("up", camera.up, usual.up);
  members.add("fov_y", camera.fovY, usual.fovY);
  members.add("near", camera.near, usual.near);
  members.addWord("type", camera.projection, usual.projection, keys::kProjections);
  members.add("height", camera.height, usual.height);
  return members.take();
}

template <class Desc>
void putNamed(Members& root, std::string_view key, const std::vector<Desc>& things) {
  if (things.empty()) return;
  JsonText object = JsonText::object();
  for (const Desc& thing : things) object.add(thing.name.text, written(thing));
  root.put(key, std::move(object));
}

}  // namespace

std::string writeScene(const SceneFile& file) {
  Members root;
  root.put("luxo", JsonText::number(1));
  if (!(file.render == RenderDesc{})) root.put("render", written(file.render));
  putNamed(root, "params", file.parameters);
  putNamed(root, "textures", file.textures);
  putNamed(root, "materials", file.materials);
  putNamed(root, "surfaces", file.surfaces);
  if (!file.nodes.empty()) root.put("nodes", written(file.nodes));
  if (file.camera) root.put("camera", written(*file.camera));
  putNamed(root, "cameras", file.cameras);
  return root.take().text() + "\n";
}

}  // namespace luxo
