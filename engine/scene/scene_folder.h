// SPDX-License-Identifier: Apache-2.0
// Where the files are that a scene file names.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace luxo {

/// How images and models are read that scenes and models name.
struct FileOptions {
  bool allowOutside = false;  ///< they may be outside of the folder of the file that names them
  /// As ModelOptions::progress has it, of one model after the other.
  std::function<void(double)> progress = {};
};

/// The file that is named relative to the folder (empty: the current one), and is in it, with all links
/// followed: a link may lead out of a folder, too. Error(Scene), which calls it a `kind`: it leads out of
/// the folder, which is not allowed.
[[nodiscard]] std::filesystem::path fileInFolder(const std::filesystem::path& folder, const std::string& name,
                                                 std::string_view kind, bool allowOutside = false);

}  // namespace luxo
