// SPDX-License-Identifier: Apache-2.0
// Which moment of an animation to show now. Pure: the caller brings the clock.
#pragma once

#include <chrono>
#include <cmath>

namespace luxo::window {

/// Plays, pauses, steps. A moment is a start, in seconds, plus what was played since, in whole nanoseconds:
/// however often it pauses, it never drifts. One that loops begins anew at 0 as it plays, and stays where it
/// is put. Every call that takes `now` needs one that does not go back.
class Playback {
 public:
  using Clock = std::chrono::steady_clock;

  Playback(double startSeconds, bool playing, Clock::time_point now)
      : start_(startSeconds), playing_(playing), since_(now) {}

  [[nodiscard]] double seconds(Clock::time_point now) const {
    const std::chrono::nanoseconds since = played(now);
    const double moment = start_ + std::chrono::duration<double>(since).count();
    if (loop_ == 0 || since.count() == 0 || (moment >= 0 && moment < loop_)) return moment;
    const double part = std::fmod(moment, loop_);
    return part < 0 ? part + loop_ : part;
  }
  [[nodiscard]] bool playing() const { return playing_; }
  /// Seconds that it lasts; 0: it goes on for ever.
  [[nodiscard]] double loop() const { return loop_; }
  void setLoop(double seconds) { loop_ = seconds; }

  void setPlaying(bool playing, Clock::time_point now) {
    played_ = played(now);
    since_ = now;
    playing_ = playing;
  }

  /// Pauses on the next (or previous) frame of an animation with that many per second: at n / fps exactly, as
  /// files are rendered.
  void stepFrames(int frames, double fps, Clock::time_point now) {
    const double position = seconds(now) * fps;
    const double nearest = std::round(position);
    const bool onFrame = std::abs(position - nearest) < 1e-6;
    const double from = onFrame ? nearest : frames > 0 ? std::floor(position) : std::ceil(position);
    pauseAt((from + frames) / fps, now);
  }

  void pauseAt(double seconds, Clock::time_point now) {
    start_ = seconds;
    played_ = {};
    since_ = now;
    playing_ = false;
  }

 private:
  [[nodiscard]] std::chrono::nanoseconds played(Clock::time_point now) const {
    return playing_ ? played_ + std::chrono::nanoseconds(now - since_) : played_;
  }

  double start_, loop_ = 0;
  bool playing_;
  std::chrono::nanoseconds played_{};  // between `start_` and `since_`
  Clock::time_point since_;
};

}  // namespace luxo::window
