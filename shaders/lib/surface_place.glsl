// SPDX-License-Identifier: Apache-2.0
// The point of its surface that a mesh shows: S(u, v), and the surface's own normal there.
#include "lib/mesh_place_interface.glsl"
#include "lib/caster_formula.glsl"
#include "lib/octahedral.glsl"
#include "lib/scene.glsl"
#include "shared/truth.h"

struct SurfacePlace {
  vec3 position, normal;  // relative; on the side that is shown
  bool exists;            // the formula has a value there
};

// `drawn`, `drawnNormal`: of the mesh. Where patches meet the one whose point is nearest to it.
SurfacePlace surfacePlace(vec2 parameters, vec3 drawn, vec3 drawnNormal) {
  mat3 linear = mat3(varyingRelative[0], varyingRelative[1], varyingRelative[2]);
  float nearest = 3e38;
  vec3 place = drawn, normal = vec3(0);
  for (uint i = 0; i < varyingNode.x; ++i) {
    CasterCell patch_ = casterCells[varyingFirst.y + i];
    vec2 from = parameters - vec2(patch_.originOfU, 0);
    if (any(greaterThan(abs(from - patch_.middle), (1.0 + kPatchSlack) * patch_.half_))) continue;
    holdPatch(patch_.patch_);
    vec2 inside = clamp(from, patch_.middle - patch_.half_, patch_.middle + patch_.half_);
    vec3 S, Su, Sv;
    surfaceAt(inside.x, inside.y, S, Su, Sv);
    vec3 position = linear * S + varyingRelative[3];
    float off = length(position - drawn);
    if (!(off < nearest)) continue;
    nearest = off;
    place = position;
    normal = unitOrZero(cross(linear * Su, linear * Sv));
  }
  if (!(dot(normal, normal) > 0.5)) normal = drawnNormal;  // a pole has none
  return SurfacePlace(place, dot(normal, drawnNormal) < 0.0 ? -normal : normal, nearest < 3e38);
}
