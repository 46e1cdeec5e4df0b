// SPDX-License-Identifier: Apache-2.0
// Whether a caster keeps its light from the point that a pixel sees.
#extension GL_GOOGLE_include_directive : require
#include "lib/shadow_test.glsl"
#include "lib/material_of_texel.glsl"
#include "lib/octahedral.glsl"

layout(scalar, set = kSetShadow, binding = kBindingShadowDoubts) buffer Doubts { uint ofPixels[]; } doubts;
layout(set = kSetFound, binding = kBindingFound) uniform sampler2D foundTexels;

layout(location = 0) out uint outShadows;

void doubtPixel() {
  uint pixel = uint(gl_FragCoord.y) * uint(2.0 * varyingMiddle.x) + uint(gl_FragCoord.x);
  atomicOr(doubts.ofPixels[pixel / kDoubtsPerWord], kShadowOpenHere << kDoubtBits * (pixel % kDoubtsPerWord));
}

void findShadow() {
  vec4 texel = texelFetch(foundTexels, ivec2(gl_FragCoord.xy), 0);
  vec2 pixel = gl_FragCoord.xy - varyingMiddle.xy;
  vec3 place = varyingPlace[0] + pixel.x * varyingPlace[1] + pixel.y * varyingPlace[2],
       sight = varyingRay[0] + pixel.x * varyingRay[1] + pixel.y * varyingRay[2];
  int result = shadowAt(place + texel.x * sight, fromOctahedral(texel.yz), texel.x, materialOfTexel(texel) == varyingMaterial);
  if (result == kOpen) doubtPixel();
  if (result != kMet) discard;
  outShadows = 1u << varyingCaster.y;
}
