// SPDX-License-Identifier: Apache-2.0
// How much of the ambient light gets into corners.
//
// The ambient light of a point is multiplied by its openness: of the half sphere above it, weighted by the
// cosine to the normal, the part in which nothing opaque is nearer than the radius. S. Zhukov, A. Iones, G.
// Kronin, "An ambient light illumination model", 1998, with obscurance 0 or 1. What is seen through has it, too,
// and occludes nothing; what is cut out (Material::cutoff) is opaque where it is no hole.
#pragma once

namespace luxo {

enum class OcclusionMethod {
  /// By the horizons that the picture itself tells: what is out of it, or behind, occludes nothing, nor does
  /// what is cut out, whose holes are known after the light on what is opaque.
  Screen,
  Rays,    ///< by the reference's rays, which are the truth of both
};

struct AmbientOcclusion {
  OcclusionMethod method = OcclusionMethod::Screen;
  double radius = 0;  ///< metres; 0: there is none, and it costs nothing

  [[nodiscard]] bool any() const { return radius > 0; }
  friend bool operator==(const AmbientOcclusion&, const AmbientOcclusion&) = default;
};

}  // namespace luxo
