// SPDX-License-Identifier: Apache-2.0
// A triangle mesh by Embree's rays, one a pixel, on all cores: where Embree is installed (libembree-dev).
#pragma once

#include "image/image.h"
#include "mesh/triangle_mesh.h"
#include "scene/view.h"

#ifdef LUXO_BENCH_EMBREE
#include <embree3/rtcore.h>

namespace luxo::bench {

class RayKnot {
 public:
  /// Builds the tree.
  explicit RayKnot(const TriangleMesh& mesh);
  ~RayKnot();
  RayKnot(const RayKnot&) = delete;
  RayKnot& operator=(const RayKnot&) = delete;

  /// As PlainKnot draws it.
  [[nodiscard]] Image picture(const View& view) const;

 private:
  TriangleMesh mesh_;
  RTCDevice device_;
  RTCScene scene_;
};

}  // namespace luxo::bench
#endif
