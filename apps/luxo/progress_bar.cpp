// SPDX-License-Identifier: Apache-2.0
#include "progress_bar.h"

#include <fmt/format.h>

#include <string>

namespace luxo {

ProgressBar::~ProgressBar() {
  if (drawn_) fmt::print(stderr, "\r\x1b[K");
}

void ProgressBar::show(double done) {
  constexpr std::chrono::milliseconds kPause(100);
  constexpr int kWidth = 40;
  const Clock::time_point now = Clock::now();
  if (!visible_ || done <= 0 || now - last_ < kPause) return;
  last_ = now;
  drawn_ = true;
  const double passed = std::chrono::duration<double>(now - start_).count();
  const int filled = static_cast<int>(done * kWidth);
  fmt::print(stderr, "\r[{}{}] {:3.0f} %, {:.0f} s left \x1b[K", std::string(filled, '#'),
             std::string(kWidth - filled, '.'), 100 * done, passed * (1 / done - 1));
}

}  // namespace luxo
