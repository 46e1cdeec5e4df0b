// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <optional>

#include "mesh/gltf_file.h"
#include "mesh/gltf_material.h"
#include "mesh/turn.h"

namespace luxo {
namespace {

// What files may require that changes nothing of what is read here, or is read.
constexpr std::array<std::string_view, 7> kExtensions = {"KHR_lights_punctual",
                                                         "KHR_texture_transform",
                                                         "KHR_materials_specular",
                                                         "LUXO_parametric_surface",
                                                         "KHR_mesh_quantization",
                                                         "KHR_materials_unlit",
                                                         "KHR_materials_emissive_strength"};

class GltfReader {
 public:
  GltfReader(const ModelSource& source, std::string_view bytes) : source_(source), file_(source, bytes) {}

  Model read() {
    model_.name = printable(source_.path().stem().string());
    const GltfValue required = file_.list("extensionsRequired");
    for (std::size_t i = 0; i < required.size(); ++i)
      if (const std::string name = required[i].text();
          std::find(kExtensions.begin(), kExtensions.end(), name) == kExtensions.end())
        required[i].refuse(fmt::format("it needs {}, which is not supported", printable(name.substr(0, 60))));
    uvSets_ = readGltfMaterials(source_, file_, model_);
    plainMaterial_ = std::uint32_t(model_.materials.size());
    readCameras();
    readLights();
    readNodes();
    readAnimation();
    if (model_.materials.empty()) model_.materials.push_back({.name = "default"});
    readSurroundings();
    readFormulas();
    if (model_.meshes.empty()) refuseModel(source_.name(), "it has no triangles with an area");
    source_.tellProgress(1);
    return std::move(model_);
  }

 private:
  void warn(const GltfValue& value, std::string_view what) {
    model_.warnings.push_back(fmt::format("{}: {}: {}", source_.name(), value.place(), what));
  }
  static double positive(const GltfValue& value) {
    if (const double number = value.number(); number > 0) return number;
    value.refuse("it is not above 0");
  }

  void readSurroundings() {
    const GltfValue scenes = file_.list("scenes");
    if (scenes.size() == 0) return;
    const GltfValue ours = scenes[file_.root()["scene"].integerOr(0)]["extras"]["luxo"];
    if (ours.has("ambient")) model_.ambient = ours["ambient"].colourOr(Vec3(0));
    if (ours.has("background")) model_.background = ours["background"].colourOr(Vec3(0));
  }

  void readFormulas() {
    const GltfValue formulas = file_.root()["extensions"]["LUXO_parametric_surface"];
    if (const std::uint64_t version = formulas["version"].integerOr(1); version != 1)
      return warn(formulas, fmt::format("version {} is not known; its triangles are used instead", version));
    model_.scene = formulas["scene"].textOr("");
    const GltfValue files = formulas["files"];
    for (std::size_t i = 0; i < files.size(); ++i)
      model_.sceneFiles[files[i]["name"].text()] = files[i].has("bufferView")
                                                       ? file_.copyOf(files[i]["bufferView"].integer())
                                                       : std::make_shared<const std::vector<std::byte>>();
  }

  void readCameras() {
    const GltfValue cameras = file_.list("cameras");
    for (std::size_t i = 0; i < cameras.size(); ++i) {
      ModelCamera camera{.name = printable(cameras[i]["name"].textOr("camera"))};
      camera.perspective = cameras[i]["type"].text() != "orthographic";
      const GltfValue lens = cameras[i][camera.perspective ? "perspective" : "orthographic"];
      if (camera.perspective) {
        camera.fovY = positive(lens["yfov"]);
        if (camera.fovY >= kPi) lens["yfov"].refuse("half a turn or more");
      } else {
        camera.height = 2 * positive(lens["ymag"]);
      }
      if (lens["znear"].numberOr(0) > 0) camera.near = lens["znear"].number();
      model_.cameras.push_back(std::move(camera));
    }
  }

  /// What scenes take (scene/ranges.h). Of angles that were rounded to float a quarter turn is above the
  /// largest one.
  ModelLight::Spot spotOf(const GltfValue& value) {
    constexpr double kLeast = 1e-9, kQuarter = kPi / 2, kRounded = kQuarter * (1 + 1e-7);
    ModelLight::Spot spot;
    spot.outer = value["outerConeAngle"].numberOr(spot.outer);
    if (!(spot.outer >= kLeast && spot.outer <= kRounded))
      value["outerConeAngle"].refuse("it is not from 1e-9 to a quarter turn (in radians)");
    spot.outer = std::min(spot.outer, kQuarter);
    spot.inner = value["innerConeAngle"].numberOr(spot.inner);
    if (!(spot.inner >= 0 && spot.inner <= spot.outer * (1 + 1e-6)))
      value["innerConeAngle"].refuse("it is not from 0 to the outer one (in radians)");
    if (spot.inner >= spot.outer) {
      warn(value, "its inner cone is as wide as its outer one: its border is a thousandth of that wide");
      spot.inner = 0.999 * spot.outer;
    }
    return spot;
  }

  void readLights() {
    const GltfValue lights = file_.root()["extensions"]["KHR_lights_punctual"]["lights"];
    bool ranged = false;
    for (std::size_t i = 0; i < lights.size(); ++i) {
      const std::string type = lights[i]["type"].text();
      if (type != "point" && type != "spot" && type != "directional")
        lights[i]["type"].refuse("it is no kind of light");
      if (!ranged && type != "directional" && lights[i].has("range")) {
        ranged = true;
        warn(lights[i], "ranges of lights are not read: it fades with the squared distance, and has no end");
      }
      ModelLight light{.name = printable(lights[i]["name"].textOr("light")),
                       .directional = type == "directional"};
      light.color = lights[i]["color"].colourOr(Vec3(1));
      light.intensity = lights[i]["intensity"].numberOr(1);
      if (light.intensity < 0) lights[i]["intensity"].refuse("it is below 0");
      if (type == "spot") light.spot = spotOf(lights[i]["spot"]);
      model_.lights.push_back(std::move(light));
    }
  }

  // Parents of all nodes; what is its own ancestor is refused, in the scene or not.
  std::vector<std::uint32_t> parents() const {
    const GltfValue nodes = file_.list("nodes");
    std::vector<std::uint32_t> parents(nodes.size(), kNone);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const GltfValue children = nodes[i]["children"];
      for (std::size_t k = 0; k < children.size(); ++k) {
        std::uint32_t& parent = parents[children[k].integer(nodes.size())];
        if (parent != kNone) children[k].refuse(fmt::format("that node hangs on node {} already", parent));
        parent = std::uint32_t(i);
      }
    }
    std::vector<std::uint32_t> seenFrom(nodes.size(), kNone);
    for (std::uint32_t i = 0; i < nodes.size(); ++i)
      for (std::uint32_t at = i; at != kNone && (seenFrom[at] == kNone || seenFrom[at] == i);
           at = parents[at]) {
        if (seenFrom[at] == i) nodes[at].refuse("it is its own ancestor");
        seenFrom[at] = i;
      }
    return parents;
  }

  void readNodes() {
    const std::vector<std::uint32_t> parents = this->parents();
    const GltfValue nodes = file_.list("nodes"), scenes = file_.list("scenes");
    std::vector<std::uint32_t> left;
    if (scenes.size() > 0) {
      const GltfValue roots = scenes[file_.root()["scene"].integerOr(0)]["nodes"];
      for (std::size_t i = 0; i < roots.size(); ++i) {
        left.push_back(std::uint32_t(roots[i].integer(nodes.size())));
        if (parents[left.back()] != kNone) roots[i].refuse("it is no root");
      }
    } else {
      for (std::uint32_t i = 0; i < nodes.size(); ++i)
        if (parents[i] == kNone) left.push_back(i);
    }
    std::reverse(left.begin(), left.end());
    numberOf_.assign(nodes.size(), kNone);
    meshNumbers_.assign(file_.list("meshes").size(), kUnread);
    while (!left.empty()) {
      const std::uint32_t i = left.back();
      left.pop_back();
      if (numberOf_[i] != kNone) nodes[i].refuse("it is in the scene twice");
      ModelNode node = readNode(nodes[i], parents[i] == kNone ? kNone : numberOf_[parents[i]]);
      numberOf_[i] = std::uint32_t(model_.nodes.size());
      model_.nodes.push_back(std::move(node));
      const GltfValue children = nodes[i]["children"];
      for (std::size_t k = children.size(); k-- > 0;)
        left.push_back(std::uint32_t(children[k].integer(nodes.size())));
      source_.tellProgress(0.95 * double(model_.nodes.size()) / double(nodes.size()));
    }
  }

  ModelNode readNode(const GltfValue& value, std::uint32_t parent) {
    if (value.has("skin")) value["skin"].refuse("skins are not supported");
    ModelNode node{.name = printable(value["name"].textOr("node")), .parent = parent};
    if (value.has("matrix")) {
      setMatrix(node, matrixOf(value["matrix"]));
    } else {
      node.translation = value["translation"].vectorOr(Vec3(0));
      node.scale = value["scale"].vectorOr(Vec3(1));
      node.rotation = value["rotation"].vectorOr(Vec4(0, 0, 0, 1));
      const double length = glm::length(node.rotation);
      if (!(std::abs(length - 1) < 0.01))
        value["rotation"].refuse(fmt::format("its length is {:.4g}, not 1", length));
      node.rotation /= length;
    }
    if (value.has("mesh")) node.mesh = mesh(value["mesh"].integer(meshNumbers_.size()));
    if (value.has("camera")) node.camera = std::uint32_t(value["camera"].integer(model_.cameras.size()));
    if (const GltfValue light = value["extensions"]["KHR_lights_punctual"]["light"]; light.given())
      node.light = std::uint32_t(light.integer(model_.lights.size()));
    return node;
  }

  // Columns; the last row of an affine map says nothing.
  static Transform matrixOf(const GltfValue& value) {
    if (value.size() != 16) value.refuse("not 16 numbers");
    Transform matrix;
    for (int column = 0; column < 3; ++column)
      for (int row = 0; row < 3; ++row)
        matrix.linear[column][row] = value[std::size_t(4 * column + row)].number();
    for (int row = 0; row < 3; ++row) matrix.translation[row] = value[std::size_t(12 + row)].number();
    return matrix;
  }

  // What is sheared or flat is scaled between two turns, and takes a node more.
  void setMatrix(ModelNode& node, const Transform& matrix) {
    node.translation = matrix.translation;
    if (const std::optional<Turn> turn = decomposed(matrix.linear)) {
      node.rotation = turn->rotation;
      node.scale = turn->scale;
      return;
    }
    const auto [outer, first] = singularValues(matrix.linear);
    model_.nodes.push_back({.parent = node.parent,
                            .translation = matrix.translation,
                            .rotation = outer.rotation,
                            .scale = outer.scale});
    node = {.name = node.name, .parent = std::uint32_t(model_.nodes.size() - 1), .rotation = first};
  }

  std::uint32_t mesh(std::uint64_t number) {
    if (meshNumbers_[number] != kUnread) return meshNumbers_[number];
    const GltfValue value = file_.list("meshes")[number], primitives = value["primitives"];
    MeshArrays arrays;
    bool uvs = false, normals = false;
    Ranges ranges;  // vertices that primitives share are read once
    for (std::size_t i = 0; i < primitives.size(); ++i) {
      const GltfValue attributes = primitives[i]["attributes"];
      uvs = uvs || attributes.has(uvsOf(primitives[i]).c_str());
      normals = normals || attributes.has("NORMAL");
    }
    for (std::size_t i = 0; i < primitives.size(); ++i)
      readPrimitive(primitives[i], arrays, ranges, normals, uvs);
    const auto fresh = std::uint32_t(model_.meshes.size());
    if (source_.addMesh(model_, std::move(arrays), printable(value["name"].textOr("mesh"))))
      return meshNumbers_[number] = fresh;
    warn(value, "it has no triangle with an area and is left out");
    return meshNumbers_[number] = kNone;
  }

  /// The attribute that the maps of a primitive's material use.
  [[nodiscard]] std::string uvsOf(const GltfValue& primitive) const {
    const GltfValue material = primitive["material"];
    return fmt::format("TEXCOORD_{}", material.given() ? uvSets_[material.integer(uvSets_.size())] : 0);
  }

  /// Vertices of a mesh, by the accessors that they come from: positions, normals, uvs.
  struct Range {
    std::uint32_t begin = 0;
    std::size_t count = 0;
  };
  using Ranges = std::map<std::array<std::uint64_t, 3>, Range>;

  void readPrimitive(const GltfValue& value, MeshArrays& arrays, Ranges& ranges, bool normals, bool uvs) {
    if (value["targets"].size() > 0) value["targets"].refuse("morph targets are not supported");
    if (value["extensions"].has("KHR_draco_mesh_compression"))
      value.refuse("compressed meshes are not supported");
    const std::uint64_t mode = value["mode"].integerOr(4);
    if (mode < 4 || mode > 6) {
      if (mode > 6) value["mode"].refuse(fmt::format("{} is no mode", mode));
      warn(value, "points and lines are not drawn");
      return;
    }
    const GltfValue attributes = value["attributes"];
    constexpr std::uint64_t kAbsent = ~std::uint64_t(0);
    const std::array<std::uint64_t, 3> key = {attributes["POSITION"].integer(),
                                              attributes["NORMAL"].integerOr(kAbsent),
                                              attributes[uvsOf(value).c_str()].integerOr(kAbsent)};
    const auto [found, fresh] =
        ranges.try_emplace(key, Range{.begin = std::uint32_t(arrays.positions.size())});
    const std::uint32_t begin = found->second.begin;
    std::size_t& count = found->second.count;
    if (fresh) {
      const std::vector<float> positions = file_.floats(key[0], 3);
      count = positions.size() / 3;
      for (std::size_t i = 0; i < count; ++i)
        arrays.positions.emplace_back(positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]);
      const auto add = [&, wanted = count](std::uint64_t accessor, auto& all) {
        using V = typename std::remove_reference_t<decltype(all)>::value_type;
        if (accessor != kAbsent) {
          const std::vector<float> read = file_.floats(accessor, std::size_t(V::length()));
          if (read.size() / std::size_t(V::length()) != wanted)
            attributes.refuse("attributes of different counts");
          for (std::size_t i = 0; i < read.size(); ++i) {
            const int k = int(i % std::size_t(V::length()));
            if (k == 0) all.emplace_back(0.0f);
            all.back()[k] = read[i];
          }
        }
        all.resize(arrays.positions.size(), V(0));
      };
      if (normals) add(key[1], arrays.normals);
      if (uvs) add(key[2], arrays.uvs);
    }
    std::vector<std::uint32_t> indices;
    if (value.has("indices")) {
      indices = file_.integers(value["indices"].integer());
      for (const std::uint32_t index : indices)
        if (index >= count) value["indices"].refuse(fmt::format("there is vertex {} of {}", index, count));
    } else {
      for (std::uint32_t i = 0; i < count; ++i) indices.push_back(i);
    }
    std::uint32_t material = plainMaterial_;
    if (value.has("material")) {
      material = std::uint32_t(value["material"].integer(plainMaterial_));
    } else if (model_.materials.size() == plainMaterial_) {
      model_.materials.push_back({.name = "default"});
    }
    if (model_.materials[material].hasMaps() && !attributes.has(uvsOf(value).c_str()))
      warn(value, fmt::format("it has no {}, which the maps of its material '{}' need", uvsOf(value),
                              model_.materials[material].name));
    if (!coloured_ && attributes.has("COLOR_0")) {
      coloured_ = true;
      warn(value, "colours of vertices are not read");
    }
    const auto triangle = [&](std::size_t a, std::size_t b, std::size_t c) {
      for (const std::size_t i : {a, b, c}) arrays.indices.push_back(begin + indices[i]);
      arrays.materials.push_back(material);
    };
    if (mode == 4)
      for (std::size_t i = 0; i + 3 <= indices.size(); i += 3) triangle(i, i + 1, i + 2);
    else
      for (std::size_t i = 0; i + 3 <= indices.size(); ++i)
        mode == 6    ? triangle(0, i + 1, i + 2)
        : i % 2 == 0 ? triangle(i, i + 1, i + 2)
                     : triangle(i + 1, i, i + 2);
  }

  void readAnimation() {
    const GltfValue animations = file_.list("animations");
    if (animations.size() > 1) warn(animations, "only the first is read");
    if (animations.size() == 0) return;
    const GltfValue channels = animations[std::size_t(0)]["channels"],
                    samplers = animations[std::size_t(0)]["samplers"];
    for (std::size_t i = 0; i < channels.size(); ++i) {
      const GltfValue target = channels[i]["target"];
      if (!target.has("node")) continue;
      const std::uint32_t number = numberOf_[target["node"].integer(numberOf_.size())];
      const std::string path = target["path"].text();
      if (path == "weights") {
        warn(target, "morph targets are not supported");
        continue;
      }
      if (path != "translation" && path != "rotation" && path != "scale")
        target["path"].refuse("nodes have no such thing");
      Keyframes keys = keyframes(samplers[channels[i]["sampler"].integer()], path == "rotation" ? 4 : 3);
      if (number == kNone) continue;
      ModelNode& node = model_.nodes[number];
      if (file_.list("nodes")[target["node"].integer()].has("matrix"))
        target.refuse("a node with a matrix cannot move");
      model_.duration = std::max(model_.duration, keys.times.back());
      (path == "translation" ? node.translationKeys
       : path == "rotation"  ? node.rotationKeys
                             : node.scaleKeys) = std::move(keys);
    }
  }

  Keyframes keyframes(const GltfValue& sampler, std::size_t components) {
    Keyframes keys;
    const std::string interpolation = sampler["interpolation"].textOr("LINEAR");
    using enum Keyframes::Interpolation;
    if (interpolation == "STEP")
      keys.interpolation = Step;
    else if (interpolation == "CUBICSPLINE")
      keys.interpolation = CubicSpline;
    else if (interpolation != "LINEAR")
      sampler["interpolation"].refuse("it is none of LINEAR, STEP and CUBICSPLINE");
    const std::vector<float> times = file_.floats(sampler["input"].integer(), 1),
                             values = file_.floats(sampler["output"].integer(), components);
    const std::size_t wanted = times.size() * (keys.interpolation == CubicSpline ? 3 : 1);
    if (times.empty() || values.size() != wanted * components)
      sampler.refuse(fmt::format("{} times, and {} values", times.size(), values.size() / components));
    keys.times.assign(times.begin(), times.end());
    for (std::size_t i = 1; i < keys.times.size(); ++i)
      if (!(keys.times[i - 1] < keys.times[i]))
        sampler["input"].refuse(fmt::format("time {} is not after the last", i));
    for (std::size_t i = 0; i < values.size(); i += components)
      keys.values.emplace_back(values[i], values[i + 1], values[i + 2], components == 4 ? values[i + 3] : 0);
    return keys;
  }

  static constexpr std::uint32_t kUnread = kNone - 1;

  const ModelSource& source_;
  GltfFile file_;
  Model model_;
  std::vector<std::uint64_t> uvSets_;    ///< of each material: which uvs its maps use
  std::uint32_t plainMaterial_ = 0;      ///< the number of the material of what has none
  std::vector<std::uint32_t> numberOf_;  ///< of nodes in the model
  std::vector<std::uint32_t> meshNumbers_;
  bool coloured_ = false;
};

}  // namespace

Model readGltf(const ModelSource& source, std::string_view bytes) { return GltfReader(source, bytes).read(); }

}  // namespace luxo
