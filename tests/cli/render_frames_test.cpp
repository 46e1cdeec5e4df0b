// SPDX-License-Identifier: Apache-2.0
// Sequences of `luxo render`, and the report of what was done.
#include <fmt/format.h>

#include <chrono>
#include <csignal>
#include <set>
#include <thread>

#include <nlohmann/json.hpp>

#include "cli/program.h"

namespace luxo::test {
namespace {

using Json = nlohmann::json;

class RenderFrames : public DeviceRenderTest {
 protected:
  [[nodiscard]] Json report() const { return Json::parse(textOf(folder / "report.json")); }
  [[nodiscard]] std::set<std::string> files() const {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
      names.insert(entry.path().filename().string());
    return names;
  }
};

using Names = std::set<std::string>;

Names keysOf(const Json& object) {
  Names keys;
  for (const auto& [key, value] : object.items()) keys.insert(key);
  return keys;
}

void expectKeys(const Json& object, const Names& expected) {
  const Names keys = keysOf(object);
  for (const std::string& key : expected) EXPECT_TRUE(keys.contains(key)) << key << " is missing";
}

TEST_F(RenderFrames, EveryFrameIsThePictureOfItsMoment) {
  const Outcome outcome =
      render({"-o", "f####.pfm", "--frames", "1-5:2,9", "--fps", "10", "--report", "report.json", "-q"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(files(), (Names{"f0001.pfm", "f0003.pfm", "f0005.pfm", "f0009.pfm", "report.json"}));
  const Json frames = report()["frames"];
  ASSERT_EQ(frames.size(), 4u);
  const int numbers[] = {1, 3, 5, 9};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(frames[i]["frame"], numbers[i]);
    EXPECT_EQ(frames[i]["time"], (numbers[i] - 1) / 10.0);
    EXPECT_EQ(frames[i]["file"], fmt::format("f{:04}.pfm", numbers[i]));
    EXPECT_TRUE(textOf(folder / frames[i]["file"].get<std::string>()) ==
                fileOf({"--time", fmt::format("{}/10", numbers[i] - 1)}, "alone.pfm"))
        << "frame " << numbers[i];
  }
  EXPECT_FALSE(textOf(folder / "f0001.pfm") == textOf(folder / "f0009.pfm")) << "the lamp turns";
}

TEST_F(RenderFrames, Names) {
  const std::pair<const char*, Names> patterns[] = {{"a##.png", {"a01.png", "a02.png"}},
                                                    {"a%03d.png", {"a001.png", "a002.png"}},
                                                    {"{frame:04}.png", {"0001.png", "0002.png"}},
                                                    {"a.png", {"a.0001.png", "a.0002.png"}}};
  for (const auto& [pattern, expected] : patterns) {
    const Outcome outcome = render({"-o", pattern, "--frames", "1,2"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(files(), expected);
    EXPECT_EQ(contains(outcome.err, "a.0001.png and so on"), std::string(pattern) == "a.png") << outcome.err;
    for (const std::string& name : expected) std::filesystem::remove(folder / name);
  }
}

TEST_F(RenderFrames, OneFrameKeepsItsNameAndHasItsTime) {
  EXPECT_EQ(fileOf({"--frames", "49"}, "a.pfm"), fileOf({"--time", "2"}, "b.pfm")) << "24 frames per second";
}

TEST_F(RenderFrames, VerboseNamesEveryFrame) {
  const Outcome outcome = render({"-o", "a#.png", "--frames", "1,2", "-v"});
  EXPECT_TRUE(contains(outcome.err, "a1.png  67x45")) << outcome.err;
  EXPECT_TRUE(contains(outcome.err, "a2.png  67x45")) << outcome.err;
  EXPECT_EQ(outcome.out, "");
}

TEST_F(RenderFrames, ReportHasEveryDocumentedName) {
  ASSERT_NE(fileOf({"--report", "report.json"}, "a.png"), "");
  const Json json = report();
  expectKeys(json, {"luxo", "report", "device", "scene", "size", "startup_ms", "frames"});
  expectKeys(json["device"], {"name", "type", "driver", "sin_cos"});
  expectKeys(json["device"]["sin_cos"], {"used", "max_error", "driver_max_error"});
  EXPECT_EQ(json["device"]["sin_cos"]["used"], "own");
  EXPECT_LE(json["device"]["sin_cos"]["max_error"], 0x1p-20);
  EXPECT_EQ(run(folder, {"--version"}).out, fmt::format("luxo {}\n", json["luxo"].get<std::string>()));
  EXPECT_EQ(json["report"], 1);
  EXPECT_EQ(json["scene"], "luxo-grandpa");
  EXPECT_EQ(json["size"], Json({kWidth, kHeight}));
  EXPECT_GT(json["startup_ms"], 0);
  for (const char* key : {"name", "type", "driver"})
    EXPECT_NE(json["device"][key].get<std::string>(), "") << key;
  ASSERT_EQ(json["frames"].size(), 1u);
  const Json& frame = json["frames"][0];
  expectKeys(frame, {"frame", "time", "file", "ms", "count", "error"});
  EXPECT_EQ(frame["frame"], 1);
  EXPECT_EQ(frame["time"], 21.0);
  EXPECT_EQ(frame["file"], "a.png");
  expectKeys(frame["ms"], {"total", "animate", "tessellate", "cull", "upload", "gpu", "readback", "encode"});
  double parts = 0;
  for (const auto& [key, value] : frame["ms"].items()) {
    if (key == "passes") continue;
    EXPECT_GE(value, 0) << key;
    if (key != "total" && key != "gpu") parts += value.get<double>();  // gpu is another clock
  }
  EXPECT_GE(frame["ms"]["total"].get<double>() * (1 + 1e-9), parts) << "a sum of doubles, in another order";
}

// The device's time is that of passes and of what is beside them, of all attempts and samples together.
TEST_F(RenderFrames, ReportTellsTheTimeOfEachPass) {
  for (const char* samples : {"1", "8"}) {
    const Outcome outcome = render({"-o", "a.png", "--samples", samples, "--report", "report.json"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const Json ms = Json::parse(textOf(folder / "report.json"))["frames"][0]["ms"];
    if (ms["passes"].empty()) GTEST_SKIP() << "the device has no timestamps";
    double sum = 0;
    for (const auto& [name, milliseconds] : ms["passes"].items()) sum += milliseconds.get<double>();
    EXPECT_NEAR(sum, ms["gpu"].get<double>(), 1e-6 * sum);
    EXPECT_TRUE(ms["passes"].contains("found"));
    EXPECT_EQ(ms["passes"].contains("average"), samples[0] == '8');
  }
}

TEST_F(RenderFrames, ReportCountsAddUp) {
  const Outcome outcome = render({"-o", "a#.png", "--frames", "1,2", "--report", "report.json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Json frames = report()["frames"];
  for (const Json& frame : frames) {
    const Json& count = frame["count"];
    expectKeys(count, {"nodes", "drawn", "culled_frustum", "culled_small", "culled_backface", "draw_calls",
                       "instances", "triangles", "vertices", "submits", "upload_bytes", "tessellated",
                       "pipelines_created", "passes", "shadow_passes"});
    const auto of = [&](const char* name) { return count[name].get<std::uint64_t>(); };
    EXPECT_EQ(of("nodes"), 9u);  // floor, base, its top, three joints, two rods, shade
    EXPECT_EQ(of("drawn") + of("culled_frustum") + of("culled_small") + of("culled_backface"), of("nodes"));
    EXPECT_GE(of("instances"), of("drawn"));
    EXPECT_LE(of("draw_calls"), of("instances"));
    EXPECT_GT(of("triangles"), 0u);
    EXPECT_GT(of("vertices"), 0u);
    EXPECT_EQ(of("shadow_passes"), 0u) << "the lamp's shadow is in closed form";
    EXPECT_EQ(of("submits"), 1u);
    const Json& error = frame["error"];
    expectKeys(error, {"tolerance_px", "bound_px", "residual_max_px", "unconverged_px", "uncertified_px"});
    EXPECT_EQ(error["tolerance_px"], 0.5);
    EXPECT_EQ(error["bound_px"], 0) << "no mesh is drawn";
    EXPECT_GT(error["residual_max_px"], 0);
    EXPECT_LE(error["residual_max_px"], 1e-3) << "what exact shading promises";
    EXPECT_EQ(error["unconverged_px"], 0);
    // Proofs fail at most where the surface turns away from the viewer: beside outlines.
    EXPECT_LT(error["uncertified_px"], kWidth);
  }
  EXPECT_GT(frames[0]["count"]["pipelines_created"], 0);
  EXPECT_EQ(frames[1]["count"]["pipelines_created"], 0) << "they are kept";
}

TEST_F(RenderFrames, ReportOfMeshesHasTheirBound) {
  ASSERT_EQ(render({"-o", "a.png", "--shading", "phong", "--report", "report.json"}).code, 0);
  const Json error = report()["frames"][0]["error"];
  EXPECT_GT(error["bound_px"], 0);
  EXPECT_LE(error["bound_px"], 0.5);
  for (const char* key : {"residual_max_px", "unconverged_px", "uncertified_px"})
    EXPECT_TRUE(error[key].is_null()) << key << ": no surface was searched for";
}

TEST_F(RenderFrames, ReportOfMeshesInShadowHasTheRaysOfThese) {
  ASSERT_EQ(run(folder, {"render", "shadows", "--shading", "phong", "--size", "40x30", "-o", "a.png",
                         "--report", "report.json", "-q"})
                .code,
            0);
  const Json error = report()["frames"][0]["error"];
  for (const char* key : {"unconverged_px", "uncertified_px", "resolved_by_rays_px", "shadow_rays_px"})
    EXPECT_TRUE(error[key].is_number()) << key;
  for (const char* key : {"residual_max_px", "audited_px"})
    EXPECT_TRUE(error[key].is_null()) << key << ": no surface was searched for";
}

TEST_F(RenderFrames, RequiredErrorOfExactPictures) {
  EXPECT_EQ(render({"-o", "a.png", "--require-error", "0.01px"}).code, 0);
  const std::string whole = textOf(folder / "a.png");
  const Outcome missed =
      render({"-o", "b.png", "--require-error", "1e-9px", "--report", "report.json", "-q"});
  expectFailure(missed, 6, "frame 1: the largest residual is", "--engine reference");
  EXPECT_TRUE(contains(missed.err, "more than the 1e-09 px required")) << missed.err;
  EXPECT_EQ(textOf(folder / "b.png"), whole) << "the picture is written all the same";
  EXPECT_GT(report()["frames"][0]["error"]["residual_max_px"], 1e-9);
  // Of geometry it is that of the surfaces in its pixels, too.
  EXPECT_EQ(render({"-o", "a.exr", "--aov", "depth", "--require-error", "0.01px"}).code, 0);
  expectFailure(render({"-o", "a.exr", "--aov", "depth", "--require-error", "1e-9px", "-q"}), 6,
                "frame 1: the largest residual is", "--engine reference");
}

TEST_F(RenderFrames, RequiredErrorDecidesTheExitCode) {
  EXPECT_EQ(render({"-o", "a.png", "--shading", "phong", "--require-error", "0.5"}).code, 0);
  const std::string whole = textOf(folder / "a.png");
  const Outcome missed = render(
      {"-o", "b.png", "--shading", "phong", "--require-error", "0.001px", "--report", "report.json", "-q"});
  expectFailure(missed, 6, "frame 1: the proven error is", "a smaller --tolerance");
  EXPECT_TRUE(contains(missed.err, "more than the 0.001 px required")) << missed.err;
  EXPECT_EQ(textOf(folder / "b.png"), whole) << "the picture is written all the same";
  EXPECT_GT(report()["frames"][0]["error"]["bound_px"], 0.001);
  EXPECT_EQ(
      render({"-o", "a.png", "--shading", "phong", "--require-error", "0.02", "--tolerance", "0.02"}).code,
      0);
}

TEST_F(RenderFrames, AFrameThatCannotBeWrittenSpoilsOnlyItself) {
  std::filesystem::create_directory(folder / "f2.pfm");
  const Outcome outcome = render({"-o", "f#.pfm", "--frames", "1-3", "--report", "report.json", "-q"});
  expectFailure(outcome, 7, "frame 2: cannot write 'f2.pfm': Is a directory", "add a file name");
  EXPECT_EQ(files(), (Names{"f1.pfm", "f2.pfm", "f3.pfm", "report.json"}));
  EXPECT_EQ(textOf(folder / "f1.pfm"), fileOf({"--time", "0"}, "alone.pfm"));
  EXPECT_EQ(textOf(folder / "f3.pfm"), fileOf({"--time", "2/24"}, "alone.pfm"));
  const Json frames = report()["frames"];
  ASSERT_EQ(frames.size(), 3u);
  EXPECT_EQ(frames[0]["file"], "f1.pfm");
  EXPECT_TRUE(frames[1]["file"].is_null());
  EXPECT_TRUE(contains(frames[1]["failure"].get<std::string>(), "cannot write 'f2.pfm'"));
  EXPECT_EQ(frames[2]["file"], "f3.pfm");
  EXPECT_FALSE(frames[0].contains("failure"));
}

/// The program, told to stop in the middle of far more frames than the test has time for.
class Interrupted : public RenderFrames, public testing::WithParamInterface<int> {};

TEST_P(Interrupted, FinishedFramesAreWholeAndKept) {
  RunningProgram program(
      rendering({"-o", "f#####.pfm", "--frames", "1-100000", "--report", "report.json", "-q"}));
  for (int tries = 0; tries < 6000 && !std::filesystem::exists(folder / "f00003.pfm"); ++tries)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  program.send(GetParam());
  const Outcome outcome = program.wait();
  EXPECT_EQ(outcome.code, 128 + GetParam()) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  const Json frames = report()["frames"];
  EXPECT_GE(frames.size(), 3u);
  EXPECT_LT(frames.size(), 100000u);
  Names expected = {"report.json"};
  for (const Json& frame : frames) {
    const auto file = frame["file"].get<std::string>();
    expected.insert(file);
    EXPECT_EQ(std::filesystem::file_size(folder / file),
              std::size_t(kWidth * kHeight * 12) + std::string("PF\n67 45\n-1.0\n").size())
        << file;
  }
  EXPECT_EQ(files(), expected) << "what is reported is there, and nothing else";
  const std::string last = frames.back()["file"];
  const auto time = fmt::format("{}/24", frames.back()["frame"].get<int>() - 1);
  EXPECT_TRUE(textOf(folder / last) == fileOf({"--time", time}, "alone.pfm")) << last;
}

INSTANTIATE_TEST_SUITE_P(Signals, Interrupted, testing::Values(SIGINT, SIGTERM),
                         [](const auto& test) { return test.param == SIGINT ? "SIGINT" : "SIGTERM"; });

}  // namespace
}  // namespace luxo::test
