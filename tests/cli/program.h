// SPDX-License-Identifier: Apache-2.0
// Runs the programs as a user would and gives what they left behind: exit code, stdout, stderr, files.
#pragma once

#include <gtest/gtest.h>
#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "unit/image_test_support.h"

namespace luxo::test {

struct Outcome {
  int code = -1;  ///< exit code, or minus the signal that ended the program
  std::string out, err;
};

using Arguments = std::vector<std::string>;

/// What to start; what is not said is as in the tests' own process, its environment included.
struct Launch {
  Arguments arguments;
  std::filesystem::path folder;  ///< to run in
  std::filesystem::path program = LUXO_PROGRAM;
  std::filesystem::path out = {};  ///< where stdout goes instead of Outcome::out
  std::optional<std::uint64_t> fileSizeLimitBytes = std::nullopt;
  std::optional<std::uint64_t> addressSpaceLimitBytes = std::nullopt;
  /// Threads included. Root has no such limit: started by it the program runs as a user who has nothing else.
  std::optional<std::uint64_t> processLimit = std::nullopt;
};

/// A program that runs beside the test.
class RunningProgram {
 public:
  explicit RunningProgram(const Launch& launch);
  ~RunningProgram();  ///< ends it if nobody waited
  RunningProgram(const RunningProgram&) = delete;
  RunningProgram& operator=(const RunningProgram&) = delete;

  void send(int signal) const;
  /// Sends it once the program has a handler for it, which sanitizers make it take seconds to, and a moment
  /// has passed.
  void interrupt(int signal) const;
  [[nodiscard]] Outcome wait();

 private:
  ScratchFolder streams_;
  bool ownOut_;
  pid_t process_;
};

[[nodiscard]] Outcome run(const Launch& launch);
/// Runs `luxo ARGUMENTS` in the folder; stdout goes to `out` if given.
[[nodiscard]] Outcome run(const ScratchFolder& folder, const Arguments& arguments,
                          const std::filesystem::path& out = {});

[[nodiscard]] std::string textOf(const std::filesystem::path& path);
void writeText(const std::filesystem::path& path, const std::string& text);
[[nodiscard]] bool contains(const std::string& text, const std::string& part);

/// The code, nothing on stdout, and on stderr one uncoloured error that says `said` and, on a second line,
/// `help`.
void expectFailure(const Outcome& outcome, int code, const std::string& said, const std::string& help = "");

/// Runs `luxo render luxo-grandpa`, small, in a folder of the test's own.
class RenderTest : public testing::Test {
 protected:
  static constexpr int kWidth = 67, kHeight = 45;  ///< odd, and no multiple of any tile or row alignment

  /// As Launch for `luxo render luxo-grandpa --size 67x45 ARGUMENTS`.
  [[nodiscard]] Launch rendering(const Arguments& arguments) const;
  [[nodiscard]] Outcome render(const Arguments& arguments) const { return run(rendering(arguments)); }
  /// Renders, expects exit code 0 and nothing on stdout, and gives the file's bytes.
  [[nodiscard]] std::string fileOf(Arguments arguments, const std::string& file) const;

  /// Every way to fail leaves no trace: with `-o FILE` naming a file that exists, that one stays as it was,
  /// and nothing else appears.
  void expectRefused(Arguments arguments, int code, const std::string& said, const std::string& help) const;

  ScratchFolder folder;
};

/// The same where a Vulkan device is needed: skipped without one, or failed when LUXO_REQUIRE_GPU=1.
class DeviceRenderTest : public RenderTest {
 protected:
  void SetUp() override;
};

/// Skips the running test, or fails it when LUXO_REQUIRE_GPU=1, if no Vulkan device is usable.
void requireDevice();

}  // namespace luxo::test
