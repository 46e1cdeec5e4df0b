// SPDX-License-Identifier: Apache-2.0
#include "gpu/address_space.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <charconv>
#include <limits>
#include <system_error>

#include "base/error.h"

namespace luxo::gpu {

std::uint64_t addressSpaceLeft() {
  constexpr std::uint64_t kAll = std::numeric_limits<std::uint64_t>::max();
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return kAll;
  const int file = open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
  std::array<char, 32> text{};
  const ssize_t size = file < 0 ? 0 : read(file, text.data(), text.size());
  if (file >= 0) close(file);
  std::uint64_t pages = 0;
  if (size <= 0 || std::from_chars(text.data(), text.data() + size, pages).ec != std::errc()) return kAll;
  const std::uint64_t used = pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
  return limit.rlim_cur > used ? limit.rlim_cur - used : 0;
}

void requireRoomForShaders(std::string_view what) {
  const std::uint64_t left = addressSpaceLeft();
  if (left >= kShaderBytes) return;
  throw Error(ErrorKind::Retry,
              fmt::format("cannot {}: a memory limit leaves {} MiB, and the driver's compiler needs {}", what,
                          left >> 20, kShaderBytes >> 20),
              "allow more memory (ulimit -v)");
}

}  // namespace luxo::gpu
