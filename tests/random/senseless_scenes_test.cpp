// SPDX-License-Identifier: Apache-2.0
// Scenes whose numbers and formulas have been made extreme or senseless: each is refused, or its picture has
// a finite colour in every pixel.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "fuzz/mutation.h"
#include "scene/scene_builder.h"
#include "scene/scene_reader.h"
#include "scene/snapshot.h"
#include "support/picture.h"

namespace luxo::test {
namespace {

constexpr PixelSize kSize{32, 24};
constexpr int kMutations = 600;  // two thirds are refused
constexpr std::uint64_t kSeed = 20261123;

constexpr std::string_view kWords[] = {
    "0",       "-1",         "1e-30",       "1e-300",        "1e18",       "1e30",
    "3e38",    "1e39",       "1e300",       "0.5",           "1e-7",       "16777217",
    "\"1/u\"", "\"log(v)\"", "\"1/(v-v)\"", "\"exp(99*u)\"", "\"1e30*u\"", "\"sqrt(u-3)\"",
    "\"u^9\"", "\"tan(u)\"", "\"w\"",       "\"k*1e37\"",    "\"0*u\"",    "\"u/v\"",
    "\"t\"",   "[0,0,0]",    "[1e20,0,0]",
};

class SenselessScenes : public PictureTest, public testing::WithParamInterface<Shading> {};

INSTANTIATE_TEST_SUITE_P(Shadings, SenselessScenes,
                         testing::Values(Shading::Gouraud, Shading::Phong, Shading::Exact));

std::optional<Snapshot> snapshotOf(const std::string& text) {
  try {
    return takeSnapshot(buildScene(parseScene(text, "fuzz.luxo.json")), 0.5, kSize);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::Scene) << error.what();
    return std::nullopt;
  }
}

TEST_P(SenselessScenes, HaveNoPixelThatIsNoNumber) {
  std::map<std::string, std::string> byName;
  for (const auto& entry : std::filesystem::directory_iterator(LUXO_FUZZ_CORPUS "/picture")) {
    std::ifstream file(entry.path(), std::ios::binary);
    byName[entry.path().filename()] = std::string(std::istreambuf_iterator<char>(file), {});
  }
  std::vector<std::string> corpus;
  for (auto& [name, text] : byName) corpus.push_back(std::move(text));
  ASSERT_GE(corpus.size(), 4u);
  Mutator mutator(corpus, kWords, kSeed + static_cast<std::uint64_t>(GetParam()));
  int drawn = 0;
  for (int i = 0; i < kMutations; ++i) {
    const std::string text = mutator.next();
    const auto snapshot = snapshotOf(text);
    if (!snapshot) continue;
    ++drawn;
    const Picture picture =
        renderer().render(*snapshot, {.shading = GetParam(), .tolerancePx = 0.5, .samples = 1});
    ASSERT_EQ(picture.statistics.error.nonfinitePx, 0u) << text;
    for (const float value : picture.image.samples()) ASSERT_TRUE(std::isfinite(value)) << text;
  }
  EXPECT_GT(drawn, kMutations / 10);
}

}  // namespace
}  // namespace luxo::test
