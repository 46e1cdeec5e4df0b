// SPDX-License-Identifier: Apache-2.0
// `--report`: what a run did, as JSON with stable names.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "draw/statistics.h"
#include "gpu/device.h"
#include "scene/camera.h"

namespace luxo {

struct FrameReport {
  int frame = 1;
  double time = 0;
  std::filesystem::path file;
  std::vector<std::pair<std::string, double>> parameters;  ///< of the scene, with their values
  FrameStatistics statistics;
  std::optional<std::string> error;  ///< why there is no file
};

struct RunReport {
  gpu::DeviceInfo device;
  std::string scene;
  PixelSize size;
  double startupMs = 0;  ///< from the start of the program to the first frame
  std::vector<FrameReport> frames;
};

/// Values that do not apply are null, and so are infinite ones, which JSON does not have.
[[nodiscard]] std::string reportJson(const RunReport& report);

}  // namespace luxo
