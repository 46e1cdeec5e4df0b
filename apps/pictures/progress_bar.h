// SPDX-License-Identifier: Apache-2.0
// How far work is that takes a while: one line on a terminal, wiped when it is over; elsewhere (a log of a
// CI) a line every five seconds.
#pragma once

#include <chrono>

namespace luxo {

class ProgressBar {
 public:
  /// An invisible one writes nothing.
  explicit ProgressBar(bool visible);
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;
  ~ProgressBar();

  /// From 0 to 1. Shows the time left, too; on a terminal at most ten times a second; nothing of work that is
  /// over before it would be shown first.
  void show(double done);

 private:
  using Clock = std::chrono::steady_clock;

  bool visible_, onTerminal_;
  bool drawn_ = false;
  Clock::time_point start_ = Clock::now(), last_ = start_;
};

}  // namespace luxo
