// SPDX-License-Identifier: Apache-2.0
#include "gpu/pipeline_cache.h"
#include "support/gpu_fixture.h"

#include <gtest/gtest.h>

namespace luxo::gpu {
namespace {

CacheIdentity someIdentity() {
  CacheIdentity identity{.vendor = 0x10005, .device = 7, .driverVersion = 3};
  for (std::size_t i = 0; i < identity.uuid.size(); ++i) identity.uuid[i] = static_cast<std::uint8_t>(17 * i);
  return identity;
}

std::vector<std::byte> someData() {
  std::vector<std::byte> data;
  for (int i = 0; i < 100; ++i) data.push_back(static_cast<std::byte>(i * i));
  return data;
}

TEST(PipelineCacheFile, GivesBackWhatWasPacked) {
  for (const auto& data : {someData(), std::vector<std::byte>{}}) {
    EXPECT_EQ(unpackCache(someIdentity(), packCache(someIdentity(), data)), data);
  }
}

TEST(PipelineCacheFile, RefusesEveryTruncationAndExtension) {
  std::vector<std::byte> file = packCache(someIdentity(), someData());
  for (std::size_t size = 0; size < file.size(); ++size) {
    EXPECT_FALSE(unpackCache(someIdentity(), std::span(file).first(size))) << size;
  }
  file.push_back(std::byte{0});
  EXPECT_FALSE(unpackCache(someIdentity(), file));
}

TEST(PipelineCacheFile, RefusesEveryFlippedBitThatMatters) {
  const std::vector<std::byte> file = packCache(someIdentity(), someData());
  constexpr std::size_t kReserved = 36;  // four unused bytes after the identity
  for (std::size_t i = 0; i < file.size(); ++i) {
    if (i >= kReserved && i < kReserved + 4) continue;
    for (int bit = 0; bit < 8; ++bit) {
      std::vector<std::byte> damaged = file;
      damaged[i] ^= std::byte{1} << bit;
      EXPECT_FALSE(unpackCache(someIdentity(), damaged)) << "byte " << i << " bit " << bit;
    }
  }
}

TEST(PipelineCacheFile, RefusesTheDataOfOthers) {
  const std::vector<std::byte> file = packCache(someIdentity(), someData());
  for (int field = 0; field < 4; ++field) {
    CacheIdentity other = someIdentity();
    if (field == 0) ++other.vendor;
    if (field == 1) ++other.device;
    if (field == 2) ++other.driverVersion;
    if (field == 3) ++other.uuid[15];
    EXPECT_FALSE(unpackCache(other, file)) << field;
  }
}

TEST(PipelineCacheFile, LivesWhereTheEnvironmentSays) {
  const test::ScopedVariable home("HOME", "/home/someone");
  const test::ScopedVariable xdg("XDG_CACHE_HOME", "/xdg");
  const test::ScopedVariable own("LUXO_CACHE_DIR", "/own");
  EXPECT_EQ(cacheDirectory(), "/own");
  const test::ScopedVariable noOwn("LUXO_CACHE_DIR", "");
  EXPECT_EQ(cacheDirectory(), "/xdg/luxo");
  const test::ScopedVariable noXdg("XDG_CACHE_HOME", nullptr);
  EXPECT_EQ(cacheDirectory(), "/home/someone/.cache/luxo");
  const test::ScopedVariable noHome("HOME", nullptr);
  EXPECT_EQ(cacheDirectory(), "");
}

}  // namespace
}  // namespace luxo::gpu
