// SPDX-License-Identifier: Apache-2.0
#include "viewer/certifier.h"

#include <algorithm>
#include <utility>

namespace luxo {
namespace {

std::pair<std::int32_t, std::int32_t> placeOf(const PixelPlace& pixel) { return {pixel.y, pixel.x}; }

}  // namespace

void Certifier::begin(const Snapshot& snapshot, const DrawOptions& options, RenderView& view) {
  cancel();
  snapshot_ = snapshot;
  rays_.begin(snapshot_, options, [this] { return !work_.cancelled(); });
  std::vector<PixelPlace> doubtful;
  for (const Doubt& doubt : view.doubts()) doubtful.push_back(doubt.pixel);
  work_.begin([this, doubtful = std::move(doubtful), probes = view.probes(), found = view.list().found,
               origin = view.list().origin, shown = view.shown(), groups = view.list().groups,
               layers = view.list().layers.found, layersFrom = view.list().layersFrom(),
               size = snapshot.view.size] {
    const auto resolved = [&](const std::vector<PixelPlace>& pixels) {
      RayPoints points = rays_.resolve(pixels, found, origin);
      rays_.addShadows(pixels, shown, groups, points);
      rays_.addLayers(pixels, layers, origin, groups, points);
      return points;
    };
    Outcome outcome{.points = resolved(doubtful), .audited = probes.size()};
    // What is resolved need not be right in the depths that were probed before.
    std::vector<DepthProbe> others;
    for (const DepthProbe& probe : probes)
      if (!std::ranges::binary_search(doubtful, placeOf(probe.pixel), {}, placeOf)) others.push_back(probe);
    const AuditResult audit = rays_.audit(others, shown, groups, layersFrom);
    outcome.failed = audit.failed;
    outcome.undecided = audit.undecided;
    if (audit.failed > 0) outcome.points = resolved(auditedPixels(size, {.extent = AuditExtent::All}, {}));
    return outcome;
  });
}

}  // namespace luxo
