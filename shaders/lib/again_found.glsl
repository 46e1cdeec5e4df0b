// SPDX-License-Identifier: Apache-2.0
// Points that are not seen through, one a pixel. Whoever includes this has an outColor.
#include "lib/again.glsl"
#include "lib/material_of_texel.glsl"
#include "lib/octahedral.glsl"
#include "lib/pixel_ray.glsl"

layout(set = kSetFound, binding = kBindingFound) uniform sampler2D foundTexels;
layout(set = kSetFound, binding = kBindingShadows) uniform usampler2D shadowsOfLights;
layout(set = kSetFound, binding = kBindingTransmittance) uniform sampler2D transmittances;

// By the depth test it is as near; but two nodes may be.
bool findPoint(uint material) {
  vec4 texel = texelFetch(foundTexels, ivec2(gl_FragCoord.xy), 0);
  point = DrawnPoint(pixelPlace() + texel.x * pixelRay(), fromOctahedral(texel.yz),
                     texelFetch(shadowsOfLights, ivec2(gl_FragCoord.xy), 0).x,
                     texelFetch(transmittances, ivec2(gl_FragCoord.xy), 0).rgb);
  return materialOfTexel(texel) == material;
}

void lightPoint(vec3 light, vec4 paint) { outColor = vec4(light, 0); }
