// SPDX-License-Identifier: Apache-2.0
// Independent pieces of work on all cores.
#pragma once

#include <oneapi/tbb/parallel_for.h>

#include <cstddef>

namespace luxo {

/// Calls work(0) .. work(count - 1), each once: in order on this thread, or in any order on all of them where
/// that is worth waking them.
template <class Work>
void forEachIndex(std::size_t count, bool onAllCores, const Work& work) {
#ifdef LUXO_SHORT_LOOPS_TOO  // for the thread sanitizer, to which few tests' loops would be long enough
  onAllCores = true;
#endif
  if (onAllCores)
    oneapi::tbb::parallel_for(std::size_t{0}, count, work);
  else
    for (std::size_t i = 0; i < count; ++i) work(i);
}

}  // namespace luxo
