// SPDX-License-Identifier: Apache-2.0
// While nothing moves: finds by rays what a picture's searches left in doubt, and audits the rest, beside the
// window.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "background.h"
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

  /// Begins with what the painter has recorded last, which has to be complete. What it did before is
  /// cancelled. `submit`: as of RenderView::doubts().
  void begin(const Snapshot& snapshot, const DrawOptions& options, RenderView& view,
             const std::function<void(const RenderView::Recording& record)>& submit);
  /// Stops soon, and forgets the outcome. Waits for a ray, or for cells that are being built.
  void cancel() { work_.cancel(); }

  [[nodiscard]] bool busy() const { return work_.busy(); }
  /// Once it is there.
  [[nodiscard]] std::optional<Outcome> poll() { return work_.poll(); }

 private:
  CertifiedRays rays_;
  Snapshot snapshot_;
  BackgroundWork<Outcome> work_;
};

}  // namespace luxo
