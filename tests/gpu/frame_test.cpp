// SPDX-License-Identifier: Apache-2.0
#include "gpu/frame.h"

#include "gpu/barrier.h"
#include "gpu/texture.h"
#include "support/gpu_fixture.h"

#include <gtest/gtest.h>

#include <string_view>
#include <vector>

namespace luxo::gpu {
namespace {

using FrameTest = test::GpuTest;

Texture smallTarget(Context& context) {
  return Texture(context, {.extent = {64, 64},
                           .format = VK_FORMAT_R8G8B8A8_UNORM,
                           .usage = VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT});
}

void clear(VkCommandBuffer commands, Texture& texture) {
  use(commands, {{texture, Use::TransferDestination, Contents::Discard}});
  const VkClearColorValue black{};
  const VkImageSubresourceRange all{
      .aspectMask = VK_IMAGE_ASPECT_COLOR_BIT, .levelCount = 1, .layerCount = 1};
  vkCmdClearColorImage(commands, texture, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &black, 1, &all);
}

TEST_F(FrameTest, AlternatesItsSlotsAndCountsSubmissions) {
  FrameRing frames(context());
  std::vector<std::size_t> slots;
  for (std::uint64_t n = 1; n <= 4; ++n) {
    frames.begin();
    slots.push_back(frames.slot());
    EXPECT_EQ(frames.submit(), n);
  }
  EXPECT_EQ(slots, (std::vector<std::size_t>{0, 1, 0, 1}));
  EXPECT_EQ(context().counters().submits, 4u);
  frames.wait(4);
  EXPECT_EQ(context().timeline().completed(), 4u);
}

TEST_F(FrameTest, WhatIsDroppedWhileRecordedLivesUntilTheDeviceIsDone) {
  FrameRing frames(context());
  const VkCommandBuffer commands = frames.begin();
  {
    Texture texture = smallTarget(context());
    clear(commands, texture);
  }
  context().timeline().collect();
  EXPECT_EQ(context().counters().textures, 1u) << "the recording uses it";
  const std::uint64_t submission = frames.submit();
  EXPECT_EQ(context().counters().textures, 1u);
  frames.wait(submission);
  context().timeline().collect();
  EXPECT_EQ(context().counters().textures, 0u);
}

TEST_F(FrameTest, DroppingNeverWaits) {
  FrameRing frames(context());
  Texture texture = smallTarget(context());
  const VkCommandBuffer commands = frames.begin();
  clear(commands, texture);
  frames.submit();
  texture = {};
  EXPECT_EQ(context().counters().textures, 1u);
  context().waitIdle();
  EXPECT_EQ(context().counters().textures, 0u);
}

TEST_F(FrameTest, AssigningReplacesATexture) {
  FrameRing frames(context());
  Texture texture = smallTarget(context());
  for (int i = 0; i < 3; ++i) {
    texture = smallTarget(context());
    clear(frames.begin(), texture);
    frames.submit();
  }
  context().waitIdle();
  EXPECT_EQ(context().counters().textures, 1u);
}

TEST_F(FrameTest, AThousandFramesLeaveNothingBehind) {
  FrameRing frames(context());
  context().waitIdle();
  const Counters before = context().counters();
  std::uint64_t mostTextures = 0;
  for (int i = 0; i < 1000; ++i) {
    const VkCommandBuffer commands = frames.begin();
    Texture texture = smallTarget(context());
    Buffer buffer(context(), {.size = 1000, .usage = VK_BUFFER_USAGE_VERTEX_BUFFER_BIT});
    clear(commands, texture);
    frames.submit();
    mostTextures = std::max(mostTextures, context().counters().textures);
  }
  context().waitIdle();
  const Counters after = context().counters();
  EXPECT_EQ(after.objects, before.objects);
  EXPECT_EQ(after.buffers, before.buffers);
  EXPECT_EQ(after.textures, before.textures);
  EXPECT_EQ(after.allocations, before.allocations);
  EXPECT_EQ(after.memoryBytes, before.memoryBytes);
  // Two frames in flight and the one being recorded, dropped but perhaps not yet collected.
  EXPECT_LE(mostTextures, FrameRing::kFrames + 1);
}

TEST_F(FrameTest, AnUnfinishedRecordingCanBeBegunAgain) {
  FrameRing frames(context());
  frames.begin();
  const std::size_t slot = frames.slot();
  { const Texture dropped = smallTarget(context()); }
  frames.begin();
  EXPECT_EQ(frames.slot(), slot);
  EXPECT_EQ(context().counters().textures, 0u) << "no submission could have used it";
  EXPECT_EQ(frames.submit(), 1u);
}

TEST_F(FrameTest, AnUnfinishedRecordingMayBeLeftBehind) {
  FrameRing frames(context());
  Texture texture = smallTarget(context());
  clear(frames.begin(), texture);
}

TEST_F(FrameTest, MeasuresTheDevice) {
  if (!context().features().timestamps) GTEST_SKIP() << "no timestamps";
  FrameRing frames(context());
  Texture texture = smallTarget(context());
  clear(frames.begin(), texture);
  const std::uint64_t submission = frames.submit();
  frames.wait(submission);
  const auto time = frames.milliseconds(submission);
  ASSERT_TRUE(time);
  EXPECT_GE(*time, 0.0);
  EXPECT_FALSE(frames.milliseconds(submission + 1)) << "not submitted";
  for (std::size_t i = 0; i < FrameRing::kFrames; ++i) {
    frames.begin();
    frames.wait(frames.submit());
  }
  EXPECT_FALSE(frames.milliseconds(submission)) << "its slot has been used again";
}

TEST_F(FrameTest, PartsAreAllOfItsTime) {
  if (!context().features().timestamps) GTEST_SKIP() << "the device has no timestamps";
  FrameRing frames(context());
  Texture texture = smallTarget(context());
  const VkCommandBuffer commands = frames.begin();
  for (const char* name : {"first", "second", "first"}) {
    frames.mark(name);
    clear(commands, texture);
  }
  const std::uint64_t submission = frames.submit();
  frames.wait(submission);
  std::vector<std::string_view> names;
  double sum = 0;
  for (const FrameRing::Part& part : frames.parts(submission)) {
    names.push_back(part.name);
    sum += part.milliseconds;
    EXPECT_GE(part.milliseconds, 0);
  }
  EXPECT_EQ(names, (std::vector<std::string_view>{FrameRing::kUnmarked, "first", "second"}));
  EXPECT_NEAR(sum, frames.milliseconds(submission).value(), 1e-9);
  frames.begin();
  const std::uint64_t next = frames.submit();
  frames.wait(next);
  ASSERT_EQ(frames.parts(next).size(), 1u) << "marks are of one frame";
  EXPECT_EQ(frames.parts(next + 1).size(), 0u) << "there is no such frame";
}

TEST_F(FrameTest, MarksBeyondTheMostAreUnmarked) {
  if (!context().features().timestamps) GTEST_SKIP() << "the device has no timestamps";
  FrameRing frames(context());
  frames.begin();
  for (std::size_t i = 0; i < FrameRing::kMaxMarks + 5; ++i)
    frames.mark(i + 1 < FrameRing::kMaxMarks ? "early" : "late");
  const std::uint64_t submission = frames.submit();
  frames.wait(submission);
  const std::vector<FrameRing::Part> parts = frames.parts(submission);
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_EQ(parts[0].name, FrameRing::kUnmarked);
  EXPECT_EQ(parts[1].name, "early");
}

}  // namespace
}  // namespace luxo::gpu
