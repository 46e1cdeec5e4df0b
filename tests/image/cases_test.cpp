// SPDX-License-Identifier: Apache-2.0
// Scenes that once had wrong pixels nobody was told about: files of `cases`, each with its camera, size and
// samples. `luxo verify --random -o DIR` writes more of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "random/run.h"
#include "support/picture.h"

namespace luxo::test {
namespace {

std::vector<std::string> caseNames() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(LUXO_CASES)) {
    const std::string file = entry.path().filename().string();
    names.push_back(file.substr(0, file.find('.')));
  }
  std::ranges::sort(names);
  return names;
}

class Cases : public PictureTest, public testing::WithParamInterface<std::string> {};

INSTANTIATE_TEST_SUITE_P(All, Cases, testing::ValuesIn(caseNames()),
                         [](const auto& name) { return name.param; });

TEST_P(Cases, HaveNoPixelSilentlyWrong) {
  const random::Trial trial =
      random::tryFile(renderer(), std::filesystem::path(LUXO_CASES) / (GetParam() + ".luxo.json"),
                      {.extent = AuditExtent::None});  // which would mend it
  EXPECT_EQ(trial.silentlyWrong, 0U) << trial.wrong.hitMiss << " hit or miss, " << trial.wrong.layer
                                     << " layer, " << trial.wrong.point << " point, " << trial.wrong.light
                                     << " light, " << trial.wrongColors << " colours";
  EXPECT_GT(trial.pixels, 0U);
}

}  // namespace
}  // namespace luxo::test
