// SPDX-License-Identifier: Apache-2.0
// Whether a caster keeps its light from the point that a pixel sees.
#extension GL_GOOGLE_include_directive : require
#include "lib/found_place.glsl"
#include "lib/opaque_caster.glsl"

layout(location = 0) out uint outShadows;

void findShadow() {
  FoundPlace found = foundPlace();
  if (facesAway(found.drawn, found.drawnNormal)) discard;
  int result = shadowAt(found.position, found.normal, found.depth, found.material == varyingMaterial.x);
  if (result == kOpen) doubtPixel();
  if (result != kMet) discard;
  outShadows = 1u << varyingCaster.y;
}
