// SPDX-License-Identifier: Apache-2.0
#include "scene_examples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

namespace luxo::test {

std::vector<std::filesystem::path> exampleScenes() {
  std::vector<std::filesystem::path> scenes;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::filesystem::path(LUXO_SOURCE_DIR) / "apps/scenes"))
    if (entry.path().string().ends_with(".luxo.json")) scenes.push_back(entry.path());
  std::ranges::sort(scenes);
  EXPECT_FALSE(scenes.empty());
  return scenes;
}

std::string sourceText(const std::string& pathInTree) {
  const std::ifstream file(std::filesystem::path(LUXO_SOURCE_DIR) / pathInTree, std::ios::binary);
  EXPECT_TRUE(file) << pathInTree;
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

}  // namespace luxo::test
