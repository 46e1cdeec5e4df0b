// SPDX-License-Identifier: Apache-2.0
// Files that save time and are never needed: whatever happens to one is no error.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace luxo::gpu {

/// $LUXO_CACHE_DIR, or $XDG_CACHE_HOME/luxo, or ~/.cache/luxo; empty when none is set.
[[nodiscard]] std::filesystem::path cacheDirectory();

/// Continues the FNV-1a hash `from`, 64 bits: against damage and for names, not against malice.
[[nodiscard]] std::uint64_t hashOf(std::span<const std::byte> data, std::uint64_t from = 0xcbf29ce484222325);

/// Empty when there is none, or it is no file, or too large to be one of ours.
[[nodiscard]] std::vector<std::byte> readCacheFile(const std::filesystem::path& path);

/// The file appears whole or not at all, so programs may share it; nothing happens when it cannot be written.
void replaceCacheFile(const std::filesystem::path& path, std::span<const std::byte> bytes);

}  // namespace luxo::gpu
