// SPDX-License-Identifier: Apache-2.0
// luxo lab: a shader on a surface, live.
#include "lab.h"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <memory>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

#include "base/error.h"
#include "console.h"
#include "open_scene.h"
#include "scene_request.h"
#include "scenes/embedded_scenes.h"
#include "shader_presets.h"
#include "verbs.h"
#include "viewer.h"

namespace luxo {
namespace {

struct LabOptions {
  std::unique_ptr<RenderOptions> render;
  ShaderOptions shader;
  std::string file, scene, material;
};

int runLab(const LabOptions& options) {
  RenderRequest request = options.render->request(RenderTarget::Window);
  showLog(request.verbosity);
  if (!namesMaterialShader(options.file))
    throw Error(ErrorKind::Usage, "'" + options.file + "' is no shader file",
                isGalleryShader(options.file + ".frag") ? "did you mean '" + options.file + ".frag'?"
                                                        : "name a file that ends in .frag or .glsl");
  if (options.scene == "-" || namesMaterialShader(options.scene))
    throw Error(ErrorKind::Usage, "'" + options.scene + "' is no scene that can be read again",
                "name a scene file, a model or a built-in scene");
  if (!options.material.empty() && options.scene.empty())
    throw Error(ErrorKind::Usage, "--material is of a scene, and none is named",
                "as in luxo lab steel.frag lamp.luxo.json");
  ShaderUse use = shaderUse(options.file, options.shader);
  use.scene = options.scene;
  use.material = options.material;
  return showShader(options.file, use, request);
}

/// Of a shader that is there and has errors the scene without it, and these over it, until it is mended.
ViewedScene readOrPlain(const std::string& shader, const ShaderUse& use, const RenderRequest& request,
                        ViewerOptions& viewer) {
  try {
    return viewer.readAgain(viewer.files);
  } catch (const Error& error) {
    std::error_code ignored;
    if (error.kind() != ErrorKind::Scene || !std::filesystem::exists(shader, ignored)) throw;
    viewer.problem = error;
    try {
      return viewedScene(openSceneOf(use, {.allowOutside = request.allowOutside}), request);
    } catch (const Error&) {
      // The scene is wrong, not the shader.
    }
    throw;
  }
}

}  // namespace

int showShader(const std::string& shader, const ShaderUse& use, const RenderRequest& request) {
  ViewerOptions viewer = viewerOptions(shader, request);
  viewer.shader = shader;
  viewer.readAgain = [shader, use, request](ViewerOptions::Files& files) {
    std::vector<std::string> warnings;
    OpenedShader opened = openShader(shader, use,
                                     {.parameters = request.parameters,
                                      .warnings = &warnings,
                                      .about = WarningsAbout::WhatIsLacking,
                                      .files = &files,
                                      .allowOutside = request.allowOutside});
    ViewedScene viewed = viewedScene(std::move(opened.scene), request);
    viewed.controls = std::move(opened.controls);
    viewed.mouse = std::move(opened.mouse);
    for (const std::string& warning : warnings) printWarning(warning);
    return viewed;
  };
  ViewedScene viewed = readOrPlain(shader, use, request, viewer);
  return runViewer(std::move(viewed), viewer);
}

void addLab(CLI::App& app, Command& chosen) {
  CLI::App* verb = app.add_subcommand("lab", "a shader on a surface, live: drawn again whenever it is saved");
  verb->group("Verbs");
  const auto options = std::make_shared<LabOptions>();
  verb->add_option("SHADER", options->file,
                   "GLSL file with `vec4 material(Point p)`, or Shadertoy's `mainImage`")
      ->type_name("")
      ->required();
  verb->add_option("SCENE", options->scene,
                   "scene file, built-in scene or model that gets it (a ball and a ring)")
      ->type_name("");
  options->render = std::make_unique<RenderOptions>(*verb, SceneArgument::None, RenderTarget::Window);
  addShaderOptions(*verb, options->shader);
  verb->add_option("--material", options->material, "only this material of the scene gets the shader (all)")
      ->type_name("NAME");
  verb->footer(
      "Uniforms are turned in the window, as their lines say:\n"
      "  uniform float grooves = 400.0;   // @slider 50 800 15     from, to, and in how many steps\n"
      "  uniform vec3 metal = vec3(0.6);  // @color\n"
      "  uniform int pattern = 1;         // @select plain|brushed|knurled\n"
      "Presets are saved beside the shader, as SHADER.presets.json. The same file renders without a window:\n"
      "  luxo render SHADER --time 1.5 -P grooves=90 -o a.png");
  verb->callback([options, &chosen] { chosen = [options] { return runLab(*options); }; });
}

}  // namespace luxo
