// SPDX-License-Identifier: Apache-2.0
#include "gpu/barrier.h"
#include "gpu/frame.h"
#include "gpu/texture.h"
#include "gpu/transfer.h"
#include "support/gpu_fixture.h"

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <span>

namespace luxo::gpu {
namespace {

class ReadbackTest : public test::GpuTest {
 protected:
  Texture target(VkExtent2D extent, VkFormat format) {
    return Texture(context(), {.extent = extent,
                               .format = format,
                               .usage = VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                               .name = "target"});
  }

  static void clear(VkCommandBuffer commands, Texture& texture, const VkClearColorValue& color) {
    use(commands, {{texture, Use::TransferDestination, Contents::Discard}});
    const VkImageSubresourceRange all{
        .aspectMask = VK_IMAGE_ASPECT_COLOR_BIT, .levelCount = 1, .layerCount = 1};
    vkCmdClearColorImage(commands, texture, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &color, 1, &all);
  }
};

TEST_F(ReadbackTest, GivesBackTheExactFloatsOfAClearedTexture) {
  // Not representable in fewer bits, above 1, negative, denormal: nothing may be rounded or clamped on the
  // way.
  const std::array<float, 4> color{0.1f, 65537.25f, -3.0e-20f, 1.0f / 3};
  VkClearColorValue value;
  std::memcpy(value.float32, color.data(), sizeof(value.float32));
  FrameRing frames(context());
  for (const VkExtent2D extent : {VkExtent2D{1, 1}, {3, 5}, {127, 2}, {641, 481}}) {
    Texture texture = target(extent, VK_FORMAT_R32G32B32A32_SFLOAT);
    Readback readback(context(), extent, texture.format());
    const VkCommandBuffer commands = frames.begin();
    clear(commands, texture, value);
    readback.record(commands, texture);
    frames.wait(frames.submit());
    ASSERT_EQ(readback.bytes().size(), std::size_t{16} * extent.width * extent.height);
    for (std::size_t i = 0; i < readback.bytes().size(); i += 16) {
      ASSERT_EQ(std::memcmp(readback.bytes().data() + i, color.data(), 16), 0) << "byte " << i;
    }
  }
}

TEST_F(ReadbackTest, LeavesRowsAloneThatItIsNotToldToRead) {
  constexpr VkExtent2D kExtent{3, 7};
  Texture texture = target(kExtent, VK_FORMAT_R32_SFLOAT);
  Readback readback(context(), kExtent, texture.format());
  FrameRing frames(context());
  const auto record = [&](float value, std::span<const Readback::Rows> rows) {
    const VkCommandBuffer commands = frames.begin();
    clear(commands, texture, {.float32 = {value}});
    readback.record(commands, texture, rows);
    frames.wait(frames.submit());
  };
  const Readback::Rows all[] = {{0, 7}}, some[] = {{1, 2}, {6, 1}};
  record(1, all);
  record(2, some);
  for (std::uint32_t y = 0; y < kExtent.height; ++y)
    for (std::uint32_t x = 0; x < kExtent.width; ++x) {
      float value = 0;
      std::memcpy(&value, readback.row(y).data() + sizeof value * x, sizeof value);
      EXPECT_EQ(value, y == 1 || y == 2 || y == 6 ? 2 : 1) << x << ", " << y;
    }
}

TEST_F(ReadbackTest, LeavesTheGapsBetweenRowsAlone) {
  constexpr VkExtent2D kExtent{5, 3};
  constexpr std::uint32_t kPitch = 64;  // 20 bytes of pixels, 44 of gap
  Texture texture = target(kExtent, VK_FORMAT_R8G8B8A8_UNORM);
  Readback readback(context(), kExtent, texture.format(), kPitch);
  EXPECT_EQ(readback.rowPitch(), kPitch);
  FrameRing frames(context());
  const VkCommandBuffer commands = frames.begin();
  clear(commands, texture, {.float32 = {1, 0, 0.2f, 1}});  // 0.2 is 51 of 255
  readback.record(commands, texture);
  frames.wait(frames.submit());
  EXPECT_EQ(readback.bytes().size(), 3 * kPitch);
  for (std::uint32_t y = 0; y < kExtent.height; ++y) {
    ASSERT_EQ(readback.row(y).size(), 20u);
    ASSERT_EQ(readback.row(y).data(), readback.bytes().data() + y * kPitch);
    for (std::size_t x = 0; x < kExtent.width; ++x) {
      const std::array pixel{std::byte{255}, std::byte{0}, std::byte{51}, std::byte{255}};
      EXPECT_EQ(std::memcmp(readback.row(y).data() + 4 * x, pixel.data(), 4), 0) << x << ", " << y;
    }
  }
}

TEST_F(ReadbackTest, WorksAgainAndAgain) {
  constexpr VkExtent2D kExtent{7, 7};
  Texture texture = target(kExtent, VK_FORMAT_R32_UINT);
  Readback readback(context(), kExtent, texture.format());
  FrameRing frames(context());
  for (std::uint32_t i = 0; i < 5; ++i) {
    const VkCommandBuffer commands = frames.begin();
    clear(commands, texture, {.uint32 = {0xfffffff0u + i, 0, 0, 0}});
    readback.record(commands, texture);
    frames.wait(frames.submit());
    std::uint32_t last = 0;
    std::memcpy(&last, readback.row(6).data() + 24, 4);
    EXPECT_EQ(last, 0xfffffff0u + i);
  }
}

using ReadbackDeathTest = ReadbackTest;

TEST_F(ReadbackDeathTest, RowsMustFitTheirPitch) {
  EXPECT_DEATH(Readback(context(), {5, 1}, VK_FORMAT_R8G8B8A8_UNORM, 16), "assertion failed");
  EXPECT_DEATH(Readback(context(), {5, 1}, VK_FORMAT_R8G8B8A8_UNORM, 30), "assertion failed");
}

}  // namespace
}  // namespace luxo::gpu
