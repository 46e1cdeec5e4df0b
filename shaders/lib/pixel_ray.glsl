// SPDX-License-Identifier: Apache-2.0
// Where the ray of a pixel is at the depth of what positions are relative to, and how it moves with the depth; and the
// point of a triangle that it sees.
#ifndef LUXO_LIB_PIXEL_RAY_GLSL
#define LUXO_LIB_PIXEL_RAY_GLSL
#include "lib/scene.glsl"

vec3 pixelPlace() {
  vec2 pixel = gl_FragCoord.xy - view.middle;
  return view.placeMiddle + pixel.x * view.placeRight + pixel.y * view.placeDown;
}
vec3 pixelRay() {
  vec2 pixel = gl_FragCoord.xy - view.middle;
  return view.rayMiddle + pixel.x * view.rayRight + pixel.y * view.rayDown;
}

// What is interpolated between corners is beside the ray by what floats leave of corners and of the interpolation, which near
// the eye is thousandths of a pixel: the point is on the ray, at the depth that is interpolated. (Light, which no such
// step changes by an 8-bit code, is that of the interpolated point where a fragment finds and lights: to move it costs 4
// samples a pixel a third more.)
vec3 seenByPixel(vec3 interpolated) { return pixelPlace() + dot(interpolated, view.forward.xyz) * pixelRay(); }
#endif
