// SPDX-License-Identifier: Apache-2.0
// The point that a pixel of a mesh shows, on the mesh's surface: S(u, v), from where its light rays start, and the surface's
// own normal there; and for the host which point it is.
#extension GL_GOOGLE_include_directive : require
#include "lib/mesh_place_interface.glsl"
#include "lib/caster_formula.glsl"
#include "lib/doubted_pixel.glsl"
#include "lib/material_of_texel.glsl"
#include "lib/octahedral.glsl"
#include "lib/scene.glsl"

layout(set = kSetFound, binding = kBindingFound) uniform sampler2D foundTexels;
layout(set = kSetFound, binding = kBindingFoundParameters) uniform sampler2D foundParameters;
layout(scalar, set = kSetShadow, binding = kBindingShownPoints) buffer ShownPoints { ShownPoint ofPixels[]; } shown;

layout(location = 0) out uvec4 outPlace;  // relative position; normal

const float kSlack = 1e-3;  // of a patch: what interpolation may overshoot an edge by

void findPlace() {
  vec4 texel = texelFetch(foundTexels, ivec2(gl_FragCoord.xy), 0);
  if (materialOfTexel(texel) != varyingNode.y) discard;
  vec2 parameters = texelFetch(foundParameters, ivec2(gl_FragCoord.xy), 0).xy;
  vec3 drawn = placeAtDepth(texel.x);
  shown.ofPixels[pixelNumber()] = ShownPoint(parameters, 1 + varyingNode.y);

  // Where patches meet the one whose point is nearest to the mesh.
  mat3 linear = mat3(varyingRelative[0], varyingRelative[1], varyingRelative[2]);
  float nearest = 3e38;
  vec3 place = drawn, normal = vec3(0);
  for (uint i = 0; i < varyingNode.x; ++i) {
    CasterCell patch_ = casterCells[varyingFirst.y + i];
    vec2 from = parameters - vec2(patch_.originOfU, 0) - patch_.middle;
    if (any(greaterThan(abs(from), (1.0 + kSlack) * patch_.half_))) continue;
    holdPatch(patch_.patch_);
    vec2 inside = patch_.middle + clamp(from, -patch_.half_, patch_.half_);
    vec3 S, Su, Sv;
    surfaceAt(inside.x, inside.y, S, Su, Sv);
    vec3 position = linear * S + varyingRelative[3];
    float off = length(position - drawn);
    if (!(off < nearest)) continue;
    nearest = off;
    place = position;
    normal = unitOrZero(cross(linear * Su, linear * Sv));
  }
  if (nearest == 3e38) {  // the formula has no value there
    doubtPixel();
    discard;
  }
  // On the side that is shown; a pole has none.
  vec3 drawnNormal = fromOctahedral(texel.yz);
  if (!(dot(normal, normal) > 0.5)) normal = drawnNormal;
  outPlace = uvec4(floatBitsToUint(place), packedOctahedral(octahedral(dot(normal, drawnNormal) < 0.0 ? -normal : normal)));
}
