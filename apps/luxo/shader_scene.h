// SPDX-License-Identifier: Apache-2.0
// A shader file as a scene: on surfaces that show it, or on those of a scene. Its uniforms are parameters:
// `luxo render steel.frag -P grooves=90`.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "option_values.h"
#include "scene/material_shader.h"
#include "scene/scene_builder.h"
#include "scene/scene_file.h"
#include "scene/scene_folder.h"
#include "shader_controls.h"
#include "viewer.h"

namespace luxo {

/// The shader in a file; of a program in the course's style what has the same name beside it, phong.vert of
/// phong.frag and the other way round, belongs to it. A vertex program may be alone. Error(Scene): as
/// ShaderFiles::get().
[[nodiscard]] MaterialShaderPtr shaderInFile(const std::filesystem::path& file);

/// The files that it has, or would have: the file, and what would belong to it beside it.
[[nodiscard]] std::vector<std::filesystem::path> programsOf(const std::filesystem::path& file);

/// How a shader is shown.
struct ShaderUse {
  std::string scene = {};  ///< a scene file, built-in scene or model; empty: luxo's own, of a ball and a ring
  std::string material = {};                ///< of the scene, that gets the shader; empty: all of them
  std::vector<ParameterValue> preset = {};  ///< for uniforms that are not given
  bool mainImage = false;  ///< the file's mainImage (main_image.h), which it may have beside a material
};

struct ShaderScene {
  SceneFile description;
  std::vector<ParameterValue> parameters;    ///< values that were given, as the description takes them
  std::vector<ParameterControl> controls;    ///< of the uniforms, in their order
  std::vector<std::string> mouse;            ///< parameters that are iMouse, where the shader reads it
  std::vector<std::filesystem::path> files;  ///< of the shader
};

/// What shaderScene() gives the shader to, without it; `use.material` may be of none. Errors as there.
[[nodiscard]] SceneFile sceneOfShader(const ShaderUse& use, const FileOptions& files = {});

/// Whether a file is one that shaderScene() takes, by its suffix: .frag, .glsl, .vert.
[[nodiscard]] bool namesMaterialShader(const std::string& path);

/// One with a `mainImage` and no `material` fills the picture by itself; others are on the scene of `use`.
/// `given`: values of uniforms, by their names, and of parameters of the scene. A uniform takes a number or a
/// formula, a vector a list of them (1,0.5,0), a colour also "#rrggbb", a choice also its name, and a bool
/// also true and false. The uniform `time`, a float without a comment, is the scene's t, unless it is given.
/// One with the name of a parameter of the scene follows that.
///
/// Error(Scene): what is wrong with the shader, at its file, line and column, or with the scene.
/// Error(Usage): a value is for nothing that there is, or none of its type. Cost: the shader is compiled, or
/// read from the cache.
[[nodiscard]] ShaderScene shaderScene(const std::string& shader, const ShaderUse& use,
                                      std::span<const ParameterValue> given,
                                      std::vector<std::string>* warnings = nullptr,
                                      const FileOptions& files = {});

}  // namespace luxo
