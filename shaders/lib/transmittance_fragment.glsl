// SPDX-License-Identifier: Apache-2.0
// How much of its light a caster lets through to the point that a pixel sees.
#extension GL_GOOGLE_include_directive : require
#include "lib/found_place.glsl"
#include "lib/transmittance_test.glsl"

layout(location = 0) out vec4 outTransmittance;

void findTransmittance() {
  FoundPlace found = foundPlace();
  if (facesAway(found.drawn, found.drawnNormal)) discard;
  vec3 transmittance = transmittanceAt(found.position, found.normal, found.depth, found.material == varyingMaterial.x);
  if (isOpen) doubtPixel();
  if (transmittance == vec3(1)) discard;
  outTransmittance = vec4(transmittance, 1);
}
