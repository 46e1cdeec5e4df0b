// SPDX-License-Identifier: Apache-2.0
// Destroys things once the device can no longer be using them, without ever waiting for it. Pure: knows
// numbers only.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>

namespace luxo::gpu {

/// Submissions carry rising numbers. What is dropped now may be used by any submission so far, and by any
/// recording that is open: it is destroyed when all of those are complete, in the order dropped.
class DestructionQueue {
 public:
  using Destroy = std::function<void()>;

  /// Destroys at the next collect() when nothing was ever submitted or recorded.
  void push(Destroy destroy);

  void recordingBegan() noexcept { ++openRecordings_; }
  /// Call after submitted() for a recording that was submitted; on its own when it was dropped.
  void recordingEnded();
  void submitted(std::uint64_t number) noexcept { lastSubmitted_ = number; }

  /// Destroys what only submissions up to `completed` could use.
  void collect(std::uint64_t completed);
  /// Destroys all. The device must be idle.
  void drain();

  [[nodiscard]] std::size_t size() const noexcept { return unnumbered_.size() + numbered_.size(); }

 private:
  struct Entry {
    std::uint64_t number;  // of the last submission that could use it
    Destroy destroy;
  };

  int openRecordings_ = 0;
  std::uint64_t lastSubmitted_ = 0;
  std::deque<Destroy> unnumbered_;  // dropped while a recording was open
  std::deque<Entry> numbered_;
};

}  // namespace luxo::gpu
