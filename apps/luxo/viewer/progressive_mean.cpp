// SPDX-License-Identifier: Apache-2.0
#include "viewer/progressive_mean.h"

namespace luxo {

bool ProgressiveMean::complete() const { return joined_ >= kMaxSamples; }

void ProgressiveMean::reset() {
  certifier_.cancel();
  tracer_.cancel();
  next_.reset();
  traced_ = false;
  joined_ = 0;
  audit_ = {};
}

bool ProgressiveMean::prepare(gpu::FrameRing& frames, ScenePainter& painter, RenderView& view,
                              const Snapshot& shown, const DrawOptions& drawn) {
  if (next_ && traced_) return true;
  Snapshot sampled = shown;
  sampled.view = sampledAt(shown.view, pattern_[static_cast<std::size_t>(joined_)]);
  if (!next_ && !find(frames, painter, view, sampled, drawn)) return false;
  traced_ = trace(frames, painter, view, sampled);
  return traced_;
}

bool ProgressiveMean::find(gpu::FrameRing& frames, ScenePainter& painter, RenderView& view,
                           const Snapshot& sampled, const DrawOptions& drawn) {
  if (!certifier_.busy()) {
    DrawOptions one = drawn;
    one.samples = 1;
    one.standIns = false;
    FrameStatistics ignored;
    // What a sample has lost rays find; but without room there is none for rays.
    do {
      painter.record(frames, frames.begin(), view, sampled, one, ignored);
      frames.wait(frames.submit());
    } while (view.makeRoom());
    if (!view.searches()) {
      next_.emplace();
      return true;
    }
    certifier_.begin(sampled, one, view, [&](const RenderView::Recording& record) {
      const VkCommandBuffer commands = frames.begin();
      record(commands);
      frames.wait(frames.submit());
    });
  }
  next_ = certifier_.poll();
  return next_.has_value();
}

bool ProgressiveMean::trace(gpu::FrameRing& frames, ScenePainter& painter, RenderView& view,
                            const Snapshot& sampled) {
  if (!view.list().traces) return true;
  FrameStatistics ignored;
  if (!tracer_.busy()) {
    tracer_.begin(sampled, view.list().origin);
    tracer_.answer(view.traces().asked());
  }
  while (const std::optional<bool> asked = tracer_.poll()) {
    if (!*asked) return true;
    painter.recordAnswers(frames, frames.begin(), view, tracer_.rays(), next_->points, ignored);
    frames.wait(frames.submit());
    tracer_.answer(view.traces().asked());
  }
  return false;
}

void ProgressiveMean::join(gpu::FrameRing& frames, VkCommandBuffer commands, ScenePainter& painter,
                           RenderView& view) {
  if (!accumulator_) accumulator_.emplace(context_);
  FrameStatistics ignored;
  if (!next_->points.empty()) painter.recordRays(frames, commands, view, next_->points, ignored);
  accumulator_->add(frames, commands, view.picture(), joined_);
  audit_.pixels += next_->audited;
  audit_.wrong += next_->failed;
  audit_.byRays += next_->points.resolved;
  next_.reset();
  traced_ = false;
  ++joined_;
}

}  // namespace luxo
