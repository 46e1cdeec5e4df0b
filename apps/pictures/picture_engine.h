// SPDX-License-Identifier: Apache-2.0
// What makes a picture of a snapshot: the Vulkan device, or rays.
#pragma once

#include <memory>
#include <optional>

#include "draw/statistics.h"
#include "gpu/validation.h"
#include "image/image.h"
#include "options.h"
#include "report.h"
#include "scene/scene.h"
#include "scene/snapshot.h"

namespace luxo {

struct MadePicture {
  Image image;
  FrameStatistics statistics;
  std::optional<ReferenceStatistics> reference = std::nullopt;
};

class PictureEngine {
 public:
  PictureEngine() = default;
  PictureEngine(const PictureEngine&) = delete;
  PictureEngine& operator=(const PictureEngine&) = delete;
  virtual ~PictureEngine() = default;

  [[nodiscard]] virtual DeviceReport device() const = 0;

  /// Nothing when a signal stopped the work half way (interruption.h).
  [[nodiscard]] virtual std::optional<MadePicture> make(const Snapshot& snapshot) = 0;
};

/// Draws on the device that the request names, and shows on a terminal how far a picture of many passes is.
/// Error(Device): there is none. With request.validate the log
/// takes what Vulkan's validation says, until the engine is gone.
[[nodiscard]] std::unique_ptr<PictureEngine> vulkanEngine(const RenderRequest& request,
                                                          const RenderSettings& settings,
                                                          std::shared_ptr<gpu::ValidationLog> validation);

/// Casts rays on all cores and needs no device. Shows on a terminal how far it is and how long it still
/// takes. Error(Scene): the settings ask for what has no ground truth: lines, a view.
[[nodiscard]] std::unique_ptr<PictureEngine> referenceEngine(const RenderRequest& request,
                                                             const RenderSettings& settings);

}  // namespace luxo
