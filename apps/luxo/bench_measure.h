// SPDX-License-Identifier: Apache-2.0
// Time against error: one scene drawn in many ways, each timed in turn and held against the ground truth.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench_statistics.h"
#include "draw/renderer.h"
#include "image/image.h"
#include "scene/snapshot.h"

namespace luxo {

/// One way to draw a scene.
struct BenchWay {
  Shading shading = Shading::Phong;
  double tolerancePx = 0.5;  ///< of the mesh; of the shell where the shading is exact
  int samples = 1;
  bool deferred = false;  ///< points are found first, and lit later
};

struct BenchCost {
  std::uint64_t triangles = 0;
  int runs = 0;  ///< timed frames
  /// Milliseconds of a frame whose meshes are there, up to the picture on the device; and of the device in
  /// it.
  Typical frameMs, deviceMs;
  double readbackMs = 0;  ///< median: from the device to an Image
  double coldMs = 0;      ///< the first frame: meshes, buffers, pipelines, picture
};

/// NaN: does not apply, or nothing could be compared.
struct BenchError {
  /// Geometry, of the pixels' centres and so the same for any number of samples.
  std::uint64_t judged = 0, covered = 0;                        ///< pixels
  double boundPx = 0;                                           ///< proven by the renderer, of meshes
  double residualPx = 0, unconvergedPx = 0, uncertifiedPx = 0;  ///< as exact shading says itself
  double positionMaxPx = 0, positionP999Px = 0, normalMaxDeg = 0, normalP999Deg = 0;
  /// How far the farthest pixel that shows another surface is from where it would be right.
  double silhouettePx = 0;
  std::uint64_t mismatches = 0, beyond = 0;  ///< such pixels; of these farther than kSilhouettePx
  /// Colour: against the centre's with one sample, with more against the mean over the pixel's area.
  double differing8Part = 0;  ///< pixels with another 8-bit colour, over the covered ones
  double psnr = 0;            ///< dB, scene-linear; of one sample off the silhouettes

  /// The largest distance on the screen from what a pixel shows to the truth, silhouettes included.
  [[nodiscard]] double largestPx() const { return std::max(silhouettePx, positionMaxPx); }
};

struct BenchRow {
  BenchWay way;
  BenchCost cost;
  BenchError error;
};

/// A picture and its map of position errors.
struct BenchPicture {
  BenchWay way;
  Image picture, heat;
};

struct BenchScene {
  std::string name;
  std::uint64_t covered = 0, undecided = 0;  ///< pixels of the truth
  double truthMs = 0;
  Image truth;
  std::vector<BenchRow> rows;
  std::vector<BenchPicture> pictures;
};

struct BenchPlan {
  std::vector<BenchWay> ways;  ///< coarse to fine within each shading
  /// Of each way, in turns. A way of which enough has been seen is done with fewer; of which much, with any.
  int runs = 15, leastRuns = 3;
  double enoughMs = 800, muchMs = 4000;
  std::uint64_t mostTriangles = 1'500'000;  ///< ways that would need more are left out
  /// Pixels in which meshes are judged: each that shows the wrong surface costs hundreds of rays. Fewer find
  /// a smaller largest error, never a larger one. Exact pictures are judged wholly.
  std::uint64_t meshPixels = 60'000;
  std::uint64_t areaPixels = 10'000;  ///< in which pictures of several samples are judged
  int areaSamples = 16;               ///< rays in each of these
};

/// Phong meshes from 2 px to 0.01 px, flat and Gouraud ones, exact shells of the usual size and half of it;
/// with 4 samples those whose colours are not yet as good as 4 samples can be.
[[nodiscard]] BenchPlan fullPlan();
/// A few of these, for a first look.
[[nodiscard]] BenchPlan quickPlan();

/// Whether pictures of it are shown: the usual tolerance of each kind, one sample.
[[nodiscard]] bool isPictured(const BenchWay& way);

/// Measures all ways of the plan. `goesOn` is told the finished part, 0..1, between any two pieces of work;
/// when it answers no, there is no result. Throws what Renderer and castPicture throw.
[[nodiscard]] std::optional<BenchScene> measureScene(gpu::Context& context, const std::string& name,
                                                     const Snapshot& snapshot, const BenchPlan& plan,
                                                     const std::function<bool(double)>& goesOn);

}  // namespace luxo
