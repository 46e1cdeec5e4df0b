// SPDX-License-Identifier: Apache-2.0
#include "gpu/cache_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <fstream>
#include <string_view>
#include <system_error>

#include "base/temporary_files.h"

namespace luxo::gpu {

namespace fs = std::filesystem;

fs::path cacheDirectory() {
  const auto variable = [](const char* name) -> std::string_view {
    const char* value = std::getenv(name);
    return value == nullptr ? "" : value;
  };
  if (const auto own = variable("LUXO_CACHE_DIR"); !own.empty()) return own;
  if (const auto xdg = variable("XDG_CACHE_HOME"); !xdg.empty()) return fs::path(xdg) / "luxo";
  if (const auto home = variable("HOME"); !home.empty()) return fs::path(home) / ".cache" / "luxo";
  return {};
}

std::uint64_t hashOf(std::span<const std::byte> data, std::uint64_t from) {
  for (const std::byte byte : data) from = (from ^ std::to_integer<std::uint64_t>(byte)) * 0x100000001b3;
  return from;
}

std::vector<std::byte> readCacheFile(const fs::path& path) {
  constexpr std::uintmax_t kLargest = std::uintmax_t{256} << 20;
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return {};
  const std::uintmax_t size = fs::file_size(path, error);
  if (error || size > kLargest) return {};
  std::vector<std::byte> bytes(size);
  std::ifstream file(path, std::ios::binary);
  file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  return bytes;
}

void replaceCacheFile(const fs::path& path, std::span<const std::byte> bytes) {
  static std::atomic<unsigned> serial = 0;  // two threads may write the same file
  std::error_code ignored;
  fs::create_directories(path.parent_path(), ignored);
  const fs::path temporary = fmt::format("{}.{}-{}", path.string(), getpid(), serial++);
  const TemporaryName name(temporary.string());
  std::ofstream file(temporary, std::ios::binary);
  file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (file) {
    fs::rename(temporary, path, ignored);
    if (!ignored) return;
  }
  fs::remove(temporary, ignored);
}

}  // namespace luxo::gpu
