// SPDX-License-Identifier: Apache-2.0
// While nothing moves: finds by rays what a picture's searches left in doubt, and audits the rest, beside the
// window.
#pragma once

#include <atomic>
#include <cstdint>
#include <future>
#include <optional>
#include <vector>

#include "draw/ray_points.h"
#include "draw/render_view.h"
#include "scene/snapshot.h"

namespace luxo {

class Certifier {
 public:
  struct Outcome {
    RayPoints points;  ///< of the pixels in doubt; of all pixels where the audit found one wrong
    std::uint64_t audited = 0, failed = 0, undecided = 0;
  };

  Certifier() = default;
  ~Certifier() { cancel(); }
  Certifier(const Certifier&) = delete;
  Certifier& operator=(const Certifier&) = delete;

  /// Begins with what the painter has recorded last, which has to be complete. What it did before is
  /// cancelled.
  void begin(const Snapshot& snapshot, const DrawOptions& options, RenderView& view);
  /// Stops soon, and forgets the outcome. Waits for a ray, or for cells that are being built.
  void cancel();

  [[nodiscard]] bool busy() const { return working_.valid(); }
  /// Once it is there.
  [[nodiscard]] std::optional<Outcome> poll();

 private:
  CertifiedRays rays_;
  Snapshot snapshot_;
  std::atomic<bool> cancelled_ = false;
  std::future<Outcome> working_;
};

}  // namespace luxo
