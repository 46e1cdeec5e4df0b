// SPDX-License-Identifier: Apache-2.0
#include "validation.h"

#include <fmt/format.h>

#include "base/error.h"

namespace luxo {

void requireNoMessage(const gpu::ValidationLog& log) {
  if (log.count() == 0) return;
  std::string texts;
  for (const std::string& message : log.messages()) texts += "\n  " + message;
  throw Error(ErrorKind::Internal,
              fmt::format("Vulkan validation reported {} message{}:{}", log.count(),
                          log.count() == 1 ? "" : "s", texts),
              "this is a bug in luxo; please report it with the command");
}

}  // namespace luxo
