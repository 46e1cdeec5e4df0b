// SPDX-License-Identifier: Apache-2.0
#include "gpu/free_list.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace luxo::gpu {
namespace {

struct Part {
  std::uint64_t offset;
  std::uint64_t size;
};

TEST(FreeList, HandsOutAlignedPartsAndKeepsThePaddingFree) {
  FreeList list(1024);
  EXPECT_EQ(list.allocate(10, 1), 0u);
  EXPECT_EQ(list.allocate(100, 256), 256u);
  EXPECT_EQ(list.freeBytes(), 1024u - 110u);
  EXPECT_EQ(list.allocate(246, 1), 10u);   // exactly the padding
  EXPECT_EQ(list.allocate(668, 4), 356u);  // exactly the rest
  EXPECT_EQ(list.freeBytes(), 0u);
  EXPECT_FALSE(list.allocate(1, 1));
}

TEST(FreeList, RefusesWhatFitsOnlyWithoutItsAlignment) {
  FreeList list(100);
  ASSERT_EQ(list.allocate(1, 1), 0u);
  EXPECT_FALSE(list.allocate(50, 64));
  EXPECT_EQ(list.allocate(36, 64), 64u);
}

TEST(FreeList, JoinsWithBothNeighbours) {
  FreeList list(300);
  for (const std::uint64_t offset : {0u, 100u, 200u}) ASSERT_EQ(list.allocate(100, 1), offset);
  list.free(0, 100);
  list.free(200, 100);
  EXPECT_FALSE(list.allocate(101, 1));
  list.free(100, 100);
  EXPECT_TRUE(list.unused());
  EXPECT_EQ(list.allocate(300, 1), 0u);
}

TEST(FreeListDeathTest, FreeingTwiceAborts) {
  FreeList list(100);
  ASSERT_EQ(list.allocate(50, 1), 0u);
  list.free(0, 50);
  EXPECT_DEATH(list.free(0, 50), "assertion failed");
  EXPECT_DEATH(list.free(60, 50), "assertion failed");
}

// Random sequences: parts never overlap, lie inside, are aligned; a refusal is right (no gap could hold it);
// and all freed is one range.
TEST(FreeList, HoldsItsPropertiesUnderRandomUse) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    std::mt19937 random(seed);
    constexpr std::uint64_t kSize = 4096;
    FreeList list(kSize);
    std::vector<Part> parts;
    for (int step = 0; step < 400; ++step) {
      if (parts.empty() || random() % 5 < 3) {
        const std::uint64_t size = 1 + random() % 300;
        const std::uint64_t alignment = std::uint64_t{1} << random() % 8;
        const auto offset = list.allocate(size, alignment);
        std::ranges::sort(parts, {}, &Part::offset);
        if (offset) {
          EXPECT_EQ(*offset % alignment, 0u);
          EXPECT_LE(*offset + size, kSize);
          for (const Part& part : parts) {
            EXPECT_TRUE(*offset + size <= part.offset || part.offset + part.size <= *offset)
                << "seed " << seed;
          }
          parts.push_back({*offset, size});
        } else {
          std::uint64_t gapBegin = 0;
          parts.push_back({kSize, 0});  // the end closes the last gap
          for (const Part& part : parts) {
            const std::uint64_t aligned = (gapBegin + alignment - 1) / alignment * alignment;
            EXPECT_GT(aligned + size, part.offset) << "seed " << seed;
            gapBegin = part.offset + part.size;
          }
          parts.pop_back();
        }
      } else {
        const std::size_t chosen = random() % parts.size();
        list.free(parts[chosen].offset, parts[chosen].size);
        parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(chosen));
      }
      std::uint64_t used = 0;
      for (const Part& part : parts) used += part.size;
      ASSERT_EQ(list.freeBytes(), kSize - used) << "seed " << seed;
    }
    std::ranges::shuffle(parts, random);
    for (const Part& part : parts) list.free(part.offset, part.size);
    EXPECT_TRUE(list.unused());
    EXPECT_EQ(list.allocate(kSize, 1), 0u) << "seed " << seed;
  }
}

}  // namespace
}  // namespace luxo::gpu
