// SPDX-License-Identifier: Apache-2.0
// What the viewer writes over the picture.
#pragma once

#include <string>
#include <vector>

#include "draw/statistics.h"
#include "scene/camera.h"
#include "viewer/controls.h"
#include "viewer/frame_meter.h"
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
  int samples = 1;  ///< per pixel, of the picture that is shown
  double seconds = 0;
  FrameStatistics statistics;  ///< of the picture that is shown
  FrameMeter::Reading reading;
  /// Of the samples that have joined the mean that is shown.
  struct Audit {
    std::uint64_t pixels = 0, wrong = 0, byRays = 0;
  } audit;
};

[[nodiscard]] window::Panel numbersPanel(const Status& status, const Controls& controls);
[[nodiscard]] window::Panel keysPanel();
[[nodiscard]] window::Panel messagePanel(const Message& message);
/// What is wrong, as much of it as fits a window of that size.
[[nodiscard]] window::Panel errorPanel(const std::string& title, const std::string& text, PixelSize window,
                                       double contentScale);

}  // namespace luxo
