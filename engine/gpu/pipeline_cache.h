// SPDX-License-Identifier: Apache-2.0
// The pipeline cache on disk. It saves time and is never needed: whatever happens to its file is no error.
#pragma once

#include "gpu/cache_file.h"
#include "gpu/vk.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

namespace luxo::gpu {

/// Whose cache data it is: data of another device or driver must not reach this one.
struct CacheIdentity {
  std::uint32_t vendor = 0;
  std::uint32_t device = 0;
  std::uint32_t driverVersion = 0;
  std::array<std::uint8_t, VK_UUID_SIZE> uuid{};

  friend bool operator==(const CacheIdentity&, const CacheIdentity&) = default;
};

[[nodiscard]] CacheIdentity identityOf(const VkPhysicalDeviceProperties& properties);

/// The file's bytes: magic, identity, size and checksum, then the data.
[[nodiscard]] std::vector<std::byte> packCache(const CacheIdentity& identity,
                                               std::span<const std::byte> data);
/// The data inside `file`, or nothing when it is not whole, not a cache, or not of this identity.
[[nodiscard]] std::optional<std::vector<std::byte>> unpackCache(const CacheIdentity& identity,
                                                                std::span<const std::byte> file);

/// The device's cache, loaded from disk when it is made, saved when it goes if it has changed. The file
/// appears whole or not at all, so programs may share it.
class PipelineCache {
 public:
  /// An empty `directory` keeps it in memory only.
  PipelineCache(VkDevice device, const VkPhysicalDeviceProperties& properties,
                const std::filesystem::path& directory);
  ~PipelineCache();
  PipelineCache(const PipelineCache&) = delete;
  PipelineCache& operator=(const PipelineCache&) = delete;

  operator VkPipelineCache() const noexcept { return cache_; }

 private:
  [[nodiscard]] std::vector<std::byte> data() const;
  void save() const noexcept;

  VkDevice device_;
  CacheIdentity identity_;
  std::filesystem::path file_;
  VkPipelineCache cache_ = VK_NULL_HANDLE;
  std::vector<std::byte> loaded_;
};

}  // namespace luxo::gpu
