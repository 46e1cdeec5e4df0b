// SPDX-License-Identifier: Apache-2.0
// The ground truth: pictures by rays in double precision, every pixel proven. It shares nothing with the
// Vulkan path but the formula, the surface and the snapshot.
//
//     ReferencePicture truth = castPicture(takeSnapshot(scene, 0, {640, 480}));
//     truth.color.save("truth.pfm");
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "image/image.h"
#include "scene/snapshot.h"

namespace luxo {

namespace reference {
class ShapeCache;
}

struct ReferenceOptions {
  /// Per pixel. 1: its centre, or where the view samples it (View::sampleOffsetPx). More: a low-discrepancy
  /// set of points, the same in every pixel up to a shift that its place decides.
  int samples = 1;
  int threads = 0;  ///< 0: all cores. The picture does not depend on it.
  /// Row * width + column of the pixels to cast; empty: all. The others stay black, with nothing hit, and do
  /// not count.
  std::vector<std::uint32_t> pixels = {};
  /// Of materials that do not say otherwise: all are lit as in exact shading, but drawings (toon).
  Shading shading = Shading::Exact;
  /// Called now and then with the finished part, 0..1, from one thread at a time; false stops the work.
  std::function<bool(double)> progress = {};
};

/// Scene-linear, unclamped. Where nothing is hit: colour the background, depth +infinity, the rest 0.
/// Everything but the colour is of the place where the view samples the pixel, and in double where float
/// would lose it.
struct ReferencePicture {
  Image color;                ///< 3 channels
  std::vector<double> depth;  ///< along the view axis, metres
  std::vector<Vec3> position, normal;
  std::vector<Vec3> facet;            ///< unit normals of triangles themselves; of formulas as `normal`
  std::vector<Vec2> parameters;       ///< (u, v)
  std::vector<std::uint32_t> number;  ///< of the node, as in the `id` output; 0: nothing
  std::vector<bool> certified;        ///< hit or miss, every sample and shadow of the pixel, is proven

  std::uint64_t hits = 0, misses = 0;  ///< pixels whose centre is a certified hit, a certified miss
  std::uint64_t undecided = 0;         ///< pixels that are not certified
  /// Standard error of the mean over the samples: root mean square over all pixels and channels, and largest.
  /// An upper estimate, since the samples are better spread than random ones. 0 with one sample.
  double standardErrorRms = 0, standardErrorMax = 0;
  bool complete = true;  ///< not stopped by `progress`
};

/// Casts one picture after the other and keeps the surfaces that stay the same between them. The pictures do
/// not depend on those before. One thread at a time.
class ReferenceCaster {
 public:
  ReferenceCaster();
  ~ReferenceCaster();
  ReferenceCaster(const ReferenceCaster&) = delete;
  ReferenceCaster& operator=(const ReferenceCaster&) = delete;

  /// As castPicture().
  [[nodiscard]] ReferencePicture cast(const Snapshot& snapshot, const ReferenceOptions& options = {});

 private:
  std::unique_ptr<reference::ShapeCache> cache_;
};

/// Throws Error(Scene) for materials whose shading is neither light nor a drawing (toon): lines, views.
[[nodiscard]] ReferencePicture castPicture(const Snapshot& snapshot, const ReferenceOptions& options = {});

}  // namespace luxo
