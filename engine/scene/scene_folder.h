// SPDX-License-Identifier: Apache-2.0
// Where the files are that a scene file names.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace luxo {

/// The file that is named relative to the folder (empty: the current one), and is in it, with all links
/// followed: a link may lead out of a folder, too. Error(Scene), which calls it a `kind`: it leads out of
/// the folder.
[[nodiscard]] std::filesystem::path fileInFolder(const std::filesystem::path& folder, const std::string& name,
                                                 std::string_view kind);

}  // namespace luxo
