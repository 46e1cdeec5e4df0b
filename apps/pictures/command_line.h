// SPDX-License-Identifier: Apache-2.0
// A program's verbs and options, and mistakes in them said in luxo's way.
#pragma once

namespace CLI {
class App;
}

namespace luxo {

/// Parses into the app and its verbs. False when that printed the help or the version on stdout: nothing is
/// left to do. Error(Usage): unknown verb, option or argument (with what was perhaps meant), a missing or
/// repeated value.
[[nodiscard]] bool parseCommandLine(CLI::App& app, int argc, const char* const* argv);

}  // namespace luxo
