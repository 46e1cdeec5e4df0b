// SPDX-License-Identifier: Apache-2.0
#include "draw/passes.h"

#include <algorithm>

namespace luxo {
namespace {

std::vector<Attachment> color(Begin begin) { return {{Target::Color, begin}}; }

/// Where every batch that a pass may find begins, and where those do that find and light at once.
struct Opaque {
  std::span<const DrawBatch> found, meshes;
};

Opaque opaqueOf(const DrawList& list) {
  const auto firstMesh =
      std::ranges::find_if(list.opaque, [](const DrawBatch& batch) { return !batch.shell; });
  return {{list.opaque.begin(), firstMesh}, {firstMesh, list.opaque.end()}};
}

}  // namespace

std::vector<Pass> passesOf(const DrawList& list, const FrameDesc& frame) {
  const Opaque opaque = opaqueOf(list);
  const bool searches = list.exact();
  std::vector<Pass> passes;
  // Points of rays replace what was found, as long as nothing was drawn over that.
  const bool replaces = frame.rays && list.onlyFound();
  const Begin begin = frame.completes || replaces ? Begin::Keep : Begin::Clear;
  if (replaces)
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
  passes.back().probes = frame.probes;
  if (replaces) return passes;
  if (!opaque.found.empty() && !opaque.meshes.empty())
    passes.push_back({.name = "meshes", .colors = color(Begin::Keep), .batches = opaque.meshes});
  if (!list.transparent.empty() || frame.emptyPasses)
    passes.push_back({.name = "transparent", .colors = color(Begin::Keep), .batches = list.transparent});
  return passes;
}

}  // namespace luxo
