// SPDX-License-Identifier: Apache-2.0
// `--report`: what a run did, as JSON with stable names.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "draw/device_precision.h"
#include "draw/statistics.h"
#include "scene/camera.h"

namespace luxo {

/// What rays say of a picture: how much of it is proven, and what sampling leaves open.
struct ReferenceStatistics {
  std::uint64_t hits = 0, misses = 0;  ///< pixels whose centre is proven to show a surface, nothing
  std::uint64_t undecided = 0;         ///< pixels in which some ray is within rounding of either
  double standardErrorRms = 0, standardErrorMax = 0;  ///< of the colour, scene-linear
};

struct FrameReport {
  int frame = 1;
  double time = 0;
  std::filesystem::path file;
  std::vector<std::pair<std::string, double>> parameters;  ///< of the scene, with their values
  std::uint64_t cutNumbers = 0;                            ///< Snapshot::cutNumbers
  std::uint64_t approximateShadows = 0;                    ///< lights whose shadows are not exact
  FrameStatistics statistics;
  std::optional<ReferenceStatistics> reference;  ///< cast, not drawn: most of `statistics` does not apply
  std::optional<std::string> error;              ///< why there is no file
  std::string scene = {};                        ///< where a run has several
  std::optional<std::array<int, 2>> at = {};     ///< the pixel of the file where the picture begins
};

struct DeviceReport {
  std::string name, type;
  std::optional<std::string> driver;
  std::optional<SinCosError> sinCos;  ///< of a Vulkan device
};

struct RunReport {
  DeviceReport device;
  std::string scene;
  PixelSize size;
  double startupMs = 0;  ///< from the start of the program to the first frame
  std::vector<FrameReport> frames;
};

/// Which sin and cos formulas are drawn with, and how wrong those and the driver's are; null for none.
[[nodiscard]] nlohmann::ordered_json sinCosJson(const std::optional<SinCosError>& error);

/// Values that do not apply are null, and so are infinite ones, which JSON does not have.
[[nodiscard]] std::string reportJson(const RunReport& report);
/// To a file, or, of -, to stdout. Error(Write): it cannot be written.
void writeReport(const RunReport& report, const std::filesystem::path& file);

}  // namespace luxo
