// SPDX-License-Identifier: Apache-2.0
// While nothing moves: the mean of more and more samples per pixel, each certified before it joins.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "draw/accumulation.h"
#include "draw/scene_painter.h"
#include "gpu/frame.h"
#include "scene/snapshot.h"
#include "viewer/certifier.h"
#include "viewer/tracer.h"

namespace luxo {

class ProgressiveMean {
 public:
  /// Of the samples that have joined.
  struct Audit {
    std::uint64_t pixels = 0, wrong = 0, byRays = 0;
  };

  explicit ProgressiveMean(gpu::Context& context) : context_(context) {}

  [[nodiscard]] int samples() const { return joined_; }
  [[nodiscard]] bool complete() const;
  /// A sample has joined, or is on its way.
  [[nodiscard]] bool begun() const { return joined_ > 0 || next_ || casting(); }
  [[nodiscard]] bool casting() const {
    return certifier_.busy() || tracer_.busy();
  }  ///< rays, beside the window
  [[nodiscard]] const Audit& audit() const { return audit_; }
  [[nodiscard]] gpu::Texture& picture() { return accumulator_->mean(); }

  /// Stops what is on its way: for what is shown next there is no sample yet.
  void reset();

  /// Draws one more sample per pixel of what is shown, and lets rays find what that leaves in doubt. Whether
  /// it is ready to join the mean: later, if not.
  [[nodiscard]] bool prepare(gpu::FrameRing& frames, ScenePainter& painter, RenderView& view,
                             const Snapshot& shown, const DrawOptions& drawn);
  /// What is ready joins the mean.
  void join(gpu::FrameRing& frames, VkCommandBuffer commands, ScenePainter& painter, RenderView& view);

 private:
  /// Draws the sample that joins next, and lets rays settle it. Whether they have.
  [[nodiscard]] bool find(gpu::FrameRing& frames, ScenePainter& painter, RenderView& view,
                          const Snapshot& sampled, const DrawOptions& drawn);
  /// Answers what its shaders ask of the scene. Whether they ask no more.
  [[nodiscard]] bool trace(gpu::FrameRing& frames, ScenePainter& painter, RenderView& view,
                           const Snapshot& sampled);

  gpu::Context& context_;
  std::optional<Accumulator> accumulator_;  // made when first needed
  Certifier certifier_;
  Tracer tracer_;
  std::vector<Vec2> pattern_ = samplePattern(kMaxSamples);
  int joined_ = 0;
  std::optional<Certifier::Outcome> next_;  // of the sample that joins next
  bool traced_ = false;                     // that, too
  Audit audit_;
};

}  // namespace luxo
