// SPDX-License-Identifier: Apache-2.0
#include "math/disjoint_sets.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace luxo {
namespace {

// Against the plain way: every number knows its set's least number, and every union goes through them all.
TEST(DisjointSets, AreThoseOfThePlainWay) {
  constexpr std::uint32_t kCount = 200;
  std::mt19937 random(3);
  DisjointSets sets(kCount);
  std::vector<std::uint32_t> least(kCount);
  std::vector<bool> flipped(kCount);
  for (std::uint32_t i = 0; i < kCount; ++i) least[i] = i;
  for (int step = 0; step < 170; ++step) {
    const auto a = static_cast<std::uint32_t>(random() % kCount),
               b = static_cast<std::uint32_t>(random() % kCount);
    const bool flip = random() % 2 == 1;
    sets.unite(a, b, flip);
    if (least[a] != least[b]) {
      const std::uint32_t low = std::min(least[a], least[b]), high = std::max(least[a], least[b]);
      const bool across = (flipped[a] != flipped[b]) != flip;
      for (std::uint32_t i = 0; i < kCount; ++i)
        if (least[i] == high) {
          least[i] = low;
          flipped[i] = flipped[i] != across;
        }
    }
    std::uint32_t count = 0;
    for (std::uint32_t i = 0; i < kCount; ++i) {
      const auto root = sets.find(i);
      ASSERT_EQ(root.number, least[i]) << step;
      ASSERT_EQ(root.flipped, flipped[i]) << step;
      count += least[i] == i;
    }
    ASSERT_EQ(sets.count(), count);
  }
}

}  // namespace
}  // namespace luxo
