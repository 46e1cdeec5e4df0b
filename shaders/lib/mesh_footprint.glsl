// SPDX-License-Identifier: Apache-2.0
// How u and v of a triangle's point move from a pixel to the next, exactly: on a triangle they are linear functions of the
// position, which is in its plane, so that differences between any fragments tell all of both; and where the rays of the
// pixels beside meet the plane is known.
#include "lib/scene.glsl"

vec4 footprintOnTriangle(vec3 position, vec2 parameters, vec3 toViewer) {
  vec3 a = dFdx(position), b = dFdy(position), n = cross(a, b);
  mat2 differences = mat2(dFdx(parameters), dFdy(parameters));
  float depth = dot(position, view.forward.xyz), perArea = 1.0 / dot(n, n), perCosine = 1.0 / dot(n, toViewer);
  vec3 right = view.placeRight + depth * view.rayRight, below = view.placeDown + depth * view.rayDown;
  right -= toViewer * (dot(n, right) * perCosine);
  below -= toViewer * (dot(n, below) * perCosine);
  vec2 onRight = differences * vec2(dot(cross(right, b), n), dot(cross(a, right), n)) * perArea,
       onBelow = differences * vec2(dot(cross(below, b), n), dot(cross(a, below), n)) * perArea;
  return vec4(onRight, onBelow);
}
