// SPDX-License-Identifier: Apache-2.0
// How long it takes from saving a shader to its new picture, and how much of that is the driver's own.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench_statistics.h"
#include "fingerprint.h"
#include "gpu/context.h"
#include "scene/camera.h"

namespace luxo {

struct ReloadRow {
  std::string shader;
  /// From the file that is written to the picture that is read: the file is read, compiled, reflected, its
  /// scene built, its pipelines made, the picture drawn. Without what tells a window that a file was saved.
  Typical totalMs;
  /// Of that, the driver's own: making pipelines, and compiling them when they first draw, which is by how
  /// much the device takes longer than for the same picture drawn again.
  Typical driverMs;
  Typical ownMs;            ///< the rest, drawing included
  std::vector<double> own;  ///< that of each run
};

/// Those of the gallery that are edited: from the least to what is long and calls noise many times.
[[nodiscard]] std::vector<std::string> reloadShaders();

struct ReloadBench {
  Fingerprint machine;
  PixelSize size;
  int runs = 0;
  std::vector<ReloadRow> rows;
};

struct ReloadPlan {
  PixelSize size{640, 360};
  int runs = 15;  ///< of each shader, each by another text that no cache knows
  std::vector<std::string> shaders = reloadShaders();
};

/// On a context of its own. `goesOn` as for measureScene(): nothing once it says no. Throws what Context,
/// openShader() and Renderer throw. From here on this process keeps in no cache of luxo's what it compiles.
/// Cost: a second for each run.
[[nodiscard]] std::optional<ReloadBench> benchReload(const gpu::ContextDesc& desc, const ReloadPlan& plan,
                                                     const std::function<bool(double)>& goesOn);

[[nodiscard]] std::string reloadText(const ReloadBench& bench);
[[nodiscard]] std::string reloadJson(const ReloadBench& bench);

}  // namespace luxo
