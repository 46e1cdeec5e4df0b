// SPDX-License-Identifier: Apache-2.0
// A snapshot as a scene of POV-Ray 3.7, of its own analytic primitives only: a referee that shares nothing
// with luxo but the definition of light.
//
// POV-Ray's finish: `diffuse` times N.L; `specular` times (N.H)^(1 / roughness), not times N.L, but both only
// where the light is above the surface's horizon, on the viewer's side; `ambient` times the pigment.
// (Its lights without shadows have no highlights; objects without shadows do.)
#pragma once

#include <string>

#include "scene/snapshot.h"

namespace luxo::povray {

/// How a torus is said.
enum class TorusAs {
  Primitive,  ///< POV-Ray's own torus: a polynomial of degree 4
  Parametric  ///< its `parametric` object, everything at its defaults
};

/// Rectangles, disks, cylinders, spheres, paraboloids and tori; opaque materials of grey highlights, with
/// faces on both sides; lights without distance. Throws Error(Scene) naming what it cannot say.
[[nodiscard]] std::string sceneText(const Snapshot& snapshot, TorusAs torusAs = TorusAs::Primitive);

/// The snapshot as POV-Ray can say it: faces on both sides, no shadows, no distance, and lights of that
/// radiance, so that nothing gets brighter than its white.
[[nodiscard]] Snapshot comparable(Snapshot snapshot, double radiance);

}  // namespace luxo::povray
