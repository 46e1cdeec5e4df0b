// SPDX-License-Identifier: Apache-2.0
// While nothing moves: answers what shaders of materials ask of the scene, beside the window.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "background.h"
#include "draw/secondary_rays.h"
#include "scene/snapshot.h"

namespace luxo {

class Tracer {
 public:
  /// As SecondaryRays::begin(). What it did before is cancelled.
  void begin(const Snapshot& snapshot, const Vec3& origin) {
    cancel();
    rays_.begin(snapshot, origin, [this] { return !work_.cancelled(); });
  }
  /// Begins to answer. Requires that it is not busy.
  void answer(std::vector<shared::TraceQuestion> questions) {
    work_.begin([this, asked = std::move(questions)] { return rays_.answer(asked); });
  }
  /// Stops soon. Waits for a ray, or for cells that are being built.
  void cancel() { work_.cancel(); }

  [[nodiscard]] bool busy() const { return work_.busy(); }
  /// Once it has answered: whether there was a question.
  [[nodiscard]] std::optional<bool> poll() { return work_.poll(); }
  /// Not while it is busy.
  [[nodiscard]] const SecondaryRays& rays() const { return rays_; }

 private:
  SecondaryRays rays_;
  BackgroundWork<bool> work_;
};

}  // namespace luxo
