// SPDX-License-Identifier: Apache-2.0
#include "draw/occlusion_culling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "cull/raster_slack.h"
#include "draw/draw_list.h"
#include "draw/exact_data.h"
#include "math/sampling.h"
#include "math/transform.h"
#include "tessellate/parallel.h"

namespace luxo {
namespace {

/// Where on the average fewer layers face the viewer, finding the hidden ones costs more than drawing them.
constexpr double kFewestLayers = 1.25;
constexpr int kCoarse = 16;  // pixels between the samples that tell
constexpr int kBand = 256;   // rows that one core works on: each band looks at every triangle
constexpr std::size_t kChunk = 512, kIndicesForAllCores = 3 * kChunk;  // triangles; indices
constexpr double kNearest = -1e30;  // of what PixelTriangle has as depths: nearer than all
constexpr std::size_t kNoBody = std::numeric_limits<std::size_t>::max();

std::span<const std::uint32_t> indicesAt(const std::vector<std::uint32_t>& indices, std::size_t first) {
  return std::span(indices).subspan(first, 3);
}

PixelTriangle triangleOf(const std::vector<Vec3>& points, std::span<const std::uint32_t> indices) {
  return {points[indices[0]], points[indices[1]], points[indices[2]]};
}

template <typename Action>
void forEachShellBatch(const DrawList& list, const Action& action) {
  for (const DrawBatch& batch : list.opaque)
    if (batch.shell && !batch.shared) action(batch);
}

}  // namespace

/// +1: the triangle is seen from outside the slab; -1: from inside; 0: it is so narrow that a device may see
/// it either way.
int OcclusionCulling::Body::facing(const PixelTriangle& t) const {
  const double area = certainArea(t);
  return area == 0 ? 0 : (area < 0) != mirrored ? 1 : -1;
}

std::uint64_t OcclusionCulling::drop(DrawList& list, const Snapshot& snapshot, int samples) {
  addBodies(list, snapshot);
  const bool hiding = layered(list, snapshot.view.size);
  if (hiding) cover(snapshot.view.size, samples);
  const std::vector<char> unseen = findUnseen(list, hiding);
  std::vector<std::uint32_t> kept;
  kept.reserve(list.shellIndices.size());
  for (DrawBatch& batch : list.opaque) {
    if (!batch.shell || batch.shared) continue;
    const std::size_t first = kept.size();
    for (std::size_t i = batch.firstIndex; i < batch.firstIndex + batch.indexCount; i += 3) {
      const auto indices = indicesAt(list.shellIndices, i);
      if (!unseen[i / 3]) kept.insert(kept.end(), indices.begin(), indices.end());
    }
    batch.firstIndex = static_cast<std::uint32_t>(first);
    batch.indexCount = static_cast<std::uint32_t>(kept.size() - first);
  }
  const std::size_t dropped = list.shellIndices.size() - kept.size();
  const std::uint64_t droppedInstances = hiding ? dropInstances(list, snapshot) : 0;
  std::erase_if(list.opaque, [](const DrawBatch& batch) {
    return batch.shell && (batch.indexCount == 0 || batch.instanceCount == 0);
  });
  // Something is bound even if nothing of it is drawn.
  if (!kept.empty()) list.shellIndices = std::move(kept);
  return dropped / 3 + droppedInstances;
}

std::uint64_t OcclusionCulling::dropInstances(DrawList& list, const Snapshot& snapshot) const {
  const auto isHidden = [&](std::uint32_t number) {
    const SnapshotNode& node = snapshot.nodes[number];
    const PixelRect pixels = pixelsOf(snapshot.view, node.boundsWorld);
    const double depth = nearestSeen(snapshot.view, node),
                 z = snapshot.view.perspective() ? -1 / depth : depth;
    const Vec3 low(pixels.low.x, pixels.low.y, z), high(pixels.high.x, pixels.high.y, z),
        right(high.x, low.y, z), left(low.x, high.y, z);
    return hides({low, right, high}) && hides({low, high, left});
  };
  std::uint64_t dropped = 0;
  for (DrawBatch& batch : list.opaque) {
    if (!batch.shared) continue;
    std::vector<char> hidden(batch.instanceCount);
    forEachIndex(hidden.size(), hidden.size() >= kChunk,
                 [&](std::size_t i) { hidden[i] = isHidden(list.instanceNodes[batch.firstInstance + i]); });
    std::size_t kept = batch.firstInstance;
    for (std::size_t i = 0; i < hidden.size(); ++i) {
      if (hidden[i]) continue;
      const std::size_t from = batch.firstInstance + i;
      list.instances[kept] = list.instances[from];
      list.exactInstances[kept] = list.exactInstances[from];
      list.instanceNodes[kept++] = list.instanceNodes[from];
    }
    const std::size_t left = kept - batch.firstInstance;
    dropped += (hidden.size() - left) * (batch.indexCount / 3);
    batch.instanceCount = static_cast<std::uint32_t>(left);
  }
  return dropped;
}

const OcclusionCulling::Body& OcclusionCulling::bodyOf(const DrawList& list, const DrawBatch& batch) const {
  return bodies_[bodyOf_[list.instanceNodes[batch.firstInstance]]];
}

void OcclusionCulling::addBodies(const DrawList& list, const Snapshot& snapshot) {
  bodies_.clear();
  bodyOf_.assign(snapshot.nodes.size(), kNoBody);
  forEachShellBatch(list, [&](const DrawBatch& batch) {
    const std::uint32_t number = list.instanceNodes[batch.firstInstance];
    if (bodyOf_[number] != kNoBody) return;
    bodyOf_[number] = bodies_.size();
    const SnapshotNode& node = snapshot.nodes[number];
    std::vector<Vec3> points = inPicture(snapshot.view, node, batch.shell->positions), occluder;
    const bool inFront = std::ranges::all_of(points, [&](const Vec3& p) { return p.z > snapshot.view.near; });
    if (inFront && batch.shell->occluder.proven)
      occluder = inPicture(snapshot.view, node, batch.shell->occluder.positions);
    if (!std::ranges::all_of(occluder, [&](const Vec3& p) { return p.z > snapshot.view.near; }))
      occluder.clear();
    if (snapshot.view.perspective() && inFront)
      for (auto* places : {&points, &occluder})
        for (Vec3& p : *places) p.z = -1 / p.z;
    bodies_.push_back({.shell = batch.shell.get(),
                       .points = std::move(points),
                       .occluder = std::move(occluder),
                       .mirrored = batch.mirrored,
                       .bothSides = batch.bothSides,
                       .inFront = inFront});
  });
}

/// Whether there is more to draw than to see.
bool OcclusionCulling::layered(const DrawList& list, const PixelSize& size) {
  coarse_.clear({size.width / kCoarse + 1, size.height / kCoarse + 1}, Vec2(0.5));
  std::vector<PixelTriangle> seen;
  std::size_t drawn = 0;
  forEachShellBatch(list, [&](const DrawBatch& batch) {
    const Body& body = bodyOf(list, batch);
    if (!body.inFront) return;
    for (std::size_t i = batch.firstIndex; i < batch.firstIndex + batch.indexCount; i += 3) {
      PixelTriangle triangle = triangleOf(body.points, indicesAt(list.shellIndices, i));
      if (body.facing(triangle) < 0) continue;
      for (Vec3& corner : triangle) corner /= kCoarse;
      const std::size_t samples = coarse_.samplesIn(triangle);
      if (samples == 0) continue;
      drawn += samples;
      seen.push_back(triangle);
    }
  });
  coarse_.cover(seen);
  return static_cast<double>(drawn) > kFewestLayers * static_cast<double>(coarse_.covered());
}

/// Covers what is behind surfaces, a band of the picture after the other.
void OcclusionCulling::cover(const PixelSize& size, int samples) {
  struct SlabSide {
    const Body* body;
    const ShellOccluder::Slab* slab;
    bool tops;
  };
  std::vector<SlabSide> sides;
  // The near side of a body hides its far side, of which little is then looked at.
  for (const bool tops : {false, true})
    for (const Body& body : bodies_)
      if (!body.occluder.empty() && (body.bothSides || !tops))
        for (const ShellOccluder::Slab& slab : body.shell->occluder.slabs)
          sides.push_back({&body, &slab, tops});
  std::vector<Passage> passages(sides.size());
  forEachIndex(sides.size(), true, [&](std::size_t i) {
    passages[i] = passageOf(*sides[i].body, *sides[i].slab, sides[i].tops);
  });

  const std::span<const Vec2> locations = sampleLocations(samples);
  const auto bands = static_cast<std::size_t>((size.height + kBand - 1) / kBand);
  buffers_.resize(bands * locations.size());
  forEachIndex(buffers_.size(), true, [&](std::size_t i) {
    const int first = static_cast<int>(i % bands) * kBand, end = std::min(first + kBand, size.height);
    buffers_[i].clear(size.width, {first, end}, locations[i / bands]);
    for (const Passage& passage : passages)
      if (passage.top <= end && passage.bottom >= first) buffers_[i].cover(passage.leaving, passage.entering);
  });
}

/// Nothing is seen behind a face that a ray leaves by (a top, or a bottom), if before it has not come in by
/// the same face (shell/shell_occluder.h). Nor by a wall or a turned prism, before or behind: where one is,
/// faces may cross, and a ray leave what it has never come into. A wall is seen where any triangle of its
/// four corners is, as it may be twisted; a turned prism where any of its six are.
OcclusionCulling::Passage OcclusionCulling::passageOf(const Body& body, const ShellOccluder::Slab& slab,
                                                      bool tops) {
  const Shell& shell = *body.shell;
  const std::vector<std::uint32_t>& leaving = tops ? slab.tops : slab.bottoms;
  const auto isTurned = [&](std::uint32_t i) {
    return shell.occluder.triangles[i / 3] == ShellOccluder::Triangle::Turned;
  };
  const auto triangle = [&](std::uint32_t i) {
    return triangleOf(body.occluder, indicesAt(shell.indices, i));
  };
  Passage passage{.top = std::numeric_limits<double>::infinity(),
                  .bottom = -std::numeric_limits<double>::infinity()};
  const auto addAtAnyDepth = [&](PixelTriangle t) {
    for (Vec3& corner : t) corner.z = kNearest;
    passage.entering.push_back(t);
  };
  const auto addAll = [&](std::span<const Vec3> corners) {
    for (std::size_t a = 0; a < corners.size(); ++a)
      for (std::size_t b = a + 1; b < corners.size(); ++b)
        for (std::size_t c = b + 1; c < corners.size(); ++c)
          addAtAnyDepth({corners[a], corners[b], corners[c]});
  };
  const std::size_t bottoms = shell.positions.size() / 2;
  for (const std::uint32_t i : slab.tops) {
    if (!isTurned(i)) continue;
    std::array<Vec3, 6> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      corners[k] = body.occluder[shell.indices[i + k]];
      corners[k + 3] = body.occluder[bottoms + shell.indices[i + k]];
    }
    addAll(corners);
  }
  for (const std::uint32_t i : leaving) {
    if (isTurned(i)) continue;
    const PixelTriangle t = triangle(i);
    const bool enters = body.facing(t) >= 0;
    (enters ? passage.entering : passage.leaving).push_back(t);
    if (enters) continue;
    passage.top = std::min({passage.top, t[0].y, t[1].y, t[2].y});
    passage.bottom = std::max({passage.bottom, t[0].y, t[1].y, t[2].y});
  }
  for (std::size_t w = 0; w < slab.walls.size(); w += 2) {  // two triangles each
    const auto a = triangle(slab.walls[w]), b = triangle(slab.walls[w + 1]);
    const std::array<Vec3, 4> corners{a[0], a[1], a[2], b[2]};
    const bool leaves = body.facing(a) < 0 && body.facing(b) < 0 &&
                        body.facing({corners[0], corners[1], corners[3]}) < 0 &&
                        body.facing({corners[1], corners[2], corners[3]}) < 0;
    if (isTurned(slab.walls[w]) || !leaves) addAll(corners);
  }
  return passage;
}

/// By triangle of the list.
std::vector<char> OcclusionCulling::findUnseen(const DrawList& list, bool hiding) const {
  struct Chunk {
    const DrawBatch* batch;
    std::size_t first, end;
  };
  std::vector<Chunk> chunks;
  forEachShellBatch(list, [&](const DrawBatch& batch) {
    const std::size_t end = batch.firstIndex + batch.indexCount;
    for (std::size_t i = batch.firstIndex; i < end; i += 3 * kChunk)
      chunks.push_back({&batch, i, std::min(i + 3 * kChunk, end)});
  });
  std::vector<char> unseen(list.shellIndices.size() / 3);
  const bool onAllCores = hiding && list.shellIndices.size() >= kIndicesForAllCores;
  forEachIndex(chunks.size(), onAllCores, [&](std::size_t chunk) {
    const auto& [batch, first, end] = chunks[chunk];
    const Body& body = bodyOf(list, *batch);
    if (!body.inFront) return;
    for (std::size_t i = first; i < end; i += 3) {
      const PixelTriangle triangle = triangleOf(body.points, indicesAt(list.shellIndices, i));
      const bool inside = batch->culling == FaceCulling::Back && body.facing(triangle) < 0;
      unseen[i / 3] = inside || (hiding && hides(triangle));
    }
  });
  return unseen;
}

/// A search that begins in the triangle may find a point before it. But where that is seen, the ray has come
/// into its slab before it, too, and so not behind what hides the triangle.
bool OcclusionCulling::hides(const PixelTriangle& triangle) const {
  return std::ranges::all_of(buffers_, [&](const OcclusionBuffer& buffer) { return buffer.hides(triangle); });
}

}  // namespace luxo
