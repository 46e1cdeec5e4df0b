// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>

#include "base/error.h"
#include "command_line.h"
#include "exit_code.h"
#include "process_tuning.h"
#include "verbs.h"

namespace {

constexpr const char* kExitCodes =
    "Data goes to stdout, everything else to stderr. The order of options never matters.\n"
    "Exit codes: 0 done, 1 internal, 2 usage, 3 scene, 4 device, 5 cannot write, 6 requirement not met,\n"
    "7 some frames failed, 75 worth retrying, 130 and 143 interrupted.";

int runLuxo(int argc, const char* const* argv) {
  CLI::App app("luxo draws scenes of parametric surfaces and knows the error of every picture.", "luxo");
  app.set_version_flag("--version", "luxo " LUXO_VERSION, "print the version");
  app.footer(kExitCodes);
  app.require_subcommand(0, 1);
  app.get_formatter()->label("SUBCOMMAND", "VERB ...");
  luxo::Command chosen;
  luxo::addRender(app, chosen);
  luxo::addView(app, chosen);
  luxo::addLab(app, chosen);
  luxo::addPlot(app, chosen);
  luxo::addInspect(app, chosen);
  luxo::addDiff(app, chosen);
  luxo::addVerify(app, chosen);
  luxo::addBench(app, chosen);
  luxo::addExport(app, chosen);
  luxo::addGallery(app, chosen);
  luxo::addDoctor(app, chosen);
  if (!luxo::parseCommandLine(app, argc, argv)) return luxo::exit_code::kDone;
  if (!chosen) throw luxo::Error(luxo::ErrorKind::Usage, "no verb is given", "see luxo --help");
  return chosen();
}

}  // namespace

int main(int argc, char** argv) {
  luxo::tuneAllocator();
  luxo::ignoreFileSizeSignal();
  luxo::fitThreadsToProcess();
  return luxo::runToExitCode([&] { return runLuxo(argc, argv); });
}
