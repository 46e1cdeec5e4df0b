// SPDX-License-Identifier: Apache-2.0
#include "frame_names.h"

#include <gtest/gtest.h>

#include "unit/image_test_support.h"

namespace luxo {
namespace {

TEST(FrameNames, EveryKindOfPlaceholder) {
  const auto name = [](const char* pattern, int frame) {
    return FrameNames(pattern, true).of(frame).string();
  };
  EXPECT_EQ(name("a_####.png", 7), "a_0007.png");
  EXPECT_EQ(name("a_#.png", 123), "a_123.png");
  EXPECT_EQ(name("a%04d.png", 7), "a0007.png");
  EXPECT_EQ(name("a%d.png", 7), "a7.png");
  EXPECT_EQ(name("a{frame}.png", 7), "a7.png");
  EXPECT_EQ(name("a{frame:04}.png", 7), "a0007.png");
  EXPECT_EQ(name("##_{frame:03}.png", 5), "05_005.png");
  EXPECT_EQ(name("####.exr", 123456), "123456.exr");
}

TEST(FrameNames, SeveralFramesWithoutAPlaceGetOneBeforeTheSuffix) {
  const FrameNames names("out/lamp.v2.png", true);
  EXPECT_TRUE(names.numberAdded());
  EXPECT_EQ(names.of(1), "out/lamp.v2.0001.png");
  EXPECT_EQ(names.of(12345), "out/lamp.v2.12345.png");
  EXPECT_FALSE(FrameNames("lamp_##.png", true).numberAdded());
}

TEST(FrameNames, OnePictureKeepsItsName) {
  const FrameNames names("out/lamp.png", false);
  EXPECT_FALSE(names.numberAdded());
  EXPECT_EQ(names.of(5), "out/lamp.png");
  EXPECT_EQ(FrameNames("lamp_##.png", false).of(5), "lamp_05.png");
}

TEST(FrameNames, FoldersAndOtherSignsAreTakenAsTheyAre) {
  EXPECT_EQ(FrameNames("c##/%d/a.png", false).of(5), "c##/%d/a.png");
  EXPECT_EQ(FrameNames("100%_{x}.png", false).of(5), "100%_{x}.png");
  EXPECT_EQ(FrameNames("50%.png", true).of(5), "50%.0005.png");
}

TEST(FrameNames, MisshapenPlaceholdersAreRefused) {
  for (const char* pattern : {"a%4d.png", "a%00d.png", "a%099d.png", "a{frame:}.png", "a{frame:4}.png",
                              "a{frame:x}.png", "a{frame04}.png", "a{frame.png", "a%099999999999d.png"})
    EXPECT_EQ(kindThrownBy([&] { const FrameNames names(pattern, true); }), ErrorKind::Usage) << pattern;
}

}  // namespace
}  // namespace luxo
