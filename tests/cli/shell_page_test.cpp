// SPDX-License-Identifier: Apache-2.0
// The page of the bounding shells follows two pixels: what it says of them is what its commands say.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>
#include <regex>
#include <string>

#include "cli/program.h"
#include "image/format.h"

namespace luxo::test {
namespace {

using Json = nlohmann::json;

/// Runs the page's commands in the folder of its pictures, and writes elsewhere.
class ShellPage : public testing::Test {
 protected:
  [[nodiscard]] Json told(Arguments arguments) const {
    arguments.insert(arguments.begin() + 1, "knot.luxo.json");
    const Outcome outcome = run(Launch{.arguments = arguments, .folder = shell_ / "pictures"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return Json::parse(outcome.out);
  }

  void expectToSay(const std::string& words) const {
    EXPECT_TRUE(contains(page_, words)) << "engine/shell/README.md does not say: " << words;
  }

  const std::filesystem::path shell_ = std::filesystem::path(LUXO_SOURCE_DIR) / "engine/shell";
  const std::string page_ = std::regex_replace(textOf(shell_ / "README.md"), std::regex("\n"), " ");
  ScratchFolder folder_;
};

TEST_F(ShellPage, ItsPointIsTheFormulas) {
  const Json point = told({"inspect", "--pixel", "250,200", "--json"})["points"][0];
  expectToSay(
      fmt::format("Take pixel (250, 200) of the picture above. Its point is `u = {:.5f}, v = {:.5f}` "
                  "at depth {:.4f} m.",
                  point["uv"][0].get<double>(), point["uv"][1].get<double>(), point["depth"].get<double>()));
}

TEST_F(ShellPage, ItsExampleIsWhatIsDrawn) {
  requireDevice();
  std::string device;
  const auto aov = [&](const std::string& name) {
    const std::filesystem::path file = folder_ / (name + ".pfm");
    device = told({"render", "--aov", name, "-o", file.string(), "--report", "-"})["device"]["name"]
                 .get<std::string>();
    return loadImage(file);
  };
  const Image certificate = aov("certificate"), residual = aov("residual");
  if (!contains(page_, "`" + device + "`")) GTEST_SKIP() << "the page is not about " << device;

  const auto count = [&](float number) { return std::ranges::count(certificate.samples(), number); };
  EXPECT_EQ(count(3), 0);
  const auto byRays = count(2), points = count(1) + byRays;
  expectToSay(fmt::format("the {} of {},{:03} points that rays found", byRays, points / 1000, points % 1000));
  expectToSay(fmt::format("what is counted stays open; above {} pixels", byRays));

  std::smatch said;
  ASSERT_TRUE(std::regex_search(
      page_, said,
      std::regex(R"(Our pixel ends at step 7 with residual ([0-9.e-]+) px and certificate )"
                 R"((\d)\. Pixel \((\d+), (\d+)\)[^.]* ends at step 9: certificate (\d)\.)")));
  EXPECT_EQ(certificate.pixel(250, 200)[0], std::stof(said[2]));
  // Rounded, and a search that ends a step later is nearer to its ray.
  EXPECT_GT(residual.pixel(250, 200)[0], std::stof(said[1]) / 3);
  EXPECT_LT(residual.pixel(250, 200)[0], std::stof(said[1]) * 3);

  const int x = std::stoi(said[3]), y = std::stoi(said[4]);
  EXPECT_EQ(certificate.pixel(x, y)[0], std::stof(said[5]));
  const Json grazed = told({"inspect", "--pixel", fmt::format("{},{}", x, y), "--json"});
  const Json &way = grazed["ray"]["direction"], &normal = grazed["points"][0]["normal"];
  double cosine = 0;
  for (std::size_t i = 0; i < 3; ++i) cosine += way[i].get<double>() * normal[i].get<double>();
  expectToSay(fmt::format("Pixel ({}, {}), whose ray is {:.0f} degrees off the normal", x, y,
                          std::acos(std::abs(cosine)) * 180 / std::numbers::pi));
}

}  // namespace
}  // namespace luxo::test
