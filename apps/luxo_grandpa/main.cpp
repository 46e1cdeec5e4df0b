// SPDX-License-Identifier: Apache-2.0
// Luxo Grandpa in a window; with -o, in a file.
#include <CLI/CLI.hpp>

#include <utility>

#include "command_line.h"
#include "console.h"
#include "exit_code.h"
#include "luxo_grandpa/lamp.h"
#include "options.h"
#include "process_tuning.h"
#include "render_to_files.h"
#include "scene_request.h"
#include "viewer.h"

namespace {

int runLamp(int argc, const char* const* argv) {
  CLI::App app("Luxo Grandpa, a lamp of three spinning joints: in a window, or with -o in a file.",
               "luxo_grandpa");
  app.set_version_flag("--version", "luxo_grandpa " LUXO_VERSION, "print the version");
  app.footer("\nIn the window, H shows the keys.");
  const luxo::RenderOptions options(app, luxo::SceneArgument::None);
  if (!luxo::parseCommandLine(app, argc, argv)) return luxo::exit_code::kDone;

  luxo::Scene lamp = luxo::luxoGrandpa();
  if (options.hasOutput()) {
    luxo::RenderRequest request = options.request();
    request.scene = "luxo-grandpa";
    luxo::refuseParameters(request);
    return luxo::renderToFiles(std::move(lamp), request);
  }
  const luxo::RenderRequest request = options.request(luxo::RenderTarget::Window);
  luxo::refuseParameters(request);
  luxo::showLog(request.verbosity);
  return luxo::runViewer(luxo::viewedScene(std::move(lamp), request),
                         luxo::viewerOptions("Luxo Grandpa", request));
}

}  // namespace

int main(int argc, char** argv) {
  luxo::tuneAllocator();
  luxo::ignoreFileSizeSignal();
  luxo::fitThreadsToProcess();
  return luxo::runToExitCode([&] { return runLamp(argc, argv); });
}
