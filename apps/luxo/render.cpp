// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "console.h"
#include "exit_code.h"
#include "open_scene.h"
#include "options.h"
#include "render_to_files.h"
#include "shader_options.h"
#include "shader_scene.h"
#include "verbs.h"

namespace luxo {
namespace {

int renderScene(const RenderRequest& request, const ShaderOptions& shader) {
  // Looking for holes takes time; what a model, a texture or a light lacks is known.
  const bool warn = request.verbosity == Verbosity::Verbose || request.verbosity == Verbosity::Normal;
  const auto about =
      request.verbosity == Verbosity::Verbose ? WarningsAbout::All : WarningsAbout::WhatIsLacking;
  std::vector<std::string> warnings;
  std::vector<NamedFile> inputs;
  const Opening opening{.parameters = request.parameters,
                        .warnings = warn ? &warnings : nullptr,
                        .about = about,
                        .inputs = &inputs,
                        .allowOutside = request.allowOutside,
                        .showsProgress = warn};
  const ShaderUse use = shaderUse(request.scene, shader);
  Scene scene = namesMaterialShader(request.scene) ? openShader(request.scene, use, opening).scene
                                                   : openScene(request.scene, opening);
  for (const std::string& warning : warnings) printWarning(warning);
  return renderToFiles(std::move(scene), request, inputs);
}

}  // namespace

void addRender(CLI::App& app, Command& chosen) {
  CLI::App* verb = app.add_subcommand("render", "draw a scene to files, without any window");
  verb->group("Verbs");
  const auto options = std::make_shared<RenderOptions>(*verb, SceneArgument::Taken);
  const auto shader = std::make_shared<ShaderOptions>();
  addShaderOptions(*verb, *shader);
  verb->callback([options, shader, &chosen] {
    chosen = [options, shader] {
      const RenderRequest request = options->request();
      if (!request.listScenes) return renderScene(request, *shader);
      for (const BuiltinScene& scene : builtinScenes())
        printData(fmt::format("{:<28} {}\n", scene.name, scene.summary));
      return exit_code::kDone;
    };
  });
}

}  // namespace luxo
