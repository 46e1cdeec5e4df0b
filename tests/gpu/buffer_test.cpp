// SPDX-License-Identifier: Apache-2.0
#include "gpu/buffer.h"

#include "gpu/barrier.h"
#include "gpu/frame.h"
#include "support/gpu_fixture.h"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

namespace luxo::gpu {
namespace {

std::vector<std::byte> counted(std::size_t size, int first = 0) {
  std::vector<std::byte> bytes(size);
  for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<std::byte>(first + static_cast<int>(i % 251));
  return bytes;
}

// Once as the device is, once as if the host could not see the device's memory.
class BufferTest : public test::GpuTest, public ::testing::WithParamInterface<bool> {
 protected:
  ContextDesc contextDesc() const override { return {.mapDeviceMemory = GetParam()}; }

  // Has the device copy the buffer to where the host can read it.
  std::vector<std::byte> readBack(FrameRing& frames, Buffer& buffer) {
    Buffer host(context(), {.size = buffer.size(), .memory = MemoryUse::Readback});
    const VkCommandBuffer commands = frames.begin();
    use(commands, {{buffer, Use::TransferSource}, {host, Use::TransferDestination}});
    const VkBufferCopy all{.size = buffer.size()};
    vkCmdCopyBuffer(commands, buffer, host, 1, &all);
    use(commands, {{host, Use::HostRead}});
    frames.wait(frames.submit());
    const auto bytes = host.read();
    return {bytes.begin(), bytes.end()};
  }

  BufferDesc source(VkDeviceSize size) const {
    return {.size = size,
            .usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
            .name = "source"};
  }
};

INSTANTIATE_TEST_SUITE_P(Memory, BufferTest, ::testing::Bool(),
                         [](const auto& memory) { return memory.param ? "AsTheDeviceHasIt" : "Staged"; });

TEST_P(BufferTest, TheDeviceSeesWhatWasWritten) {
  FrameRing frames(context());
  for (const std::size_t size : {1u, 3u, 1000u, 5'000'000u, 9'000'001u}) {  // the last one has its own memory
    Buffer buffer(context(), source(size));
    buffer.write(0, counted(size));
    EXPECT_EQ(readBack(frames, buffer), counted(size)) << size;
  }
}

TEST_P(BufferTest, LaterWritesCoverEarlierOnes) {
  FrameRing frames(context());
  Buffer buffer(context(), source(100));
  std::vector<std::byte> expected = counted(100);
  buffer.write(0, expected);
  buffer.write(40, counted(20, 7));
  buffer.write(59, counted(10, 100));
  std::ranges::copy(counted(20, 7), expected.begin() + 40);
  std::ranges::copy(counted(10, 100), expected.begin() + 59);
  EXPECT_EQ(readBack(frames, buffer), expected);
  buffer.write(99, counted(1, 200));  // after the device has read it
  expected[99] = std::byte{200};
  EXPECT_EQ(readBack(frames, buffer), expected);
}

TEST_P(BufferTest, CountsWhatWasUploaded) {
  FrameRing frames(context());
  Buffer buffer(context(), source(100));
  buffer.write(0, counted(60));
  buffer.write(60, counted(40));
  buffer.write(0, {});
  EXPECT_EQ(context().counters().uploadedBytes, 100u);
  frames.begin();
  frames.wait(frames.submit());
  EXPECT_EQ(context().counters().submits, 1u) << "staged copies travel with the frame";
}

TEST_P(BufferTest, DroppedBeforeItsWriteTravels) {
  FrameRing frames(context());
  {
    Buffer buffer(context(), source(100));
    buffer.write(0, counted(100));
  }
  frames.begin();
  frames.wait(frames.submit());
  context().waitIdle();
  EXPECT_EQ(context().counters().buffers, 0u);
}

TEST_P(BufferTest, ManySmallOnesShareFewBlocks) {
  std::vector<Buffer> buffers;
  for (int i = 0; i < 300; ++i) buffers.emplace_back(context(), source(1000));
  EXPECT_EQ(context().counters().buffers, 300u);
  EXPECT_GE(context().counters().memoryBytes, 300'000u);
  EXPECT_LE(context().counters().deviceAllocations, 3u);
  buffers.clear();
  context().waitIdle();
  EXPECT_EQ(context().counters().buffers, 0u);
  EXPECT_EQ(context().counters().memoryBytes, 0u);
}

TEST_P(BufferTest, UploadAndReadbackMemoryIsAlwaysMapped) {
  for (const MemoryUse memory : {MemoryUse::Upload, MemoryUse::Readback}) {
    const Buffer buffer(context(),
                        {.size = 77, .usage = VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, .memory = memory});
    EXPECT_EQ(buffer.mapped().size(), 77u);
  }
  if (!GetParam()) {
    EXPECT_TRUE(Buffer(context(), source(77)).mapped().empty());
  }
}

using BufferDeathTest = BufferTest;
INSTANTIATE_TEST_SUITE_P(Memory, BufferDeathTest, ::testing::Values(true));

TEST_P(BufferDeathTest, WritingPastTheEndAborts) {
  Buffer buffer(context(), source(100));
  EXPECT_DEATH(buffer.write(99, counted(2)), "assertion failed");
  EXPECT_DEATH(buffer.write(101, {}), "assertion failed");
  EXPECT_DEATH(Buffer(context(), source(0)), "assertion failed");
}

}  // namespace
}  // namespace luxo::gpu
