// SPDX-License-Identifier: Apache-2.0
// While nothing moves: answers what shaders of materials ask of the scene, beside the window.
#pragma once

#include <atomic>
#include <future>
#include <optional>
#include <vector>

#include "draw/secondary_rays.h"
#include "scene/snapshot.h"

namespace luxo {

class Tracer {
 public:
  Tracer() = default;
  ~Tracer() { cancel(); }
  Tracer(const Tracer&) = delete;
  Tracer& operator=(const Tracer&) = delete;

  /// As SecondaryRays::begin(). What it did before is cancelled.
  void begin(const Snapshot& snapshot, const Vec3& origin);
  /// Begins to answer.
  void answer(std::vector<shared::TraceQuestion> questions);
  /// Stops soon. Waits for a ray, or for cells that are being built.
  void cancel();

  [[nodiscard]] bool busy() const { return working_.valid(); }
  /// Once it has answered: whether there was a question.
  [[nodiscard]] std::optional<bool> poll();
  /// Not while it is busy.
  [[nodiscard]] const SecondaryRays& rays() const { return rays_; }

 private:
  SecondaryRays rays_;
  std::atomic<bool> cancelled_ = false;
  std::future<bool> working_;
};

}  // namespace luxo
