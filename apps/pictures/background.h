// SPDX-License-Identifier: Apache-2.0
// Work beside the calling thread, where the system gives another one.
#pragma once

#include <atomic>
#include <chrono>
#include <future>
#include <memory>
#include <optional>
#include <system_error>
#include <utility>

namespace luxo {

/// The result of `work`, which runs in a thread of its own, or now where none can be started. What it throws
/// comes out of the future. Dropping the future waits for the work.
template <class Work>
[[nodiscard]] auto inBackground(Work work) -> std::future<decltype(work())> {
  const auto shared = std::make_shared<Work>(std::move(work));
  try {
    return std::async(std::launch::async, [shared] { return (*shared)(); });
  } catch (const std::system_error&) {
    std::promise<decltype((*shared)())> now;
    try {
      now.set_value((*shared)());
    } catch (...) {
      now.set_exception(std::current_exception());
    }
    return now.get_future();
  }
}

/// Work beside the window, one at a time, that may be called off. What it uses must outlive it.
template <class Result>
class BackgroundWork {
 public:
  BackgroundWork() = default;
  ~BackgroundWork() { cancel(); }
  BackgroundWork(const BackgroundWork&) = delete;
  BackgroundWork& operator=(const BackgroundWork&) = delete;

  /// Requires that it is not busy.
  template <class Work>
  void begin(Work work) {
    working_ = inBackground(std::move(work));
  }
  /// For the work itself, from any thread: whether it should end.
  [[nodiscard]] bool cancelled() const { return cancelled_; }
  /// Waits until it has, and forgets the outcome.
  void cancel() {
    if (!busy()) return;
    cancelled_ = true;
    working_.wait();
    working_ = {};
    cancelled_ = false;
  }
  [[nodiscard]] bool busy() const { return working_.valid(); }
  /// Once it is there.
  [[nodiscard]] std::optional<Result> poll() {
    if (!busy() || working_.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
      return std::nullopt;
    return working_.get();
  }

 private:
  std::atomic<bool> cancelled_ = false;
  std::future<Result> working_;
};

}  // namespace luxo
