// SPDX-License-Identifier: Apache-2.0
#include "gpu/memory.h"

#include <gtest/gtest.h>

#include <initializer_list>

namespace luxo::gpu {
namespace {

constexpr VkMemoryPropertyFlags kLocal = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
constexpr VkMemoryPropertyFlags kVisible = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT;
constexpr VkMemoryPropertyFlags kCoherent = VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
constexpr VkMemoryPropertyFlags kCached = VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
constexpr std::uint32_t kAny = ~0u;

VkPhysicalDeviceMemoryProperties memoryOf(std::initializer_list<VkMemoryPropertyFlags> types) {
  VkPhysicalDeviceMemoryProperties memory{};
  for (const VkMemoryPropertyFlags flags : types)
    memory.memoryTypes[memory.memoryTypeCount++].propertyFlags = flags;
  return memory;
}

TEST(MemoryType, OneTypeServesAll) {
  const auto lavapipe = memoryOf({kLocal | kVisible | kCoherent | kCached});
  for (const MemoryUse use : {MemoryUse::Device, MemoryUse::Upload, MemoryUse::Readback}) {
    EXPECT_EQ(chooseMemoryType(lavapipe, kAny, use), 0u);
    EXPECT_FALSE(chooseMemoryType(lavapipe, 0, use));
  }
}

TEST(MemoryType, ADiscreteCardGetsOneOfEach) {
  const auto card = memoryOf(
      {0, kLocal, kVisible | kCoherent, kVisible | kCoherent | kCached, kLocal | kVisible | kCoherent});
  EXPECT_EQ(chooseMemoryType(card, kAny, MemoryUse::Device), 1u);
  EXPECT_EQ(chooseMemoryType(card, kAny, MemoryUse::Upload), 2u);
  EXPECT_EQ(chooseMemoryType(card, kAny, MemoryUse::Readback), 3u);
}

TEST(MemoryType, TakesSecondBestWhenTheBestIsNotAllowed) {
  const auto card =
      memoryOf({0, kLocal, kVisible | kCoherent, kVisible | kCached, kLocal | kVisible | kCoherent});
  EXPECT_EQ(chooseMemoryType(card, 0b10001, MemoryUse::Device), 4u);
  EXPECT_EQ(chooseMemoryType(card, 0b00001, MemoryUse::Device), 0u);
  EXPECT_EQ(chooseMemoryType(card, 0b11001, MemoryUse::Upload), 4u) << "coherent before cached";
  EXPECT_EQ(chooseMemoryType(card, kAny, MemoryUse::Readback), 3u) << "cached before coherent";
  EXPECT_EQ(chooseMemoryType(card, 0b00101, MemoryUse::Readback), 2u);
  EXPECT_FALSE(chooseMemoryType(card, 0b00011, MemoryUse::Upload));
}

TEST(MemoryType, NeverTakesSpecialMemory) {
  const auto memory = memoryOf({kLocal | VK_MEMORY_PROPERTY_PROTECTED_BIT,
                                kLocal | VK_MEMORY_PROPERTY_LAZILY_ALLOCATED_BIT, kVisible});
  EXPECT_EQ(chooseMemoryType(memory, kAny, MemoryUse::Device), 2u);
}

}  // namespace
}  // namespace luxo::gpu
