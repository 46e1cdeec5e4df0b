// SPDX-License-Identifier: Apache-2.0
#include "gpu/destruction_queue.h"

#include <gtest/gtest.h>

#include <string>

namespace luxo::gpu {
namespace {

class DestructionQueueTest : public ::testing::Test {
 protected:
  void push(char name) {
    queue.push([this, name] { destroyed += name; });
  }

  DestructionQueue queue;
  std::string destroyed;
};

TEST_F(DestructionQueueTest, DestroysAtOnceWhatNothingUsed) {
  push('a');
  EXPECT_EQ(destroyed, "");
  queue.collect(0);
  EXPECT_EQ(destroyed, "a");
}

TEST_F(DestructionQueueTest, WaitsForTheSubmissionsSoFar) {
  queue.submitted(1);
  queue.submitted(2);
  push('a');
  queue.submitted(3);
  push('b');
  queue.collect(1);
  EXPECT_EQ(destroyed, "");
  queue.collect(2);
  EXPECT_EQ(destroyed, "a");
  queue.collect(3);
  EXPECT_EQ(destroyed, "ab");
}

TEST_F(DestructionQueueTest, WaitsForTheOpenRecordingToBeSubmittedAndComplete) {
  queue.recordingBegan();
  push('a');
  queue.collect(0);
  EXPECT_EQ(destroyed, "");
  queue.submitted(1);
  queue.recordingEnded();
  queue.collect(0);
  EXPECT_EQ(destroyed, "");
  queue.collect(1);
  EXPECT_EQ(destroyed, "a");
}

TEST_F(DestructionQueueTest, WaitsForTheLastOfOverlappingRecordings) {
  queue.recordingBegan();
  push('a');
  queue.recordingBegan();
  queue.submitted(1);
  queue.recordingEnded();
  queue.collect(1);
  EXPECT_EQ(destroyed, "") << "the other recording may use it";
  queue.submitted(2);
  queue.recordingEnded();
  queue.collect(1);
  EXPECT_EQ(destroyed, "");
  queue.collect(2);
  EXPECT_EQ(destroyed, "a");
}

TEST_F(DestructionQueueTest, ADroppedRecordingUsesNothing) {
  queue.submitted(1);
  queue.recordingBegan();
  push('a');
  queue.recordingEnded();
  queue.collect(1);
  EXPECT_EQ(destroyed, "a");
}

TEST_F(DestructionQueueTest, KeepsTheOrderAndDrainsAll) {
  push('a');
  queue.submitted(1);
  push('b');
  queue.recordingBegan();
  push('c');
  EXPECT_EQ(queue.size(), 3u);
  queue.drain();
  EXPECT_EQ(destroyed, "abc");
  EXPECT_EQ(queue.size(), 0u);
}

TEST_F(DestructionQueueTest, DestroyingMayDropMore) {
  queue.push([this] { push('b'); });
  queue.collect(0);
  EXPECT_EQ(destroyed, "b");
}

}  // namespace
}  // namespace luxo::gpu
