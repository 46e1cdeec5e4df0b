// SPDX-License-Identifier: Apache-2.0
// The point that a pixel sees, as shadows need it, and the pixel's bit where what light reaches it is open. Of a mesh that
// is its surface's own point (lib/mesh_place_fragment.glsl).
#include "lib/doubted_pixel.glsl"
#include "lib/material_of_texel.glsl"
#include "lib/octahedral.glsl"
#include "lib/place_interface.glsl"

layout(constant_id = kConstantPlaces) const bool kPlaces = false;

layout(set = kSetFound, binding = kBindingFound) uniform sampler2D foundTexels;
layout(set = kSetFound, binding = kBindingPlaces) uniform usampler2D places;

struct FoundPlace {
  vec3 position, normal;
  vec3 drawn, drawnNormal;  // where and on what light falls: of a mesh its own
  float depth;
  uint material;  // its number
};

FoundPlace foundPlace() {
  vec4 texel = texelFetch(foundTexels, ivec2(gl_FragCoord.xy), 0);
  vec3 normal = fromOctahedral(texel.yz);
  vec3 position = placeAtDepth(texel.x);
  FoundPlace found = FoundPlace(position, normal, position, normal, texel.x, materialOfTexel(texel));
  if (!kPlaces) return found;
  uvec4 place = texelFetch(places, ivec2(gl_FragCoord.xy), 0);
  if (place.w != 0) {
    found.position = uintBitsToFloat(place.xyz);
    found.normal = fromOctahedral(unpackedOctahedral(place.w));
  }
  return found;
}
