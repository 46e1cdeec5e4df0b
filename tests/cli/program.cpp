// SPDX-License-Identifier: Apache-2.0
#include "cli/program.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

#include "gpu/device.h"
#include "image/file.h"

namespace luxo::test {
namespace {

constexpr uid_t kNobodyElse = 54321;

void redirect(int stream, const std::filesystem::path& path) {
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (file < 0 || dup2(file, stream) < 0) _exit(99);
}

void limitResource(decltype(RLIMIT_FSIZE) resource, std::uint64_t bytes) {
  const rlimit limit{bytes, bytes};
  if (setrlimit(resource, &limit) != 0) _exit(97);
}

}  // namespace

RunningProgram::RunningProgram(const Launch& launch) : ownOut_(launch.out.empty()) {
  Arguments words = {launch.program.string()};
  words.insert(words.end(), launch.arguments.begin(), launch.arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);

  process_ = fork();
  if (process_ != 0) return;
  redirect(STDOUT_FILENO, ownOut_ ? streams_ / "out" : launch.out);
  redirect(STDERR_FILENO, streams_ / "err");
  if (launch.fileSizeLimitBytes) limitResource(RLIMIT_FSIZE, *launch.fileSizeLimitBytes);
  if (launch.addressSpaceLimitBytes) limitResource(RLIMIT_AS, *launch.addressSpaceLimitBytes);
  if (launch.processLimit) {
    limitResource(RLIMIT_NPROC, *launch.processLimit);
    if (geteuid() == 0 && (setgid(kNobodyElse) != 0 || setuid(kNobodyElse) != 0)) _exit(96);
  }
  if (chdir(launch.folder.c_str()) == 0) execv(argv[0], argv.data());
  _exit(98);
}

RunningProgram::~RunningProgram() {
  if (process_ <= 0) return;
  send(SIGKILL);
  waitpid(process_, nullptr, 0);
}

void RunningProgram::send(int signal) const { kill(process_, signal); }

void RunningProgram::interrupt(int signal) const {
  const auto handles = [&] {
    std::ifstream status(fmt::format("/proc/{}/status", process_));
    for (std::string line; std::getline(status, line);)
      if (line.starts_with("SigCgt:"))
        return (std::stoull(line.substr(7), nullptr, 16) >> (signal - 1) & 1) != 0;
    return true;  // it is over
  };
  while (!handles()) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  send(signal);
}

Outcome RunningProgram::wait() {
  int status = 0;
  waitpid(std::exchange(process_, -1), &status, 0);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status),
          ownOut_ ? textOf(streams_ / "out") : "", textOf(streams_ / "err")};
}

Outcome run(const Launch& launch) { return RunningProgram(launch).wait(); }

Outcome run(const ScratchFolder& folder, const Arguments& arguments, const std::filesystem::path& out) {
  return run({.arguments = arguments, .folder = folder.path(), .out = out});
}

std::string textOf(const std::filesystem::path& path) {
  const auto bytes = readFile(path);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

void writeText(const std::filesystem::path& path, const std::string& text) {
  writeFileAtomically(path, std::as_bytes(std::span(text)));
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

void expectFailure(const Outcome& outcome, int code, const std::string& said, const std::string& help) {
  EXPECT_EQ(outcome.code, code) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_TRUE(outcome.err.starts_with("error: ")) << outcome.err;
  EXPECT_TRUE(contains(outcome.err, said)) << outcome.err;
  EXPECT_FALSE(contains(outcome.err, "\x1b")) << "colour although stderr is a file";
  if (help.empty()) return;
  const std::size_t at = outcome.err.find("\nhelp: ");
  ASSERT_NE(at, std::string::npos) << outcome.err;
  EXPECT_TRUE(contains(outcome.err.substr(at), help)) << outcome.err;
}

Launch RenderTest::rendering(const Arguments& arguments) const {
  Launch launch{.arguments = {"render", "luxo-grandpa"}, .folder = folder.path()};
  if (std::find(arguments.begin(), arguments.end(), "--size") == arguments.end())
    launch.arguments.insert(launch.arguments.end(), {"--size", fmt::format("{}x{}", kWidth, kHeight)});
  launch.arguments.insert(launch.arguments.end(), arguments.begin(), arguments.end());
  return launch;
}

std::string RenderTest::fileOf(Arguments arguments, const std::string& file) const {
  arguments.insert(arguments.end(), {"-o", file});
  const Outcome outcome = render(arguments);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  return outcome.code == 0 ? textOf(folder / file) : "";
}

void RenderTest::expectRefused(Arguments arguments, int code, const std::string& said,
                               const std::string& help) const {
  writeText(folder / "kept.png", "what was here before");
  const std::size_t before = folder.entries();
  if (std::find(arguments.begin(), arguments.end(), "-o") == arguments.end())
    arguments.insert(arguments.end(), {"-o", "kept.png"});
  SCOPED_TRACE(fmt::format("luxo render luxo-grandpa {}", fmt::join(arguments, " ")));
  expectFailure(render(arguments), code, said, help);
  EXPECT_EQ(textOf(folder / "kept.png"), "what was here before");
  EXPECT_EQ(folder.entries(), before);
}

void DeviceRenderTest::SetUp() { requireDevice(); }

void requireDevice() {
  const std::vector<gpu::DeviceInfo> devices = gpu::listDevices();
  if (std::any_of(devices.begin(), devices.end(), [](const auto& device) { return device.usable(); })) return;
  const char* required = std::getenv("LUXO_REQUIRE_GPU");
  ASSERT_FALSE(required != nullptr && std::string_view(required) == "1") << gpu::noDriverHint();
  GTEST_SKIP() << gpu::noDriverHint();
}

}  // namespace luxo::test
