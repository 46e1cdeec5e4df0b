// SPDX-License-Identifier: Apache-2.0
// The files that a command is to write, looked at before it works: none is an input, no two are one, and all
// can be written.
#pragma once

#include <filesystem>
#include <span>
#include <string>

namespace luxo {

/// A file, and the words of the command line that named it: "-o", "--report", "the scene".
struct NamedFile {
  std::string what;
  std::filesystem::path path;
};

/// Whether both names lead to the same regular file, or would. What is not a file (a terminal, /dev/null) is
/// never the same: it holds nothing that could be lost.
[[nodiscard]] bool sameFile(const std::filesystem::path& a, const std::filesystem::path& b);

/// Error(Usage): an output is an input or another output. Error(Write): one cannot be written
/// (image/file.h, requireWritable). Empty paths are left out. Cost: a temporary file per output.
void requireOutputs(std::span<const NamedFile> outputs, std::span<const NamedFile> inputs = {});

}  // namespace luxo
