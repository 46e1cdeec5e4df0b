// SPDX-License-Identifier: Apache-2.0
// Reads scene files (.luxo.json). Strict: unknown keys, wrong types, missing and doubled names are errors,
// and all errors of a file are reported at once, each with its line and a caret.
#pragma once

#include <cstddef>
#include <filesystem>
#include <iosfwd>
#include <string>
#include <string_view>

#include "scene/scene_file.h"
#include "scene/scene_folder.h"

namespace luxo {

/// Limits of one file, each an error of its own; those of its text are in scene/json.h.
inline constexpr std::size_t kMaxSceneNodes = std::size_t{1} << 22;
inline constexpr std::size_t kMaxSceneParameters = 4096;

/// The description in a text; `name` is what messages call it. Throws Error(Scene) whose what() shows every
/// error (20 of them, and how many more), those of its formulas and references included. What it names is
/// relative to `folder`. Linear in the text.
/// Memory: the text, 16 bytes per JSON value while reading, then about 600 bytes per node.
[[nodiscard]] SceneFile parseScene(std::string text, std::string name,
                                   const std::filesystem::path& folder = {}, const FileOptions& files = {});

/// The description in a stream, such as standard input, up to its end.
[[nodiscard]] SceneFile readScene(std::istream& stream, std::string name);

/// The description in a file. Throws Error(Scene) also for one that does not exist, is no regular file,
/// cannot be read or is larger than 1 GiB.
[[nodiscard]] SceneFile readSceneFile(const std::filesystem::path& path, const FileOptions& files = {});

}  // namespace luxo
