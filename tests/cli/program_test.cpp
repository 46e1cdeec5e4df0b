// SPDX-License-Identifier: Apache-2.0
// The program as a user meets it: exit code, stdout, stderr.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <sys/resource.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <new>
#include <thread>

#include "cli/program.h"
#include "console.h"
#include "exit_code.h"
#include "image/file.h"
#include "image/format.h"
#include "image/srgb.h"
#include "unit/image_test_support.h"

namespace luxo::test {
namespace {

/// a.png, b.png that differ by three codes in the blue of pixel (1, 0), and c.pfm, whose encode is a.png.
class DiffTest : public testing::Test {
 protected:
  DiffTest() {
    Image image(2, 2, 3);
    for (float& sample : image.samples()) sample = decodeSrgb8(100);
    image.save(folder / "a.png");
    for (float& sample : image.samples()) sample = std::nextafter(sample, 1.0f);
    image.save(folder / "c.pfm");
    image.pixel(1, 0)[2] = decodeSrgb8(103);
    image.save(folder / "b.png");
  }

  ScratchFolder folder;
};

TEST(Program, VersionAndHelpAreData) {
  const ScratchFolder folder;
  const Outcome version = run(folder, {"--version"});
  EXPECT_EQ(version.code, 0);
  EXPECT_TRUE(version.out.starts_with("luxo ")) << version.out;
  EXPECT_EQ(version.err, "");
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"--help"}, {"diff", "--help"}}) {
    const Outcome help = run(folder, arguments);
    EXPECT_EQ(help.code, 0);
    EXPECT_NE(help.out.find("diff"), std::string::npos);
    EXPECT_EQ(help.err, "");
  }
}

TEST(Program, MistakesAreUsageErrors) {
  const ScratchFolder folder;
  expectFailure(run(folder, {}), 2, "no verb");
  expectFailure(run(folder, {"dif", "a", "b"}), 2, "help: did you mean 'diff'?");
  expectFailure(run(folder, {"diff", "a.png", "b.png", "--maxx", "1"}), 2, "help: did you mean '--max'?");
  expectFailure(run(folder, {"diff", "a.png"}), 2, "two pictures");
  expectFailure(run(folder, {"diff", "a.png", "b.jpg"}), 2, "'.jpg'");
  expectFailure(run(folder, {"diff", "a.png", "b.png", "--max", "x"}), 2, "--max 'x'");
  expectFailure(run(folder, {"diff", "a.png", "b.png", "--mean", "-1"}), 2, "below 0");
}

TEST_F(DiffTest, PrintsTheNumbers) {
  const Outcome outcome = run(folder, {"diff", "a.png", "b.png"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_NE(outcome.out.find(fmt::format("max {} at 1,0\n", 3 / 255.0)), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("differing 1 of 4 pixels"), std::string::npos) << outcome.out;
}

TEST_F(DiffTest, JsonIsTheOnlyThingOnStdout) {
  const Outcome outcome = run(folder, {"--json", "a.png", "b.png"});
  EXPECT_EQ(outcome.code, 2);
  const auto json = nlohmann::json::parse(run(folder, {"diff", "--json", "a.png", "b.png"}).out);
  EXPECT_DOUBLE_EQ(json["max"], 3 / 255.0);
  EXPECT_DOUBLE_EQ(json["mean"], 3 / 255.0 / 12);
  EXPECT_EQ(json["max_at"], nlohmann::json({1, 0}));
  EXPECT_EQ(json["size"], nlohmann::json({2, 2}));
  EXPECT_EQ(json["differing_pixels"], 1);
  EXPECT_EQ(json["differing_part"], 0.25);
  // Only one sample of twelve differs, by 3/255 in code: as psnr, which is of codes here.
  EXPECT_NEAR(json["psnr_srgb"], json["psnr"], 1e-4);
  EXPECT_NE(json["psnr_linear"], json["psnr"]);
  EXPECT_GT(json["flip"]["mean"], 0);
  EXPECT_LE(json["flip"]["mean"], json["flip"]["max"]);
  EXPECT_EQ(json["equal"], false);
  EXPECT_EQ(json["space"], "srgb8");
  const auto same = nlohmann::json::parse(run(folder, {"diff", "a.png", "a.png", "--json"}).out);
  EXPECT_EQ(same["equal"], true);
  EXPECT_TRUE(same["psnr"].is_null());
}

TEST_F(DiffTest, AFloatFileIsComparedWithAnEightBitOneByItsCodes) {
  const auto json = nlohmann::json::parse(run(folder, {"diff", "a.png", "c.pfm", "--json"}).out);
  EXPECT_EQ(json["max"], 0.0);
}

TEST_F(DiffTest, LimitsDecideTheExitCode) {
  EXPECT_EQ(run(folder, {"diff", "a.png", "b.png", "--max", "3/255"}).code, 0);
  EXPECT_EQ(run(folder, {"--", "diff"}).code, 2);
  const Outcome above = run(folder, {"diff", "a.png", "--max", "2/255", "b.png"});
  EXPECT_EQ(above.code, 6);
  EXPECT_NE(above.err.find("error: the largest difference"), std::string::npos) << above.err;
  EXPECT_NE(above.out.find("max "), std::string::npos) << "the numbers are printed all the same";
  EXPECT_EQ(run(folder, {"diff", "a.png", "b.png", "--mean", "0.0009"}).code, 6);  // 3 / 255 / 12 = 0.00098
  EXPECT_EQ(run(folder, {"diff", "a.png", "b.png", "--mean", "0.001"}).code, 0);
}

TEST_F(DiffTest, WritesAHeatMap) {
  const Outcome outcome = run(folder, {"diff", "a.png", "b.png", "-o", "heat.png"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  const Image heat = loadImage(folder / "heat.png");
  for (const float sample : heat.pixel(0, 0)) EXPECT_EQ(sample, 0.0f);
  EXPECT_GT(heat.pixel(1, 0)[0], 0.5f);
}

TEST_F(DiffTest, WorldFailuresHaveTheirCodes) {
  expectFailure(run(folder, {"diff", "a.png", "none.png"}), 3, "none.png");
  expectFailure(run(folder, {"diff", "a.png", "b.png", "-o", "missing/heat.png"}), 5,
                "No such file or directory");
  Image(3, 2, 3).save(folder / "wide.png");
  expectFailure(run(folder, {"diff", "a.png", "wide.png"}), 6, "2 x 2");
  writeFileAtomically(folder / "broken.png", readFile(folder / "c.pfm"));
  expectFailure(run(folder, {"diff", "a.png", "broken.png"}), 3, "broken.png");
  if (std::filesystem::exists("/dev/full"))
    expectFailure(run(folder, {"diff", "a.png", "b.png"}, "/dev/full"), 5, "standard output");
}

TEST(ExitCode, OfEveryKind) {
  const std::pair<ErrorKind, int> kinds[] = {
      {ErrorKind::Internal, 1}, {ErrorKind::Usage, 2},       {ErrorKind::Scene, 3}, {ErrorKind::Device, 4},
      {ErrorKind::Write, 5},    {ErrorKind::Requirement, 6}, {ErrorKind::Retry, 75}};
  for (const auto& [kind, code] : kinds) {
    testing::internal::CaptureStderr();
    EXPECT_EQ(runToExitCode([k = kind]() -> int { throw Error(k, "it broke", "try again"); }), code);
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "error: it broke\nhelp: try again\n");
  }
  testing::internal::CaptureStderr();
  EXPECT_EQ(runToExitCode([] { return 7; }), 7);
  EXPECT_EQ(runToExitCode([]() -> int { throw std::bad_alloc(); }), 75);
  EXPECT_EQ(runToExitCode([]() -> int { throw std::runtime_error("surprise"); }), 1);
  EXPECT_NE(testing::internal::GetCapturedStderr().find("surprise"), std::string::npos);
}

TEST(ExitCodeDeathTest, MemoryThatIsShortWhereNothingCatches) {
  const auto draw = [] {
    std::thread([] { throw std::bad_alloc(); }).join();
    return 0;
  };
  EXPECT_EXIT(std::exit(runToExitCode(draw)), testing::ExitedWithCode(75),
              "error: out of memory\nhelp: ask for a smaller size, or try again");
}

// As a driver's compiler does.
TEST(ExitCodeDeathTest, MemoryThatIsShortWhereOneAborts) {
#ifdef LUXO_SANITIZED
  GTEST_SKIP() << "sanitizers map terabytes";
#endif
  const auto abortsWith = [](std::uint64_t bytesLeft) {
    std::uint64_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    const std::uint64_t most = pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE)) + bytesLeft;
    const rlimit limit{most, most};
    setrlimit(RLIMIT_AS, &limit);
    std::exit(runToExitCode([]() -> int { std::abort(); }));
  };
  EXPECT_EXIT(abortsWith(64 << 20), testing::ExitedWithCode(75), "error: out of memory");
  EXPECT_EXIT(abortsWith(std::uint64_t{1} << 32), testing::KilledBySignal(SIGABRT), "");
}

TEST(Console, ColoursOnlyTheLabels) {
  const Error error(ErrorKind::Usage, "what", "hint");
  EXPECT_EQ(errorText(error, false), "error: what\nhelp: hint\n");
  EXPECT_EQ(errorText(error, true), "\x1b[1;31merror:\x1b[0m what\n\x1b[1;32mhelp:\x1b[0m hint\n");
  EXPECT_EQ(errorText(Error(ErrorKind::Usage, "what"), false), "error: what\n");
}

}  // namespace
}  // namespace luxo::test
