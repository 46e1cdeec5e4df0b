// SPDX-License-Identifier: Apache-2.0
// Where the ray of a pixel is at the depth of what positions are relative to, and how it moves with the depth.
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
#endif
