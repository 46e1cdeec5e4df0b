// SPDX-License-Identifier: Apache-2.0
// What SCENE on a command line means: a scene that every luxo carries, or a file.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "option_values.h"
#include "output_files.h"
#include "scene/material_shader.h"
#include "scene/scene.h"
#include "scene/scene_builder.h"
#include "scene/scene_file.h"
#include "scene/scene_folder.h"
#include "viewer.h"

namespace luxo {

struct BuiltinScene {
  std::string name, summary;
};

/// By name. They are carried as text, so they work from any folder.
[[nodiscard]] std::vector<BuiltinScene> builtinScenes();

/// How a scene is opened, and who is told of it.
struct Opening {
  std::span<const ParameterValue> parameters = {};  ///< they replace values of the scene's
  /// Takes what is allowed but probably not meant (scene/scene_builder.h), as people read it.
  std::vector<std::string>* warnings = nullptr;
  WarningsAbout about = WarningsAbout::All;
  /// Takes the files that it is made of, so that none is overwritten.
  std::vector<NamedFile>* inputs = nullptr;
  /// Takes all files that it names, there or not, also where it throws: what may mend it.
  std::vector<std::filesystem::path>* files = nullptr;
  bool allowOutside = false;   ///< images and models may be outside of the folder of who names them
  bool showsProgress = false;  ///< of the reading of models that take a while (progress_bar.h)
};

struct OpenedScene {
  Scene scene;
  std::optional<SceneFile>
      description;        ///< what it was built from; none: a program, a model's triangles, a shader
  double duration = 0;    ///< seconds, of what moves in a model; 0: it does not, or for ever
  bool ownLights = true;  ///< false: those of a model that has none (scene/model_scene.h)
};

/// The scene of that name: built-in ones first, then files (so ./teapot is the file), a model (mesh/model.h),
/// the folder of one, the shader of a material (shader_scene.h) or a description; - is standard input. A GLB
/// that carries its formulas (export/carried_scene.h) is these. Error(Scene): there is none of that name; it
/// cannot be read or has errors. Error(Usage): it has no such parameter, or not with that value.
[[nodiscard]] OpenedScene openDescribedScene(const std::string& name, const Opening& opening = {});
/// As above, where nobody asks what it was built from.
[[nodiscard]] Scene openScene(const std::string& scene, const Opening& opening = {});

/// The description of a scene that is built in, in a file, or on standard input. Nothing: it is made by a
/// program. Error(Scene): there is none of that name, it cannot be read, or is none.
[[nodiscard]] std::optional<SceneFile> sceneDescription(const std::string& scene,
                                                        const FileOptions& files = {});

/// The material's shader in a file; where there is none of that name, the gallery's: gallery/steel.frag.
/// Error(Scene): there is neither, or what ShaderFiles::get() says.
[[nodiscard]] MaterialShaderPtr openMaterialShader(const std::string& shader);

struct ShaderUse;

/// A scene that shows a shader (shader_scene.h), and how people turn its uniforms. As openDescribedScene()
/// else.
struct OpenedShader {
  Scene scene;
  std::vector<ParameterControl> controls;
  std::vector<std::string> mouse;  ///< parameters that follow it
};
[[nodiscard]] OpenedShader openShader(const std::string& shader, const ShaderUse& use,
                                      const Opening& opening = {});
/// The scene that it would be on, with materials of its own.
[[nodiscard]] Scene openSceneOf(const ShaderUse& use, const Opening& opening = {});

/// What -P says, as descriptions take it.
[[nodiscard]] std::vector<ParameterOverride> overridesOf(std::span<const ParameterValue> parameters);

/// As openScene(), for a description that is in memory. It is moved by the device that is chosen
/// automatically.
[[nodiscard]] Scene buildScene(const SceneFile& file, std::span<const ParameterValue> parameters,
                               std::vector<std::string>* warnings, WarningsAbout about = WarningsAbout::All);

}  // namespace luxo
