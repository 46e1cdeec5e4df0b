// SPDX-License-Identifier: Apache-2.0
#include "gpu/device.h"

#include "base/error.h"
#include "gpu/adapter.h"
#include "gpu/instance.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <sstream>

namespace luxo::gpu {
namespace {

std::string lower(std::string_view text) {
  std::string result(text);
  std::ranges::transform(result, result.begin(), [](unsigned char c) { return std::tolower(c); });
  return result;
}

std::optional<std::size_t> parseNumber(std::string_view text) {
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return number;
}

std::string listed(std::span<const DeviceInfo> devices) {
  std::string text;
  for (std::size_t i = 0; i < devices.size(); ++i) {
    const DeviceInfo& device = devices[i];
    text += fmt::format("\n  {}: {} ({}, {}, Vulkan {}): {}", i, device.name, deviceTypeName(device.type),
                        device.driver, device.apiVersion,
                        device.usable() ? "usable" : "not usable, " + device.missing);
  }
  return text;
}

// The first usable device of the first of these types that has one.
std::optional<std::size_t> firstUsable(std::span<const DeviceInfo> devices,
                                       std::span<const DeviceType> types) {
  for (const DeviceType type : types) {
    for (std::size_t i = 0; i < devices.size(); ++i) {
      if (devices[i].type == type && devices[i].usable()) return i;
    }
  }
  return std::nullopt;
}

[[noreturn]] void throwNotFound(std::span<const DeviceInfo> devices, std::string_view problem) {
  const bool anyUsable = std::ranges::any_of(devices, &DeviceInfo::usable);
  throw Error(ErrorKind::Device, fmt::format("{}; this machine has:{}", problem, listed(devices)),
              anyUsable ? "choose one by its number or a part of its name, or let luxo choose: auto"
                        : "update the driver, or draw on the processor: apt install mesa-vulkan-drivers");
}

[[noreturn]] void throwUnusable(std::span<const DeviceInfo> devices, std::string_view wanted,
                                const DeviceInfo& device) {
  throwNotFound(devices,
                fmt::format("Vulkan device {} ({}) is not usable: {}", wanted, device.name, device.missing));
}

std::size_t chooseName(std::span<const DeviceInfo> devices, std::string_view wanted) {
  const std::string part = lower(wanted);
  const DeviceInfo* unusable = nullptr;
  for (std::size_t i = 0; i < devices.size(); ++i) {
    if (lower(devices[i].name).find(part) == std::string::npos) continue;
    if (devices[i].usable()) return i;
    if (unusable == nullptr) unusable = &devices[i];
  }
  if (unusable != nullptr) throwUnusable(devices, wanted, *unusable);
  throwNotFound(devices, fmt::format("there is no Vulkan device '{}'", wanted));
}

}  // namespace

const char* deviceTypeName(DeviceType type) noexcept {
  switch (type) {
    case DeviceType::Discrete:
      return "discrete GPU";
    case DeviceType::Integrated:
      return "integrated GPU";
    case DeviceType::Virtual:
      return "virtual GPU";
    case DeviceType::Cpu:
      return "CPU";
    case DeviceType::Other:
      break;
  }
  return "other";
}

std::size_t chooseDevice(std::span<const DeviceInfo> devices, std::string_view wanted) {
  using enum DeviceType;
  static constexpr std::array kAll{Discrete, Integrated, Virtual, Cpu, Other};
  static constexpr std::array kGpus{Discrete, Integrated, Virtual};
  static constexpr std::array kCpus{Cpu};

  if (devices.empty()) {
    throw Error(ErrorKind::Device, "no Vulkan device found: no installed driver offers one", noDriverHint());
  }
  const std::string name = lower(wanted);
  if (const auto number = parseNumber(name)) {
    if (*number >= devices.size())
      throwNotFound(devices, fmt::format("there is no Vulkan device '{}'", wanted));
    if (!devices[*number].usable()) throwUnusable(devices, wanted, devices[*number]);
    return *number;
  }
  const bool keyword = name == "auto" || name == "gpu" || name == "cpu";
  if (!keyword) return chooseName(devices, wanted);

  const std::span<const DeviceType> types = name == "auto"  ? std::span<const DeviceType>(kAll)
                                            : name == "gpu" ? kGpus
                                                            : std::span<const DeviceType>(kCpus);
  if (const auto found = firstUsable(devices, types)) return *found;
  throwNotFound(devices, name == "auto"
                             ? "no Vulkan device is usable"
                             : fmt::format("no usable Vulkan device is a {}", name == "gpu" ? "GPU" : "CPU"));
}

std::string noDriverHint() {
  for (const char* variable : {"VK_DRIVER_FILES", "VK_ICD_FILENAMES"}) {
    const char* value = std::getenv(variable);
    if (value == nullptr || *value == '\0') continue;
    std::istringstream files(value);
    for (std::string file; std::getline(files, file, ':');) {
      if (!file.empty() && !std::filesystem::exists(std::filesystem::path(file))) {
        return fmt::format("{} names {}, which does not exist: unset it, or name a driver's .json file there",
                           variable, file);
      }
    }
    return fmt::format(
        "{}={} hides every other driver, and names none that works: unset it to use what is "
        "installed",
        variable, value);
  }
  return "install a driver: apt install mesa-vulkan-drivers (it also draws on the processor, without a GPU)";
}

std::vector<DeviceInfo> listDevices() {
  const Instance instance = createInstance({});
  std::vector<DeviceInfo> infos;
  for (Adapter& adapter : findAdapters(instance.get(), {})) infos.push_back(std::move(adapter.info));
  return infos;
}

}  // namespace luxo::gpu
