// SPDX-License-Identifier: Apache-2.0
// How much of a light reaches what a pixel shows that is seen through, as its depth map tells.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/layers.glsl"
#include "lib/light_map.glsl"
#include "lib/octahedral.glsl"

void main() {
  LightMapFace first = face;
  vec2 pixel = gl_FragCoord.xy - varyingMiddle;
  vec3 place = varyingPlace[0] + pixel.x * varyingPlace[1] + pixel.y * varyingPlace[2],
       ray = varyingRay[0] + pixel.x * varyingRay[1] + pixel.y * varyingRay[2];
  for (uint index = layerHeads[layerPixel()]; index != 0; index = layerPoints[index].next) {
    LayerPoint point = layerPoints[index];
    face = first;
    corner = ivec2(0);
    layerReaches[index].transmittance *= litByMap(place + point.depth * ray, fromOctahedral(point.normal));
  }
  countEndedLoops();
}
