// SPDX-License-Identifier: Apache-2.0
// The point that a pixel of a mesh shows, on the mesh's surface, from where its light rays start; and for the host which
// point it is.
#extension GL_GOOGLE_include_directive : require
#include "lib/surface_place.glsl"
#include "lib/doubted_pixel.glsl"
#include "lib/material_of_texel.glsl"

layout(set = kSetFound, binding = kBindingFound) uniform sampler2D foundTexels;
layout(set = kSetFound, binding = kBindingFoundParameters) uniform sampler2D foundParameters;
layout(scalar, set = kSetShadow, binding = kBindingShownPoints) buffer ShownPoints { ShownPoint ofPixels[]; } shown;

layout(location = 0) out uvec4 outPlace;  // relative position; normal

void findPlace() {
  vec4 texel = texelFetch(foundTexels, ivec2(gl_FragCoord.xy), 0);
  if (materialOfTexel(texel) != varyingNode.y) discard;
  vec2 parameters = texelFetch(foundParameters, ivec2(gl_FragCoord.xy), 0).xy;
  shown.ofPixels[pixelNumber()] = ShownPoint(parameters, 1 + varyingNode.y);
  SurfacePlace found = surfacePlace(parameters, placeAtDepth(texel.x), fromOctahedral(texel.yz));
  if (!found.exists) {
    doubtPixel();
    discard;
  }
  outPlace = uvec4(floatBitsToUint(found.position), packedOctahedral(octahedral(found.normal)));
}
