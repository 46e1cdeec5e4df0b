// SPDX-License-Identifier: Apache-2.0
// A picture by POV-Ray, run as a program (Debian package povray).
#pragma once

#include <string>
#include <vector>

#include "scene/camera.h"

namespace luxo::povray {

struct PovPicture {
  /// Scene-linear red, green, blue of each pixel's centre, 0 to 1 in steps of 1/65535, from the top left.
  std::vector<double> samples;
  double seconds = 0;  ///< of the whole program
};

/// Whether there is a `povray` to run.
[[nodiscard]] bool isInstalled();

/// Rows of a picture: from the first to before the end.
struct Rows {
  int first = 0, end = 0;
};

/// One ray through each pixel's centre, on all cores; black outside of `rows`. Throws Error(Internal) with
/// the end of POV-Ray's log when it fails.
[[nodiscard]] PovPicture render(const std::string& sceneText, PixelSize size, Rows rows);
[[nodiscard]] inline PovPicture render(const std::string& sceneText, PixelSize size) {
  return render(sceneText, size, {0, size.height});
}

}  // namespace luxo::povray
