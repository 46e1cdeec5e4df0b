// SPDX-License-Identifier: Apache-2.0
// The lights of fragments whose vertices carry the first few; the others are read from the buffer (lib/lights.glsl).
#include "lib/lights.glsl"

// Of triangles of a few pixels each varying costs more than it saves: their fragments read from buffers all that is the same
// all over the draw.
layout(constant_id = kConstantCarries) const bool kCarries = true;

layout(location = 8) flat in vec4 inLights[2 * kCarriedLights];
layout(location = 12) flat in vec4 inShades[2 * kCarriedShades];

LightData lightAt(uint i) {
  if (!kCarries) return lightSet.lights[i];
  if (i >= kCarriedLights) return lightSet.lights[i];
  return LightData(inLights[2 * i], inLights[2 * i + 1].xyz, uint(inLights[2 * i + 1].w));
}

ShadeData shadeAt(uint i) {
  if (!kCarries) return lightSet.shades[i];
  if (i >= kCarriedShades) return lightSet.shades[i];
  return ShadeData(inShades[2 * i].xyz, inShades[2 * i].w, inShades[2 * i + 1].x);
}
