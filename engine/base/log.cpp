// SPDX-License-Identifier: Apache-2.0
#include "base/log.h"

#include <mutex>

namespace luxo {
namespace {

struct Sink {
  std::mutex mutex;
  LogSink write;
};

Sink& sink() {
  static Sink instance;
  return instance;
}

}  // namespace

void setLogSink(LogSink write) {
  const std::lock_guard lock(sink().mutex);
  sink().write = std::move(write);
}

void log(LogLevel level, const std::string& message) {
  const std::lock_guard lock(sink().mutex);
  if (sink().write) sink().write(level, message);
}

}  // namespace luxo
