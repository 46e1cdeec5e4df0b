// SPDX-License-Identifier: Apache-2.0
#include "draw/passes.h"

#include <algorithm>
#include <utility>

namespace luxo {
namespace {

std::vector<Attachment> color(Begin begin) { return {{Target::Color, begin}}; }

/// What the first pass draws, and what is drawn over that.
struct Opaque {
  std::span<const DrawBatch> found, meshes;
};

Opaque opaqueOf(const DrawList& list) {
  const auto firstOther = std::ranges::find_if(list.opaque, [&](const DrawBatch& batch) {
    return list.deferred ? batch.state.form == Form::Fused : !batch.shell;
  });
  return {{list.opaque.begin(), firstOther}, {firstOther, list.opaque.end()}};
}

/// Points are found, by searches and triangles or by rays, and then lit, by one group of lights after the
/// other.
std::vector<Pass> deferredPasses(const DrawList& list, const FrameDesc& frame,
                                 std::span<const DrawBatch> found, Begin begin, bool replaces) {
  std::vector<Attachment> targets{{Target::Found, begin}};
  std::vector<Target> reads{Target::Found};
  if (list.findsParameters()) {
    targets.push_back({Target::FoundParameters, begin});
    reads.push_back(Target::FoundParameters);
  }
  Pass finds{.name = replaces ? "rays" : "found",
             .colors = targets,
             .depth = begin,
             .searches = list.exact() && !replaces,
             .batches = replaces ? std::span<const DrawBatch>() : found,
             .rays = frame.rays,
             .probes = frame.probes};
  std::vector<Pass> passes{std::move(finds)};
  // The shadows of many groups share one target, which holds those of the last.
  const bool shadowsStay = replaces && list.groups.size() == 1;
  for (std::size_t i = 0; i < list.groups.size(); ++i) {
    const LightGroup& group = list.groups[i];
    Pass shades{.name = "shade",
                .colors = color(i == 0 ? Begin::Clear : Begin::Keep),
                .reads = reads,
                .group = i,
                .shades = group.shades};
    if (!group.lights.empty()) {
      passes.push_back({.name = "shadows",
                        .colors = {{Target::Shadows, shadowsStay ? Begin::Keep : Begin::Clear}},
                        .reads = {Target::Found},
                        .searches = !shadowsStay,
                        .group = i,
                        .shadows = shadowsStay ? std::span<const ShadowDraw>() : group.shadows,
                        .flatShadows = shadowsStay ? std::span<const FlatShadowDraw>() : group.flatShadows,
                        .rays = frame.rays,
                        .probes = frame.probes});
      shades.reads.push_back(Target::Shadows);
    }
    passes.push_back(std::move(shades));
  }
  return passes;
}

}  // namespace

std::vector<Pass> passesOf(const DrawList& list, const FrameDesc& frame) {
  const Opaque opaque = opaqueOf(list);
  const bool searches = list.exact();
  std::vector<Pass> passes;
  // Points of rays replace what was found, as long as nothing was drawn over that.
  const bool replaces = frame.rays && list.onlyFound();
  const Begin begin = frame.completes || replaces ? Begin::Keep : Begin::Clear;
  if (list.deferred)
    passes = deferredPasses(list, frame, opaque.found, begin, replaces);
  else if (replaces)
    passes.push_back({.name = "rays", .colors = color(begin), .depth = begin, .rays = frame.rays});
  else if (opaque.found.empty() && !opaque.meshes.empty())
    passes.push_back({.name = "opaque",
                      .colors = color(begin),
                      .depth = begin,
                      .batches = opaque.meshes,
                      .rays = frame.rays});
  else
    passes.push_back({.name = "found",
                      .colors = color(begin),
                      .depth = begin,
                      .searches = searches,
                      .batches = opaque.found,
                      .rays = frame.rays});
  if (!list.deferred) passes.back().probes = frame.probes;
  if (replaces) return passes;
  if (!opaque.found.empty() && !opaque.meshes.empty())
    passes.push_back({.name = "meshes", .colors = color(Begin::Keep), .batches = opaque.meshes});
  if (!list.transparent.empty() || frame.emptyPasses)
    passes.push_back({.name = "transparent", .colors = color(Begin::Keep), .batches = list.transparent});
  return passes;
}

}  // namespace luxo
