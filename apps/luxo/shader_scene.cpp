// SPDX-License-Identifier: Apache-2.0
#include "shader_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include "base/error.h"
#include "base/suggestion.h"
#include "draw/course_style.h"
#include "draw/material_program.h"
#include "formula/parse.h"
#include "main_image.h"
#include "mesh/model.h"
#include "open_scene.h"
#include "option_values.h"
#include "scene/model_files.h"
#include "scene/scene_reader.h"
#include "scene/shader_files.h"
#include "shader_values.h"

namespace luxo {
namespace {

namespace fs = std::filesystem;
using Kind = UniformControl::Kind;

// What shows a material best: a ball for its highlights, a ring for what bends the other way and for (u, v).
constexpr const char* kBallAndRing = R"({ "luxo": 1,
  "render": { "background": [0.05, 0.055, 0.06], "ambient": 0.15 },
  "materials": { "shader": { "two_sided": true }, "floor": { "diffuse": [0.16, 0.155, 0.15], "specular": 0.03 } },
  "surfaces": { "ball": { "type": "sphere", "radius": 1 }, "ring": { "type": "torus", "major": 0.95, "minor": 0.36 },
                "floor": { "type": "rectangle", "size": [40, 40] } },
  "nodes": [
    { "name": "ball", "translate": [-1.35, 1, 0], "surface": "ball", "material": "shader" },
    { "name": "ring", "translate": [1.35, 1.26, 0], "rotate": { "axis": [1, 0, 0.25], "angle": "62deg" }, "surface": "ring",
      "material": "shader" },
    { "name": "floor", "surface": "floor", "material": "floor" },
    { "name": "key", "translate": [3, 7, 6], "light": { "type": "point", "intensity": 70, "attenuation": "inverse-square",
      "shadow": "exact" } },
    { "name": "fill", "translate": [-6, 4, 5], "light": { "type": "point", "color": [0.75, 0.85, 1], "intensity": 22,
      "attenuation": "inverse-square" } } ],
  "camera": { "eye": [0, 2.6, 7.5], "look_at": [0, 1.05, 0], "fov_y": "30deg" } })";

// The model takes the place of the sphere.
constexpr const char* kOfModel = R"({ "luxo": 1,
  "render": { "ambient": 0.15 },
  "materials": { "shader": { "two_sided": true } },
  "surfaces": { "model": { "type": "sphere" } },
  "nodes": [
    { "name": "model", "surface": "model", "material": "shader" },
    { "name": "key", "rotate": [ { "axis": [0, 1, 0], "angle": "60deg" }, { "axis": [1, 0, 0], "angle": "-40deg" } ],
      "light": { "type": "directional" } },
    { "name": "fill", "rotate": [ { "axis": [0, 1, 0], "angle": "-30deg" }, { "axis": [1, 0, 0], "angle": "-20deg" } ],
      "light": { "type": "directional", "intensity": 0.4 } } ] })";

/// One of luxo's own, of which no message shows the text.
SceneFile ownScene(const char* text, const std::string& name, const fs::path& folder = {},
                   const FileOptions& files = {}) {
  SceneFile file = parseScene(text, name, folder, files);
  file.source.text.reset();
  return file;
}

SceneFile sceneOf(const std::string& shader, const std::string& scene, const FileOptions& files) {
  if (scene.empty()) return ownScene(kBallAndRing, shader);
  if (namesModel(scene)) {
    SceneFile file = ownScene(kOfModel, scene, fs::path(scene).parent_path(), files);
    file.surfaces.front().shape = MeshShape{.file = fs::path(scene).filename().string()};
    return file;
  }
  std::optional<SceneFile> file = sceneDescription(scene, files);
  if (!file)
    throw Error(ErrorKind::Usage,
                fmt::format("'{}' is made by a program: its materials are not replaced", scene),
                "name a scene file or a model");
  return std::move(*file);
}

/// A shader takes the place of all that colours, but maps, which it may read.
void give(MaterialDesc& material, const FileName& shader, const std::vector<UniformDesc>& uniforms) {
  const MaterialDesc plain;
  for (Quantity& component : material.diffuse)
    if (component.isFormula()) material.diffuse = plain.diffuse;
  if (material.ambient)
    for (const Quantity& component : *material.ambient)
      if (component.isFormula()) {
        material.ambient.reset();
        break;
      }
  material.opacity = plain.opacity;
  material.blend = plain.blend;
  material.lesson = false;
  material.normalMap.reset();
  material.shader = shader;
  material.vertex = {};
  if (material.map) material.map->alpha = false;
  // Textures stay where there are no others.
  std::erase_if(material.uniforms, [&](const UniformDesc& own) {
    return !own.map ||
           std::ranges::any_of(uniforms, [&](const UniformDesc& one) { return one.name == own.name; });
  });
  material.uniforms.insert(material.uniforms.end(), uniforms.begin(), uniforms.end());
}

std::vector<std::string> namesOf(const auto& described) {
  std::vector<std::string> names;
  for (const auto& one : described) names.push_back(one.name.text);
  return names;
}

/// Nodes without a material get one that has it.
void giveToAll(SceneFile& scene, const FileName& shader, const std::vector<UniformDesc>& uniforms) {
  const std::vector<std::string> known = namesOf(scene.materials);
  std::string own = "shader";
  while (std::ranges::find(known, own) != known.end()) own += '_';
  bool needsOwn = false;
  for (NodeDesc& node : scene.nodes)
    if (!node.surface.empty() && node.material.empty()) {
      node.material = own;
      needsOwn = true;
    }
  for (MaterialDesc& material : scene.materials) give(material, shader, uniforms);
  if (!needsOwn) return;
  give(scene.materials.emplace_back(), shader, uniforms);
  scene.materials.back().name = own;
}

void giveToNamed(SceneFile& scene, const std::string& name, const FileName& shader,
                 const std::vector<UniformDesc>& uniforms) {
  const auto named =
      std::ranges::find(scene.materials, name, [](const MaterialDesc& m) { return m.name.text; });
  if (named != scene.materials.end()) return give(*named, shader, uniforms);
  const std::vector<std::string> names = namesOf(scene.materials);
  throw Error(ErrorKind::Usage, fmt::format("--material: the scene has no material '{}'", name),
              names.empty() ? "it has none; leave the option out"
                            : didYouMean(name, names, fmt::format("it has {}", listed(names))));
}

/// Makes parameters of uniforms.
class Parameters {
 public:
  Parameters(ShaderScene& made, std::span<const ParameterValue> given, std::span<const ParameterValue> preset,
             bool ofPicture, bool wrapped, std::vector<std::string>* warnings)
      : made_(made),
        given_(given),
        preset_(preset),
        ofPicture_(ofPicture),
        wrapped_(wrapped),
        warnings_(warnings) {
    for (const std::string& name : namesOf(made.description.parameters)) {
      ofScene_.insert(name);
      taken_.insert(name);
    }
    for (const char* variable : {"t", "u", "v"}) taken_.insert(variable);
  }

  void add(const UniformControl& uniform) {
    names_.push_back(uniform.name);
    if (uniform.numbers == 1 && ofScene_.contains(uniform.name)) {
      uniforms_.push_back({uniform.name, {Quantity(uniform.name)}});
      return;
    }
    const ParameterValue* value = valueOf(uniform.name);
    if (value) used_.insert(uniform.name);
    if (!uniform.active) return warnOf(value);
    if (uniform.type == "sampler2D" && uniform.kind == Kind::None) {
      if (value) addTexture(uniform.name, value->value);
      return;
    }
    if (!value && takesTime(uniform)) return;
    if (value || uniform.kind != Kind::None) addParameters(uniform, value);
  }

  /// What else is given is of the scene's own parameters. What a preset has left of another time is no error.
  [[nodiscard]] std::vector<UniformDesc> finish(const std::string& shader) {
    for (const ParameterValue& value : given_) {
      if (used_.contains(value.name)) continue;
      if (ofScene_.contains(value.name)) {
        made_.parameters.push_back(value);
        continue;
      }
      names_.insert(names_.end(), ofScene_.begin(), ofScene_.end());
      throw Error(
          ErrorKind::Usage, fmt::format("-P: the shader '{}' has no uniform '{}'", shader, value.name),
          names_.empty() ? "it has none"
                         : didYouMean(value.name, names_, fmt::format("there are {}", listed(names_))));
    }
    for (const ParameterValue& value : preset_)
      if (warnings_ && !used_.contains(value.name))
        warnings_->push_back(fmt::format(
            "the preset has a value for '{}', which the shader '{}' does not take", value.name, shader));
    return std::move(uniforms_);
  }

 private:
  [[nodiscard]] const ParameterValue* valueOf(const std::string& name) const {
    for (const std::span<const ParameterValue> values : {given_, preset_})
      if (const auto value = std::ranges::find(values, name, &ParameterValue::name); value != values.end())
        return &*value;
    return nullptr;
  }

  void warnOf(const ParameterValue* value) const {
    if (value && warnings_)
      warnings_->push_back(
          fmt::format("-P {}: nothing in the shader uses the uniform '{}'", value->name, value->name));
  }

  bool takesTime(const UniformControl& uniform) {
    std::string_view formulas = wrapped_ ? mainImageFormulas(uniform.name) : std::string_view();
    if (uniform.name == "time" && uniform.type == "float" && uniform.kind == Kind::Plain) formulas = "t";
    if (formulas.empty()) return false;
    UniformDesc& desc = uniforms_.emplace_back(UniformDesc{uniform.name});
    while (true) {
      const std::size_t end = std::min(formulas.find(';'), formulas.size());
      desc.values.emplace_back(std::string(formulas.substr(0, end)));
      if (end == formulas.size()) return true;
      formulas.remove_prefix(end + 1);
    }
  }

  /// One of the scene's, or an image file beside it.
  void addTexture(const std::string& uniform, const std::string& texture) {
    const std::vector<std::string> known = namesOf(made_.description.textures);
    if (std::ranges::find(known, texture) == known.end())
      made_.description.textures.push_back({.name = texture, .file = texture});
    uniforms_.push_back({.name = uniform, .map = MapDesc{.texture = texture}});
  }

  std::string freeName(std::string name) {
    while (Scope().nameProblem(name) || !taken_.insert(name).second) name += '_';
    return name;
  }

  void addParameters(const UniformControl& uniform, const ParameterValue* value) {
    const std::vector<std::string> texts =
        value ? componentTexts(uniform, value->value, ofPicture_) : std::vector<std::string>();
    if (value && isOfPreset(*value)) requireInRange(uniform, *value, texts);
    UniformDesc& desc = uniforms_.emplace_back(UniformDesc{uniform.name});
    ParameterControl control{.label = uniform.name, .choices = uniform.choices, .encoded = ofPicture_};
    control.kind = uniform.kind == Kind::Color    ? ParameterControl::Kind::Color
                   : uniform.kind == Kind::Choice ? ParameterControl::Kind::Choice
                   : uniform.kind == Kind::Switch ? ParameterControl::Kind::Switch
                                                  : ParameterControl::Kind::Slider;
    for (std::size_t i = 0; i < uniform.numbers; ++i) {
      const std::string suffix = componentSuffix(uniform, i), name = freeName(uniform.name + suffix);
      ParameterDesc parameter{.name = name, .label = uniform.name + suffix};
      if (!uniform.initial.empty()) parameter.value = uniform.initial[i];
      if (uniform.range) parameter.range = QuantityPair{uniform.range->lo, uniform.range->hi};
      if (uniform.step) parameter.step = *uniform.step;
      made_.description.parameters.push_back(std::move(parameter));
      desc.values.emplace_back(name);
      control.parameters.push_back(name);
      if (value) made_.parameters.push_back({name, texts[i]});
    }
    if (ofPicture_ && uniform.name == "iMouse") {
      made_.mouse = std::move(control.parameters);
      return;
    }
    if (uniform.kind == Kind::None) return;
    control.range = uniform.range.value_or(reachOf(uniform));
    made_.controls.push_back(std::move(control));
  }

  [[nodiscard]] bool isOfPreset(const ParameterValue& value) const {
    return std::ranges::any_of(preset_, [&](const ParameterValue& one) { return &one == &value; });
  }

  static void requireInRange(const UniformControl& uniform, const ParameterValue& value,
                             const std::vector<std::string>& texts) {
    for (const std::string& one : texts)
      if (const auto number = finiteNumber(one); number && uniform.range && !uniform.range->contains(*number))
        throw Error(ErrorKind::Scene,
                    fmt::format("the preset's '{}' is {}, outside its range from {} to {}", value.name, one,
                                uniform.range->lo, uniform.range->hi),
                    "the comment at the uniform says the range");
  }

  /// Of numbers that nothing limits: from 0 to 1, or to twice what they are.
  static Interval reachOf(const UniformControl& uniform) {
    if (uniform.kind == Kind::Color) return {0, 1};
    Interval reach{0, 1};
    for (const double number : uniform.initial) {
      reach.lo = std::min(reach.lo, 2 * number);
      reach.hi = std::max(reach.hi, number > 1 ? 2 * number : 1);
    }
    return reach;
  }

  ShaderScene& made_;
  std::span<const ParameterValue> given_, preset_;
  bool ofPicture_, wrapped_;  ///< a picture's; given what mainImage is
  std::vector<std::string>* warnings_;
  std::set<std::string> ofScene_, taken_, used_;
  std::vector<std::string> names_;  ///< of uniforms
  std::vector<UniformDesc> uniforms_;
};

}  // namespace

bool namesMaterialShader(const std::string& path) {
  const std::string suffix = fs::path(path).extension().string();
  return suffix == ".frag" || suffix == ".glsl" || suffix == ".vert";
}

MaterialShaderPtr shaderInFile(const fs::path& file) {
  ShaderFiles files(file.parent_path());
  if (file.extension() == ".vert") {
    const fs::path fragment = fs::path(file).replace_extension(".frag");
    return files.get(fs::exists(fragment) ? fragment.filename().string() : "", file.filename().string());
  }
  MaterialShaderPtr shader = files.get(file.filename().string());
  const fs::path vertex = fs::path(file).replace_extension(".vert");
  return vertex != file && fs::exists(vertex) && inCourseStyle(*shader)
             ? files.get(file.filename().string(), vertex.filename().string())
             : shader;
}

std::vector<fs::path> programsOf(const fs::path& file) {
  std::vector<fs::path> programs{file};
  if (file.extension() == ".frag") programs.push_back(fs::path(file).replace_extension(".vert"));
  if (file.extension() == ".vert") programs.push_back(fs::path(file).replace_extension(".frag"));
  return programs;
}

SceneFile sceneOfShader(const ShaderUse& use, const FileOptions& files) {
  return sceneOf("the scene of a shader", use.scene, files);
}

ShaderScene shaderScene(const std::string& shader, const ShaderUse& use,
                        std::span<const ParameterValue> given, std::vector<std::string>* warnings,
                        const FileOptions& files) {
  MaterialShaderPtr text = openMaterialShader(shader);
  ShaderScene made;
  for (const MaterialShader::File& file : text->files)
    if (file.name != kFixedFragments.name) made.files.emplace_back(file.name);
  const bool ofPicture = use.mainImage || (hasMainImage(*text) && !hasMaterial(*text));
  if (ofPicture && !(use.scene.empty() && use.material.empty()))
    throw Error(ErrorKind::Usage,
                fmt::format("'{}' fills the picture by itself: there is no scene beside it", shader),
                "leave the scene out, or write a function 'vec4 material(Point p)' (shaders/MATERIALS.md)");
  text = ofPicture ? materialOfMainImage(text) : materialBesideMainImage(text);
  const MaterialProgram program(text);
  made.description = ofPicture ? ownScene(kMainImageScene, shader) : sceneOf(shader, use.scene, files);
  Parameters parameters(made, given, use.preset, ofPicture, text->wrapped, warnings);
  for (const UniformControl& uniform : uniformControls(*text, program.uniforms(), warnings))
    parameters.add(uniform);
  const std::vector<UniformDesc> uniforms = parameters.finish(shader);

  // No file of a scene has that name.
  const FileName name = fmt::format("/{}", text->files.front().name);
  SceneSource& source = made.description.source;
  if (!source.shaders) source.shaders = std::make_shared<ShaderFiles>();
  source.shaders->put(name.text, text);
  if (use.scene.empty())
    giveToNamed(made.description, "shader", name, uniforms);
  else if (use.material.empty())
    giveToAll(made.description, name, uniforms);
  else
    giveToNamed(made.description, use.material, name, uniforms);
  return made;
}

}  // namespace luxo
