// SPDX-License-Identifier: Apache-2.0
// luxo doctor: is this machine ready, and what to install if not?
#include <fmt/format.h>
#include <sys/utsname.h>
#include <CLI/CLI.hpp>

#include <cstdlib>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/stopwatch.h"
#include "console.h"
#include "draw/device_precision.h"
#include "draw/renderer.h"
#include "exit_code.h"
#include "gpu/device.h"
#include "report.h"
#include "surface/library.h"
#include "verbs.h"

namespace luxo {
namespace {

constexpr const char* kVariables[] = {
    "VK_DRIVER_FILES", "VK_ICD_FILENAMES", "VK_LOADER_DRIVERS_SELECT", "VK_INSTANCE_LAYERS",
    "LUXO_DEVICE",     "LUXO_CACHE_DIR",   "LP_NUM_THREADS",           "MESA_VK_DEVICE_SELECT"};

struct Check {
  gpu::DeviceInfo info;
  std::string verdict;                     ///< empty: the test picture and the arithmetic are right
  std::optional<SinCosError> sinCos = {};  ///< none: it could not be measured
  double ms = 0;
};

/// A white unit square under ambient light 0.5 fills the picture: every pixel must be exactly 0.5.
std::string testPicture(gpu::Context& context) {
  Scene scene;
  scene.set(RenderSettings{.size = {64, 64}, .ambient = Vec3(0.5)});
  const MaterialId white = scene.add(Material{.diffuse = Vec3(1)});
  scene.add(Node{.surface = rectangle(2, 2), .material = white});
  scene.add(Camera{.eye = Vec3(0, 1, 0), .lookAt = Vec3(0), .fovY = radians(60)});
  const Picture picture = Renderer(context).render(scene);
  for (const float sample : picture.image.samples())
    if (sample != 0.5f) return fmt::format("drew {} where 0.5 is right", sample);
  return {};
}

std::string testArithmetic(const SinCosError& sinCos) {
  if (sinCos.ofFormulas <= kSinCosTolerance) return {};
  return fmt::format("finds sin and cos wrong by {:.2g}, more than {:.2g}", sinCos.ofFormulas,
                     kSinCosTolerance);
}

std::vector<Check> checkDevices() {
  std::vector<Check> checks;
  const std::vector<gpu::DeviceInfo> devices = gpu::listDevices();
  for (std::size_t i = 0; i < devices.size(); ++i) {
    Check check{devices[i], devices[i].missing};
    if (devices[i].usable()) {
      const Stopwatch watch;
      try {
        gpu::Context context({.device = std::to_string(i)});
        check.verdict = testPicture(context);
        check.sinCos = sinCosError(context, {});
        if (check.verdict.empty()) check.verdict = testArithmetic(*check.sinCos);
      } catch (const Error& error) {
        check.verdict = error.what();
      }
      check.ms = watch.milliseconds();
    }
    checks.push_back(std::move(check));
  }
  return checks;
}

nlohmann::ordered_json toJson(const std::vector<Check>& checks, bool ready) {
  nlohmann::ordered_json devices = nlohmann::ordered_json::array();
  for (const Check& c : checks)
    devices.push_back({{"name", c.info.name},
                       {"type", gpu::deviceTypeName(c.info.type)},
                       {"driver", c.info.driver},
                       {"api", c.info.apiVersion},
                       {"usable", c.verdict.empty()},
                       {"problem", c.verdict},
                       {"sin_cos", sinCosJson(c.sinCos)}});
  return {{"luxo", LUXO_VERSION}, {"ready", ready}, {"devices", std::move(devices)}};
}

int doctor(bool json) {
  const std::vector<Check> checks = checkDevices();
  bool ready = false;
  for (const Check& c : checks) ready = ready || c.verdict.empty();
  if (json) {
    printData(toJson(checks, ready).dump(2) + "\n");
  } else {
    utsname system{};
    uname(&system);
    printData(
        fmt::format("luxo {} on {} {} {}\n", LUXO_VERSION, system.sysname, system.release, system.machine));
    for (const char* name : kVariables)
      if (const char* value = std::getenv(name)) printData(fmt::format("  {}={}\n", name, value));
    for (std::size_t i = 0; i < checks.size(); ++i) {
      const Check& c = checks[i];
      printData(fmt::format("device {}: {} ({}, {}, Vulkan {})\n", i, c.info.name,
                            gpu::deviceTypeName(c.info.type), c.info.driver, c.info.apiVersion));
      printData(c.verdict.empty()
                    ? fmt::format("  the test picture is right ({:.0f} ms)\n"
                                  "  sin and cos are within {:.2g}, the driver's own within {:.2g}\n",
                                  c.ms, c.sinCos->ofFormulas, c.sinCos->ofDriver)
                    : fmt::format("  not usable: {}\n", c.verdict));
    }
    if (ready) printData("ready\n");
  }
  if (!ready) throw Error(ErrorKind::Device, "no usable Vulkan device", gpu::noDriverHint());
  return exit_code::kDone;
}

}  // namespace

void addDoctor(CLI::App& app, Command& chosen) {
  const auto json = std::make_shared<bool>(false);
  CLI::App* verb = app.add_subcommand("doctor", "is this machine ready, and what to install if not");
  verb->group("Verbs");
  verb->add_flag("--json", *json, "print the findings as JSON");
  verb->callback([json, &chosen] { chosen = [json] { return doctor(*json); }; });
}

}  // namespace luxo
