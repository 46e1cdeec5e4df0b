// SPDX-License-Identifier: Apache-2.0
// What fits on a device is known before anything is drawn.
#include "draw/picture_room.h"

#include <gtest/gtest.h>

#include <limits>

namespace luxo {
namespace {

constexpr std::uint64_t kMuch = std::numeric_limits<std::uint64_t>::max(), kGiB = std::uint64_t{1} << 30;

TEST(PictureRoom, CountsTargetsReadbackAndImage) {
  // 64 x 64 pixels are one tile.
  EXPECT_EQ(roomOf({64, 64}, 1, true), (PictureRoom{4096 * 16, 4096 * 20, 4096 * (20 + 28)}));
  EXPECT_EQ(roomOf({64, 64}, 4, true), (PictureRoom{4096 * 64, 4096 * 96, 4096 * (96 + 28)}));
  EXPECT_EQ(roomOf({64, 64}, 9, false), (PictureRoom{4096 * 16, 4096 * 36, 4096 * (36 + 28)}));
  EXPECT_EQ(roomOf({65, 1}, 1, true), roomOf({128, 64}, 1, true));
  EXPECT_EQ(roomOf({16384, 16384}, 1, true).largest, 4 * kGiB);  // no overflow
}

TEST(PictureRoom, NamesTheLargestSizeOfTheSameShapeThatFits) {
  EXPECT_EQ(sizeThatFits({16384, 16384}, 1, true, {kMuch, kMuch, kMuch}), std::nullopt);
  for (const int samples : {1, 4, 9}) {
    const PictureRoom room{2 * kGiB, 6 * kGiB, 8 * kGiB};
    const auto fits = sizeThatFits({16384, 8192}, samples, samples < 9, room);
    if (samples == 1) {
      EXPECT_EQ(fits, std::nullopt);  // 2 GiB of colour
      continue;
    }
    const auto within = [&](PixelSize size) {
      const PictureRoom needed = roomOf(size, samples, samples < 9);
      return needed.largest <= room.largest && needed.device <= room.device && needed.all <= room.all;
    };
    if (!fits) {
      EXPECT_TRUE(within({16384, 8192}));
      continue;
    }
    EXPECT_TRUE(within(*fits));
    EXPECT_NEAR(fits->width, 2 * fits->height, 2);
    EXPECT_FALSE(within({fits->width + 128, fits->height + 64}));
  }
  EXPECT_EQ(sizeThatFits({100, 100}, 1, true, {0, 0, 0}), (PixelSize{1, 1}));
}

}  // namespace
}  // namespace luxo
