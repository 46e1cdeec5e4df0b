// SPDX-License-Identifier: Apache-2.0
#include "gpu/pipeline_cache.h"

#include "gpu/result.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string_view>
#include <system_error>

namespace luxo::gpu {
namespace {

namespace fs = std::filesystem;

struct Header {
  std::array<char, 8> magic{'l', 'u', 'x', 'o', 'p', 'i', 'p', '1'};
  CacheIdentity identity;
  std::uint32_t reserved = 0;
  std::uint64_t size = 0;
  std::uint64_t checksum = 0;
};
static_assert(sizeof(Header) == 56, "no padding: the file is the memory");

// FNV-1a, 64 bits: against damage, not against malice.
std::uint64_t checksumOf(std::span<const std::byte> data) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const std::byte byte : data) hash = (hash ^ std::to_integer<std::uint64_t>(byte)) * 0x100000001b3;
  return hash;
}

CacheIdentity identityOf(const VkPhysicalDeviceProperties& properties) {
  CacheIdentity identity{.vendor = properties.vendorID,
                         .device = properties.deviceID,
                         .driverVersion = properties.driverVersion};
  std::memcpy(identity.uuid.data(), properties.pipelineCacheUUID, VK_UUID_SIZE);
  return identity;
}

// Empty when there is none, or it is no file, or too large to be one of ours.
std::vector<std::byte> readFile(const fs::path& path) {
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

// Whole or not at all; nothing when it cannot.
void replaceFile(const fs::path& path, std::span<const std::byte> bytes) {
  std::error_code ignored;
  fs::create_directories(path.parent_path(), ignored);
  const fs::path temporary = fmt::format("{}.{}", path.string(), getpid());
  std::ofstream file(temporary, std::ios::binary);
  file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (file) {
    fs::rename(temporary, path, ignored);
    if (!ignored) return;
  }
  fs::remove(temporary, ignored);
}

}  // namespace

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

std::vector<std::byte> packCache(const CacheIdentity& identity, std::span<const std::byte> data) {
  const Header header{.identity = identity, .size = data.size(), .checksum = checksumOf(data)};
  const auto bytes = std::as_bytes(std::span(&header, 1));
  std::vector<std::byte> file(bytes.size() + data.size());
  std::copy(data.begin(), data.end(), std::copy(bytes.begin(), bytes.end(), file.begin()));
  return file;
}

std::optional<std::vector<std::byte>> unpackCache(const CacheIdentity& identity,
                                                  std::span<const std::byte> file) {
  Header header;
  if (file.size() < sizeof(header)) return std::nullopt;
  std::memcpy(&header, file.data(), sizeof(header));
  const std::span<const std::byte> data = file.subspan(sizeof(header));
  const bool ours = header.magic == Header{}.magic && header.identity == identity;
  const bool whole = header.size == data.size() && header.checksum == checksumOf(data);
  if (!ours || !whole) return std::nullopt;
  return std::vector<std::byte>(data.begin(), data.end());
}

PipelineCache::PipelineCache(VkDevice device, const VkPhysicalDeviceProperties& properties,
                             const fs::path& directory)
    : device_(device), identity_(identityOf(properties)) {
  if (!directory.empty()) {
    file_ = directory / fmt::format("pipelines-{:x}-{:x}.bin", identity_.vendor, identity_.device);
    loaded_ = unpackCache(identity_, readFile(file_)).value_or(std::vector<std::byte>{});
  }
  const VkPipelineCacheCreateInfo info{.sType = VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO,
                                       .initialDataSize = loaded_.size(),
                                       .pInitialData = loaded_.data()};
  check(vkCreatePipelineCache(device_, &info, nullptr, &cache_), "create the pipeline cache");
}

PipelineCache::~PipelineCache() {
  if (!file_.empty()) save();
  vkDestroyPipelineCache(device_, cache_, nullptr);
}

void PipelineCache::save() const noexcept try {
  const std::vector<std::byte> now = data();
  if (now != loaded_) replaceFile(file_, packCache(identity_, now));
} catch (const std::exception&) {
  // Out of memory, an unreadable path: the next run compiles again, which is all there is to lose.
}

std::vector<std::byte> PipelineCache::data() const {
  std::size_t size = 0;
  check(vkGetPipelineCacheData(device_, cache_, &size, nullptr), "read the pipeline cache");
  std::vector<std::byte> bytes(size);
  check(vkGetPipelineCacheData(device_, cache_, &size, bytes.data()), "read the pipeline cache");
  bytes.resize(size);
  return bytes;
}

}  // namespace luxo::gpu
