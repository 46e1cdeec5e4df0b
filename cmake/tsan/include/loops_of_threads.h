// SPDX-License-Identifier: Apache-2.0
// What luxo uses of oneTBB, made of std::thread: the thread sanitizer sees how threads begin and end. Of
// oneTBB's own library it sees nothing, so that every loop would be a race to it. Nothing else orders the
// indices of a loop here (the counters are relaxed): what two of them touch without a lock is reported.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <thread>
#include <utility>
#include <vector>

/// engine/tessellate/parallel.h wakes threads for the shortest loop.
#define LUXO_SHORT_LOOPS_TOO

namespace tbb {
namespace threads {

/// At most this many beside those that begin loops; more than there are cores, as races need not be fast.
inline constexpr int kMaxHelpers = 3;

inline std::atomic<int> free = kMaxHelpers;

/// Of the arena that this thread is in.
inline thread_local int limit = kMaxHelpers + 1;

class Limit {
 public:
  explicit Limit(int most) : before_(std::exchange(limit, most)) {}
  ~Limit() { limit = before_; }
  Limit(const Limit&) = delete;
  Limit& operator=(const Limit&) = delete;

 private:
  int before_;
};

/// Threads that a loop may start.
class Helpers {
 public:
  explicit Helpers(std::size_t useful) {
    const auto most = static_cast<int>(std::min(useful, static_cast<std::size_t>(std::max(limit, 1) - 1)));
    int there = free.load(std::memory_order_relaxed);
    do count_ = std::clamp(there, 0, most);
    while (!free.compare_exchange_weak(there, there - count_, std::memory_order_relaxed));
  }
  ~Helpers() { free.fetch_add(count_, std::memory_order_relaxed); }
  Helpers(const Helpers&) = delete;
  Helpers& operator=(const Helpers&) = delete;

  [[nodiscard]] std::size_t count() const { return static_cast<std::size_t>(count_); }

 private:
  int count_ = 0;
};

}  // namespace threads

/// Every thread has one index for sure: even the shortest loop is on several.
template <class Index, class Work>
void parallel_for(Index first, Index last, const Work& work) {
  if (!(first < last)) return;
  const auto count = static_cast<std::size_t>(last - first);
  const threads::Helpers helpers(count - 1);
  std::atomic<std::size_t> next = helpers.count() + 1;
  std::vector<std::exception_ptr> thrown(helpers.count() + 1);
  const auto run = [&, limit = threads::limit](std::size_t worker) {
    const threads::Limit same(limit);
    try {
      for (std::size_t i = worker; i < count; i = next.fetch_add(1, std::memory_order_relaxed))
        work(static_cast<Index>(first + static_cast<Index>(i)));
    } catch (...) {
      thrown[worker] = std::current_exception();
      next.store(count, std::memory_order_relaxed);
    }
  };
  {
    std::vector<std::jthread> started;
    started.reserve(helpers.count());
    for (std::size_t worker = 1; worker <= helpers.count(); ++worker) started.emplace_back(run, worker);
    run(0);
  }
  for (const std::exception_ptr& exception : thrown)
    if (exception) std::rethrow_exception(exception);
}

template <class First, class Second>
void parallel_invoke(const First& first, const Second& second) {
  parallel_for(0, 2, [&](int i) {
    if (i == 0)
      first();
    else
      second();
  });
}

class task_arena {
 public:
  static constexpr int automatic = -1;

  explicit task_arena(int threads = automatic)
      : threads_(threads == automatic ? threads::kMaxHelpers + 1 : threads) {}
  task_arena(const task_arena&) = delete;
  task_arena& operator=(const task_arena&) = delete;

  template <class Work>
  decltype(auto) execute(const Work& work) {
    const threads::Limit mine(threads_);
    return work();
  }

 private:
  int threads_;
};

namespace this_task_arena {

/// Who waits for a loop here does nothing else.
template <class Work>
decltype(auto) isolate(const Work& work) {
  return work();
}

}  // namespace this_task_arena

class global_control {
 public:
  enum parameter { max_allowed_parallelism };

  global_control(parameter, std::size_t threads)
      : taken_(std::max(0, threads::kMaxHelpers + 1 - static_cast<int>(threads))) {
    threads::free.fetch_sub(taken_, std::memory_order_relaxed);
  }
  ~global_control() { threads::free.fetch_add(taken_, std::memory_order_relaxed); }
  global_control(const global_control&) = delete;
  global_control& operator=(const global_control&) = delete;

 private:
  int taken_;
};

}  // namespace tbb

namespace oneapi {
namespace tbb = ::tbb;
}
