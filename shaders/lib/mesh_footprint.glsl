// SPDX-License-Identifier: Apache-2.0
// How u and v of a triangle's point move from a pixel to the next, exactly. They are ratios of functions that are linear in
// the picture, and so is 1 / depth: the derivative here is the difference from the pixel beside times the ratio of both
// depths, whichever side that is on.
#include "lib/scene.glsl"

vec4 footprintOnTriangle(vec3 position, vec2 parameters) {
  float depth = dot(vec4(position, 1), view.forward);
  // Pixels are shaded in twos from even ones on.
  vec2 toOther = 1.0 - 2.0 * mod(floor(gl_FragCoord.xy), 2.0);
  vec2 others = depth + toOther * vec2(dFdxFine(depth), dFdyFine(depth));
  vec2 ratios = view.viewer.w != 0.0 ? depth / others : vec2(1);
  return vec4(dFdxFine(parameters) * ratios.x, dFdyFine(parameters) * ratios.y);
}
