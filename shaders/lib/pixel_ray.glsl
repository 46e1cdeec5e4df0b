// SPDX-License-Identifier: Apache-2.0
// Where the ray of a pixel is at the depth of what positions are relative to, and how it moves with the depth; and the
// point of a triangle that it sees.
#ifndef LUXO_LIB_PIXEL_RAY_GLSL
#define LUXO_LIB_PIXEL_RAY_GLSL
#include "lib/number.glsl"
#include "lib/scene.glsl"

vec3 pixelPlace() {
  vec2 pixel = gl_FragCoord.xy - view.middle;
  return view.placeMiddle + pixel.x * view.placeRight + pixel.y * view.placeDown;
}
vec3 pixelRay() {
  vec2 pixel = gl_FragCoord.xy - view.middle;
  return view.rayMiddle + pixel.x * view.rayRight + pixel.y * view.rayDown;
}

// Where the ray meets a triangle's plane, of a point of it that is interpolated. Devices interpolate between corners that they
// have rounded to 1/256 of a pixel: the point is on the triangle, beside the ray by as much (and, near the eye, by what floats
// leave of corners); at its depth the ray would be off the triangle. The plane is that of the point and its derivatives, and
// between the two places depths differ no more than they do in 1/128 of a pixel. A point that a ray has found has no
// derivatives: it is where it is seen.
//
// Light, which no such step changes by an 8-bit code, is that of the interpolated point where a fragment finds and lights: to
// move it costs 4 samples a pixel a third more.
vec3 seenByPixel(vec3 interpolated) {
  float depth = dot(interpolated, view.forward.xyz), most = fwidth(depth) / 128.0;
  vec3 ray = pixelRay(), onRay = pixelPlace() + depth * ray, normal = cross(dFdx(interpolated), dFdy(interpolated));
  float along = dot(normal, interpolated - onRay) / dot(normal, ray);
  return isNumber(along) ? onRay + clamp(along, -most, most) * ray : onRay;
}
#endif
