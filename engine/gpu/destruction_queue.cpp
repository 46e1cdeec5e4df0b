// SPDX-License-Identifier: Apache-2.0
#include "gpu/destruction_queue.h"

#include "base/assert.h"

#include <utility>

namespace luxo::gpu {

void DestructionQueue::push(Destroy destroy) {
  if (openRecordings_ > 0) {
    unnumbered_.push_back(std::move(destroy));
  } else {
    numbered_.push_back({lastSubmitted_, std::move(destroy)});
  }
}

void DestructionQueue::recordingEnded() {
  LUXO_REQUIRE_COMPARE(openRecordings_, >, 0);
  // Only when the last recording is closed is it known which submission could use them last.
  if (--openRecordings_ > 0) return;
  for (Destroy& destroy : unnumbered_) numbered_.push_back({lastSubmitted_, std::move(destroy)});
  unnumbered_.clear();
}

void DestructionQueue::collect(std::uint64_t completed) {
  while (!numbered_.empty() && numbered_.front().number <= completed) {
    const Destroy destroy = std::move(numbered_.front().destroy);
    numbered_.pop_front();
    destroy();
  }
}

void DestructionQueue::drain() {
  collect(lastSubmitted_);
  for (const Destroy& destroy : std::exchange(unnumbered_, {})) destroy();
}

}  // namespace luxo::gpu
