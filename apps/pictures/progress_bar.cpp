// SPDX-License-Identifier: Apache-2.0
#include "progress_bar.h"

#include <fmt/format.h>
#include <unistd.h>

#include <string>

namespace luxo {

ProgressBar::ProgressBar(bool visible) : visible_(visible), onTerminal_(isatty(STDERR_FILENO) == 1) {}

ProgressBar::~ProgressBar() {
  if (drawn_) fmt::print(stderr, "\r\x1b[K");
}

void ProgressBar::show(double done) {
  const std::chrono::milliseconds pause(onTerminal_ ? 100 : 5000);
  constexpr int kWidth = 40;
  const Clock::time_point now = Clock::now();
  if (!visible_ || done <= 0 || now - last_ < pause) return;
  last_ = now;
  const double passed = std::chrono::duration<double>(now - start_).count(), left = passed * (1 / done - 1);
  if (!onTerminal_) {
    fmt::print(stderr, "{:.0f} %, {:.0f} s left\n", 100 * done, left);
    return;
  }
  drawn_ = true;
  const int filled = static_cast<int>(done * kWidth);
  fmt::print(stderr, "\r[{}{}] {:3.0f} %, {:.0f} s left \x1b[K", std::string(filled, '#'),
             std::string(kWidth - filled, '.'), 100 * done, left);
}

}  // namespace luxo
