// SPDX-License-Identifier: Apache-2.0
#include "command_line.h"

#include <CLI/CLI.hpp>

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "base/suggestion.h"
#include "console.h"

namespace luxo {
namespace {

using Names = std::vector<std::string>;

Names optionsOf(const CLI::App& app) {
  Names names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
  }
  return names;
}

Names verbsOf(const CLI::App& app) {
  Names names;
  for (const CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(verb->get_name());
  return names;
}

// `luxo`, or `luxo render` for a verb.
std::string commandOf(const CLI::App& app) {
  return app.get_parent() == nullptr ? app.get_name() : app.get_parent()->get_name() + " " + app.get_name();
}

std::string seeHelp(const CLI::App& app) { return fmt::format("see {} --help", commandOf(app)); }

// CLI11 says "--max: 1 required X missing" or "--max: At Most 1 required but received 2".
[[noreturn]] void refuseCount(const CLI::App& app, const std::string& said) {
  const std::string option = said.substr(0, said.find(':'));
  const bool missing = said.find("missing") != std::string::npos;
  const auto verbs = app.get_subcommands();
  throw Error(ErrorKind::Usage,
              fmt::format("option '{}' {}", option, missing ? "needs a value" : "is given more than once"),
              seeHelp(verbs.empty() ? app : *verbs[0]));
}

[[noreturn]] void refuseOption(const CLI::App& app, const std::string& argument) {
  const std::string option = argument.substr(0, argument.find('='));
  for (const CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; })) {
    const Names known = optionsOf(*verb);
    if (std::find(known.begin(), known.end(), option) != known.end())
      throw Error(ErrorKind::Usage, fmt::format("option '{}' stands before the verb", option),
                  fmt::format("write {} {} ... {}", app.get_name(), verb->get_name(), option));
  }
  throw Error(ErrorKind::Usage, fmt::format("unknown option '{}'", option),
              didYouMean(option, optionsOf(app), seeHelp(app)));
}

// What nobody took: an unknown option before anything else, as its value may stand among the rest.
void refuseLeftovers(const CLI::App& app) {
  const Names left = app.remaining();
  if (left.empty()) return;
  const auto option = std::find_if(left.begin(), left.end(),
                                   [](const std::string& s) { return s.size() > 1 && s[0] == '-'; });
  const Names verbs = verbsOf(app);
  if (!verbs.empty() && left[0][0] != '-' && app.get_subcommands().empty())
    throw Error(ErrorKind::Usage, fmt::format("unknown verb '{}'", left[0]),
                didYouMean(left[0], verbs, fmt::format("one of {}", listed(verbs))));
  if (option != left.end()) refuseOption(app, *option);
  throw Error(ErrorKind::Usage, fmt::format("unexpected argument '{}'", left[0]), seeHelp(app));
}

}  // namespace

bool parseCommandLine(CLI::App& app, int argc, const char* const* argv) {
  app.allow_extras();
  for (CLI::App* verb : app.get_subcommands([](CLI::App*) { return true; })) verb->allow_extras();
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    const auto verbs = app.get_subcommands();
    printData(verbs.empty() ? app.help() : verbs[0]->help(app.get_name()));
    return false;
  } catch (const CLI::CallForVersion& version) {
    printData(std::string(version.what()) + "\n");
    return false;
  } catch (const CLI::ArgumentMismatch& error) {
    refuseCount(app, error.what());
  } catch (const CLI::ParseError& error) {
    throw Error(ErrorKind::Usage, error.what(), seeHelp(app));
  }
  for (const CLI::App* verb : app.get_subcommands()) refuseLeftovers(*verb);
  refuseLeftovers(app);
  return true;
}

}  // namespace luxo
