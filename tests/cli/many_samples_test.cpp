// SPDX-License-Identifier: Apache-2.0
// --samples beyond what a device takes in one pass.
#include <sys/wait.h>

#include <csignal>
#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "support/gpu_fixture.h"

namespace luxo::test {
namespace {

class ManySamples : public DeviceRenderTest {};
class TooManySamples : public RenderTest {};

TEST_F(ManySamples, AreCountedInTheReport) {
  ASSERT_NE(fileOf({"--samples", "16", "--report", "report.json"}, "a.png"), "");
  const auto frame = nlohmann::json::parse(textOf(folder / "report.json"))["frames"][0];
  const auto& count = frame["count"];
  // The lamp has one pass, or more where a search for a surface is repeated.
  EXPECT_GE(count["passes"], 16);
  EXPECT_LE(count["passes"], 32);
  EXPECT_EQ(count["submits"].get<int>(), count["passes"].get<int>() + 16) << "each is drawn, then added";
  EXPECT_EQ(count["nodes"], 9);
  EXPECT_GE(count["draw_calls"], 16 * 4);
  EXPECT_LE(frame["error"]["bound_px"], 0.5);
}

TEST_F(ManySamples, AreTheSameBytesOnAnyNumberOfThreads) {
  std::string first;
  for (const char* threads : {"1", "2", "3"}) {
    const ScopedVariable limited("LP_NUM_THREADS", threads);
    const std::string bytes = fileOf({"--samples", "7"}, "a.pfm");
    if (first.empty()) first = bytes;
    EXPECT_TRUE(bytes == first) << threads << " threads";
  }
}

TEST_F(ManySamples, EachNumberIsAPictureOfItsOwn) {
  const std::string four = fileOf({"--samples", "4"}, "a.pfm"), five = fileOf({"--samples", "5"}, "a.pfm");
  EXPECT_NE(four, five);
  EXPECT_NE(five, fileOf({"--samples", "256"}, "a.pfm"));
  EXPECT_EQ(five, fileOf({"--samples", "5", "--skip", "none"}, "a.pfm"));
}

// Minutes of work for a processor, stopped after a moment between two passes: no picture, whole or half.
TEST_F(ManySamples, StopInTheMiddleOfAPicture) {
  RunningProgram program({.arguments = {"render", "luxo-grandpa", "--samples", "256", "--size", "2048x2048",
                                        "-o", "a.png", "-q"},
                          .folder = folder.path()});
  program.interrupt(SIGINT);
  const Outcome outcome = program.wait();
  if (outcome.code == 0) GTEST_SKIP() << "the device was done before the signal came";
  EXPECT_EQ(outcome.code, 130) << outcome.err;
  EXPECT_EQ(folder.entries(), 0u);
}

TEST_F(TooManySamples, OnTheCommandLine) {
  for (const char* samples : {"0", "257", "1000000000", "99999999999999999999", "-1", "2.5"})
    expectRefused({"--samples", samples}, 2, std::string("--samples '") + samples + "'", "from 1 to 256");
}

TEST_F(TooManySamples, InTheScene) {
  for (const char* samples : {"0", "257", "1e9", "2.5"}) {
    writeText(
        folder / "many.luxo.json",
        std::string(R"({ "luxo": 1, "render": { "samples": )") + samples +
            R"( }, "surfaces": { "ball": { "type": "sphere" } }, "nodes": [ { "surface": "ball" } ] })");
    expectFailure(run(folder, {"render", "many.luxo.json", "-o", "a.png"}), 3,
                  "it must be a whole number from 1 to 256");
    EXPECT_FALSE(std::filesystem::exists(folder / "a.png"));
  }
}

}  // namespace
}  // namespace luxo::test
