// SPDX-License-Identifier: Apache-2.0
#include "viewer/progressive_mean.h"

namespace luxo {

void ProgressiveMean::reset() {
  work_.cancel();
  stage_ = Stage::None;
  joined_ = 0;
  audit_ = {};
}

bool ProgressiveMean::prepare(const Snapshot& shown, const DrawOptions& drawn) {
  if (stage_ == Stage::None) begin(shown, drawn);
  if (stage_ == Stage::Refines && refine()) stage_ = Stage::Ready;
  return stage_ == Stage::Ready;
}

void ProgressiveMean::begin(const Snapshot& shown, const DrawOptions& drawn) {
  sampled_ = shown;
  sampled_.view = sampledAt(shown.view, pattern_[static_cast<std::size_t>(joined_)]);
  DrawOptions one = drawn;
  one.samples = 1;
  refinement_.begin(sampled_, one, [this] { return !work_.cancelled(); });
  stage_ = Stage::Refines;
}

bool ProgressiveMean::refine() {
  if (work_.busy() && !work_.poll()) return false;
  const auto rays =
      refinement_.advance([this](const RenderView::Recording& record, const Refinement::Changed&,
                                 FrameStatistics&) { submit(record); });
  if (!rays) return true;
  work_.begin([cast = *rays] {
    cast();
    return true;
  });
  return false;
}

void ProgressiveMean::submit(const RenderView::Recording& record) {
  record(frames_.begin());
  frames_.wait(frames_.submit());
}

void ProgressiveMean::join(VkCommandBuffer commands) {
  if (!accumulator_) accumulator_.emplace(context_);
  accumulator_->add(frames_, commands, view_.picture(), joined_);
  const FrameError& error = refinement_.statistics().error;
  audit_.pixels += error.auditedPx;
  audit_.wrong += error.auditFailedPx;
  audit_.byRays += error.resolvedByRaysPx;
  audit_.open += error.unconvergedPx;
  stage_ = Stage::None;
  ++joined_;
}

}  // namespace luxo
