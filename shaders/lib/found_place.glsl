// SPDX-License-Identifier: Apache-2.0
// The point that a pixel sees, as shadows need it, and the pixel's bit where what light reaches it is open.
#include "lib/material_of_texel.glsl"
#include "lib/octahedral.glsl"
#include "lib/place_interface.glsl"

layout(scalar, set = kSetShadow, binding = kBindingShadowDoubts) buffer Doubts { uint ofPixels[]; } doubts;
layout(set = kSetFound, binding = kBindingFound) uniform sampler2D foundTexels;

struct FoundPlace {
  vec3 position, normal;
  float depth;
  uint material;  // its number
};

FoundPlace foundPlace() {
  vec4 texel = texelFetch(foundTexels, ivec2(gl_FragCoord.xy), 0);
  vec2 pixel = gl_FragCoord.xy - varyingMiddle.xy;
  vec3 place = varyingPlace[0] + pixel.x * varyingPlace[1] + pixel.y * varyingPlace[2],
       sight = varyingRay[0] + pixel.x * varyingRay[1] + pixel.y * varyingRay[2];
  return FoundPlace(place + texel.x * sight, fromOctahedral(texel.yz), texel.x, materialOfTexel(texel));
}

void doubtPixel() {
  uint pixel = uint(gl_FragCoord.y) * uint(2.0 * varyingMiddle.x) + uint(gl_FragCoord.x);
  atomicOr(doubts.ofPixels[pixel / kDoubtsPerWord], kShadowOpenHere << kDoubtBits * (pixel % kDoubtsPerWord));
}
