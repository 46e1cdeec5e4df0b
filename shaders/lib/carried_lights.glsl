// SPDX-License-Identifier: Apache-2.0
// The lights of a draw: vertices carry the first few, the same all over it, to its fragments, which read the others from the
// buffer (lib/lights.glsl).
#include "lib/lights.glsl"

#ifdef LUXO_VERTEX
#define LUXO_VARYING out
#else
#define LUXO_VARYING in
#endif

// Of triangles of a few pixels each varying costs more than it saves: their fragments read from buffers all that is the same
// all over the draw.
layout(constant_id = kConstantCarries) const bool kCarries = true;

layout(location = kLocationLights) flat LUXO_VARYING vec4 varyingLights[2 * kCarriedLights];   // position; radiance, whether inverse-square
layout(location = kLocationShades) flat LUXO_VARYING vec4 varyingShades[2 * kCarriedShades];  // axis, cosine of the rim; reach

#ifdef LUXO_VERTEX
void carryLights() {
  for (uint i = 0; i < kCarriedLights; ++i) {
    LightData light = lightSet.lights[i];
    varyingLights[2 * i] = light.position;
    varyingLights[2 * i + 1] = vec4(light.radiance, light.inverseSquare);
  }
  for (uint i = 0; i < kCarriedShades; ++i) {
    ShadeData shade = lightSet.shades[i];
    varyingShades[2 * i] = vec4(shade.axis, shade.cosRim);
    varyingShades[2 * i + 1] = vec4(shade.reach, 0, 0, 0);
  }
}
#else
// Where kCarries is false no varying is read: an `if` of its own, which compilers take out with all that it holds.
LightData lightAt(uint i) {
  if (kCarries) {
    if (i < kCarriedLights)
      return LightData(varyingLights[2 * i], varyingLights[2 * i + 1].xyz, uint(varyingLights[2 * i + 1].w));
  }
  return lightSet.lights[i];
}

ShadeData shadeAt(uint i) {
  if (kCarries) {
    if (i < kCarriedShades)
      return ShadeData(varyingShades[2 * i].xyz, varyingShades[2 * i].w, varyingShades[2 * i + 1].x, 1);  // the first
  }
  return lightSet.shades[i];
}
#endif
