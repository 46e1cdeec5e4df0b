// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <vector>

#include "base/temporary_folder.h"
#include "benchmarks.h"
#include "side_by_side.h"

namespace luxo::bench {
namespace {

namespace fs = std::filesystem;

/// Runs the program with all caches under `caches`; whether it succeeded.
bool renderPng(const fs::path& program, const fs::path& caches, const fs::path& png) {
  std::vector<std::string> arguments = {program, "-o", png, "--size", "1280x720", "--time", "21", "-q"};
  // Of two values of a variable the first counts.
  std::vector<std::string> variables;
  for (const char* name : {"HOME", "XDG_CACHE_HOME", "MESA_SHADER_CACHE_DIR", "LUXO_CACHE_DIR"})
    variables.push_back(fmt::format("{}={}", name, caches.string()));
  for (char** variable = environ; *variable; ++variable) variables.emplace_back(*variable);
  const auto pointers = [](std::vector<std::string>& strings) {
    std::vector<char*> all;
    for (std::string& s : strings) all.push_back(s.data());
    all.push_back(nullptr);
    return all;
  };
  pid_t child = 0;
  int status = 0;
  if (posix_spawn(&child, program.c_str(), nullptr, nullptr, pointers(arguments).data(),
                  pointers(variables).data()) != 0)
    return false;
  return waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0 &&
         fs::exists(png);
}

void startToPng(benchmark::State& state) {
  const fs::path program = fs::read_symlink("/proc/self/exe").parent_path() / "luxo_grandpa";
  const TemporaryFolder scratch;
  const fs::path full = scratch.path() / "full", empty = scratch.path() / "empty",
                 png = scratch.path() / "lamp.png";
  bool rendered = true;
  const auto render = [&](const fs::path& caches) {
    fs::create_directories(caches);
    rendered = renderPng(program, caches, png) && rendered;
  };
  sideBySide(
      state, [&](int) { render(full); },
      [&](int) {
        fs::remove_all(empty);
        render(empty);
      });
  if (!rendered) state.SkipWithError("luxo_grandpa -o did not make a picture");
}

}  // namespace

void registerStart() {
  benchmark::RegisterBenchmark("start_to_png/warm_of_cold_caches", startToPng)
      ->UseManualTime()
      ->Iterations(11)
      ->Unit(benchmark::kMillisecond);
}

}  // namespace luxo::bench
