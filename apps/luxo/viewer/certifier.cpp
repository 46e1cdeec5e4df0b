// SPDX-License-Identifier: Apache-2.0
#include "viewer/certifier.h"

#include <algorithm>
#include <utility>

namespace luxo {
namespace {

std::pair<std::int32_t, std::int32_t> placeOf(const PixelPlace& pixel) { return {pixel.y, pixel.x}; }
std::pair<std::int32_t, std::int32_t> placeOfDoubt(const Doubt& doubt) { return placeOf(doubt.pixel); }

}  // namespace

void Certifier::begin(const Snapshot& snapshot, const DrawOptions& options, RenderView& view,
                      const std::function<void(const RenderView::Recording&)>& submit) {
  cancel();
  snapshot_ = snapshot;
  rays_.begin(snapshot_, options, [this] { return !work_.cancelled(); });
  work_.begin([this, doubts = view.doubts(submit), probes = view.probes(), draws = RayDraws(view.list()),
               shown = view.shown(), size = snapshot.view.size] {
    Outcome outcome{.points = rays_.resolve(doubts, draws, shown), .audited = probes.size()};
    // What is resolved need not be right in the depths that were probed before.
    std::vector<DepthProbe> others;
    for (const DepthProbe& probe : probes)
      if (!std::ranges::binary_search(doubts, placeOf(probe.pixel), {}, placeOfDoubt))
        others.push_back(probe);
    const AuditResult audit = rays_.audit(others, draws, shown);
    outcome.failed = audit.failed;
    outcome.undecided = audit.undecided;
    if (audit.failed > 0) outcome.points = rays_.resolve(everywhere(size, doubts), draws, shown);
    return outcome;
  });
}

}  // namespace luxo
