// SPDX-License-Identifier: Apache-2.0
#include "scene/scene_warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <span>
#include <string>
#include <string_view>
#include <unordered_set>

#include "scene/scene_problems.h"

namespace luxo {
namespace {

using Visit = std::function<void(const Quantity&)>;

void visitAll(std::span<const Quantity> quantities, const Visit& visit) {
  for (const Quantity& quantity : quantities) visit(quantity);
}

void visitMap(const MapDesc& map, const Visit& visit) {
  visitAll(map.offset, visit);
  visitAll(map.scale, visit);
  visit(map.rotate);
}

void visitLet(const std::vector<LetDesc>& let, const Visit& visit) {
  for (const LetDesc& entry : let) visit(entry.value);
}

struct ShapeVisitor {
  const Visit& visit;

  void operator()(std::monostate) const {}
  void operator()(const NamedShape& shape) const {
    for (const NamedShape::Argument& argument : shape.arguments) visitAll(argument.values, visit);
  }
  void operator()(const FormulaShape& shape) const {
    visitAll(shape.u, visit);
    visitAll(shape.v, visit);
    visitLet(shape.let, visit);
    visitAll(shape.position, visit);
  }
  void operator()(const RevolveShape& shape) const {
    visitAll(shape.u, visit);
    visitAll(shape.v, visit);
    visitLet(shape.let, visit);
    visit(shape.radius);
    visit(shape.height);
  }
  void operator()(const TubeShape& shape) const {
    visitAll(shape.u, visit);
    visitLet(shape.let, visit);
    visitAll(shape.curve, visit);
    visit(shape.radius);
  }
  void operator()(const BezierShape& shape) const {
    for (const Quantity3& point : shape.points) visitAll(point, visit);
  }
  void operator()(const MeshShape& shape) const { visit(shape.crease); }
  void operator()(const ClothShape& shape) const {
    visitAll(shape.size, visit);
    visitAll({{shape.density, shape.stretch, shape.shear, shape.bend, shape.damping, shape.step}}, visit);
    visitAll(shape.gravity, visit);
    if (!shape.ball) return;
    visitAll(shape.ball->center, visit);
    visit(shape.ball->radius);
    visit(shape.ball->friction);
  }
};

void visitCamera(const CameraDesc& camera, const Visit& visit) {
  visitAll(camera.eye, visit);
  visitAll(camera.lookAt, visit);
  visitAll(camera.up, visit);
  visitAll({{camera.fovY, camera.near, camera.height}}, visit);
}

void visitNode(const NodeDesc& node, const Visit& visit) {
  visitAll(node.translate, visit);
  for (const RotationDesc& rotation : node.rotate) {
    visitAll(rotation.axis, visit);
    visit(rotation.angle);
  }
  visitAll(node.scale, visit);
  visit(node.visible);
  if (!node.light) return;
  visitAll(node.light->color, visit);
  visitAll({{node.light->intensity, node.light->radius, node.light->shadowSamples}}, visit);
  if (node.light->spot) visitAll({{node.light->spot->inner, node.light->spot->outer}}, visit);
  const ShadowMapDesc& map = node.light->map;
  visitAll({{map.size, map.bias, map.slopeBias, map.normalOffset, map.pcf}}, visit);
}

/// Where a quotient's divisor is a number that a name or bracket follows without a sign: 1/2u, whose u is
/// above the line. Empty if there is none.
SourceRange ambiguousQuotient(std::string_view formula) {
  const auto at = [&](std::size_t i) { return i < formula.size() ? formula[i] : '\0'; };
  const auto isDigit = [&](std::size_t i) { return at(i) >= '0' && at(i) <= '9'; };
  for (std::size_t slash = formula.find('/'); slash != std::string_view::npos;
       slash = formula.find('/', slash + 1)) {
    const std::size_t first = formula.find_first_not_of(' ', slash + 1);
    std::size_t end = first;
    while (isDigit(end) || at(end) == '.') ++end;
    if (end == first || end > formula.size()) continue;
    const bool exponent =
        (at(end) == 'e' || at(end) == 'E') &&
        (isDigit(end + 1) || ((at(end + 1) == '-' || at(end + 1) == '+') && isDigit(end + 2)));
    if (!exponent && (std::isalpha(static_cast<unsigned char>(at(end))) || at(end) == '('))
      return {slash, end + 1};
  }
  return {};
}

/// A colour whose components are far above 1 was probably meant to count to 255.
void warnOfBrightness(const MaterialDesc& material, std::vector<Diagnostic>& warnings) {
  constexpr double kBright = 1.5;  // some go a little over 1 for a glow
  const Quantity3& color = material.diffuse;
  const auto found = std::ranges::find_if(color, [](const Quantity& q) { return q.number() > kBright; });
  if (found == color.end()) return;
  constexpr double kFaintByte = 16;  // 2 or 3 mean bright, not nearly black
  const bool bytes =
      found->number() >= kFaintByte && std::ranges::all_of(color, [](const Quantity& q) {
        return !q.isFormula() && q.number() >= 0 && q.number() <= 255 && q.number() == std::floor(q.number());
      });
  warnings.push_back(
      {rangeOf(found->place()),
       fmt::format("the diffuse colour of '{}' has the component {}: colours are 0..1", material.name.text,
                   found->number()),
       bytes ? fmt::format("write \"#{:02x}{:02x}{:02x}\"", static_cast<int>(color[0].number()),
                           static_cast<int>(color[1].number()), static_cast<int>(color[2].number()))
             : std::string()});
}

/// Of what says how a shadow is, where that is another one, or none.
void warnOfShadow(const LightDesc& light, std::vector<Diagnostic>& warnings) {
  const bool hasRadius = light.radius.isFormula() || light.radius.number() != 0;
  if (hasRadius && light.shadow == Light::Shadow::None)
    warnings.push_back({rangeOf(light.radius.place()), "a light without a shadow has no use for a radius",
                        "write \"shadow\": \"exact\", or leave the radius out"});
  if (light.map != ShadowMapDesc() && light.shadow != Light::Shadow::Map)
    warnings.push_back({rangeOf(light.map.place), "only a light whose shadow is \"map\" has a map",
                        "write \"shadow\": \"map\", or leave \"map\" out"});
  if (!hasRadius && light.shadowSamples != LightDesc().shadowSamples)
    warnings.push_back({rangeOf(light.shadowSamples.place()),
                        "the shadow of a light without a radius is one sample",
                        "give the light a \"radius\", or leave \"shadow_samples\" out"});
  if (light.casters && !light.casters->empty() && light.shadow == Light::Shadow::None)
    warnings.push_back({rangeOf(light.casters->front().place), "a light without a shadow has no casters",
                        "write \"shadow\": \"exact\", or leave \"casters\" out"});
  if (!light.shadowPlane.empty() && light.shadow != Light::Shadow::Planar)
    warnings.push_back({rangeOf(light.shadowPlane.place), "only a planar shadow falls on a plane alone",
                        "write \"shadow\": \"planar\", or leave \"shadow_plane\" out"});
}

/// The names of those that it uses.
void addTexturesOf(const MaterialDesc& material, std::unordered_set<std::string_view>& textures) {
  for (const MapDesc* map : material.maps())
    if (map) textures.insert(map->texture.text);
  for (const UniformDesc& uniform : material.uniforms) {
    if (uniform.map) textures.insert(uniform.map->texture.text);
    if (uniform.values.size() == 1 && uniform.values[0].isFormula())
      textures.insert(uniform.values[0].formula());
  }
}

}  // namespace

void forEachQuantity(const SceneFile& file, const Visit& visit) {
  const RenderDesc& render = file.render;
  visitAll(render.size, visit);
  visitAll({{render.time, render.fps, render.samples, render.tolerance, render.ambientOcclusion.radius}},
           visit);
  visitAll(render.background, visit);
  visitAll(render.ambient, visit);
  for (const ParameterDesc& parameter : file.parameters) {
    visit(parameter.value);
    if (parameter.range) visitAll(*parameter.range, visit);
    if (parameter.step) visit(*parameter.step);
  }
  for (const TextureDesc& texture : file.textures) {
    if (texture.checker)
      for (const Quantity3& color : *texture.checker) visitAll(color, visit);
    if (texture.color) visitAll(*texture.color, visit);
    visitAll({{texture.squares, texture.anisotropy}}, visit);
  }
  for (const MaterialDesc& material : file.materials) {
    visitAll(material.diffuse, visit);
    for (const MapDesc* map : material.maps())
      if (map) visitMap(*map, visit);
    if (material.ambient) visitAll(*material.ambient, visit);
    visitAll(material.specular, visit);
    visitAll({{material.shininess, material.opacity, material.cutoff, material.displacement}}, visit);
    for (const UniformDesc& uniform : material.uniforms) {
      visitAll(uniform.values, visit);
      if (uniform.map) visitMap(*uniform.map, visit);
    }
    for (const LetDesc& entry : material.let) visit(entry.value);
    for (const IsolinesDesc& isolines : material.isolines) {
      for (const auto* quantity : {&isolines.of, &isolines.step, &isolines.u, &isolines.v})
        if (*quantity) visit(**quantity);
      visitAll({{isolines.at, isolines.width, isolines.opacity}}, visit);
      visitAll(isolines.color, visit);
    }
  }
  for (const SurfaceDesc& surface : file.surfaces) {
    std::visit(ShapeVisitor{visit}, surface.shape);
    if (surface.segments) visitAll(*surface.segments, visit);
  }
  for (const NodeDesc& node : file.nodes) visitNode(node, visit);
  if (file.camera) visitCamera(*file.camera, visit);
  for (const CameraDesc& camera : file.cameras) visitCamera(camera, visit);
}

void addShadowWarnings(const SceneFile& file, std::vector<Diagnostic>& warnings) {
  for (const NodeDesc& node : file.nodes)
    if (node.light) warnOfShadow(*node.light, warnings);
}

void addFileWarnings(const SceneFile& file, std::vector<Diagnostic>& warnings) {
  std::unordered_set<std::string_view> surfaces, materials, textures;
  for (const NodeDesc& node : file.nodes) {
    surfaces.insert(node.surface.text);
    materials.insert(node.material.text);
  }
  for (const MaterialDesc& material : file.materials) addTexturesOf(material, textures);
  const auto unused = [&](const auto& things, const auto& used, std::string_view kind) {
    for (const auto& thing : things)
      if (!used.contains(thing.name.text))
        warnings.push_back(
            {rangeOf(thing.name.place), fmt::format("no node uses the {} '{}'", kind, thing.name.text), {}});
  };
  unused(file.surfaces, surfaces, "surface");
  unused(file.materials, materials, "material");
  for (const TextureDesc& texture : file.textures)
    if (!textures.contains(texture.name.text))
      warnings.push_back({rangeOf(texture.name.place),
                          fmt::format("no material uses the texture '{}'", texture.name.text),
                          {}});
  for (const MaterialDesc& material : file.materials) warnOfBrightness(material, warnings);
  forEachQuantity(file, [&](const Quantity& quantity) {
    if (!quantity.isFormula()) return;
    const SourceRange quotient = ambiguousQuotient(quantity.formula());
    if (quotient.end > 0)
      warnings.push_back({rangeIn(quantity, quotient),
                          "what follows the number is multiplied, not divided by: 1/2u is u/2",
                          "write 1/(2u), or u/2"});
  });
}

}  // namespace luxo
