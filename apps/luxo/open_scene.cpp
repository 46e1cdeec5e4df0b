// SPDX-License-Identifier: Apache-2.0
#include "open_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <memory>
#include <optional>
#include <string_view>

#include "base/diagnostic.h"
#include "base/error.h"
#include "base/suggestion.h"
#include "interruption.h"
#include "mesh/model.h"
#include "progress_bar.h"
#include "scene/model_files.h"
#include "scene/model_scene.h"
#include "scene/scene_builder.h"
#include "scene/scene_reader.h"
#include "scene/shader_files.h"
#include "scene/texture_files.h"
#include "scene_request.h"
#include "scenes/embedded_scenes.h"
#include "scenes/gallery.h"
#include "scenes/primitives.h"
#include "shader_inspection.h"
#include "shader_scene.h"

namespace luxo {
namespace {

using Names = std::vector<std::string>;

constexpr const char* kPrimitives = "primitives";  // in C++
constexpr const char* kGallery = "gallery";
constexpr const char* kStandardInput = "-";

const EmbeddedScene* sceneNamed(std::string_view name, std::span<const EmbeddedScene> scenes) {
  const auto found = std::ranges::find(scenes, name, &EmbeddedScene::name);
  return found == scenes.end() ? nullptr : &*found;
}

Names builtinNames() {
  Names names;
  for (const BuiltinScene& scene : builtinScenes()) names.push_back(scene.name);
  return names;
}

/// The first sentence of the first comment, which may go on over lines.
std::string summaryOf(std::string_view text) {
  constexpr std::string_view kComment = "// ";
  std::string summary;
  for (std::size_t at = text.find(kComment); at != std::string_view::npos;) {
    const std::string_view line = text.substr(at + kComment.size());
    const std::size_t end = std::min(line.find('\n'), line.size());
    if (!summary.empty()) summary += ' ';
    summary.append(line.substr(0, end));
    const std::size_t next = line.find_first_not_of(" \n", end);
    const bool goesOn = next != std::string_view::npos && line.substr(next).starts_with(kComment);
    at = goesOn ? at + kComment.size() + next : std::string_view::npos;
  }
  if (const std::size_t sentence = summary.find(". "); sentence != std::string::npos)
    summary.resize(sentence);
  if (summary.ends_with('.')) summary.pop_back();
  return summary;
}

/// Where it could be: files that the program carries have folders that are nowhere.
void addNamed(const std::filesystem::path& file, const Opening& opening) {
  std::error_code ignored;
  if (opening.files && std::filesystem::exists(file.has_parent_path() ? file.parent_path() : ".", ignored))
    opening.files->push_back(file);
}

void addFile(const char* what, const std::filesystem::path& file, const Opening& opening) {
  if (opening.inputs) opening.inputs->push_back({what, file});
  addNamed(file, opening);
}

void addFiles(std::span<const std::filesystem::path> files, const Opening& opening) {
  std::error_code ignored;
  for (const std::filesystem::path& file : files) {
    addNamed(file, opening);
    if (opening.inputs && std::filesystem::exists(file, ignored))
      opening.inputs->push_back({"a file of the scene", file});
  }
}

bool isBuiltin(const std::string& scene) {
  return scene == kPrimitives || sceneNamed(scene, embeddedScenes()) || sceneNamed(scene, galleryScenes());
}

void requireKnown(const std::string& scene) {
  const Names names = builtinNames();
  if (scene == kGallery) {
    Names ofGallery;
    for (const EmbeddedScene& one : galleryScenes()) ofGallery.emplace_back(one.name);
    throw Error(ErrorKind::Scene, "'gallery' is many scenes",
                fmt::format("they are {}; `luxo gallery` draws them all, and the named surfaces are '{}'",
                            listed(ofGallery), kPrimitives));
  }
  std::error_code ignored;
  const bool looksLikeFile = scene.find('.') != std::string::npos ||
                             (scene.find('/') != std::string::npos && closestName(scene, names).empty());
  if (looksLikeFile || std::filesystem::exists(scene, ignored)) return;
  throw Error(ErrorKind::Scene, fmt::format("there is no scene '{}'", scene),
              didYouMean(scene, names, "luxo render --list names the built-in scenes"));
}

Quantity quantityOf(const std::string& text) {
  const auto number = finiteNumber(text);
  return number ? Quantity(*number) : Quantity(text);
}

void refuseParameters(const std::string& scene, std::span<const ParameterValue> parameters) {
  if (!parameters.empty())
    throw Error(ErrorKind::Usage, fmt::format("the scene has no parameter '{}'", parameters.front().name),
                fmt::format("{} has no parameters", scene));
}

/// With the files that it names, as far as it is built.
Scene builtScene(const SceneFile& file, std::span<const ParameterValue> parameters, const Opening& opening) {
  const auto addFilesOf = [&opening](const SceneSource& source) {
    if (source.models) addFiles(source.models->files(), opening);
    if (source.textures) addFiles(source.textures->files(), opening);
    if (source.shaders) addFiles(source.shaders->files(), opening);
  };
  try {
    Scene scene = buildScene(file, parameters, opening.warnings, opening.about);
    addFilesOf(file.source);
    return scene;
  } catch (const Error&) {
    addFilesOf(file.source);
    throw;
  }
}

OpenedScene openDescription(SceneFile file, const Opening& opening) {
  Scene scene = builtScene(file, opening.parameters, opening);
  return {std::move(scene), std::move(file)};
}

/// The formulas that a model carries, with the files that they name, which lead to no others. Nothing, with a
/// warning: this luxo cannot read them.
std::optional<OpenedScene> openCarried(const Model& model, const std::string& file, const Opening& opening) {
  if (model.scene.empty()) return std::nullopt;
  try {
    return openDescription(parseScene(model.scene, file, {}, {.from = FileSource(model.sceneFiles)}),
                           opening);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::Scene) throw;
    if (opening.warnings)
      opening.warnings->push_back(fmt::format(
          "{}: its formulas cannot be read; its triangles are used instead\n{}", file, error.what()));
  }
  return std::nullopt;
}

/// Descriptions keep them; the bar is shown while it is there.
FileOptions fileOptionsOf(const Opening& opening, const std::weak_ptr<ProgressBar>& bar) {
  return {.allowOutside = opening.allowOutside, .progress = [bar](double done) {
            if (const auto shown = bar.lock()) shown->show(done);
          }};
}

OpenedScene openModel(const std::string& file, const Opening& opening, const FileOptions& files) {
  const auto model = std::make_shared<const Model>(
      readModel(file, {.allowOutside = files.allowOutside, .progress = files.progress}));
  addFiles(model->files, opening);
  if (auto carried = openCarried(*model, file, opening)) return std::move(*carried);
  refuseParameters(file, opening.parameters);
  if (opening.warnings)
    opening.warnings->insert(opening.warnings->end(), model->warnings.begin(), model->warnings.end());
  return {modelScene(model), std::nullopt, model->duration, model->lit()};
}

/// A folder stands for the one model in it.
std::string modelIn(const std::string& scene) {
  std::error_code failure;
  if (isBuiltin(scene) || !std::filesystem::is_directory(scene, failure)) return scene;
  Names models;
  for (std::filesystem::directory_iterator file(scene, failure), end; !failure && file != end;
       file.increment(failure))
    if (namesModel(file->path().string())) models.push_back(file->path().string());
  if (models.size() > 1) {
    std::ranges::sort(models);
    throw Error(ErrorKind::Scene, fmt::format("the folder '{}' has {} models", scene, models.size()),
                fmt::format("name one of them: {}", listed(models)));
  }
  return models.empty() ? scene : models.front();
}

}  // namespace

std::vector<BuiltinScene> builtinScenes() {
  std::vector<BuiltinScene> scenes;
  for (const EmbeddedScene& scene : embeddedScenes())
    scenes.push_back({std::string(scene.name), summaryOf(scene.text)});
  for (const EmbeddedScene& scene : galleryScenes())
    scenes.push_back({std::string(scene.name), summaryOf(scene.text)});
  scenes.push_back({kPrimitives, "the named surfaces side by side"});
  std::ranges::sort(scenes, {}, &BuiltinScene::name);
  return scenes;
}

OpenedScene openDescribedScene(const std::string& name, const Opening& opening) {
  const std::string scene = modelIn(name);
  const bool isFile = !isBuiltin(scene);
  if (isFile && namesMaterialShader(scene)) return {openShader(scene, {}, opening).scene, std::nullopt};
  if (isFile && isShader(scene))
    throw Error(
        ErrorKind::Usage, fmt::format("'{}' is a shader that draws nothing by itself", scene),
        "materials have fragment and vertex programs (.frag, .glsl, .vert); luxo inspect tells what any "
        "shader takes and gives");
  if (isFile && scene != kStandardInput) addFile("the scene", scene, opening);
  const auto bar = std::make_shared<ProgressBar>(opening.showsProgress);
  const FileOptions files = fileOptionsOf(opening, bar);
  if (isFile && namesModel(scene)) return openModel(scene, opening, files);
  std::optional<SceneFile> description = sceneDescription(scene, files);
  if (!description) {
    refuseParameters(scene, opening.parameters);
    return {primitives(), std::nullopt};
  }
  return openDescription(std::move(*description), opening);
}

std::optional<SceneFile> sceneDescription(const std::string& scene, const FileOptions& files) {
  if (const EmbeddedScene* embedded = sceneNamed(scene, embeddedScenes()))
    return parseScene(std::string(embedded->text), scene);
  if (const EmbeddedScene* ofGallery = sceneNamed(scene, galleryScenes()))
    return galleryDescription(*ofGallery);
  if (scene == kPrimitives) return std::nullopt;
  if (scene == kStandardInput) return readScene(std::cin, "standard input");
  requireKnown(scene);
  return readSceneFile(scene, files);
}

MaterialShaderPtr openMaterialShader(const std::string& shader) {
  const std::filesystem::path path(shader);
  std::error_code ignored;
  return isGalleryShader(shader) && !std::filesystem::exists(path, ignored)
             ? galleryShaderFiles()->get(path.filename().string())
             : shaderInFile(path);
}

OpenedShader openShader(const std::string& shader, const ShaderUse& use, const Opening& opening) {
  addFile("the shader", shader, opening);
  if (!use.scene.empty() && !isBuiltin(use.scene)) addFile("the scene", use.scene, opening);
  if (opening.files)
    for (const std::filesystem::path& program : programsOf(shader))
      for (const std::filesystem::path& file : filesNamedBy(program)) addNamed(file, opening);
  ShaderScene shown =
      shaderScene(shader, use, opening.parameters, opening.warnings, {.allowOutside = opening.allowOutside});
  addFiles(shown.files, opening);
  Scene scene = builtScene(shown.description, shown.parameters, opening);
  return {std::move(scene), std::move(shown.controls), std::move(shown.mouse)};
}

Scene openSceneOf(const ShaderUse& use, const Opening& opening) {
  return builtScene(sceneOfShader(use, {.allowOutside = opening.allowOutside}), {}, opening);
}

Scene openScene(const std::string& scene, const Opening& opening) {
  return openDescribedScene(scene, opening).scene;
}

std::vector<ParameterOverride> overridesOf(std::span<const ParameterValue> parameters) {
  std::vector<ParameterOverride> overrides;
  for (const auto& [name, value] : parameters) overrides.push_back({name, quantityOf(value)});
  return overrides;
}

Scene buildScene(const SceneFile& file, std::span<const ParameterValue> parameters,
                 std::vector<std::string>* warnings, WarningsAbout about) {
  std::vector<Diagnostic> found;
  Scene scene = buildScene(file, overridesOf(parameters), warnings != nullptr ? &found : nullptr, about);
  for (const Diagnostic& diagnostic : found)
    warnings->push_back(
        describe(file.source.name, file.source.text ? *file.source.text : std::string(), diagnostic));
  moveByDevice(scene, "auto");
  return scene;
}

}  // namespace luxo
