// SPDX-License-Identifier: Apache-2.0
// Where the files are that a scene file names.
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "image/file_source.h"

namespace luxo {

/// How images and models are read that scenes and models name.
struct FileOptions {
  bool allowOutside = false;  ///< they may be outside of the folder of the file that names them
  /// As ModelOptions::progress has it, of one model after the other.
  std::function<void(double)> progress = {};
  FileSource from = {};  ///< where they are, and the shaders: in memory nothing is outside
};

/// The file that is named relative to the folder (empty: the current one), and is in it, with all links
/// followed: a link may lead out of a folder, too. Error(Scene), which calls it a `kind`: it leads out of
/// the folder, which is not allowed. In memory nothing is outside.
[[nodiscard]] std::filesystem::path fileInFolder(const std::filesystem::path& folder, const std::string& name,
                                                 std::string_view kind, const FileOptions& options = {});

/// Those of the files that there are, by their paths from the folder: in memory a scene in no folder names
/// them as the one in the folder does. Error(Scene): one cannot be read.
[[nodiscard]] FilesInMemory inMemory(std::span<const std::filesystem::path> files,
                                     const std::filesystem::path& folder, const FileSource& from);

}  // namespace luxo
