// SPDX-License-Identifier: Apache-2.0
// Whether two meetings of a ray in one place are one point of the surface, which two cells have found at their common border:
// to what floats leave of them the parameters are the same, and the normals. Where a surface touches itself the parameters
// are others, from however near; so they are at seams and poles, and these, too, are left to rays.
#ifndef LUXO_LIB_ONE_POINT_GLSL
#define LUXO_LIB_ONE_POINT_GLSL

const float kSameNormal = 1e-3;
const float kSameParameter = 4e-6;  // of it: 34 roundings; cells are shrunk by 2e-6 of their half (lib/meeting.glsl)

bool isOnePoint(vec2 parameters, vec3 normal, vec2 otherParameters, vec3 otherNormal) {
  vec2 larger = max(abs(parameters), abs(otherParameters));
  return all(lessThanEqual(abs(parameters - otherParameters), kSameParameter * larger)) &&
         length(normal - otherNormal) <= kSameNormal;
}
#endif
