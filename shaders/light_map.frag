// SPDX-License-Identifier: Apache-2.0
// How much of a light reaches the point that a pixel sees, as its depth map tells.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/light_map.glsl"
#include "lib/octahedral.glsl"

layout(set = kSetFound, binding = kBindingFound) uniform sampler2D foundTexels;

layout(location = 0) out vec4 outTransmittance;

void main() {
  vec4 texel = texelFetch(foundTexels, ivec2(gl_FragCoord.xy), 0);
  vec2 pixel = gl_FragCoord.xy - varyingMiddle;
  vec3 place = varyingPlace[0] + pixel.x * varyingPlace[1] + pixel.y * varyingPlace[2],
       ray = varyingRay[0] + pixel.x * varyingRay[1] + pixel.y * varyingRay[2];
  float lit = litByMap(place + texel.x * ray, fromOctahedral(texel.yz));
  if (lit == 1.0) discard;
  outTransmittance = vec4(vec3(lit), 1);
}
