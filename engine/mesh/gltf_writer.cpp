// SPDX-License-Identifier: Apache-2.0
// GLB: a model as glTF 2.0 in one file. What glTF has no word for is left out, or said by what it has:
//
// A material is the one that gltf_material.h reads back as this: no metal, base colour = diffuse, roughness =
// (2 / (n + 2))^(1/4), and KHR_materials_specular scales what is reflected so that the highlight is as high.
// Colours above 1 are cut off there. Other programs reflect light from everywhere as they please: an ambient
// colour that is not the diffuse one, the light itself and the background are "extras", {"luxo": {"ambient":
// ..., "background": ...}}, of materials and of the scene. Maps are embedded as they are.
//
// LUXO_parametric_surface, optional, at the root: { "version": 1, "scene": "...", "files": [{ "name":
// "a.png", "bufferView": 3 }, ...] }, the text of a scene file (engine/scene/luxo-scene-1.schema.json) whose
// surfaces the meshes stand for, and the files that it names (images, models, shaders, what these name), as
// they are. Who knows it draws the scene; who does not sees the meshes.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/assert.h"
#include "base/error.h"
#include "mesh/gltf_material.h"
#include "mesh/model_target.h"

namespace luxo {
namespace {

using Object = nlohmann::ordered_json;

constexpr std::uint32_t kFloat = 5126, kUint16 = 5123, kUint32 = 5125;
constexpr std::uint32_t kVertices = 34962, kIndices = 34963;  // what a view is for

Object json(const Vec3& v) { return {v.x, v.y, v.z}; }
Object json(const Vec4& v) { return {v.x, v.y, v.z, v.w}; }

Object json(const Vec2& v) { return {v.x, v.y}; }

Object materialOf(const ModelMaterial& from) {
  const double n = std::min(from.shininess, kMaxGltfShininess);
  const Vec4 base(glm::clamp(from.diffuse, 0.0, 1.0), from.opacity);
  Object material = {{"name", from.name},
                     {"pbrMetallicRoughness",
                      {{"baseColorFactor", json(base)},
                       {"metallicFactor", 0},
                       {"roughnessFactor", std::pow(2 / (n + 2), 0.25)}}}};
  if (from.glow != Vec3(0)) material["emissiveFactor"] = json(glm::clamp(from.glow, 0.0, 1.0));
  if (from.opacityFromMap && from.cutoff > 0) {
    material["alphaMode"] = "MASK";
    material["alphaCutoff"] = from.cutoff;
  } else if (from.opacity < 1 || from.opacityFromMap) {
    material["alphaMode"] = "BLEND";
  }
  if (from.twoSided) material["doubleSided"] = true;
  if (from.ambient) material["extras"]["luxo"]["ambient"] = json(*from.ambient);
  material["extensions"]["KHR_materials_specular"]["specularColorFactor"] =
      json(8 / (n + 2) / kGltfReflectance * from.specular);
  return material;
}

class GlbWriter {
 public:
  GlbWriter(const Model& model, const ModelClaim& claim) : model_(model), claim_(claim) {}

  std::vector<std::byte> write() {
    root_["asset"] = {{"version", "2.0"}, {"generator", "luxo"}, {"extras", {{"luxo", claimOf()}}}};
    addScene();
    for (const ModelMaterial& material : model_.materials) addMaterial(material);
    for (const ModelImage& image : model_.images) addImage(image);
    for (const TriangleMesh& mesh : model_.meshes) addMesh(mesh);
    for (const ModelCamera& camera : model_.cameras) addCamera(camera);
    addExtensions();
    root_["buffers"] = {{{"byteLength", binary_.size()}}};
    return file();
  }

 private:
  Object claimOf() const {
    Object claim = {{"deviation", std::isfinite(claim_.deviation) ? Object(claim_.deviation) : Object()},
                    {"closed", claim_.closed}};
    if (claim_.thickness > 0) claim["thickness"] = claim_.thickness;
    return claim;
  }

  void addScene() {
    Object roots = Object::array();
    for (std::uint32_t i = 0; i < model_.nodes.size(); ++i) {
      const ModelNode& node = model_.nodes[i];
      root_["nodes"].push_back(nodeOf(node));
      if (node.parent == kNone)
        roots.push_back(i);
      else
        root_["nodes"][node.parent]["children"].push_back(i);
    }
    // The points of a mesh are relative to its origin, to which a node of its own takes them.
    for (std::uint32_t i = 0; i < model_.nodes.size(); ++i) {
      const ModelNode& node = model_.nodes[i];
      if (node.mesh == kNone || originOf(node) == Vec3(0)) continue;
      root_["nodes"][i]["children"].push_back(root_["nodes"].size());
      root_["nodes"].push_back(
          {{"name", node.name}, {"translation", json(originOf(node))}, {"mesh", node.mesh}});
    }
    root_["scenes"] = {{{"nodes", roots}}};
    Object surroundings = Object::object();
    if (model_.ambient) surroundings["ambient"] = json(*model_.ambient);
    if (model_.background) surroundings["background"] = json(*model_.background);
    if (!surroundings.empty()) root_["scenes"][0]["extras"]["luxo"] = surroundings;
    root_["scene"] = 0;
  }

  const Vec3& originOf(const ModelNode& node) const { return model_.meshes[node.mesh].origin(); }

  Object nodeOf(const ModelNode& from) const {
    Object node = {{"name", from.name}};
    if (from.translation != Vec3(0)) node["translation"] = json(from.translation);
    if (from.rotation != Vec4(0, 0, 0, 1)) node["rotation"] = json(from.rotation);
    if (from.scale != Vec3(1)) node["scale"] = json(from.scale);
    if (from.mesh != kNone && originOf(from) == Vec3(0)) node["mesh"] = from.mesh;
    if (from.camera != kNone) node["camera"] = from.camera;
    if (from.light != kNone) node["extensions"]["KHR_lights_punctual"]["light"] = from.light;
    return node;
  }

  void addMaterial(const ModelMaterial& from) {
    Object material = materialOf(from);
    if (from.map.given()) material["pbrMetallicRoughness"]["baseColorTexture"] = textureOf(from.map);
    if (from.normalMap.given()) {
      LUXO_REQUIRE(!from.objectNormals);
      material["normalTexture"] = textureOf(from.normalMap);
      if (from.normalScale != 1) material["normalTexture"]["scale"] = from.normalScale;
    }
    if (from.specularMap.given()) {
      LUXO_REQUIRE(from.specularColors);
      material["extensions"]["KHR_materials_specular"]["specularColorTexture"] = textureOf(from.specularMap);
    }
    if (from.glowMap.given()) material["emissiveTexture"] = textureOf(from.glowMap);
    root_["materials"].push_back(std::move(material));
  }

  /// A texture of the image and a sampler for each way to read it.
  Object textureOf(const ModelMap& map) {
    const auto wrap = [](ModelMap::Wrap w) {
      return w == ModelMap::Wrap::Repeat ? 10497 : w == ModelMap::Wrap::Clamp ? 33071 : 33648;
    };
    root_["samplers"].push_back({{"magFilter", map.nearest ? 9728 : 9729},
                                 {"minFilter", map.nearest ? 9728 : 9987},
                                 {"wrapS", wrap(map.wrapU)},
                                 {"wrapT", wrap(map.wrapV)}});
    root_["textures"].push_back({{"sampler", root_["samplers"].size() - 1}, {"source", map.image}});
    Object texture = {{"index", root_["textures"].size() - 1}};
    if (map.offset != Vec2(0) || map.scale != Vec2(1) || map.angle != 0) {
      transformsTextures_ = true;
      texture["extensions"]["KHR_texture_transform"] = {
          {"offset", json(map.offset)}, {"rotation", -map.angle}, {"scale", json(map.scale)}};
    }
    return texture;
  }

  void addImage(const ModelImage& image) {
    LUXO_REQUIRE(image.bytes != nullptr);
    const std::size_t view = addBytes(*image.bytes);
    root_["images"].push_back({{"name", image.name}, {"mimeType", "image/png"}, {"bufferView", view}});
  }

  /// A view of them.
  std::size_t addBytes(const std::vector<std::byte>& bytes) {
    const std::size_t begin = binary_.size();
    binary_.insert(binary_.end(), bytes.begin(), bytes.end());
    return addView(begin, 0);
  }

  /// Aligned to what floats and 32-bit indices need. `target`: what it is for; 0: no vertices, no indices.
  std::size_t addView(std::size_t begin, std::uint32_t target) {
    root_["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", begin}, {"byteLength", binary_.size() - begin}});
    if (target != 0) root_["bufferViews"].back()["target"] = target;
    while (binary_.size() % 4 != 0) binary_.push_back(std::byte(0));
    return root_["bufferViews"].size() - 1;
  }

  std::size_t addAccessor(std::size_t view, std::uint32_t kind, std::size_t count, const char* type) {
    root_["accessors"].push_back(
        {{"bufferView", view}, {"componentType", kind}, {"count", count}, {"type", type}});
    return root_["accessors"].size() - 1;
  }

  template <class Vector>
  std::size_t addVectors(std::span<const Vector> vectors, const char* type) {
    const std::size_t begin = binary_.size();
    for (const Vector& v : vectors) append(binary_, v);
    return addAccessor(addView(begin, kVertices), kFloat, vectors.size(), type);
  }

  std::size_t addIndices(std::span<const std::uint32_t> indices, bool small) {
    const std::size_t begin = binary_.size();
    for (const std::uint32_t index : indices)
      small ? append(binary_, std::uint16_t(index)) : append(binary_, index);
    return addAccessor(addView(begin, kIndices), small ? kUint16 : kUint32, indices.size(), "SCALAR");
  }

  void addMesh(const TriangleMesh& mesh) {
    const std::size_t positions = addVectors(mesh.positions(), "VEC3");
    Object attributes = {{"POSITION", positions}, {"NORMAL", addVectors(mesh.normals(), "VEC3")}};
    if (!mesh.tangents().empty()) attributes["TANGENT"] = addVectors(mesh.tangents(), "VEC4");
    if (!mesh.uvs().empty()) attributes["TEXCOORD_0"] = addVectors(mesh.uvs(), "VEC2");
    Vec3f low(std::numeric_limits<float>::infinity()), high = -low;
    for (const Vec3f& p : mesh.positions()) {
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
    root_["accessors"][positions]["min"] = json(Vec3(low));
    root_["accessors"][positions]["max"] = json(Vec3(high));
    const bool small = mesh.positions().size() < 65535;  // the last number restarts strips
    Object primitives = Object::array();
    for (const MeshGroup& group : mesh.groups())
      primitives.push_back(
          {{"attributes", attributes},
           {"indices", addIndices(mesh.indices().subspan(std::size_t{3} * group.firstTriangle,
                                                         std::size_t{3} * group.triangles),
                                  small)},
           {"material", group.material}});
    root_["meshes"].push_back({{"name", mesh.name()}, {"primitives", primitives}});
  }

  void addCamera(const ModelCamera& from) {
    Object camera = {{"name", from.name}, {"type", from.perspective ? "perspective" : "orthographic"}};
    if (from.perspective)
      camera["perspective"] = {{"yfov", from.fovY}, {"znear", from.near}};
    else
      camera["orthographic"] = {
          {"xmag", from.height / 2}, {"ymag", from.height / 2}, {"znear", from.near}, {"zfar", from.far}};
    root_["cameras"].push_back(std::move(camera));
  }

  void addExtensions() {
    Object used = Object::array();
    if (!model_.materials.empty()) used.push_back("KHR_materials_specular");
    if (transformsTextures_) used.push_back("KHR_texture_transform");
    if (!model_.lights.empty()) {
      used.push_back("KHR_lights_punctual");
      Object& lights = root_["extensions"]["KHR_lights_punctual"]["lights"];
      for (const ModelLight& light : model_.lights) {
        lights.push_back({{"name", light.name},
                          {"type", light.spot          ? "spot"
                                   : light.directional ? "directional"
                                                       : "point"},
                          {"color", json(glm::clamp(light.color, 0.0, 1.0))},
                          {"intensity", light.intensity}});
        if (light.spot)
          lights.back()["spot"] = {{"innerConeAngle", light.spot->inner},
                                   {"outerConeAngle", light.spot->outer}};
      }
    }
    if (!model_.scene.empty()) {
      used.push_back("LUXO_parametric_surface");
      Object formulas = {{"version", 1}, {"scene", model_.scene}};
      for (const auto& [name, bytes] : model_.sceneFiles) {
        Object file = {{"name", name}};
        if (!bytes->empty()) file["bufferView"] = addBytes(*bytes);  // no view is empty
        formulas["files"].push_back(std::move(file));
      }
      root_["extensions"]["LUXO_parametric_surface"] = std::move(formulas);
    }
    if (!used.empty()) root_["extensionsUsed"] = used;
  }

  std::vector<std::byte> file() const {
    std::string text = root_.dump(-1, ' ', false, Object::error_handler_t::replace);
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const std::uint64_t size = 12 + 8 + text.size() + 8 + binary_.size();
    if (size > std::numeric_limits<std::uint32_t>::max())
      throw Error(ErrorKind::Scene, fmt::format("{} bytes are more than a GLB has room for", size),
                  "allow a larger deviation, leave the formulas out, or write another format");
    std::vector<std::byte> bytes;
    bytes.reserve(size);
    appendText(bytes, "glTF");
    append(bytes, std::uint32_t(2));
    append(bytes, std::uint32_t(size));
    append(bytes, std::uint32_t(text.size()));
    appendText(bytes, "JSON");
    appendText(bytes, text);
    append(bytes, std::uint32_t(binary_.size()));
    appendText(bytes, std::string_view("BIN\0", 4));
    bytes.insert(bytes.end(), binary_.begin(), binary_.end());
    return bytes;
  }

  const Model& model_;
  const ModelClaim& claim_;
  Object root_ = Object::object();
  bool transformsTextures_ = false;
  std::vector<std::byte> binary_;
};

}  // namespace

std::vector<std::byte> writeGlb(const Model& model, const ModelClaim& claim) {
  return GlbWriter(model, claim).write();
}

}  // namespace luxo
