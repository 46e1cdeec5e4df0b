// SPDX-License-Identifier: Apache-2.0
#include "fingerprint.h"

#include <fmt/format.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <thread>

namespace luxo {
namespace {

std::string processorName() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (const auto colon = line.find(": "); line.starts_with("model name") && colon != std::string::npos)
      return line.substr(colon + 2);
  return "unknown";
}

std::string systemName() {
  utsname system{};
  if (uname(&system) != 0) return "unknown";
  return fmt::format("{} {} {}", system.sysname, system.release, system.machine);
}

std::string memorySize() {
  const double bytes =
      static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  return fmt::format("{:.0f} GiB", bytes / (1 << 30));
}

/// Of the last minute: what else the machine did, in cores.
std::string load() {
  double average = 0;
  return getloadavg(&average, 1) == 1 ? fmt::format("{:.2f}", average) : "unknown";
}

std::string compilerName() {
#ifdef __clang__
  return "clang " __clang_version__;
#else
  return "g++ " __VERSION__;
#endif
}

}  // namespace

Fingerprint fingerprintOf(const gpu::DeviceInfo& device) {
  Fingerprint fingerprint = {
      {"luxo", LUXO_VERSION},         {"compiler", compilerName()},
      {"device", device.name},        {"device_type", gpu::deviceTypeName(device.type)},
      {"driver", device.driver},      {"vulkan", device.apiVersion},
      {"processor", processorName()}, {"cores", std::to_string(std::thread::hardware_concurrency())},
      {"memory", memorySize()},       {"system", systemName()},
      {"load_before", load()},
  };
  if (const char* threads = std::getenv("LP_NUM_THREADS"))
    fingerprint.emplace_back("LP_NUM_THREADS", threads);
  return fingerprint;
}

}  // namespace luxo
