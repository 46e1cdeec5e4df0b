// SPDX-License-Identifier: Apache-2.0
// What a frame cost, what it skipped and how wrong it can be: the numbers behind `--report`.
#pragma once

#include <cstdint>
#include <optional>

namespace luxo {

/// Milliseconds of the host's clock, except gpu, which is the device's where it has timestamps.
struct FrameTimes {
  double total = 0, animate = 0, tessellate = 0, cull = 0, upload = 0, gpu = 0, readback = 0, encode = 0;
};

struct FrameCounts {
  std::uint64_t nodes = 0;  ///< with a surface, visible in the scene
  std::uint64_t drawn = 0;
  std::uint64_t culledFrustum = 0, culledSmall = 0, culledBackface = 0, culledLights = 0;
  std::uint64_t culledHidden = 0;  ///< triangles of hulls
  std::uint64_t drawCalls = 0, instances = 0;
  std::uint64_t triangles = 0, vertices = 0;  ///< submitted, every instance counted
  std::uint64_t submits = 0;
  std::uint64_t uploadBytes = 0;
  std::uint64_t tessellated = 0;  ///< meshes made for this frame
  std::uint64_t pipelinesCreated = 0;
  std::uint64_t shadersCompiled = 0;  ///< of patterns that no run before this one has drawn
  std::uint64_t passes = 0, shadowPasses = 0;
};

struct FrameError {
  double tolerancePx = 0;
  /// Proven: no drawn point of a mesh is farther than this on the screen from the surface it stands for.
  /// Infinite where a node passes the eye or its formula has no proven bounds.
  double boundPx = 0;
  /// Of exact shading, where a node has it: the largest distance on the screen between a pixel's centre and
  /// the point of the surface that it shows, as the shader measured it. Nothing: no node has it.
  std::optional<double> residualMaxPx;
  /// Pixels whose point was not found although no miss was certain, after all refinement; and pixels that
  /// show a point which is not proven to be the root nearest to where the search began.
  std::uint64_t unconvergedPx = 0, uncertifiedPx = 0;
};

struct FrameStatistics {
  FrameTimes ms;
  FrameCounts count;
  FrameError error;
};

}  // namespace luxo
