// SPDX-License-Identifier: Apache-2.0
// While nothing moves: the mean of more and more samples per pixel, each refined before it joins, as a file's
// are.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "background.h"
#include "draw/accumulation.h"
#include "draw/refinement.h"
#include "draw/scene_painter.h"
#include "gpu/frame.h"
#include "scene/snapshot.h"

namespace luxo {

class ProgressiveMean {
 public:
  /// Of the samples that have joined.
  struct Audit {
    std::uint64_t pixels = 0, wrong = 0, byRays = 0;
    std::uint64_t open = 0;  ///< what no trial has settled
  };

  /// All of which must outlive it.
  ProgressiveMean(gpu::Context& context, gpu::FrameRing& frames, ScenePainter& painter, RenderView& view)
      : context_(context), frames_(frames), view_(view), refinement_(frames, painter, view) {}

  [[nodiscard]] int samples() const { return joined_; }
  [[nodiscard]] bool complete() const { return joined_ >= kMaxSamples; }
  /// A sample has joined, or is on its way.
  [[nodiscard]] bool begun() const { return joined_ > 0 || stage_ != Stage::None; }
  /// Rays are at work, beside the window.
  [[nodiscard]] bool casting() const { return work_.busy(); }
  [[nodiscard]] const Audit& audit() const { return audit_; }
  [[nodiscard]] gpu::Texture& picture() { return accumulator_->mean(); }

  /// Stops what is on its way: for what is shown next there is no sample yet.
  void reset();

  /// Draws one more sample per pixel of what is shown, and refines it. Whether it is ready to join the mean:
  /// later, if not.
  [[nodiscard]] bool prepare(const Snapshot& shown, const DrawOptions& drawn);
  /// What is ready joins the mean.
  void join(VkCommandBuffer commands);

 private:
  /// Of the sample that joins next.
  enum class Stage { None, Refines, Ready };

  void begin(const Snapshot& shown, const DrawOptions& drawn);
  /// Goes on with it as far as it gets without waiting for rays. Whether that is to its end.
  [[nodiscard]] bool refine();
  void submit(const RenderView::Recording& record);

  gpu::Context& context_;
  gpu::FrameRing& frames_;
  RenderView& view_;
  std::optional<Accumulator> accumulator_;  // made when first needed
  std::vector<Vec2> pattern_ = samplePattern(kMaxSamples);
  int joined_ = 0;
  Audit audit_;

  Stage stage_ = Stage::None;
  Snapshot sampled_;
  Refinement refinement_;
  BackgroundWork<bool> work_;  // of its rays
};

}  // namespace luxo
