// SPDX-License-Identifier: Apache-2.0
// Whole files in, whole files out.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

namespace luxo {

/// The file's bytes. Error(Scene): missing or unreadable, with what the system said; at once for what is no
/// regular file, such as a device or a pipe.
[[nodiscard]] std::vector<std::byte> readFile(const std::filesystem::path& path);

/// Writes a file that appears whole or not at all: a temporary name in the same folder, fsync, rename. An
/// existing file stays as it was until then, hands its mode on to what replaces it, and a symbolic link keeps
/// pointing at the file it names. What is not a file (a pipe, a terminal) is written to directly.
/// Error(Write), with what the system said; nothing is left behind. Safe from any thread; a file size limit
/// gives an error, not a signal.
void writeFileAtomically(const std::filesystem::path& path, std::span<const std::byte> bytes);

/// Before long work: Error(Write), as writeFileAtomically() would say it, where the folder is missing or may
/// not be written to, or the path names a folder. Leaves no trace. A disk may still fill up meanwhile.
void requireWritable(const std::filesystem::path& path);

}  // namespace luxo
