// SPDX-License-Identifier: Apache-2.0
// What a scene shows now, and through which camera.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scene/camera.h"
#include "scene/snapshot.h"
#include "viewer.h"
#include "viewer/controls.h"

namespace luxo {

class ViewedMoment {
 public:
  /// Both must outlive this.
  ViewedMoment(const ViewedScene& viewed, const Controls& controls)
      : viewed_(&viewed), controls_(&controls) {}

  /// Another scene has come into view.
  void look();

  /// Where the scene has no camera, one that stands still while sliders move: turning a parameter shows what
  /// it does.
  [[nodiscard]] Camera sceneCamera(PixelSize size);

  /// Lights with a radius have few samples while anything moves, and more after each soften(). A moment that
  /// the scene does not allow (a value out of its range) leaves `last`, what is shown; where that is null,
  /// nothing yet, it throws Error(Scene).
  [[nodiscard]] Snapshot next(PixelSize size, const Snapshot* last);
  /// With all samples.
  [[nodiscard]] Snapshot whole(PixelSize size, const Snapshot* last);
  /// False: next() has all samples that the scene asks for.
  [[nodiscard]] bool soften();
  [[nodiscard]] std::uint32_t shadowSamples() const { return shadowSamples_; }  ///< so many at most

  /// Of the last snapshot.
  [[nodiscard]] double seconds() const { return seconds_; }
  [[nodiscard]] const std::vector<double>& parameters() const { return parameters_; }
  [[nodiscard]] const std::string& impossible() const { return impossible_; }  ///< why it is `last`; or empty

 private:
  // Of a scene without a camera: what it was when it came into view, and the camera for a size of the window.
  struct Fitted {
    Snapshot scene;
    PixelSize size;
    Camera camera;
  };

  [[nodiscard]] Snapshot snapshot(PixelSize size, const Snapshot* last, std::uint32_t mostShadowSamples);

  static constexpr std::uint32_t kQuickShadowSamples = 4;

  const ViewedScene* viewed_;
  const Controls* controls_;
  std::optional<Fitted> fitted_;
  double seconds_ = 0;
  std::vector<double> parameters_;
  std::string impossible_;
  // Samples of lights with a radius: what the scene asks for, and what next() has; quick_ has the fewest.
  std::uint32_t mostShadowSamples_ = 1, shadowSamples_ = kQuickShadowSamples;
  Snapshot quick_;
};

/// The same picture for a window of another size: as high as it was, and wider or narrower.
[[nodiscard]] Snapshot resized(Snapshot snapshot, PixelSize size);

}  // namespace luxo
