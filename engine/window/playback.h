// SPDX-License-Identifier: Apache-2.0
// Which moment of an animation to show now. Pure: the caller brings the clock.
#pragma once

#include <chrono>
#include <cmath>

namespace luxo::window {

/// Plays, pauses, steps. A moment is a start, in seconds, plus what was played since, in whole nanoseconds:
/// however often it pauses, it never drifts. Every call that takes `now` needs one that does not go back.
class Playback {
 public:
  using Clock = std::chrono::steady_clock;

  Playback(double startSeconds, bool playing, Clock::time_point now)
      : start_(startSeconds), playing_(playing), since_(now) {}

  [[nodiscard]] double seconds(Clock::time_point now) const {
    return start_ + std::chrono::duration<double>(played(now)).count();
  }
  [[nodiscard]] bool playing() const { return playing_; }

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

  double start_;
  bool playing_;
  std::chrono::nanoseconds played_{};  // between `start_` and `since_`
  Clock::time_point since_;
};

}  // namespace luxo::window
