// SPDX-License-Identifier: Apache-2.0
// Whether a file is in a folder, or in one below.
#pragma once

#include <algorithm>
#include <filesystem>

namespace luxo {

/// Of paths that are canonical: links, which may lead out of a folder, have been followed.
[[nodiscard]] inline bool isInside(const std::filesystem::path& file, const std::filesystem::path& folder) {
  const auto [inFolder, inFile] = std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
  return inFolder == folder.end();
}

}  // namespace luxo
