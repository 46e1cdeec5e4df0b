// SPDX-License-Identifier: Apache-2.0
#include "export/exported_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>

#include "base/assert.h"
#include "base/error.h"
#include "base/suggestion.h"
#include "export/thickened.h"
#include "image/codes.h"
#include "image/png.h"
#include "image/texture.h"
#include "mesh/gltf_material.h"
#include "mesh/turn.h"
#include "scene/snapshot.h"
#include "tessellate/shape_cache.h"
#include "tessellate/tessellator.h"

namespace luxo {
namespace {

// What rounding moves a point by whose coordinates are up to 1.
constexpr double kSingle = 0x1p-24 * 1.7320508075688774, kDouble = 0x1p-44;

/// The next number below of those with 8 bits: nodes whose places differ need the same mesh.
double roundedDown(double tolerance) {
  int exponent = 0;
  const double bits = std::floor(std::ldexp(std::frexp(tolerance, &exponent), 8));
  return std::ldexp(bits, exponent - 8);
}

double largestCoordinate(const Box& box) {
  const Vec3 most = glm::max(glm::abs(box.min), glm::abs(box.max));
  return std::max({most.x, most.y, most.z});
}

/// Of what a transform makes of a box, or more.
double largestCoordinate(const Transform& place, const Box& box) {
  const Vec3 most = glm::max(glm::abs(box.min), glm::abs(box.max));
  double largest = 0;
  for (int row = 0; row < 3; ++row) {
    double sum = std::abs(place.translation[row]);
    for (int column = 0; column < 3; ++column) sum += std::abs(place.linear[column][row]) * most[column];
    largest = std::max(largest, sum);
  }
  return largest;
}

/// Translation, rotation and scale that are the transform but for rounding.
std::optional<ModelNode> placedNode(const Transform& place) {
  const std::optional<Turn> turn = decomposed(place.linear);
  if (!turn) return std::nullopt;
  ModelNode node{.translation = place.translation, .rotation = turn->rotation, .scale = turn->scale};
  const Transform again = node.parentFromNodeAt(0);
  for (int i = 0; i < 3; ++i)
    if (!(glm::length(again.linear[i] - place.linear[i]) <= 1e-14 * glm::length(place.linear[i])))
      return std::nullopt;
  return node;
}

/// The mesh where it stands in the world.
void moveTo(const Transform& place, Mesh& mesh) {
  const Mat3 normals = normalMatrix(place.linear);
  for (Vec3& p : mesh.positions) p = transformPoint(place, p);
  for (Vec3& n : mesh.normals) n = unit(normals * n);
  if (mirrors(place))
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
      std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
}

/// The finest level, as a PNG of 8 bits. Only colours have an alpha.
ModelImage imageOf(const Texture& texture, Codes codes) {
  const TextureLevel& finest = texture.levels.front();
  const int channels = texture.transparent && codes == Codes::Srgb ? 4 : 3;
  Image image(finest.width, finest.height, channels);
  for (int y = 0; y < finest.height; ++y)
    for (int x = 0; x < finest.width; ++x)
      std::copy_n(finest.texel(x, y).begin(), channels,
                  &image.row(y)[static_cast<std::size_t>(channels * x)]);
  return {.name = "map", .bytes = std::make_shared<const std::vector<std::byte>>(encodePng(image, codes))};
}

ModelMap::Wrap wrapOf(TextureWrap wrap) {
  return wrap == TextureWrap::Repeat  ? ModelMap::Wrap::Repeat
         : wrap == TextureWrap::Clamp ? ModelMap::Wrap::Clamp
                                      : ModelMap::Wrap::Mirror;
}

class Exporter {
 public:
  Exporter(const Scene& scene, double timeSeconds, const ExportDesc& desc)
      : scene_(scene),
        time_(timeSeconds),
        desc_(desc),
        snapshot_(takeSnapshot(scene, timeSeconds, scene.settings().size, desc.camera)) {
    const Vec3 extent = framingOf(snapshot_).extent();
    // Without an extent there is nothing whose triangles could be off.
    tolerance_ = desc.tolerance.value_or(std::max(glm::length(extent) / 2000, 1e-300));
    LUXO_REQUIRE_COMPARE(tolerance_, >, 0.0);
  }

  ExportedModel exported() {
    out_.claim = {.deviation = 0, .closed = true};
    for (std::size_t i = 0; i < snapshot_.nodes.size(); ++i) {
      addNode(snapshot_.nodes[i]);
      if (desc_.progress) desc_.progress(double(i + 1) / double(snapshot_.nodes.size()));
    }
    if (out_.model.meshes.empty())
      throw Error(ErrorKind::Scene, "the scene shows no surface that could be exported",
                  "see luxo inspect; is everything invisible at that time?");
    addCameras();
    addLights();
    if (writesGlb()) addSurroundings();
    tellLosses();
    return std::move(out_);
  }

 private:
  void warn(std::string message) {
    if (std::ranges::find(out_.warnings, message) == out_.warnings.end())
      out_.warnings.push_back(std::move(message));
  }

  [[nodiscard]] std::string nameOf(NodeId id) const {
    const std::string& name = scene_[id].name;
    return name.empty() ? scene_.shownName(id) : name;
  }

  void addNode(const SnapshotNode& from) {
    const Material& material = snapshot_.materials[from.material.index];
    if (material.invisible()) return;
    const double stretch = largestStretch(from.worldFromObject.linear) * (1 + 1e-12);
    const bool plate = desc_.thickness > 0 && !from.surface.closed();
    const std::optional<ModelNode> placed = plate ? std::nullopt : placedNode(from.worldFromObject);

    const double rounding = roundingOf(from.worldFromObject, from.boundsObject);
    // Written so that what is not a number leaves half of it.
    const double left = tolerance_ - rounding;
    const double tolerance = roundedDown((left > tolerance_ / 2 ? left : tolerance_ / 2) / stretch);

    const Key key{Shape(from.surface, from.parameters), tolerance, from.material.index};
    ModelNode node = placed.value_or(ModelNode{});
    node.name = nameOf(from.id);
    if (const auto shared = meshes_.find(key); placed && shared != meshes_.end()) {
      node.mesh = shared->second;
    } else {
      Mesh mesh = tessellate(from.surface, from.parameters, {.tolerance = tolerance});
      if (mesh.indices.empty()) {
        warn(fmt::format("{} has no triangles and is left out", node.name));
        return;
      }
      if (mesh.dropped > 0)
        warn(fmt::format("{}: {} triangles are missing, where its formula has no value", node.name,
                         mesh.dropped));
      bounds_.push_back(mesh.bound);
      const std::uint32_t number = materialOf(from, mesh);
      if (!placed) moveTo(from.worldFromObject, mesh);
      node.mesh = addMesh(from, plate ? plateOf(from, mesh) : arraysOf(from, mesh), number);
      if (placed) meshes_.emplace(key, node.mesh);
    }
    const TriangleMesh& mesh = out_.model.meshes[node.mesh];
    out_.claim.closed &= mesh.closed();
    const double bound =
        stretch * bounds_[node.mesh] +
        roundingOf(placed ? from.worldFromObject : Transform(), mesh.bounds(), mesh.origin());
    out_.claim.deviation = std::max(out_.claim.deviation, bound);
    out_.model.nodes.push_back(std::move(node));
  }

  /// How far rounding moves the points of a box: in a mesh, whose points are relative to its origin, and in a
  /// file that has them in the world.
  [[nodiscard]] double roundingOf(const Transform& place, const Box& box,
                                  const Vec3& origin = Vec3(0)) const {
    return largestStretch(place.linear) * kSingle * largestCoordinate({box.min - origin, box.max - origin}) +
           (writesGlb() ? kDouble : kSingle) * largestCoordinate(place, box);
  }

  [[nodiscard]] MeshArrays arraysOf(const SnapshotNode& from, const Mesh& mesh) const {
    MeshArrays arrays{.positions = mesh.positions, .indices = mesh.indices};
    for (const Vec3& n : mesh.normals) arrays.normals.emplace_back(n);
    if (!exportsMaps(from)) return arrays;
    const TexturePlacement place = TextureMap::onceOver(from.surface);
    for (const Vec2& uv : mesh.parameters) arrays.uvs.emplace_back(place.linear * uv + place.constant);
    return arrays;
  }

  [[nodiscard]] bool writesGlb() const { return desc_.kept == Kept::All; }
  [[nodiscard]] bool writesObj() const { return desc_.kept == Kept::Materials; }

  [[nodiscard]] bool exportsMaps(const SnapshotNode& from) const {
    const Material& material = snapshot_.materials[from.material.index];
    const bool plate = desc_.thickness > 0 && !from.surface.closed();
    return desc_.kept >= Kept::Materials && !plate && material.hasMaps();
  }

  /// Each texture is one image for each way to read it. None, if the file has no words for how it is read.
  [[nodiscard]] ModelMap mapOf(const TextureMap& from, Codes codes) {
    ModelMap map{.wrapU = wrapOf(from.wrapU),
                 .wrapV = wrapOf(from.wrapV),
                 .nearest = from.filter == TextureFilter::Nearest,
                 .offset = from.offset,
                 .scale = from.scale,
                 .angle = from.angle};
    if (!from.valid() || (writesObj() && !saidByMtl(map))) return {};
    const auto next = static_cast<std::uint32_t>(out_.model.images.size());
    const auto [known, fresh] = images_.try_emplace({from.texture, codes}, next);
    if (fresh) out_.model.images.push_back(imageOf(*from.texture, codes));
    map.image = known->second;
    return map;
  }

  void addMaps(const SnapshotNode& from, const Material& material, ModelMaterial& made) {
    const bool tangential = material.normalSpace == NormalSpace::Tangent;
    if (exportsMaps(from)) {
      // Of an MTL colours that are black are those of their maps.
      const auto coloured = [&](const Vec3& colour) { return !writesObj() || colour != Vec3(0); };
      if (coloured(material.diffuse)) made.map = mapOf(material.map, Codes::Srgb);
      if (tangential) made.normalMap = mapOf(material.normalMap, Codes::Data);
      made.normalScale = material.normalScale;
      made.specularColors = !writesObj();
      if (!material.lesson && coloured(material.specular))
        made.specularMap = mapOf(material.specularMap, made.specularColors ? Codes::Srgb : Codes::Data);
      if (coloured(material.glow)) made.glowMap = mapOf(material.glowMap, Codes::Srgb);
      if (made.glowMap.given()) made.glow = material.glow;
      made.opacityFromMap = material.mapOpacity && made.map.given();
      made.cutoff = made.opacityFromMap ? material.cutoff : 0;
    }
    tellLosses(material, made);
  }

  /// Of a material: what the file has no word for. One without colours has lost them all, and that is told
  /// once.
  void tellLosses(const Material& material, const ModelMaterial& made) {
    const auto tell = [&](bool left, const char* what) {
      if (left) warn(fmt::format("material '{}': its {} is not exported", material.name, what));
    };
    if (desc_.kept == Kept::Triangles) return;
    tell(material.map.valid() && !made.map.given(), "map");
    if (desc_.kept == Kept::Colours) return;
    const bool tangential = material.normalSpace == NormalSpace::Tangent;
    tell(material.glowMap.valid() && !made.glowMap.given(), "glow_map");
    tell(material.normalMap.valid() && !made.normalMap.given(),
         tangential ? "normal_map" : "normal_map, in the axes of the object,");
    tell(material.specularMap.valid() && !made.specularMap.given(), "specular_map");
    tell(material.lesson || material.shading, "shading");
    tell(material.isolines.valid(), "isolines");
    tell(material.lectureSpecular, "lecture_specular");
    if (writesGlb()) {
      const double strongest = std::max({material.specular.x, material.specular.y, material.specular.z});
      if (strongest > strongestGltfSpecular(material.shininess) || material.shininess > kMaxGltfShininess)
        warn(fmt::format("material '{}': its highlights are weaker there, or wider", material.name));
    }
    if (writesObj()) {
      tell(made.cutoff > 0, "cutoff");
      for (const ModelMap* map : {&made.map, &made.normalMap, &made.specularMap, &made.glowMap})
        tell(map->given() && map->nearest, "filter, nearest,");
    }
    tell(material.shader != nullptr, "shader");
    if (material.blend != Blend::Over && material.transparent())
      warn(fmt::format("material '{}': it blends as 'over' does", material.name));
  }

  [[nodiscard]] MeshArrays plateOf(const SnapshotNode& from, const Mesh& mesh) {
    Plate plate = thickened(mesh, desc_.thickness, !from.surface.topology().orientable);
    if (plate.folded > 0)
      warn(fmt::format("{} bends more sharply than half its thickness: {} triangles are turned over",
                       nameOf(from.id), plate.folded));
    out_.claim.thickness = desc_.thickness;
    return std::move(plate.arrays);
  }

  std::uint32_t addMesh(const SnapshotNode& from, MeshArrays arrays, std::uint32_t material) {
    arrays.materials.assign(arrays.indices.size() / 3, material);
    const std::string& surface = from.surface.name();
    const bool bent = out_.model.materials[material].normalMap.given();
    out_.model.meshes.push_back(
        triangleMesh(std::move(arrays), surface.empty() ? "mesh" : surface, {.tangents = bent}));
    return static_cast<std::uint32_t>(out_.model.meshes.size() - 1);
  }

  /// The number of a material in the model. One that is a formula is there for each mesh.
  std::uint32_t materialOf(const SnapshotNode& from, const Mesh& mesh) {
    const Material& material = snapshot_.materials[from.material.index];
    const bool twoSided =
        material.twoSided == TwoSided::Yes || (material.twoSided == TwoSided::Auto && !from.surface.closed());
    const bool varies = material.diffusePattern.valid();
    const auto next = static_cast<std::uint32_t>(out_.model.materials.size());
    if (!varies) {
      const auto [known, fresh] =
          materials_.try_emplace({from.material.index, twoSided, exportsMaps(from)}, next);
      if (!fresh) return known->second;
    }
    ModelMaterial made{.name = material.name,
                       .diffuse = material.diffuse,
                       .ambient = material.ambient,
                       .specular = material.specular,
                       .shininess = material.shininess,
                       .opacity = material.opacity,
                       .twoSided = twoSided};
    if (varies) {
      Vec3 colour(0);
      double opacity = 0;
      for (const Vec2& at : mesh.parameters) {
        colour += material.diffuseAt(at.x, at.y);
        opacity += material.opacityAt(at.x, at.y);
      }
      made.diffuse = colour / double(mesh.parameters.size());
      made.opacity = std::clamp(opacity / double(mesh.parameters.size()), 0.0, 1.0);
      if (desc_.kept > Kept::Triangles)
        warn(fmt::format("material '{}': its colour is a formula; the mesh has the mean", material.name));
    }
    addMaps(from, material, made);
    out_.model.materials.push_back(std::move(made));
    return next;
  }

  void addCameras() {
    const std::vector<double> parameters = scene_.parametersAt(time_);
    std::vector<std::uint32_t> order;
    for (std::uint32_t i = 0; i < scene_.cameras().size(); ++i) order.push_back(i);
    if (desc_.camera.valid())
      std::stable_partition(order.begin(), order.end(),
                            [&](std::uint32_t i) { return i == desc_.camera.index; });
    for (const std::uint32_t i : order) {
      const Camera& camera = scene_.cameras()[i];
      const View view = viewAt(camera, {time_, parameters}, scene_.settings().size, framingOf(snapshot_));
      const Mat3 worldFromEye = glm::transpose(view.eyeFromWorld);
      out_.model.nodes.push_back({.name = camera.name,
                                  .translation = view.eye,
                                  .rotation = decomposed(worldFromEye)->rotation,
                                  .camera = static_cast<std::uint32_t>(out_.model.cameras.size())});
      out_.model.cameras.push_back({.name = camera.name,
                                    .perspective = view.perspective(),
                                    .fovY = 2 * std::atan(view.halfExtent.y),
                                    .height = 2 * view.halfExtent.y,
                                    .near = view.near,
                                    .far = view.far});
    }
  }

  /// What no other program reads: see mesh/gltf_writer.cpp.
  void addSurroundings() {
    out_.model.ambient = snapshot_.ambient;
    out_.model.background = snapshot_.background;
    for (const SnapshotLight& light : snapshot_.lights)
      if (light.hasShadow()) warn(fmt::format("light '{}': its shadow is not exported", nameOf(light.id)));
  }

  void addLights() {
    // A soft light is several there.
    struct Sum {
      Vec4 position{0};
      Vec3 radiance{0};
      double count = 0;
      Light::Attenuation attenuation = Light::Attenuation::None;
      std::optional<SpotCone> cone = {};
    };
    std::map<std::uint32_t, Sum> lights;
    for (const SnapshotLight& light : snapshot_.lights) {
      Sum& sum = lights[light.id.index];
      sum.position += light.positionWorld;
      sum.radiance += light.radiance;
      sum.count += 1;
      sum.attenuation = light.attenuation;
      sum.cone = light.cone;
    }
    const Box framing = framingOf(snapshot_);
    for (const auto& [node, sum] : lights) {
      const bool directional = sum.position.w == 0;
      const Vec3 position = Vec3(sum.position) / sum.count;
      const double most = std::max({sum.radiance.x, sum.radiance.y, sum.radiance.z});
      if (!(most > 0)) continue;
      const std::string name = nameOf({node});
      ModelLight light{
          .name = name, .directional = directional, .color = sum.radiance / most, .intensity = kPi * most};
      if (sum.cone) light.spot = {sum.cone->inner, sum.cone->outer};
      if (!directional && sum.attenuation == Light::Attenuation::None) {
        const Vec3 way = 0.5 * (framing.min + framing.max) - position;
        light.intensity *= glm::dot(way, way);
        if (writesGlb())
          warn(fmt::format("light '{}' is as bright everywhere; the model's falls off with distance", name));
      }
      ModelNode at{.name = name, .light = static_cast<std::uint32_t>(out_.model.lights.size())};
      if (directional)
        at.rotation = turnTo(unit(position));
      else
        at.translation = position;
      if (sum.cone) at.rotation = turnTo(-sum.cone->axis);
      out_.model.nodes.push_back(std::move(at));
      out_.model.lights.push_back(std::move(light));
    }
  }

  /// What of the scene the file has no room for at all.
  void tellLosses() {
    std::vector<std::string> lost;
    const auto differs = [&](const SnapshotNode& shown) {
      Material material = snapshot_.materials[shown.material.index];
      const Material plain;
      if (material.invisible()) return false;  // of a node that is not exported
      material.name = plain.name;
      if (!material.glowMap.valid()) material.glow = plain.glow;  // of nothing
      if (desc_.kept == Kept::Colours) {
        // Maps and formulas are told of one by one; how opaque they are is lost beside their colours.
        material.diffuse = plain.diffuse;
        material.map = plain.map;
        if (!material.diffusePattern.hasOpacity()) {
          material.diffusePattern = plain.diffusePattern;
          material.patternParameters = plain.patternParameters;
        }
      }
      return material != plain;
    };
    if (desc_.kept < Kept::Materials && std::ranges::any_of(snapshot_.nodes, differs))
      lost.emplace_back(desc_.kept == Kept::Colours ? "materials but their colours" : "materials");
    if (!writesGlb() && !out_.model.cameras.empty()) lost.emplace_back("cameras");
    if (!writesGlb() && desc_.ownLights && !out_.model.lights.empty()) lost.emplace_back("lights");
    if (!lost.empty()) warn(fmt::format("the file has no room for {}", listed(lost)));
    const RenderSettings& settings = scene_.settings();
    if (desc_.kept >= Kept::Materials && settings.shading != Shading::Exact)
      warn(fmt::format("the scene's shading, {}, is not exported", luxo::nameOf(settings.shading)));
    if (desc_.kept >= Kept::Materials && settings.ambientOcclusion.any())
      warn("ambient occlusion is not exported");
    tellMovement();
  }

  void tellMovement() {
    const auto moves = [](const auto& value) { return value.movesWithTime(); };
    // Which of the parameters a function reads it does not say.
    const auto varies = [](const auto& value) { return !value.isConstant(); };
    if (writesGlb() ? scene_.movesWithTime() : trianglesMove(moves))
      warn(fmt::format("the triangles stand still, as they are at {:g} s", time_));
    else if (!writesGlb() && scene_.parametersMove() && trianglesMove(varies))
      warn(fmt::format("the triangles stand still, as they are at {:g} s; parameters may move them", time_));
  }

  /// Whether they, or their materials, are others at another time, where `moves` says that of a value.
  template <class Moves>
  [[nodiscard]] bool trianglesMove(const Moves& moves) const {
    std::vector<bool> places;  // of nodes, with what they hang on
    for (const Scene::Entry& entry : scene_.nodes()) {
      const Node& node = entry.node;
      places.push_back(moves(node.translation) || moves(node.rotation) || moves(node.scale) ||
                       moves(node.visible) || (node.parent.valid() && places[node.parent.index]));
      if (entry.removed || !node.surface.valid()) continue;
      if (places.back() || isCloth(node.surface) || std::ranges::any_of(node.surface.parameters(), moves))
        return true;
      if (node.surface.isPolygonal() && node.material.valid() && moves(scene_[node.material]) &&
          snapshot_.materials[node.material.index].movesVertices())
        return true;
      if (desc_.kept > Kept::Triangles && node.material.valid() && moves(scene_[node.material])) return true;
    }
    return false;
  }

  /// A rotation that takes +Z, where a light's light comes from, to a unit direction.
  [[nodiscard]] static Vec4 turnTo(const Vec3& direction) {
    const Vec3 aside =
        unit(glm::cross(std::abs(direction.y) < 0.9 ? Vec3(0, 1, 0) : Vec3(1, 0, 0), direction));
    return decomposed(Mat3(aside, glm::cross(direction, aside), direction))->rotation;
  }

  using Key = std::tuple<Shape, double, std::uint32_t>;

  const Scene& scene_;
  double time_;
  const ExportDesc& desc_;
  Snapshot snapshot_;
  double tolerance_ = 0;
  ExportedModel out_;
  std::map<Key, std::uint32_t> meshes_;
  std::vector<double> bounds_;  ///< of each mesh, in object space
  std::map<std::tuple<std::uint32_t, bool, bool>, std::uint32_t> materials_;
  std::map<std::pair<std::shared_ptr<const Texture>, Codes>, std::uint32_t> images_;
};

}  // namespace

ExportedModel exportedModel(const Scene& scene, double timeSeconds, const ExportDesc& desc) {
  return Exporter(scene, timeSeconds, desc).exported();
}

}  // namespace luxo
