// SPDX-License-Identifier: Apache-2.0
// The verbs of `luxo`. Each add...() describes one; when the command line names it, `chosen` becomes what to
// run.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace luxo {

/// Does the work and gives the exit code; throws Error.
using Command = std::function<int()>;

void addRender(CLI::App& app, Command& chosen);
void addView(CLI::App& app, Command& chosen);
void addLab(CLI::App& app, Command& chosen);
void addPlot(CLI::App& app, Command& chosen);
void addInspect(CLI::App& app, Command& chosen);
void addDiff(CLI::App& app, Command& chosen);
void addVerify(CLI::App& app, Command& chosen);
void addBench(CLI::App& app, Command& chosen);
void addExport(CLI::App& app, Command& chosen);
void addGallery(CLI::App& app, Command& chosen);
void addDoctor(CLI::App& app, Command& chosen);

}  // namespace luxo
