// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "console.h"
#include "lab.h"
#include "open_scene.h"
#include "scene_request.h"
#include "verbs.h"
#include "viewer.h"

namespace luxo {

void addView(CLI::App& app, Command& chosen) {
  CLI::App* verb = app.add_subcommand("view", "show a scene in a window: luxo-grandpa, or the one named");
  verb->group("Verbs");
  const auto options = std::make_shared<RenderOptions>(*verb, SceneArgument::Taken, RenderTarget::Window);
  const auto shader = std::make_shared<ShaderOptions>();
  addShaderOptions(*verb, *shader);
  verb->callback([options, shader, &chosen] {
    chosen = [options, shader] {
      const RenderRequest request = options->request(RenderTarget::Window);
      showLog(request.verbosity);
      const std::string name = request.scene.empty() ? "luxo-grandpa" : request.scene;
      const ShaderUse use = shaderUse(name, *shader);
      if (namesMaterialShader(name)) return showShader(name, use, request);
      ViewerOptions viewer = viewerOptions(name, request);
      viewer.readAgain = [name, request](ViewerOptions::Files& files) {
        std::vector<std::string> warnings;
        const auto about =
            request.verbosity == Verbosity::Verbose ? WarningsAbout::All : WarningsAbout::WhatIsLacking;
        OpenedScene opened =
            openDescribedScene(name, {.parameters = request.parameters,
                                      .warnings = request.verbosity == Verbosity::Quiet ? nullptr : &warnings,
                                      .about = about,
                                      .files = &files,
                                      .allowOutside = request.allowOutside,
                                      .showsProgress = request.verbosity == Verbosity::Normal});
        for (const std::string& warning : warnings) printWarning(warning);
        ViewedScene viewed = viewedScene(std::move(opened.scene), request);
        viewed.loop = opened.duration;
        return viewed;
      };
      ViewedScene viewed = viewer.readAgain(viewer.files);
      return runViewer(std::move(viewed), viewer);
    };
  });
}

}  // namespace luxo
