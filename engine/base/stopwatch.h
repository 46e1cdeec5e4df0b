// SPDX-License-Identifier: Apache-2.0
// How long something took.
#pragma once

#include <chrono>

namespace luxo {

/// Wall time, from a clock that is never set back; it runs from when the stopwatch is made.
class Stopwatch {
 public:
  [[nodiscard]] double milliseconds() const {
    return std::chrono::duration<double, std::milli>(Clock::now() - start_).count();
  }
  [[nodiscard]] double seconds() const { return milliseconds() / 1000; }

  /// Milliseconds since it was made, or since the last lap.
  double lap() {
    const auto now = Clock::now();
    const std::chrono::duration<double, std::milli> passed = now - start_;
    start_ = now;
    return passed.count();
  }

 private:
  using Clock = std::chrono::steady_clock;

  Clock::time_point start_ = Clock::now();
};

}  // namespace luxo
