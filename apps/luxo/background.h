// SPDX-License-Identifier: Apache-2.0
// Work beside the calling thread, where the system gives another one.
#pragma once

#include <future>
#include <memory>
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

}  // namespace luxo
