// SPDX-License-Identifier: Apache-2.0
#include "scene/model_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

#include "base/error.h"
#include "image/image.h"
#include "image/texture.h"
#include "math/transform.h"

namespace luxo {
namespace {

using ModelPtr = std::shared_ptr<const Model>;

/// Of each node: whether it, or one that it hangs on, moves.
std::vector<bool> movesInWorld(const Model& model) {
  std::vector<bool> moves;
  moves.reserve(model.nodes.size());
  for (const ModelNode& node : model.nodes)
    moves.push_back(node.moves() || (node.parent != kNone && moves[node.parent]));
  return moves;
}

bool isIdentity(const Transform& t) { return t.linear == Mat3(1) && t.translation == Vec3(0); }

Rotation rotationOf(const Vec4& quaternion) {
  const Vec3 axis(quaternion);
  const double sine = glm::length(axis);
  return sine > 0 ? Rotation{axis / sine, 2 * std::atan2(sine, quaternion.w)} : Rotation{};
}

/// Adds a mesh's triangles as they stand in the world; turned over where that is mirrored, so that fronts
/// stay fronts.
void append(const TriangleMesh& mesh, const Transform& place, MeshArrays& arrays) {
  const auto first = static_cast<std::uint32_t>(arrays.positions.size());
  const Mat3 normals = normalMatrix(place.linear);
  for (std::uint32_t i = 0; i < mesh.positions().size(); ++i) {
    arrays.positions.push_back(transformPoint(place, mesh.point(i)));
    arrays.normals.emplace_back(unit(normals * Vec3(mesh.normals()[i])));
    arrays.uvs.push_back(mesh.uvs().empty() ? Vec2f(0) : mesh.uvs()[i]);
  }
  const bool turns = mirrors(place);
  for (std::uint32_t i = 0; i < mesh.indices().size(); i += 3)
    for (const std::uint32_t k : {0U, turns ? 2U : 1U, turns ? 1U : 2U})
      arrays.indices.push_back(first + mesh.indices()[i + k]);
}

Material materialOf(const ModelMaterial& from) {
  return {.name = from.name,
          .diffuse = from.diffuse,
          .ambient = from.ambient,
          .specular = from.specular,
          .shininess = from.shininess,
          .opacity = from.opacity,
          .twoSided = from.twoSided ? TwoSided::Yes : TwoSided::Auto,
          .normalSpace = from.objectNormals ? NormalSpace::Object : NormalSpace::Tangent,
          .normalScale = from.normalScale,
          .glow = from.glow,
          .lesson = from.lesson};
}

Texture textureOf(const ModelImage& image, Codes codes) try {
  return image.bytes ? decodeTexture(*image.bytes, image.name, codes) : loadTexture(image.file, codes);
} catch (const Error& error) {
  if (image.place.empty()) throw;
  throw Error(error.kind(), fmt::format("{}: {}", image.place, error.what()), error.hint());
}

/// Of light of its own without a map.
std::shared_ptr<const Texture> white() {
  return std::make_shared<const Texture>(makeTexture(Image(1, 1, 3, {1, 1, 1}), "white"));
}

class ModelBuilder {
 public:
  /// Below `parent`, which may be none, by names that begin with `prefix`.
  ModelBuilder(const ModelPtr& model, Scene& scene, NodeId parent = {}, std::string prefix = {})
      : model_(model), scene_(scene), parent_(parent), prefix_(std::move(prefix)) {}

  std::vector<MaterialId> addMaterials() {
    std::vector<MaterialId> materials;
    for (const ModelMaterial& material : model_->materials) materials.push_back(scene_.add(mapped(material)));
    return materials;
  }

  /// The nodes that have a surface.
  std::vector<NodeId> addNodes(const std::vector<MaterialId>& materials) {
    materials_ = materials;
    for (std::uint32_t i = 0; i < model_->nodes.size(); ++i) addNode(i);
    return std::move(shown_);
  }

  void addCameras() {
    const std::vector<bool> moves = movesInWorld(*model_);
    const std::vector<Transform> places = worldFromNodesAt(*model_);
    for (std::uint32_t i = 0; i < model_->nodes.size(); ++i)
      if (const std::uint32_t camera = model_->nodes[i].camera; camera != kNone)
        scene_.add(moves[i] ? movingCamera(i, model_->cameras[camera])
                            : stillCamera(places[i], model_->cameras[camera]));
  }

  /// From the left and above, and a weak one from the right.
  void addLights() {
    const double azimuth = std::atan2(1.0, 1.5);  // of the direction in which fitted cameras are
    const auto add = [&](const char* name, double turn, double tilt, double intensity, const Vec3& color) {
      const NodeId turned = scene_.add(Node{.name = fmt::format("{} turn", name),
                                            .rotation = Rotation{{0, 1, 0}, azimuth + radians(turn)}});
      scene_.add(
          Node{.name = name,
               .parent = turned,
               .rotation = Rotation{{1, 0, 0}, radians(tilt)},
               .light = Light{.type = Light::Type::Directional, .color = color, .intensity = intensity}});
    };
    add("key light", -49, -50, 0.9, {1, 0.97, 0.92});
    add("fill light", 66, -10, 0.25, {0.85, 0.92, 1});
  }

 private:
  void addNode(std::uint32_t index) {
    const ModelNode& from = model_->nodes[index];
    Node node{.name = from.name.empty() ? std::string() : prefix_ + from.name,
              .parent = from.parent == kNone ? parent_ : nodes_[from.parent]};
    node.translation = from.translation;
    node.rotation = rotationOf(from.rotation);
    node.scale = from.scale;
    if (from.translationKeys)
      node.translation = [model = model_, index](double t) { return model->nodes[index].translationAt(t); };
    if (from.rotationKeys)
      node.rotation = [model = model_, index](double t) {
        return rotationOf(model->nodes[index].rotationAt(t));
      };
    if (from.scaleKeys)
      node.scale = [model = model_, index](double t) { return model->nodes[index].scaleAt(t); };
    if (from.light != kNone) node.light = lightOf(model_->lights[from.light]);
    const TriangleMesh* mesh = from.mesh == kNone ? nullptr : &model_->meshes[from.mesh];
    if (mesh && mesh->groups().size() == 1) {
      node.surface = *mesh;
      node.material = materials_[mesh->groups()[0].material];
    }
    const bool isShown = node.surface.valid();
    nodes_.push_back(scene_.add(std::move(node)));
    if (isShown) shown_.push_back(nodes_.back());
    if (mesh && mesh->groups().size() > 1)
      for (const MeshGroup& group : mesh->groups())
        shown_.push_back(scene_.add(Node{.parent = nodes_.back(),
                                         .surface = Surface(*mesh, group),
                                         .material = materials_[group.material]}));
  }

  [[nodiscard]] Material mapped(const ModelMaterial& from) {
    Material material = materialOf(from);
    material.map = mapOf(from.map, Codes::Srgb);
    material.mapOpacity =
        from.opacityFromMap && !material.lesson && material.map.valid() && material.map.texture->transparent;
    if (material.mapOpacity)
      material.cutoff = from.cutoff;
    else if (from.cutoff > 0)
      material.opacity = from.opacity < from.cutoff ? 0 : 1;
    material.normalMap = mapOf(from.normalMap, Codes::Data);
    material.specularMap = mapOf(from.specularMap, from.specularColors ? Codes::Srgb : Codes::Data);
    material.glowMap = mapOf(from.glowMap, Codes::Srgb);
    if (!from.glowMap.given() && from.glow != Vec3(0)) material.glowMap.texture = white();
    return material;
  }

  /// Each image is decoded once for each way to read it.
  [[nodiscard]] TextureMap mapOf(const ModelMap& from, Codes codes) {
    if (!from.given()) return {};
    using enum ModelMap::Wrap;
    std::shared_ptr<const Texture>& texture = images_[{from.image, codes}];
    if (!texture) texture = std::make_shared<const Texture>(textureOf(model_->images[from.image], codes));
    const auto wrap = [](ModelMap::Wrap w) {
      return w == Repeat ? TextureWrap::Repeat : w == Clamp ? TextureWrap::Clamp : TextureWrap::Mirror;
    };
    return {.texture = texture,
            .wrapU = wrap(from.wrapU),
            .wrapV = wrap(from.wrapV),
            .filter = from.nearest ? TextureFilter::Nearest : TextureFilter::Trilinear,
            .offset = from.offset,
            .scale = from.scale,
            .angle = from.angle};
  }

  [[nodiscard]] static Light lightOf(const ModelLight& from) {
    return {.type = from.directional ? Light::Type::Directional : Light::Type::Point,
            .color = from.color,
            .intensity = from.intensity / kPi,
            .attenuation = Light::Attenuation::InverseSquare,
            .spot = from.spot ? std::optional(Spot{from.spot->inner, from.spot->outer}) : std::nullopt};
  }

  [[nodiscard]] static Camera lensOf(const ModelCamera& from) {
    return {.name = from.name.empty() ? "camera" : from.name,
            .fovY = from.fovY,
            .near = from.near,
            .projection = from.perspective ? Projection::Perspective : Projection::Orthographic,
            .height = from.height};
  }

  [[nodiscard]] static Camera stillCamera(const Transform& place, const ModelCamera& from) {
    Camera camera = lensOf(from);
    camera.eye = transformPoint(place, kEye);
    camera.lookAt = transformPoint(place, kAhead);
    camera.up = transformDirection(place, kUp);
    return camera;
  }

  [[nodiscard]] Camera movingCamera(std::uint32_t node, const ModelCamera& from) const {
    const auto placed = [&](const Vec3& point) {
      return [model = model_, node, point](double t) {
        return transformPoint(worldFromNodeAt(*model, node, t), point);
      };
    };
    Camera camera = lensOf(from);
    camera.eye = placed(kEye);
    camera.lookAt = placed(kAhead);
    camera.up = [model = model_, node](double t) {
      return transformDirection(worldFromNodeAt(*model, node, t), kUp);
    };
    return camera;
  }

  // Of a camera, in the axes of its node.
  static constexpr Vec3 kEye{0, 0, 0}, kAhead{0, 0, -1}, kUp{0, 1, 0};

  ModelPtr model_;
  Scene& scene_;
  NodeId parent_;
  std::string prefix_;
  std::map<std::pair<std::uint32_t, Codes>, std::shared_ptr<const Texture>> images_;
  std::vector<MaterialId> materials_;
  std::vector<NodeId> nodes_;  // as the model's
  std::vector<NodeId> shown_;
};

}  // namespace

Surface surfaceOf(const Model& model) {
  const std::vector<Transform> places = worldFromNodesAt(model);
  std::vector<std::pair<std::uint32_t, Transform>> shown;  // meshes, and where they are
  for (std::uint32_t i = 0; i < model.nodes.size(); ++i)
    if (model.nodes[i].mesh != kNone) shown.emplace_back(model.nodes[i].mesh, places[i]);
  if (shown.empty())
    throw Error(ErrorKind::Scene, fmt::format("the model '{}' has no triangles", model.name));
  if (shown.size() == 1 && isIdentity(shown[0].second)) return model.meshes[shown[0].first];
  MeshArrays arrays;
  for (const auto& [mesh, place] : shown) append(model.meshes[mesh], place, arrays);
  const bool tangents =
      std::ranges::any_of(model.meshes, [](const TriangleMesh& mesh) { return !mesh.tangents().empty(); });
  return triangleMesh(std::move(arrays), model.name, {.tangents = tangents});
}

Scene modelScene(const ModelPtr& model) {
  Scene scene;
  ModelBuilder builder(model, scene);
  builder.addNodes(builder.addMaterials());
  builder.addCameras();
  if (!model->lit()) builder.addLights();
  RenderSettings settings = scene.settings();
  settings.ambient = model->ambient.value_or(settings.ambient);
  settings.background = model->background.value_or(settings.background);
  scene.set(settings);
  return scene;
}

std::vector<NodeId> addModel(Scene& scene, NodeId parent, const ModelPtr& model,
                             std::vector<MaterialId>& materials) {
  const std::string& name = scene[parent].name;
  ModelBuilder builder(model, scene, parent, name.empty() ? name : name + "/");
  if (materials.empty()) materials = builder.addMaterials();
  return builder.addNodes(materials);
}

}  // namespace luxo
