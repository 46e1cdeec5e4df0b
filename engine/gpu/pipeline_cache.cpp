// SPDX-License-Identifier: Apache-2.0
#include "gpu/pipeline_cache.h"

#include "gpu/result.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

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

}  // namespace

CacheIdentity identityOf(const VkPhysicalDeviceProperties& properties) {
  CacheIdentity identity{.vendor = properties.vendorID,
                         .device = properties.deviceID,
                         .driverVersion = properties.driverVersion};
  std::memcpy(identity.uuid.data(), properties.pipelineCacheUUID, VK_UUID_SIZE);
  return identity;
}

std::vector<std::byte> packCache(const CacheIdentity& identity, std::span<const std::byte> data) {
  const Header header{.identity = identity, .size = data.size(), .checksum = hashOf(data)};
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
  const bool whole = header.size == data.size() && header.checksum == hashOf(data);
  if (!ours || !whole) return std::nullopt;
  return std::vector<std::byte>(data.begin(), data.end());
}

PipelineCache::PipelineCache(VkDevice device, const VkPhysicalDeviceProperties& properties,
                             const fs::path& directory)
    : device_(device), identity_(identityOf(properties)) {
  if (!directory.empty()) {
    file_ = directory / fmt::format("pipelines-{:x}-{:x}.bin", identity_.vendor, identity_.device);
    loaded_ = unpackCache(identity_, readCacheFile(file_)).value_or(std::vector<std::byte>{});
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
  if (now != loaded_) replaceCacheFile(file_, packCache(identity_, now));
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
