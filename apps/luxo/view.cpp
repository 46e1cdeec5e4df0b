// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>

#include <memory>

#include "builtin_scenes.h"
#include "console.h"
#include "scene_request.h"
#include "verbs.h"
#include "viewer.h"

namespace luxo {

void addView(CLI::App& app, Command& chosen) {
  CLI::App* verb = app.add_subcommand("view", "show a scene in a window: luxo-grandpa, or the one named");
  verb->group("Verbs");
  const auto options = std::make_shared<RenderOptions>(*verb, SceneArgument::Taken, Destination::Window);
  verb->callback([options, &chosen] {
    chosen = [options] {
      const RenderRequest request = options->request(Destination::Window);
      showLog(request.verbosity);
      const std::string name = request.scene.empty() ? "luxo-grandpa" : request.scene;
      const Scene scene = openScene(name);
      return runViewer(scene, viewerOptions(scene, name, request));
    };
  });
}

}  // namespace luxo
