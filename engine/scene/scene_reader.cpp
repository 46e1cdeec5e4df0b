// SPDX-License-Identifier: Apache-2.0
#include "scene/scene_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <istream>
#include <memory>
#include <set>
#include <system_error>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/suggestion.h"
#include "formula/parse.h"
#include "scene/isolines_reader.h"
#include "scene/json.h"
#include "scene/model_files.h"
#include "scene/scene_construction.h"
#include "scene/scene_members.h"
#include "scene/shader_files.h"
#include "scene/shape_reader.h"
#include "scene/texture_files.h"

namespace luxo {
namespace {

constexpr double kVersion = 1;

/// Walks a document; what it cannot read is reported and left at its default.
class SceneReader {
 public:
  SceneReader(SceneFile& file, SceneProblems& problems)
      : file_(file), problems_(problems), values_(problems) {}

  void readRoot(const JsonValue& root);

 private:
  void readVersion(const JsonValue& version);
  void readRender(const JsonValue& render);
  void readParameter(const JsonValue& value, const FileName& name);
  void readTexture(const JsonValue& value, const FileName& name);
  void readMaterial(const JsonValue& value, const FileName& name);
  void readTextureMap(const JsonValue& value, MapDesc& map);
  void readColorMap(const JsonValue& value, MapDesc& map);
  void readNormalMap(const JsonValue& value, NormalMapDesc& map);
  void readPlacedTexture(const SceneMembers& members, MapDesc& map);
  void readNodes(const JsonValue& nodes, std::uint32_t parent);
  void readNode(const JsonValue& value, std::uint32_t parent);
  bool takesNode(const JsonValue& value);
  void readName(const JsonValue& name, NodeDesc& node);
  void readRotations(const JsonValue& rotate, std::vector<RotationDesc>& rotations);
  void readRotation(const JsonValue& rotate, RotationDesc& rotation);
  void rejectRotations(const JsonValue& rotate);
  void readScale(const JsonValue& scale, Quantity3& target);
  /// The name of something that stands in `section`.
  void readReference(const JsonValue& value, std::string_view section, FileName& target);
  void readColor(const JsonValue& value, Quantity3& target);
  void readUniforms(const JsonValue& value, std::vector<UniformDesc>& uniforms);
  void readVisible(const JsonValue& visible, Quantity& target);
  void readLight(const JsonValue& value, LightDesc& light);
  void readSpot(const JsonValue& value, LightDesc& light);
  void readMap(const JsonValue& value, ShadowMapDesc& map);
  void readOcclusion(const JsonValue& value, OcclusionDesc& occlusion);
  void readCasters(const JsonValue& value, std::optional<std::vector<FileName>>& casters);
  CameraDesc readCamera(const JsonValue& value, const FileName& name);
  /// Calls read(member, name) for every member of an object of named things.
  template <class Read>
  void readNamed(const JsonValue& object, const Read& read);

  SceneFile& file_;
  SceneProblems& problems_;
  SceneValues values_;
  std::unordered_map<std::string, FilePlace> nodeNames_;
  std::set<std::string> parameterNames_;
};

template <class Read>
void SceneReader::readNamed(const JsonValue& object, const Read& read) {
  if (!object.exists()) return;
  if (object.kind() != JsonKind::Object) {
    values_.reject(object, "an object of names and what they stand for");
    return;
  }
  std::unordered_set<std::string> seen;
  for (JsonValue member = object.first(); member.exists(); member = member.next()) {
    const FileName name(member.key(), placeOf(member.keyWhere()));
    if (name.empty()) problems_.add(name.place, "a name is empty");
    const bool fresh = seen.insert(name.text).second;  // JsonDocument reports those that are not
    if (fresh && !name.empty() && !name.text.starts_with("x-")) read(member, name);
  }
}

void SceneReader::readRoot(const JsonValue& root) {
  const SceneMembers members(root, keys::kRoot, problems_);
  readVersion(members["luxo"]);
  std::string schema;
  values_.read(members["$schema"], schema);
  readNamed(members["params"], [&](const JsonValue& v, const FileName& name) { readParameter(v, name); });
  readRender(members["render"]);  // its colours and those of materials may name parameters
  readNamed(members["textures"], [&](const JsonValue& v, const FileName& name) { readTexture(v, name); });
  readNamed(members["materials"], [&](const JsonValue& v, const FileName& name) { readMaterial(v, name); });
  readNamed(members["surfaces"], [&](const JsonValue& v, const FileName& name) {
    file_.surfaces.push_back(readSurface(v, name, problems_));
  });
  readNodes(members["nodes"], kNoParent);
  if (members["camera"].exists()) file_.camera = readCamera(members["camera"], "camera");
  readNamed(members["cameras"],
            [&](const JsonValue& v, const FileName& name) { file_.cameras.push_back(readCamera(v, name)); });
}

void SceneReader::readVersion(const JsonValue& version) {
  if (!version.exists()) return;
  if (version.kind() != JsonKind::Number) {
    values_.reject(version, "the version of the format", "write \"luxo\": 1");
  } else if (version.number() != kVersion) {
    problems_.add(version.where(), fmt::format("this luxo reads version {} of the format, not {}", kVersion,
                                               version.number()));
  }
}

void SceneReader::readRender(const JsonValue& render) {
  if (!render.exists()) return;
  const SceneMembers members(render, keys::kRender, problems_);
  RenderDesc& target = file_.render;
  values_.read(members["size"], target.size);
  values_.read(members["time"], target.time);
  values_.read(members["fps"], target.fps);
  values_.read(members["samples"], target.samples);
  values_.read(members["tolerance"], target.tolerance);
  values_.readWord(members["shading"], kShadingNames, target.shading);
  values_.read(members["hidden_lines"], target.hiddenLines);
  values_.readWord(members["blend_order"], keys::kBlendOrders, target.blendOrder);
  readColor(members["background"], target.background);
  readColor(members["ambient"], target.ambient);
  readOcclusion(members["ambient_occlusion"], target.ambientOcclusion);
}

void SceneReader::readOcclusion(const JsonValue& value, OcclusionDesc& occlusion) {
  if (!value.exists()) return;
  occlusion.radius = 1;
  const SceneMembers members(value, keys::kOcclusion, problems_);
  values_.readWord(members["method"], keys::kOcclusionMethods, occlusion.method);
  values_.read(members["radius"], occlusion.radius);
}

void SceneReader::readParameter(const JsonValue& value, const FileName& name) {
  if (file_.parameters.size() >= kMaxSceneParameters) {
    problems_.add(name.place, fmt::format("the scene has more than {} parameters", kMaxSceneParameters));
    return;
  }
  parameterNames_.insert(name.text);
  ParameterDesc parameter{.name = name};
  if (value.kind() == JsonKind::Object) {
    const SceneMembers members(value, keys::kParameter, problems_);
    values_.read(members["value"], parameter.value);
    values_.read(members["range"], parameter.range);
    values_.read(members["step"], parameter.step);
    values_.read(members["label"], parameter.label);
  } else if (value.kind() == JsonKind::Number || value.kind() == JsonKind::String) {
    values_.read(value, parameter.value);
  } else {
    values_.reject(value, "a number, a formula, or an object with \"value\" and \"range\"");
  }
  file_.parameters.push_back(std::move(parameter));
}

void SceneReader::readTexture(const JsonValue& value, const FileName& name) {
  const SceneMembers members(value, keys::kTexture, problems_);
  TextureDesc texture{.name = name};
  values_.read(members["file"], texture.file);
  if (const JsonValue checker = members["checker"]; checker.exists()) {
    if (checker.kind() == JsonKind::Array && checker.size() == 2) {
      auto& colors = texture.checker.emplace();
      readColor(checker.first(), colors[0]);
      readColor(checker.first().next(), colors[1]);
    } else {
      values_.reject(checker, "an array of 2 colours");
    }
  }
  values_.read(members["squares"], texture.squares);
  if (members["color"].exists()) readColor(members["color"], texture.color.emplace());
  values_.readWord(members["wrap"], keys::kWraps, texture.wrap);
  values_.readWord(members["filter"], keys::kFilters, texture.filter);
  values_.read(members["anisotropy"], texture.anisotropy);
  values_.read(members["data"], texture.data);
  const int kinds = members["file"].exists() + members["checker"].exists() + members["color"].exists();
  if (value.kind() == JsonKind::Object && kinds != 1)
    problems_.add(kinds == 0 ? placeOf(value.where()) : name.place,
                  kinds == 0 ? "a texture needs an image" : "a texture has one image",
                  "write \"file\", \"checker\" or \"color\"");
  file_.textures.push_back(std::move(texture));
}

/// A name, or an object with a name.
void SceneReader::readTextureMap(const JsonValue& value, MapDesc& map) {
  if (value.kind() == JsonKind::String) {
    values_.read(value, map.texture);
    return;
  }
  readPlacedTexture(SceneMembers(value, keys::kTextureMap, problems_), map);
}

/// The same; its alpha may count.
void SceneReader::readColorMap(const JsonValue& value, MapDesc& map) {
  if (value.kind() == JsonKind::String) {
    values_.read(value, map.texture);
    return;
  }
  const SceneMembers members(value, keys::kColorMap, problems_);
  readPlacedTexture(members, map);
  values_.read(members["alpha"], map.alpha);
}

void SceneReader::readNormalMap(const JsonValue& value, NormalMapDesc& map) {
  if (value.kind() == JsonKind::String) {
    values_.read(value, map.map.texture);
    return;
  }
  const SceneMembers members(value, keys::kNormalMap, problems_);
  readPlacedTexture(members, map.map);
  values_.readWord(members["space"], keys::kNormalSpaces, map.space);
}

void SceneReader::readPlacedTexture(const SceneMembers& members, MapDesc& map) {
  values_.read(members["texture"], map.texture);
  values_.read(members["offset"], map.offset);
  values_.read(members["scale"], map.scale);
  values_.read(members["rotate"], map.rotate);
}

void SceneReader::readMaterial(const JsonValue& value, const FileName& name) {
  const SceneMembers members(value, keys::kMaterial, problems_);
  MaterialDesc material{.name = name};
  if (members["map"].exists()) {
    readColorMap(members["map"], material.map.emplace());
    material.diffuse = repeated(1);  // times what the texture says
  }
  if (members["normal_map"].exists()) readNormalMap(members["normal_map"], material.normalMap.emplace());
  if (members["specular_map"].exists()) {
    readTextureMap(members["specular_map"], material.specularMap.emplace());
    material.specular = repeated(1);
  }
  if (members["glow_map"].exists()) readTextureMap(members["glow_map"], material.glowMap.emplace());
  readColor(members["diffuse"], material.diffuse);
  if (members["ambient"].exists()) readColor(members["ambient"], material.ambient.emplace());
  readColor(members["specular"], material.specular);
  values_.read(members["shininess"], material.shininess);
  values_.read(members["opacity"], material.opacity);
  values_.read(members["cutoff"], material.cutoff);
  values_.read(members["displacement"], material.displacement);
  values_.readWord(members["blend"], keys::kBlends, material.blend);
  if (const JsonValue sides = members["two_sided"]; sides.exists()) {
    bool both = false;
    if (sides.isBoolean()) {
      values_.read(sides, both);
      material.twoSided = both ? TwoSided::Yes : TwoSided::No;
    } else if (sides.kind() != JsonKind::String || sides.string() != "auto") {
      problems_.add(sides.where(), "expected true, false or \"auto\"");
    }
  }
  if (std::size_t word = 0; members["shading"].exists()) {
    values_.readWord(members["shading"], keys::kMaterialShadings, word);
    material.lesson = word == kShadingNames.size();
    if (!material.lesson) material.shading = static_cast<Shading>(word);
  }
  values_.read(members["lecture_specular"], material.lectureSpecular);
  values_.read(members["let"], material.let);
  if (members["isolines"].exists()) readIsolines(members["isolines"], problems_, material.isolines);
  values_.read(members["shader"], material.shader);
  values_.read(members["vertex"], material.vertex);
  if (const JsonValue uniforms = members["uniforms"]; uniforms.exists()) {
    if (!material.hasShader())
      problems_.add(uniforms.where(), "there are uniforms and no shader", "name its file as \"shader\"");
    readUniforms(uniforms, material.uniforms);
  }
  file_.materials.push_back(std::move(material));
}

void SceneReader::readUniforms(const JsonValue& value, std::vector<UniformDesc>& uniforms) {
  readNamed(value, [&](const JsonValue& v, const FileName& name) {
    UniformDesc uniform{.name = name, .place = placeOf(v.where())};
    std::size_t truths = 0;
    const auto add = [&](const auto& self, const JsonValue& one) -> void {
      if (one.kind() == JsonKind::Array) {
        for (JsonValue item = one.first(); item.exists(); item = item.next()) self(self, item);
      } else if (one.isBoolean()) {
        bool truth = false;
        values_.read(one, truth);
        ++truths;
        uniform.values.emplace_back(truth ? 1 : 0, placeOf(one.where()));
      } else if (one.kind() == JsonKind::String && one.string().starts_with('#')) {
        Quantity3 color;
        if (values_.readColor(one, color))
          uniform.values.insert(uniform.values.end(), color.begin(), color.end());
      } else {
        values_.read(one, uniform.values.emplace_back());
      }
    };
    if (v.kind() == JsonKind::Object)
      readTextureMap(v, uniform.map.emplace());
    else
      add(add, v);
    uniform.truth = truths > 0;
    if (uniform.truth && truths < uniform.values.size()) values_.reject(v, "true and false, or numbers");
    uniforms.push_back(std::move(uniform));
  });
}

void SceneReader::readNodes(const JsonValue& nodes, std::uint32_t parent) {
  if (!nodes.exists()) return;
  if (nodes.kind() != JsonKind::Array) {
    values_.reject(nodes, "an array of nodes");
    return;
  }
  for (JsonValue node = nodes.first(); node.exists(); node = node.next()) readNode(node, parent);
}

bool SceneReader::takesNode(const JsonValue& value) {
  if (value.kind() != JsonKind::Object) {
    const SceneMembers rejected(value, keys::kNode, problems_);
    return false;
  }
  if (file_.nodes.size() < kMaxSceneNodes) return true;
  problems_.add(value.where(), fmt::format("the scene has more than {} nodes", kMaxSceneNodes));
  return false;
}

// Recursive: nodes are nested at most half as deep as JSON values may be.
void SceneReader::readNode(const JsonValue& value, std::uint32_t parent) {
  if (!takesNode(value)) return;
  const SceneMembers members(value, keys::kNode, problems_);
  const auto index = static_cast<std::uint32_t>(file_.nodes.size());
  NodeDesc& node = file_.nodes.emplace_back();
  const std::size_t begin = value.where().begin;
  node.place = placeOf({begin, begin + 1});
  node.parent = parent;
  readName(members["name"], node);
  values_.read(members["translate"], node.translate);
  readRotations(members["rotate"], node.rotate);
  readScale(members["scale"], node.scale);
  readVisible(members["visible"], node.visible);
  readReference(members["surface"], "surfaces", node.surface);
  readReference(members["material"], "materials", node.material);
  values_.read(members["model"], node.model);
  if (!node.model.empty() && !(node.surface.empty() && node.material.empty()))
    problems_.add(node.model.place, "a node has a model, or a surface with its material",
                  "give the model, or the surface, a node of its own, as one of \"children\"");
  if (members["light"].exists()) readLight(members["light"], node.light.emplace());
  readNodes(members["children"], index);  // moves `node`
}

void SceneReader::readName(const JsonValue& name, NodeDesc& node) {
  if (!name.exists() || !values_.read(name, node.name)) return;
  const auto [first, fresh] = nodeNames_.emplace(node.name.text, node.name.place);
  if (!fresh)
    problems_.add(
        node.name.place, fmt::format("two nodes have the name '{}'", node.name.text),
        fmt::format("the first one is in line {}", positionAt(*file_.source.text, first->second.begin).line));
}

void SceneReader::readReference(const JsonValue& value, std::string_view section, FileName& target) {
  if (value.exists() && value.kind() == JsonKind::Object)
    values_.reject(value, "a name", fmt::format("define it in \"{}\" and write its name here", section));
  else
    values_.read(value, target);
}

void SceneReader::readScale(const JsonValue& scale, Quantity3& target) {
  if (scale.exists() && scale.kind() == JsonKind::Number)
    values_.reject(scale, "an array of 3 numbers", fmt::format("write [{0}, {0}, {0}]", scale.number()));
  else
    values_.read(scale, target);
}

/// Whether a word means nothing in a formula, unless a parameter has this name.
bool isUnknownWord(const std::string& word) {
  constexpr std::array<std::string_view, 3> kVariables = {"t", "u", "v"};
  // A scope takes any name that has no meaning yet.
  return std::ranges::find(kVariables, word) == kVariables.end() && !Scope().nameProblem(word);
}

void SceneReader::readColor(const JsonValue& value, Quantity3& target) {
  const std::string word = value.exists() && value.kind() == JsonKind::String ? value.string() : "";
  if (word.empty() || parameterNames_.contains(word) || problems_.full() || !isUnknownWord(word)) {
    values_.readColor(value, target);
    return;
  }
  constexpr std::size_t kMaxToCompare = 100;
  std::vector<std::string> names;
  if (parameterNames_.size() <= kMaxToCompare) names.assign(parameterNames_.begin(), parameterNames_.end());
  problems_.add(value.where(), fmt::format("'{}' is no colour and no parameter", word),
                didYouMean(word, names, R"(write a colour as "#rrggbb" or [r, g, b])"));
}

void SceneReader::readRotations(const JsonValue& rotate, std::vector<RotationDesc>& rotations) {
  if (!rotate.exists()) return;
  if (rotate.kind() == JsonKind::Object) return readRotation(rotate, rotations.emplace_back());
  bool good = rotate.kind() == JsonKind::Array;
  for (JsonValue element = rotate.first(); good && element.exists(); element = element.next())
    good = element.kind() == JsonKind::Object;
  if (!good) return rejectRotations(rotate);
  for (JsonValue element = rotate.first(); element.exists(); element = element.next())
    readRotation(element, rotations.emplace_back());
}

void SceneReader::rejectRotations(const JsonValue& rotate) {
  // [0, 90, 0] can only mean one thing; turns about several axes would need an order.
  std::vector<double> angles;
  for (JsonValue element = rotate.first(); element.exists(); element = element.next())
    angles.push_back(element.kind() == JsonKind::Number ? element.number() : 0);
  if (angles.size() != 3 || std::ranges::count(angles, 0.0) != 2) angles = {0, 90, 0};
  const double angle = *std::ranges::find_if(angles, [](double a) { return a != 0; });
  const std::string written =
      std::abs(angle) > kTau ? fmt::format("\"{}deg\"", angle) : fmt::format("{}", angle);
  const auto axis = [&](std::size_t i) { return angles[i] == 0 ? 0 : 1; };
  values_.reject(
      rotate, "an axis and an angle",
      fmt::format(R"(write {{ "axis": [{}, {}, {}], "angle": {} }})", axis(0), axis(1), axis(2), written));
}

void SceneReader::readRotation(const JsonValue& value, RotationDesc& rotation) {
  const SceneMembers members(value, keys::kRotation, problems_);
  rotation.place = placeOf(value.where());
  values_.read(members["axis"], rotation.axis);
  values_.read(members["angle"], rotation.angle);
}

void SceneReader::readVisible(const JsonValue& visible, Quantity& target) {
  if (!visible.exists() || !visible.isBoolean()) {
    values_.read(visible, target);
    return;
  }
  bool shown = true;
  values_.read(visible, shown);
  target = Quantity(shown, placeOf(visible.where()));
}

void SceneReader::readLight(const JsonValue& value, LightDesc& light) {
  const SceneMembers members(value, keys::kLight, problems_);
  if (const JsonValue type = members["type"];
      type.exists() && type.kind() == JsonKind::String && type.string() == "spot")
    problems_.add(
        type.where(), "unknown word 'spot'",
        "a spot is a point light with a cone: write \"type\": \"point\", \"spot\": { \"outer\": \"30deg\" }");
  else
    values_.readWord(type, keys::kLightTypes, light.type);
  readColor(members["color"], light.color);
  values_.read(members["intensity"], light.intensity);
  values_.readWord(members["attenuation"], keys::kAttenuations, light.attenuation);
  readSpot(members["spot"], light);
  values_.readWord(members["shadow"], keys::kShadows, light.shadow);
  values_.read(members["radius"], light.radius);
  values_.read(members["shadow_samples"], light.shadowSamples);
  readMap(members["map"], light.map);
  values_.read(members["shadow_plane"], light.shadowPlane);
  if (light.shadow == Light::Shadow::Planar && light.shadowPlane.empty())
    problems_.add(members["shadow"].where(), "a planar shadow needs a plane to fall on",
                  "write \"shadow_plane\": and the name of a flat node");
  readCasters(members["casters"], light.casters);
}

void SceneReader::readSpot(const JsonValue& value, LightDesc& light) {
  if (!value.exists()) return;
  const SceneMembers members(value, keys::kSpot, problems_);
  SpotDesc& spot = light.spot.emplace();
  spot.place = placeOf(value.where());
  values_.read(members["inner"], spot.inner);
  values_.read(members["outer"], spot.outer);
  if (light.type != Light::Type::Directional) return;
  light.spot.reset();
  problems_.add(value.where(), "a directional light has no cone",
                "write \"type\": \"point\": a spot shines from its node's origin along its -Z; or leave "
                "\"spot\" out");
}

void SceneReader::readMap(const JsonValue& value, ShadowMapDesc& map) {
  if (!value.exists()) return;
  const SceneMembers members(value, keys::kMap, problems_);
  map.place = placeOf(value.where());
  values_.read(members["size"], map.size);
  values_.read(members["bias"], map.bias);
  values_.read(members["slope_bias"], map.slopeBias);
  values_.read(members["normal_offset"], map.normalOffset);
  values_.read(members["pcf"], map.pcf);
  values_.read(members["receiver_plane"], map.receiverPlane);
}

void SceneReader::readCasters(const JsonValue& value, std::optional<std::vector<FileName>>& casters) {
  if (!value.exists()) return;
  if (value.kind() == JsonKind::String && value.string() == "all") return;
  if (value.kind() != JsonKind::Array) {
    values_.reject(value, "\"all\" or an array of node names");
    return;
  }
  casters.emplace();
  for (JsonValue element = value.first(); element.exists(); element = element.next())
    values_.read(element, casters->emplace_back());
}

CameraDesc SceneReader::readCamera(const JsonValue& value, const FileName& name) {
  const SceneMembers members(value, keys::kCamera, problems_);
  CameraDesc camera{.name = name};
  values_.read(members["eye"], camera.eye);
  values_.read(members["look_at"], camera.lookAt);
  values_.read(members["up"], camera.up);
  values_.read(members["fov_y"], camera.fovY);
  values_.read(members["near"], camera.near);
  values_.readWord(members["type"], keys::kProjections, camera.projection);
  values_.read(members["height"], camera.height);
  return camera;
}

/// All of a stream, in chunks; up to the limit and one chunk more, which the parser then refuses.
std::string textIn(std::istream& stream, std::size_t chunk) {
  std::string text;
  while (stream && text.size() <= kMaxJsonBytes) {
    const std::size_t before = text.size();
    text.resize(before + chunk);
    stream.read(text.data() + before, static_cast<std::streamsize>(chunk));
    text.resize(before + static_cast<std::size_t>(stream.gcount()));
  }
  return text;
}

std::string readText(const std::filesystem::path& path) {
  const auto reject = [&](const std::string& why, std::string hint = {}) {
    throw Error(ErrorKind::Scene, fmt::format("cannot read the scene file '{}': {}", path.string(), why),
                std::move(hint));
  };
  std::error_code failure;
  const auto status = std::filesystem::status(path, failure);
  if (status.type() == std::filesystem::file_type::not_found) reject("there is no such file");
  if (failure) reject(failure.message());
  if (std::filesystem::is_directory(status)) reject("it is a directory", "name a file in it");
  // Devices have no end, and pipes none before somebody closes them.
  if (!std::filesystem::is_regular_file(status))
    reject("it is no regular file", "write - to read a scene from standard input");
  std::ifstream stream(path, std::ios::binary);
  if (!stream) reject(std::strerror(errno));
  const std::uintmax_t size = std::filesystem::file_size(path, failure);
  if (failure) reject(failure.message());
  if (size > kMaxJsonBytes) reject(fmt::format("it has {} bytes; at most {} are read", size, kMaxJsonBytes));
  const std::string text = textIn(stream, static_cast<std::size_t>(size) + 1);  // so that the end is seen
  if (stream.bad()) reject(std::strerror(errno));
  return text;
}

}  // namespace

SceneFile parseScene(std::string text, std::string name, const std::filesystem::path& folder,
                     const FileOptions& files) {
  SceneFile file;
  file.source = {name, std::make_shared<const std::string>(std::move(text)),
                 std::make_shared<ModelFiles>(folder, files), std::make_shared<TextureFiles>(folder, files),
                 std::make_shared<ShaderFiles>(folder, files.from)};
  SceneProblems problems(file.source);
  {
    const JsonDocument document(file.source.text);
    for (const Diagnostic& slip : document.diagnostics()) problems.add(slip.where, slip.message, slip.hint);
    if (document.complete()) SceneReader(file, problems).readRoot(document.root());
  }
  if (problems.any()) {
    static_cast<void>(constructScene(file, {}, problems, nullptr));  // for what is wrong in its formulas
    problems.raise();
  }
  return file;
}

SceneFile readScene(std::istream& stream, std::string name) {
  return parseScene(textIn(stream, std::size_t{1} << 16), std::move(name));
}

SceneFile readSceneFile(const std::filesystem::path& path, const FileOptions& files) {
  return parseScene(readText(path), path.string(), path.parent_path(), files);
}

}  // namespace luxo
