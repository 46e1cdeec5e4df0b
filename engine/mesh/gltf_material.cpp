// SPDX-License-Identifier: Apache-2.0
#include "mesh/gltf_material.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace luxo {
namespace {

class MaterialReader {
 public:
  MaterialReader(const ModelSource& source, GltfFile& file, Model& model)
      : source_(source), file_(file), model_(model), images_(file.list("images").size(), kUnread) {}

  /// The material, and which uvs its maps use.
  std::pair<ModelMaterial, std::uint64_t> read(const GltfValue& value) {
    uvSet_.reset();
    ModelMaterial material{.name = printable(value["name"].textOr("material"))};
    const GltfValue pbr = value["pbrMetallicRoughness"];
    const Vec4 base = pbr["baseColorFactor"].vectorOr(Vec4(1));
    if (std::min({base.x, base.y, base.z, base.w}) < 0) pbr["baseColorFactor"].refuse("a factor below 0");
    double metallic = std::clamp(pbr["metallicFactor"].numberOr(1), 0.0, 1.0),
           roughness = std::clamp(pbr["roughnessFactor"].numberOr(1), 0.0, 1.0);
    if (pbr.has("metallicRoughnessTexture")) {
      warn(value, "its metallic and roughness map is not read: it is taken for rough and no metal");
      metallic = 0;
      roughness = std::max(roughness, 0.5);
    } else if (metallic > 0 && pbr.has("baseColorTexture")) {
      warn(value, "a metal whose colour is a map is not drawn as one: it is taken for no metal");
      metallic = 0;
    }
    if (value.has("occlusionTexture")) warn(value, "its occlusion map is not read");
    const GltfValue extensions = value["extensions"], specular = extensions["KHR_materials_specular"];
    if (specular.has("specularTexture")) warn(specular, "its map of how strong highlights are is not read");
    setBlinn(material, Vec3(base), metallic, roughness,
             specular["specularColorFactor"].colourOr(Vec3(1)) *
                 std::clamp(specular["specularFactor"].numberOr(1), 0.0, 1.0));

    material.map = map(pbr["baseColorTexture"]);
    material.normalMap = map(value["normalTexture"]);
    material.normalScale = value["normalTexture"]["scale"].numberOr(1);
    material.glowMap = map(value["emissiveTexture"]);
    if (metallic > 0 && specular.has("specularColorTexture"))
      warn(specular, "its map of the colours of highlights is not read, as it is a metal");
    else
      material.specularMap = map(specular["specularColorTexture"]);
    material.specularColors = true;
    material.glow =
        value["emissiveFactor"].colourOr(Vec3(0)) *
        std::max(0.0, extensions["KHR_materials_emissive_strength"]["emissiveStrength"].numberOr(1));
    if (extensions.has("KHR_materials_unlit")) {
      material.glow = Vec3(base);
      material.glowMap = material.map;
      material.diffuse = material.specular = Vec3(0);
      material.ambient = Vec3(0);
    }

    const std::string mode = value["alphaMode"].textOr("OPAQUE");
    if (mode != "OPAQUE" && mode != "MASK" && mode != "BLEND")
      value["alphaMode"].refuse("it is none of OPAQUE, MASK and BLEND");
    if (mode != "OPAQUE") {
      material.opacity = std::min(base.w, 1.0);
      material.opacityFromMap = material.map.given();
      if (mode == "MASK") cutOff(material, std::max(value["alphaCutoff"].numberOr(0.5), 0.0));
    }
    material.twoSided = value["doubleSided"].flagOr(false);
    const GltfValue ours = value["extras"]["luxo"];
    if (ours.has("ambient")) material.ambient = ours["ambient"].colourOr(Vec3(0));
    return {std::move(material), uvSet_.value_or(0)};
  }

 private:
  static constexpr std::uint32_t kUnread = kNone - 1;

  void warn(const GltfValue& value, std::string_view what) {
    model_.warnings.push_back(fmt::format("{}: {}: {}", source_.name(), value.place(), what));
  }

  /// Nothing is below 0, and all is below what is above 1.
  static void cutOff(ModelMaterial& material, double cutoff) {
    material.cutoff = std::min(cutoff, 1.0);
    if (cutoff > 0 && cutoff <= 1) return;
    material.opacityFromMap = false;
    material.opacity = cutoff > 1 ? 0 : 1;
  }

  static void setBlinn(ModelMaterial& material, const Vec3& base, double metallic, double roughness,
                       const Vec3& specular) {
    const double alpha = roughness * roughness;
    const double shininess = std::min(2 / std::max(alpha * alpha, 1e-12) - 2, kMaxGltfShininess);
    const Vec3 dielectric = glm::min(kGltfReflectance * specular, Vec3(1));
    const Vec3 f0 = dielectric + metallic * (base - dielectric);
    material.diffuse = (1 - metallic) * base;
    if (metallic > 0) material.ambient = base;  // of others it is as diffuse light is, times the map
    material.shininess = shininess;
    material.specular = (shininess + 2) / 8 * f0;
  }

  ModelMap map(const GltfValue& info) {
    ModelMap map;
    if (!info.given()) return map;
    const GltfValue texture = file_.list("textures")[info["index"].integer()];
    const GltfValue transform = info["extensions"]["KHR_texture_transform"];
    const std::uint64_t uvSet = transform["texCoord"].integerOr(info["texCoord"].integerOr(0));
    if (uvSet_.value_or(uvSet) != uvSet) {
      warn(info,
           fmt::format("it uses uvs {}, other maps of the material {}, and is not read", uvSet, *uvSet_));
      return map;
    }
    uvSet_ = uvSet;
    if (!texture.has("source")) {
      warn(texture, "its image is of a kind that is not supported, and is not read");
      return map;
    }
    map.image = image(texture["source"].integer(images_.size()));
    map.offset = transform["offset"].vectorOr(Vec2(0));
    map.scale = transform["scale"].vectorOr(Vec2(1));
    map.angle = -transform["rotation"].numberOr(0);
    if (texture.has("sampler")) {
      const GltfValue sampler = file_.list("samplers")[texture["sampler"].integer()];
      const auto wrap = [](const GltfValue& mode) {
        const std::uint64_t code = mode.integerOr(10497);
        return code == 33071   ? ModelMap::Wrap::Clamp
               : code == 33648 ? ModelMap::Wrap::Mirror
                               : ModelMap::Wrap::Repeat;
      };
      map.wrapU = wrap(sampler["wrapS"]);
      map.wrapV = wrap(sampler["wrapT"]);
      map.nearest = sampler["magFilter"].integerOr(9729) == 9728;
    }
    return map;
  }

  std::uint32_t image(std::uint64_t number) {
    if (images_[number] != kUnread) return images_[number];
    const GltfValue image = file_.list("images")[number], uri = image["uri"];
    const std::string name = printable(image["name"].textOr("image")),
                      place = fmt::format("{}: {}", source_.name(), image.place());
    std::uint32_t& read = images_[number];
    if (uri.given() && !GltfFile::isData(uri.text())) {
      return read = source_.image(model_, GltfFile::decodedName(uri.text()), place, 0);
    }
    FileBytes bytes = uri.given() ? std::make_shared<const std::vector<std::byte>>(GltfFile::decodedData(uri))
                                  : file_.copyOf(image["bufferView"].integer());
    read = std::uint32_t(model_.images.size());
    model_.images.push_back({.name = name, .place = place, .bytes = std::move(bytes)});
    return read;
  }

  const ModelSource& source_;
  GltfFile& file_;
  Model& model_;
  std::vector<std::uint32_t> images_;
  std::optional<std::uint64_t> uvSet_;  ///< of the maps of the material that is read
};

}  // namespace

std::vector<std::uint64_t> readGltfMaterials(const ModelSource& source, GltfFile& file, Model& model) {
  MaterialReader reader(source, file, model);
  const GltfValue materials = file.list("materials");
  std::vector<std::uint64_t> uvSets;
  for (std::size_t i = 0; i < materials.size(); ++i) {
    // In a statement of its own: reading adds images and warnings to the model.
    auto [material, uvSet] = reader.read(materials[i]);
    model.materials.push_back(std::move(material));
    uvSets.push_back(uvSet);
  }
  return uvSets;
}

}  // namespace luxo
