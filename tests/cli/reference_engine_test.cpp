// SPDX-License-Identifier: Apache-2.0
// `luxo render --engine reference`: pictures without any Vulkan driver, what is said of them, and refusals.
#include <algorithm>
#include <csignal>
#include <cstring>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "support/gpu_fixture.h"

namespace luxo::test {
namespace {

using Json = nlohmann::json;

/// Every test runs without a driver.
class ReferenceEngine : public RenderTest {
 protected:
  [[nodiscard]] Outcome cast(Arguments arguments) const {
    arguments.insert(arguments.end(), {"--engine", "reference"});
    return render(arguments);
  }
  [[nodiscard]] Json report() const { return Json::parse(textOf(folder / "report.json")); }

 private:
  ScopedVariable driver_{"VK_DRIVER_FILES", "/nonexistent"}, legacy_{"VK_ICD_FILENAMES", "/nonexistent"};
};

/// The samples of a .pfm file of kWidth x kHeight, rows from the bottom to the top.
std::vector<float> numbersOf(const std::string& file, std::size_t count) {
  std::vector<float> numbers(count);
  EXPECT_GT(file.size(), count * sizeof(float));
  if (file.size() > count * sizeof(float))
    std::memcpy(numbers.data(), file.data() + file.size() - count * sizeof(float), count * sizeof(float));
  return numbers;
}

TEST_F(ReferenceEngine, ReportsWhatIsProven) {
  const Outcome outcome = cast({"-o", "a.png", "--samples", "3", "--report", "report.json", "-q"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.out + outcome.err, "");
  const Json json = report();
  EXPECT_EQ(json["device"],
            Json({{"name", "reference"}, {"type", "cpu"}, {"driver", nullptr}, {"sin_cos", nullptr}}));
  const Json& frame = json["frames"][0];
  const Json& reference = frame["reference"];
  EXPECT_EQ(reference["hits"].get<int>() + reference["misses"].get<int>() + reference["undecided"].get<int>(),
            kWidth * kHeight);
  EXPECT_GT(reference["hits"], kWidth * kHeight / 4) << "the floor fills the lower half";
  EXPECT_EQ(reference["undecided"], 0);
  EXPECT_EQ(frame["error"]["bound_px"], 0);
  EXPECT_GT(reference["standard_error_rms"], 0) << "edges differ from sample to sample";
  EXPECT_GE(reference["standard_error_max"], reference["standard_error_rms"]);
  EXPECT_GT(frame["ms"]["total"], 0);
  EXPECT_EQ(frame["count"]["nodes"], 9);
  for (const auto& [group, name] :
       {std::pair("ms", "gpu"), {"count", "triangles"}, {"error", "tolerance_px"}})
    EXPECT_TRUE(frame[group].at(name).is_null()) << name;
}

TEST_F(ReferenceEngine, OneSampleHasNoStandardError) {
  EXPECT_EQ(cast({"-o", "a.png", "--report", "report.json", "--require-error", "0.001px"}).code, 0);
  EXPECT_EQ(report()["frames"][0]["reference"]["standard_error_max"], 0);
}

TEST_F(ReferenceEngine, Frames) {
  const Outcome outcome = cast({"-o", "f#.pfm", "--frames", "1,2", "--report", "report.json"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(report()["frames"].size(), 2u);
  EXPECT_NE(textOf(folder / "f1.pfm"), textOf(folder / "f2.pfm")) << "the lamp turns";
}

// Every output, of the lamp's sky and floor: what each says of one pixel follows from the others.
TEST_F(ReferenceEngine, Outputs) {
  const std::size_t pixels = std::size_t(kWidth * kHeight);
  const auto numbers = [&](const std::string& output, std::size_t channels) {
    const Outcome outcome = cast({"-o", output + ".pfm", "--aov", output, "--samples", "16", "-q"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return numbersOf(textOf(folder / (output + ".pfm")), pixels * channels);
  };
  const auto depth = numbers("depth", 1), id = numbers("id", 1);
  const auto normal = numbers("normal", 3), position = numbers("position", 3), uv = numbers("uv", 3);
  for (std::size_t i = 0; i < pixels; ++i) {
    const double length = std::hypot(normal[3 * i], normal[3 * i + 1], normal[3 * i + 2]);
    EXPECT_NEAR(length, id[i] == 0 ? 0 : 1, 1e-6);
    EXPECT_EQ(std::isinf(depth[i]), id[i] == 0);
    EXPECT_EQ(id[i], std::floor(id[i])) << "of the centre, never averaged";
    EXPECT_EQ(uv[3 * i + 2], 0);
  }
  // The lowest row, first in the file, is all floor: y = 0, normal +Y, seen from about 20 m away.
  for (std::size_t x = 0; x < std::size_t(kWidth); ++x) {
    EXPECT_EQ(id[x], id[0]);
    EXPECT_NEAR(position[3 * x + 1], 0, 1e-12);
    EXPECT_EQ(normal[3 * x + 1], 1);
    EXPECT_GT(depth[x], 5);
    EXPECT_LT(depth[x], 20);
  }
}

TEST_F(ReferenceEngine, HasNoResidual) {
  EXPECT_EQ(cast({"-o", "residual.pfm", "--aov", "residual", "-q"}).code, 0);
  const std::vector<float> residual =
      numbersOf(textOf(folder / "residual.pfm"), std::size_t(kWidth * kHeight));
  EXPECT_EQ(std::count(residual.begin(), residual.end(), 0.0f), kWidth * kHeight);
}

TEST_F(ReferenceEngine, Refusals) {
  const auto refused = [&](Arguments arguments, int code, const std::string& said, const std::string& help) {
    arguments.insert(arguments.end(), {"-o", "a.png"});
    expectFailure(cast(arguments), code, said, help);
    EXPECT_EQ(folder.entries(), 0u);
  };
  refused({"--shading", "wireframe"}, 3, "shading 'wireframe' has no ground truth", "--shading phong");
  refused({"--shading", "normal"}, 3, "shading 'normal' has no ground truth", "--aov");
  refused({"--shading", "residual"}, 3, "shading 'residual' has no ground truth", "--aov");
  refused({"--device", "gpu"}, 2, "--device and --engine reference contradict", "");
  refused({"--samples", "257"}, 2, "--samples '257'", "1 to 256");
  expectFailure(run(folder, {"view", "primitives", "--engine", "reference"}), 2, "means nothing in a window",
                "");
}

TEST_F(ReferenceEngine, RefusesMaterialsThatAreNotLight) {
  writeText(folder / "inky.luxo.json", R"({ "luxo": 1, "materials": { "inky": { "shading": "wireframe" } },
    "surfaces": { "ball": { "type": "sphere" } }, "nodes": [ { "surface": "ball", "material": "inky" } ] })");
  const Outcome outcome =
      run(folder, {"render", "inky.luxo.json", "-o", "a.png", "--size", "8x8", "--engine", "reference"});
  expectFailure(outcome, 3, "material 'inky' is shaded as wireframe, which has no ground truth",
                "--engine vulkan");
  EXPECT_FALSE(std::filesystem::exists(folder / "a.png"));
}

// Of a map, which rays have none of, the reference shows the shadow that it stands for.
TEST_F(ReferenceEngine, ShadowsOfMapsAreTheExactOnes) {
  const auto picture = [&](const std::string& shadow) {
    writeText(folder / "ball.luxo.json", R"({ "luxo": 1,
      "surfaces": { "floor": { "type": "rectangle", "size": [8, 8] }, "ball": { "type": "sphere" } },
      "camera": { "eye": [0, 6, 6], "look_at": [0, 0, 0], "fov_y": "50deg" },
      "nodes": [ { "name": "floor", "surface": "floor" }, { "surface": "ball", "translate": [0, 2, 0] },
                 { "translate": [1, 6, 1], "light": { "radius": 0.1, "shadow": ")" +
                                             shadow + R"(" } } ] })");
    const Outcome outcome = run(folder, {"render", "ball.luxo.json", "-o", shadow + ".pfm", "--size", "40x30",
                                         "--engine", "reference"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.err.find("not exact"), std::string::npos) << outcome.err;
    return textOf(folder / (shadow + ".pfm"));
  };
  EXPECT_EQ(picture("map"), picture("exact"));
  EXPECT_NE(picture("map"), picture("none"));
}

// What is flattened onto a plane is on that alone, for rays, too.
TEST_F(ReferenceEngine, ShadowsOnAPlaneAreToldNotToBeExact) {
  writeText(folder / "ball.luxo.json", R"({ "luxo": 1,
    "surfaces": { "floor": { "type": "rectangle", "size": [8, 8] }, "ball": { "type": "sphere" } },
    "nodes": [ { "name": "floor", "surface": "floor" }, { "surface": "ball", "translate": [0, 2, 0] },
               { "translate": [1, 6, 1], "light": { "shadow": "planar", "shadow_plane": "floor" } } ] })");
  const Outcome outcome =
      run(folder, {"render", "ball.luxo.json", "-o", "a.pfm", "--size", "8x6", "--engine", "reference"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("not exact"), std::string::npos) << outcome.err;
}

// Hours of work, stopped after a moment: there is no picture, whole or half.
TEST_F(ReferenceEngine, StopsInTheMiddleOfAPicture) {
  RunningProgram program({.arguments = {"render", "luxo-grandpa", "--engine", "reference", "--samples", "256",
                                        "--size", "4096x4096", "-o", "a.png", "-q"},
                          .folder = folder.path()});
  program.interrupt(SIGINT);
  const Outcome outcome = program.wait();
  EXPECT_EQ(outcome.code, 130) << outcome.err;
  EXPECT_EQ(folder.entries(), 0u);
}

}  // namespace
}  // namespace luxo::test
