// SPDX-License-Identifier: Apache-2.0
#include "gpu/deep_stack.h"

#include <fmt/format.h>
#include <pthread.h>

#include <exception>
#include <system_error>

#include "base/error.h"

namespace luxo::gpu {
namespace {

struct Task {
  const std::function<void()>& action;
  std::exception_ptr failure = {};
};

void* perform(void* argument) {
  Task& task = *static_cast<Task*>(argument);
  try {
    task.action();
  } catch (...) {
    task.failure = std::current_exception();
  }
  return nullptr;
}

}  // namespace

void onDeepStack(const std::function<void()>& action) {
  Task task{action};
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  pthread_attr_setstacksize(&attributes, kDeepStackBytes);
  pthread_t thread{};
  const int failed = pthread_create(&thread, &attributes, perform, &task);
  pthread_attr_destroy(&attributes);
  if (failed != 0)
    throw Error(ErrorKind::Retry,
                fmt::format("cannot start a thread that compiles a shader: {}",
                            std::generic_category().message(failed)),
                "let the process have more memory or threads (ulimit -v, ulimit -u)");
  pthread_join(thread, nullptr);
  if (task.failure) std::rethrow_exception(task.failure);
}

}  // namespace luxo::gpu
