// SPDX-License-Identifier: Apache-2.0
#include "viewer/tracer.h"

#include <chrono>
#include <utility>

#include "background.h"

namespace luxo {

void Tracer::begin(const Snapshot& snapshot, const Vec3& origin) {
  cancel();
  rays_.begin(snapshot, origin, [this] { return !cancelled_; });
}

void Tracer::answer(std::vector<shared::TraceQuestion> questions) {
  working_ = inBackground([this, asked = std::move(questions)] { return rays_.answer(asked); });
}

void Tracer::cancel() {
  if (!busy()) return;
  cancelled_ = true;
  working_.wait();
  working_ = {};
  cancelled_ = false;
}

std::optional<bool> Tracer::poll() {
  if (!busy() || working_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return std::nullopt;
  return working_.get();
}

}  // namespace luxo
