// SPDX-License-Identifier: Apache-2.0
#include "scene/material_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "base/error.h"
#include "scene/shader_files.h"

namespace luxo {
namespace {

/// What no map, shader or lesson is drawn beside.
constexpr const char* kPainting = "the diffuse colour or opacity uses u or v";

/// What a sampler is given: a texture, or the name of one, which is written as formulas are. A parameter is
/// the number of a map, as programs in the course's style have it.
std::optional<MapDesc> textureOf(const UniformDesc& uniform, const MaterialShaderPtr& shader,
                                 std::span<const ParameterDesc> parameters) {
  if (uniform.map || uniform.values.size() != 1 || !uniform.values[0].isFormula()) return uniform.map;
  const std::string& name = uniform.values[0].formula();
  const auto isIt = [&](const ParameterDesc& parameter) { return parameter.name.text == name; };
  if (!shader || !shader->hasSampler(uniform.name.text) || std::ranges::any_of(parameters, isIt))
    return std::nullopt;
  return MapDesc{.texture = FileName(name, uniform.values[0].place())};
}

}  // namespace

bool isOpaque(const MaterialDesc& material) {
  return material.opacity == Quantity(1) && material.blend != Blend::Add &&
         !(material.map && material.map->alpha);
}

/// Where a texture is, as it may move.
struct MaterialBuilder::MapPlace {
  std::array<Animated<double>, 2> offset = {0.0, 0.0}, scale = {1.0, 1.0};
  Animated<double> angle = 0.0;

  void put(TextureMap& map, const Moment& moment) const {
    map.offset = {offset[0].at(moment), offset[1].at(moment)};
    map.scale = {scale[0].at(moment), scale[1].at(moment)};
    map.angle = angle.at(moment);
  }
  [[nodiscard]] std::array<Animated<double>, 5> numbers() const {
    return {offset[0], offset[1], scale[0], scale[1], angle};
  }
};

/// A material whose numbers may move.
struct MaterialBuilder::Moving {
  Material fixed;
  Animated<Vec3> diffuse = Vec3(0), specular = Vec3(0);
  std::optional<Animated<Vec3>> ambient = {};
  Animated<double> shininess = 0.0, opacity = 0.0, cutoff = 0.0;
  std::vector<Animated<double>> patternParameters = {}, isolineParameters = {}, curvatureParameters = {};
  std::array<MapPlace, 4> places = {};                       ///< of Material::maps()
  std::vector<MapPlace> uniformPlaces = {};                  ///< of each uniform
  std::vector<std::vector<Animated<double>>> uniforms = {};  ///< of each the values

  [[nodiscard]] Material at(const Moment& moment) const {
    Material material = fixed;
    material.diffuse = diffuse.at(moment);
    if (ambient) material.ambient = ambient->at(moment);
    material.specular = specular.at(moment);
    material.shininess = shininess.at(moment);
    material.opacity = opacity.at(moment);
    material.cutoff = cutoff.at(moment);
    for (const Animated<double>& parameter : patternParameters)
      material.patternParameters.push_back(parameter.at(moment));
    for (const Animated<double>& parameter : isolineParameters)
      material.isolineParameters.push_back(parameter.at(moment));
    for (const Animated<double>& parameter : curvatureParameters)
      material.curvatureParameters.push_back(parameter.at(moment));
    const std::array<TextureMap*, 4> maps = material.maps();
    for (std::size_t i = 0; i < places.size(); ++i) places[i].put(*maps[i], moment);
    for (std::size_t i = 0; i < uniforms.size(); ++i) uniformPlaces[i].put(material.uniforms[i].map, moment);
    for (std::size_t i = 0; i < uniforms.size(); ++i)
      for (const Animated<double>& value : uniforms[i])
        material.uniforms[i].values.push_back(value.at(moment));
    return material;
  }

  [[nodiscard]] Animated<Material> animated() && {
    bool constant = diffuse.isConstant() && specular.isConstant() && shininess.isConstant() &&
                    opacity.isConstant() && cutoff.isConstant() && (!ambient || ambient->isConstant());
    bool moves = diffuse.movesWithTime() || specular.movesWithTime() || shininess.movesWithTime() ||
                 opacity.movesWithTime() || cutoff.movesWithTime() || (ambient && ambient->movesWithTime());
    const auto consider = [&](const Animated<double>& number) {
      constant = constant && number.isConstant();
      moves = moves || number.movesWithTime();
    };
    std::ranges::for_each(patternParameters, consider);
    std::ranges::for_each(isolineParameters, consider);
    std::ranges::for_each(curvatureParameters, consider);
    for (const std::vector<Animated<double>>& values : uniforms) std::ranges::for_each(values, consider);
    for (const MapPlace& place : places) std::ranges::for_each(place.numbers(), consider);
    for (const MapPlace& place : uniformPlaces) std::ranges::for_each(place.numbers(), consider);
    if (constant) return at(0);
    return {[material = std::move(*this)](const Moment& moment) { return material.at(moment); },
            moves ? DependsOn::Both : DependsOn::Parameters};
  }
};

Animated<Material> MaterialBuilder::build(const MaterialDesc& desc, ShapeBuilder::MovingPaint paint) {
  Moving material{.fixed = {.name = desc.name.text,
                            .blend = desc.blend,
                            .twoSided = desc.twoSided,
                            .shading = desc.lesson ? Shading::Exact : desc.shading,
                            .lectureSpecular = desc.lectureSpecular}};
  material.fixed.diffusePattern = std::move(paint.pattern);
  material.patternParameters = std::move(paint.parameters);
  material.fixed.isolines = std::move(paint.isolines);
  material.isolineParameters = std::move(paint.isolineParameters);
  material.fixed.curvature = std::move(paint.curvature);
  material.curvatureParameters = std::move(paint.curvatureParameters);
  material.diffuse = std::move(paint.uniform);
  material.opacity = std::move(paint.opacity);
  if (desc.ambient) material.ambient = formulas_.vector(*desc.ambient, kLight);
  material.specular = formulas_.vector(desc.specular, kLight);
  material.shininess = formulas_.number(desc.shininess, kLight);
  material.cutoff = formulas_.number(desc.cutoff, kFraction);
  addMaps(desc, material);
  addLesson(desc, material);
  addShader(desc, material);
  return std::move(material).animated();
}

void MaterialBuilder::addMaps(const MaterialDesc& desc, Moving& material) {
  const auto maps = desc.maps();
  for (std::size_t i = 0; i < maps.size(); ++i) {
    if (!maps[i]) continue;
    const MapDesc& map = *maps[i];
    addMap(map, *material.fixed.maps()[i], material.places[i]);
    if (material.fixed.diffusePattern.valid())
      problems_.add(map.texture.place, fmt::format("{}, and there is a map, too", kPainting),
                    "leave out one of them");
  }
  material.fixed.mapOpacity = desc.map && desc.map->alpha && material.fixed.map.valid();
  if (material.fixed.mapOpacity && (desc.hasShader() || desc.lesson)) {
    problems_.add(desc.map->texture.place,
                  "the alpha of the map is to be how opaque the surface is, and there is a shader, or the "
                  "lesson's formula",
                  "leave \"alpha\" out; a shader says itself how opaque it is (shaders/MATERIALS.md)");
    material.fixed.mapOpacity = false;
  }
  if (desc.cutoff != Quantity(0) && (!(desc.map && desc.map->alpha) || desc.blend != Blend::Over)) {
    problems_.add(desc.name.place,
                  "\"cutoff\" makes holes where a map's alpha is below it, of what is seen through as "
                  "\"over\", and the material is not such",
                  "write \"map\": { \"texture\": .., \"alpha\": true }, without another \"blend\"");
    material.cutoff = 0.0;
  }
  if (!desc.normalMap) return;
  material.fixed.normalSpace = desc.normalMap->space;
  requireNumbers(desc.normalMap->map.texture);
}

void MaterialBuilder::addMap(const MapDesc& desc, TextureMap& map, MapPlace& place) {
  if (const TextureMap* texture = textures_.find(desc.texture, problems_)) map = *texture;
  for (std::size_t k = 0; k < 2; ++k) {
    place.offset[k] = formulas_.number(desc.offset[k], kPlace);
    place.scale[k] = formulas_.number(desc.scale[k], kPlace);
  }
  place.angle = formulas_.number(desc.rotate);
}

void MaterialBuilder::addLesson(const MaterialDesc& desc, Moving& material) {
  if (!desc.lesson) return;
  material.fixed.lesson = true;
  if (material.fixed.diffusePattern.valid())
    problems_.add(desc.name.place, fmt::format("{}, which the lesson's formula does not know", kPainting),
                  "draw it with a \"map\"");
  else if (!isOpaque(desc) && warnings_)
    warnings_->push_back(
        {rangeOf(desc.name.place), "what is seen through is not lit by the lesson's formula", {}});
}

std::shared_ptr<ShaderFiles> MaterialBuilder::shaderFiles() const {
  const SceneSource& source = problems_.source();
  return source.shaders ? source.shaders : std::make_shared<ShaderFiles>();
}

bool MaterialBuilder::readsCurvature(const MaterialDesc& desc) const {
  if (desc.shader.empty()) return false;
  try {
    return shaderFiles()->get(desc.shader.text)->readsCurvature();
  } catch (const Error&) {
    return false;  // addShader() tells
  }
}

void MaterialBuilder::addShader(const MaterialDesc& desc, Moving& material) {
  if (!desc.hasShader()) return;
  const SceneSource& source = problems_.source();
  const auto files = shaderFiles();
  const FileName* named = &desc.shader;
  try {
    if (!desc.shader.empty()) material.fixed.shader = files->get(desc.shader.text);
    if (!desc.vertex.empty()) {
      named = &desc.vertex;
      material.fixed.shader = files->get(desc.shader.text, desc.vertex.text);
    }
  } catch (const Error& error) {
    problems_.add(named->place, error.what(), error.hint());
  }
  const FilePlace where = (desc.shader.empty() ? desc.vertex : desc.shader).place;
  if (material.fixed.diffusePattern.valid())
    problems_.add(where, fmt::format("{}, and there is a shader, too", kPainting),
                  "compute them in the shader, from uv (\"#pragma luxo opacity\")");
  const MaterialShaderPtr& shader = material.fixed.shader;
  if (shader && shader->traces() && (!isOpaque(desc) || shader->hasOpacity()))
    problems_.add(
        where, "the material is seen through, and its shader sends rays into the scene",
        "leave out \"opacity\" and \"blend\", and '#pragma luxo opacity' in the shader, or trace()");
  if (desc.normalMap)
    problems_.add(where, "there is a map of normals, and a shader, too", "leave out one of them");
  if (desc.lesson)
    problems_.add(where, "the lesson's formula and a shader exclude each other", "leave out one of them");
  for (const UniformDesc& uniform : desc.uniforms) {
    std::vector<Animated<double>>& values = material.uniforms.emplace_back();
    MapPlace& place = material.uniformPlaces.emplace_back();
    UniformValue& value = material.fixed.uniforms.emplace_back(
        UniformValue{uniform.name.text, {}, {source.name, source.text, rangeOf(uniform.place)}});
    value.truth = uniform.truth;
    if (const std::optional<MapDesc> map = textureOf(uniform, shader, file_.parameters))
      addMap(*map, value.map, place);
    else
      for (const Quantity& number : uniform.values) values.push_back(formulas_.number(number, kPlace));
  }
}

/// Vectors are not colours: decoded as these they would lead elsewhere.
void MaterialBuilder::requireNumbers(const FileName& texture) {
  const auto desc = std::ranges::find(file_.textures, texture.text,
                                      [](const TextureDesc& t) -> const std::string& { return t.name.text; });
  if (desc != file_.textures.end() && !desc->file.empty() && !desc->data)
    problems_.add(texture.place,
                  fmt::format("the texture '{}' is read as colours, and normals are none", texture.text),
                  "write \"data\": true in the texture");
}

}  // namespace luxo
