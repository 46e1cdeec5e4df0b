// SPDX-License-Identifier: Apache-2.0
#include "window/playback.h"

#include <gtest/gtest.h>

namespace luxo::window {
namespace {

using std::chrono::nanoseconds;
using std::chrono::seconds;

constexpr Playback::Clock::time_point kStart{nanoseconds(123'456'789)};

TEST(WindowPlayback, FollowsTheClockFromItsStart) {
  const Playback playback(21, true, kStart);
  EXPECT_EQ(playback.seconds(kStart), 21);
  EXPECT_EQ(playback.seconds(kStart + seconds(3)), 24);
}

TEST(WindowPlayback, StandsStillWhilePaused) {
  Playback playback(0, true, kStart);
  playback.setPlaying(false, kStart + seconds(2));
  EXPECT_EQ(playback.seconds(kStart + seconds(2)), 2);
  EXPECT_EQ(playback.seconds(kStart + seconds(100)), 2);
  playback.setPlaying(true, kStart + seconds(100));
  EXPECT_EQ(playback.seconds(kStart + seconds(101)), 3);
}

// A third of a second has no exact nanoseconds and no exact double: sums of either would drift.
TEST(WindowPlayback, AMillionPausesDoNotDrift) {
  Playback playback(0, true, kStart);
  Playback::Clock::time_point now = kStart;
  for (int i = 0; i < 1'000'000; ++i) {
    now += nanoseconds(333'333'333);
    playback.setPlaying(false, now);
    now += nanoseconds(77);
    playback.setPlaying(true, now);
  }
  EXPECT_EQ(playback.seconds(now), 333'333.333);
}

TEST(WindowPlayback, StepsOntoFramesExactly) {
  Playback playback(0, true, kStart);
  const Playback::Clock::time_point now = kStart + nanoseconds(60'000'000);  // between frames 1 and 2
  playback.stepFrames(1, 24, now);
  EXPECT_FALSE(playback.playing());
  EXPECT_EQ(playback.seconds(now), 2.0 / 24);
  for (int i = 0; i < 1000; ++i) playback.stepFrames(1, 24, now);
  EXPECT_EQ(playback.seconds(now), 1002.0 / 24);
  for (int i = 0; i < 1003; ++i) playback.stepFrames(-1, 24, now);
  EXPECT_EQ(playback.seconds(now), -1.0 / 24);
}

TEST(WindowPlayback, StepsBackFromBetweenFrames) {
  Playback playback(0, true, kStart);
  const Playback::Clock::time_point now = kStart + nanoseconds(60'000'000);
  playback.stepFrames(-1, 24, now);
  EXPECT_EQ(playback.seconds(now), 1.0 / 24);
}

TEST(WindowPlayback, GoesOnFromWhereItWasPut) {
  Playback playback(0, true, kStart);
  playback.pauseAt(5.5, kStart + seconds(1));
  EXPECT_EQ(playback.seconds(kStart + seconds(9)), 5.5);
  playback.setPlaying(true, kStart + seconds(9));
  EXPECT_EQ(playback.seconds(kStart + seconds(10)), 6.5);
}

TEST(WindowPlayback, LoopsAsItPlays) {
  Playback playback(0.5, true, kStart);
  playback.setLoop(2);
  EXPECT_EQ(playback.seconds(kStart + seconds(1)), 1.5);
  EXPECT_EQ(playback.seconds(kStart + seconds(2)), 0.5);
  EXPECT_EQ(playback.seconds(kStart + nanoseconds(1'500'000'000)), 0);  // the end is the beginning
  EXPECT_EQ(playback.seconds(kStart + seconds(1'000'001)), 1.5);
  playback.setPlaying(false, kStart + seconds(3));
  EXPECT_EQ(playback.seconds(kStart + seconds(90)), 1.5);
  playback.setPlaying(true, kStart + seconds(90));
  EXPECT_EQ(playback.seconds(kStart + seconds(91)), 0.5);
  playback.setLoop(0);
  EXPECT_EQ(playback.seconds(kStart + seconds(91)), 4.5);
}

// What is asked for is shown: the end of a loop, what is before it and what is after.
TEST(WindowPlayback, StaysWhereItIsPutThoughItLoops) {
  Playback playback(7, false, kStart);
  playback.setLoop(2);
  EXPECT_EQ(playback.seconds(kStart + seconds(9)), 7);
  playback.pauseAt(2, kStart);
  EXPECT_EQ(playback.seconds(kStart), 2);
  playback.pauseAt(-0.25, kStart);
  EXPECT_EQ(playback.seconds(kStart), -0.25);
  playback.setPlaying(true, kStart);
  EXPECT_EQ(playback.seconds(kStart + nanoseconds(125'000'000)), 1.875);
}

}  // namespace
}  // namespace luxo::window
