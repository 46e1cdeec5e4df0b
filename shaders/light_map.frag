// SPDX-License-Identifier: Apache-2.0
// How much of a light reaches the point that a pixel sees, as its depth map tells.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/light_map.glsl"
#include "lib/octahedral.glsl"
#include "lib/pixel_ray.glsl"

layout(set = kSetFound, binding = kBindingFound) uniform sampler2D foundTexels;

layout(location = 0) out vec4 outTransmittance;

void main() {
  vec4 texel = texelFetch(foundTexels, ivec2(gl_FragCoord.xy), 0);
  float lit = texel.w != 0.0 ? litByMap(pixelPlace() + texel.x * pixelRay(), fromOctahedral(texel.yz)) : 1.0;
  if (lit == 1.0) discard;
  outTransmittance = vec4(vec3(lit), 1);
}
