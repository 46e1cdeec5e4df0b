// SPDX-License-Identifier: Apache-2.0
// What a frame cost, what it skipped and how wrong it can be: the numbers behind `--report`.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "gpu/frame.h"

namespace luxo {

/// How long the device took for all passes of a name (Pass::name), or, as "other", for what is beside them.
using PassTime = gpu::FrameRing::Part;

/// Adds up what has the same name.
void addPassTimes(std::vector<PassTime>& sums, std::span<const PassTime> times);

/// Milliseconds of the host's clock, except gpu, which is the device's where it has timestamps.
struct FrameTimes {
  double total = 0, animate = 0, tessellate = 0, cull = 0, upload = 0, gpu = 0, readback = 0, encode = 0;
  double rays = 0;      ///< points found by certified rays, and the audit
  double rayTrees = 0;  ///< the cells that these are cast against, where they were not there yet
  std::vector<PassTime> passes = {};  ///< of gpu, in the order of the first ones; empty without timestamps
};

struct FrameCounts {
  std::uint64_t nodes = 0;  ///< with a surface, visible in the scene
  std::uint64_t drawn = 0;
  std::uint64_t culledFrustum = 0, culledSmall = 0, culledBackface = 0, culledLights = 0;
  std::uint64_t culledHidden = 0;  ///< triangles of shells and of meshes
  /// Triangles of meshes, cluster by cluster, every draw counted.
  std::uint64_t culledTrianglesFrustum = 0, culledTrianglesBackface = 0;
  std::uint64_t drawCalls = 0, instances = 0;
  std::uint64_t triangles = 0, vertices = 0;  ///< submitted, every instance counted
  std::uint64_t submits = 0;
  std::uint64_t uploadBytes = 0;
  std::uint64_t tessellated = 0;  ///< meshes made for this frame
  std::uint64_t pipelinesCreated = 0;
  std::uint64_t shadersCompiled = 0;  ///< of patterns that no run before this one has drawn
  std::uint64_t tooLarge = 0;  ///< nodes whose formulas are too large for shaders: rays find their points
  std::uint64_t passes = 0;
  std::uint64_t shadowPasses = 0;  ///< searches for shadows: one for each light and caster
  std::uint64_t tracedRays = 0;    ///< that shaders of materials have sent into the scene
  std::uint64_t layerPoints = 0;   ///< points of what is seen through
  std::uint64_t deferred = 0;  ///< pictures, of one sample each, whose points were found first and lit later
};

struct FrameError {
  double tolerancePx = 0;
  /// Proven: no drawn point of a mesh is farther than this on the screen from the surface it stands for.
  /// Infinite where a node passes the eye or its formula has no proven bounds.
  double boundPx = 0;
  /// Of exact shading, where a node has it: the largest distance on the screen between a pixel's centre and
  /// the point of the surface that it shows, as the shader measured it. Nothing: no node has it.
  std::optional<double> residualMaxPx;
  bool found = false;  ///< points of some node are found in its pixels: what follows applies
  /// Shadows are found in its pixels, of meshes, too: the first four of what follows apply.
  bool shadowed = false;
  /// Of all samples: pixels whose point was not found although no miss was certain, or which an audit found
  /// to be wrong, after all trials; and pixels that show a point which is not proven, neither by the
  /// search that found it nor by a ray.
  std::uint64_t unconvergedPx = 0, uncertifiedPx = 0;
  std::uint64_t resolvedByRaysPx = 0;  ///< pixels whose point, or miss, was found by a certified ray
  std::uint64_t shadowRaysPx = 0;      ///< of these, pixels whose shadows alone were left open
  /// Points of what is seen through that found no room (kMaxLayerBytes), or pixels with more of them than the
  /// device's loops go through (shaders/lib/rounds.glsl): the picture lacks them. They count as pixels that
  /// did not converge, too.
  std::uint64_t layersMissing = 0;
  /// Pixels that were audited; those that were found wrong, in any attempt; those of the last attempt that
  /// the reference cannot decide.
  std::uint64_t auditedPx = 0, auditFailedPx = 0, auditUndecidedPx = 0;
  std::uint64_t nonfinitePx =
      0;  ///< pixels with a value that is no finite number: pictures show them in magenta
};

struct FrameStatistics {
  FrameTimes ms;
  FrameCounts count;
  FrameError error;
};

/// Adds the time and the work of something drawn before, or once more, for the same picture: not what it
/// shows.
void addCost(FrameStatistics& picture, const FrameStatistics& other);

/// Adds what a pass cost to what its picture, of several, has cost so far. Counts of nodes are those of the
/// first pass, as they are about the scene; errors are the largest of any pass, pixels with errors the sum
/// over all.
void addPass(FrameStatistics& picture, const FrameStatistics& pass);

/// Of a frame that shows what the one before it showed: all that was done for that one is not done.
[[nodiscard]] FrameStatistics shownAgain(const FrameStatistics& before);

}  // namespace luxo
