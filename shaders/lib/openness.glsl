// SPDX-License-Identifier: Apache-2.0
// How open the sky is above a point, as far as that tells which an earlier pass has found.
//
// Around the way to the viewer slices are cut, and in each the highest horizon is looked for on both sides, among points no
// farther than the radius: what is farther, or is not in the picture, occludes nothing. Between the horizons the integral,
// weighted by the cosine to the normal, is known. J. Jimenez, X. Wu, A. Pesce, A. Jarabo, "Practical real-time strategies
// for accurate indirect occlusion", 2016. No noise, no blur: the slices of all pixels are the same.
//
// Whoever includes this has the view's numbers of shade.vert.
#ifndef LUXO_LIB_OPENNESS_GLSL
#define LUXO_LIB_OPENNESS_GLSL

#include "lib/material_of_texel.glsl"

const float kPi = 3.14159265;
// Against the reference, rms of a floor and a wall, and of a teapot, a ball and a torus on them: with 12 and 10 0.017 and 0.059,
// with 20 and 14 0.014 and 0.059 at twice the time. The rest is what the picture does not show.
const int kSlices = 16;
const int kSteps = 12;  // to each side, denser near the point

vec3 positionAt(ivec2 texel, float depth) {
  vec2 pixel = vec2(texel) + 0.5 - inMiddle;
  return inPlace[0] + pixel.x * inPlace[1] + pixel.y * inPlace[2] +
         depth * (inRay[0] + pixel.x * inRay[1] + pixel.y * inRay[2]);
}

// How far the highest point on that side is above the surface's own plane: the angle there, in the slice that it is in itself,
// as a pixel's middle is in none of these; 0 where there is none.
float horizonAlong(vec2 way, ivec2 here, vec3 position, vec3 normal, vec3 viewer, float radiusPx) {
  ivec2 end = textureSize(foundTexels, 0);
  float cosine = 1.0;
  ivec2 last = here;
  for (int i = 1; i <= kSteps; ++i) {
    float part = float(i) / float(kSteps), reach = max(float(i), radiusPx * part * sqrt(part));
    ivec2 there = ivec2(floor(vec2(here) + 0.5 + way * reach));
    if (reach > radiusPx || any(lessThan(there, ivec2(0))) || any(greaterThanEqual(there, end))) break;
    if (there == last) continue;
    last = there;
    vec4 texel = texelFetch(foundTexels, there, 0);
    if (residualOfTexel(texel) == 0.0) continue;  // nothing was found
    vec3 to = positionAt(there, texel.x) - position;
    float squared = dot(to, to), height = dot(to, normal);
    if (squared > view.occlusionRadius * view.occlusionRadius || height <= 0.0) continue;
    // In the plane of `viewer` and `to` the surface is along (-beside, facing).
    float ahead = dot(to, viewer), aside = sqrt(max(squared - ahead * ahead, 1e-37)), facing = dot(normal, viewer);
    float beside = (height - ahead * facing) / aside;
    cosine = min(cosine, (facing * aside - beside * ahead) * inversesqrt(max(squared * (facing * facing + beside * beside), 1e-37)));
  }
  cosine = max(cosine, -1.0);
  return atan(sqrt(1.0 - cosine * cosine), cosine);
}

// Of |sin a| cos(a - tilt) from 0 to a, to its sign, times 2.
float openBelow(float a, float tilt) { return 0.25 * (cos(tilt) - cos(2.0 * a - tilt) + 2.0 * a * sin(tilt)); }

// Of a point that the pixel `here` sees at that depth.
float opennessOf(ivec2 here, float depth, vec3 position, vec3 normal, vec3 viewer) {
  vec3 right = inPlace[1] + depth * inRay[1], down = inPlace[2] + depth * inRay[2];  // a pixel
  // What is nearer to the eye is larger.
  float metres = max(length(right - view.occlusionRadius * inRay[1]), 0.5 * length(right));
  float radiusPx = min(view.occlusionRadius / max(metres, 1e-18), length(vec2(textureSize(foundTexels, 0))));
  // Of a side that is turned away the picture shows nothing that is above it.
  if (dot(normal, viewer) <= 0.0) return 1.0;
  float sum = 0.0, whole = 0.0;
  for (int i = 0; i < kSlices; ++i) {
    float turn = kPi * (float(i) + 0.5) / float(kSlices);
    vec2 way = vec2(cos(turn), sin(turn));
    vec3 across = way.x * right + way.y * down;
    across -= dot(across, viewer) * viewer;
    // Aside of the picture's middle even ways in it are not even around the way to the viewer: by so much each stands for more.
    float weight = dot(right, right) / max(dot(across, across), 1e-37);
    across *= inversesqrt(max(dot(across, across), 1e-37));
    vec2 inSlice = vec2(dot(normal, viewer), dot(normal, across));
    float tilt = atan(inSlice.y, inSlice.x);
    float ahead = tilt + 0.5 * kPi - horizonAlong(way, here, position, normal, viewer, radiusPx),
          behind = tilt - 0.5 * kPi + horizonAlong(-way, here, position, normal, viewer, radiusPx);
    sum += weight * length(inSlice) * (openBelow(ahead, tilt) + openBelow(behind, tilt));
    whole += weight;
  }
  return clamp(sum / whole, 0.0, 1.0);
}
#endif
