// SPDX-License-Identifier: Apache-2.0
// The point that a ray sees: what whoever finds it tells whoever lights it, and neither knows the other.
//
// Searches, equations, planes, triangles and what an earlier pass has found each implement the functions below; the
// light on a point is lib/lit_plain.glsl's, or lib/lit_pattern.glsl's. Joined in one fragment they are the fused form; with
// a texel in between (lib/found_texel.glsl) the deferred one.
#ifndef LUXO_LIB_FOUND_GLSL
#define LUXO_LIB_FOUND_GLSL
#extension GL_GOOGLE_include_directive : require
#include "lib/found_around.glsl"
#include "lib/illumination.glsl"

// Light asks for no id and no certificate. Views of geometry do: they are in Inspected (lib/inspection.glsl), which shells fill
// from this and from their instance, what is drawn as triangles from these alone.
struct Found {
  vec3 position;    // metres
  vec3 normal;      // unit, of the side that is shown
  vec3 viewer;      // unit, toward the viewer
  vec2 parameters;  // u and v
  float depth;      // metres along the view axis: of shells, for views of geometry alone; elsewhere 0
  float residual;   // pixels; negative where the point is not certified
};

// Ends the fragment where there is nothing to see.
Found foundPoint();

// What it is made of, its pattern apart; and its number in the buffer of them all.
Material foundMaterial();
uint foundMaterialNumber();

// Of a material, in the direction of the viewer.
vec3 lit(Found found);

#endif
