// SPDX-License-Identifier: Apache-2.0
// What the viewer writes over the picture.
#pragma once

#include <string>
#include <vector>

#include "draw/statistics.h"
#include "scene/camera.h"
#include "viewer/controls.h"
#include "viewer/frame_meter.h"
#include "viewer/progressive_mean.h"
#include "window/overlay.h"

namespace luxo {

struct Message {
  std::string text;
  bool alert = false;
};

/// Everything the panels tell.
struct Status {
  std::string title, device;
  PixelSize size;
  int samples = 1;                   ///< per pixel, of the picture that is shown
  Shading shading = Shading::Exact;  ///< of the picture that is shown
  double seconds = 0;
  bool tellsPasses = false;    ///< how long each takes
  FrameStatistics statistics;  ///< of the picture that is shown
  FrameMeter::Reading reading;
  ProgressiveMean::Audit audit;
};

[[nodiscard]] window::Panel numbersPanel(const Status& status, const Controls& controls);
[[nodiscard]] window::Panel keysPanel();
[[nodiscard]] window::Panel messagePanel(const Message& message);
/// What is wrong, as much of it as fits a window of that size.
[[nodiscard]] window::Panel errorPanel(const std::string& title, const std::string& text, PixelSize window,
                                       double contentScale);

}  // namespace luxo
