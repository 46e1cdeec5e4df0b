// SPDX-License-Identifier: Apache-2.0
// The scene files that come with luxo, for tests.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace luxo::test {

/// Every apps/scenes/*.luxo.json.
[[nodiscard]] std::vector<std::filesystem::path> exampleScenes();

/// A file of the source tree, as it is.
[[nodiscard]] std::string sourceText(const std::string& pathInTree);

}  // namespace luxo::test
