// SPDX-License-Identifier: Apache-2.0
#include "scene/material.h"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <string_view>

#include "base/error.h"
#include "scene/ranges.h"

namespace luxo {

namespace {

[[noreturn]] void reject(const Material& material, std::string_view value, const std::string& found,
                         std::string_view wanted) {
  throw Error(ErrorKind::Scene,
              fmt::format("material '{}': {} is {}; it must be {}", material.name, value, found, wanted));
}

void requireColor(const Material& material, std::string_view value, const Vec3& color) {
  if (!isColor(color))
    reject(material, value, fmt::format("({}, {}, {})", color.x, color.y, color.z),
           fmt::format("from 0 to {}", kMaxSceneNumber));
}

}  // namespace

void validate(const Material& material) {
  requireColor(material, "diffuse", material.diffuse);
  if (material.ambient) requireColor(material, "ambient", *material.ambient);
  requireColor(material, "specular", material.specular);
  requireColor(material, "glow", material.glow);
  if (!isColor(Vec3(material.shininess)))
    reject(material, "shininess", fmt::format("{}", material.shininess),
           fmt::format("from 0 to {}", kMaxSceneNumber));
  if (!(material.opacity >= 0 && material.opacity <= 1))
    reject(material, "opacity", fmt::format("{}", material.opacity), "from 0 to 1");
  // It is told by the search for the points of a picture, before what is lit in shadows is found.
  if (material.shading == Shading::Residual)
    reject(material, "shading", "residual", "a way to draw one material: residuals are a view of a picture");
  if (material.patternParameters.size() != material.diffusePattern.parameterCount())
    reject(material, "the number of pattern parameters", fmt::format("{}", material.patternParameters.size()),
           fmt::format("{}", material.diffusePattern.parameterCount()));
  if (material.isolineParameters.size() != material.isolines.parameterCount())
    reject(material, "the number of parameters of its isolines",
           fmt::format("{}", material.isolineParameters.size()),
           fmt::format("{}", material.isolines.parameterCount()));
  if (material.curvatureParameters.size() != material.curvature.parameterCount())
    reject(material, "the number of parameters of its surface's curvature",
           fmt::format("{}", material.curvatureParameters.size()),
           fmt::format("{}", material.curvature.parameterCount()));
  if (material.map.valid() && material.diffusePattern.valid())
    reject(material, "map", "given beside a pattern", "alone");
  if (material.mapOpacity && (!material.map.valid() || material.shader || material.lesson))
    reject(material, "its opacity", "that of its map",
           "given with a map, without a shader or the lesson's formula");
  if (!(material.cutoff >= 0 && material.cutoff <= 1))
    reject(material, "the cutoff of its opacity", fmt::format("{}", material.cutoff), "from 0 to 1");
  if (material.cutoff > 0 && (!material.mapOpacity || material.blend != Blend::Over))
    reject(material, "the cutoff of its opacity", fmt::format("{}", material.cutoff),
           "0, but of opacities that a map has the alpha of, in mode \"over\"");
  if (material.lesson && material.diffusePattern.valid())
    reject(material, "the lesson's formula", "given beside a pattern", "alone, or with a map");
  if (material.shader && material.diffusePattern.valid())
    reject(material, "its shader", "given beside a pattern", "alone");
  if (material.shader && material.shader->traces() && material.transparent())
    reject(material, "its shader", "one that sends rays into the scene, of what is seen through",
           "of an opaque material, or without trace()");
  if (material.shader && (material.normalMap.valid() || material.lesson))
    reject(material, "its shader", "given beside a map of normals or the lesson's formula", "alone");
  for (const UniformValue& uniform : material.uniforms)
    for (const double value : uniform.values)
      if (!(std::abs(value) <= kMaxSceneNumber))
        throw Error(ErrorKind::Scene,
                    uniform.place.describe(fmt::format("material '{}': the uniform '{}' is {}; it must be "
                                                       "finite, from -1e18 to 1e18",
                                                       material.name, uniform.name, value),
                                           {}));
  if (!std::isfinite(material.normalScale))
    reject(material, "the scale of its normals", fmt::format("{}", material.normalScale), "finite");
  for (const TextureMap* map : material.maps()) {
    if (map->anisotropy < 1 || map->anisotropy > kMaxAnisotropy)
      reject(material, "the anisotropy of its map", fmt::format("{}", map->anisotropy),
             fmt::format("from 1 to {}", kMaxAnisotropy));
    for (const double number : {map->offset.x, map->offset.y, map->scale.x, map->scale.y, map->angle})
      if (!std::isfinite(number))
        reject(material, "a number of its map", fmt::format("{}", number), "finite");
  }
  for (const double parameter : material.patternParameters)
    if (!std::isfinite(parameter))
      reject(material, "a pattern parameter", fmt::format("{}", parameter), "finite");
  for (const double parameter : material.isolineParameters)
    if (!std::isfinite(parameter))
      reject(material, "a parameter of its isolines", fmt::format("{}", parameter), "finite");
}

Vec3 Material::transmission(double opacityThere, const Vec3& diffuseThere) const {
  return blend == Blend::Add ? Vec3(1) : lightThrough(opacityThere, diffuseThere);
}

Vec3 Material::lightThrough(double opacityThere, const Vec3& diffuseThere) const {
  const double through = 1 - opacityThere;
  return blend == Blend::Multiply ? through * diffuseThere : Vec3(through);
}

std::uint32_t cutToRange(Material& material) {
  std::uint32_t cut =
      cutToRange(material.diffuse) + cutToRange(material.specular) + cutToRange(material.glow);
  if (material.ambient) cut += cutToRange(*material.ambient);
  return cut + cutToRange(material.shininess);
}

}  // namespace luxo
