// SPDX-License-Identifier: Apache-2.0
// Spheres by tracing rays: each meets the nearest, goes on where that mirrors it, a bounded number of times, and asks whether
// the sun gets there (T. Whitted, "An improved illumination model for shaded display", CACM 1980).
#ifndef SPHERES_GLSL
#define SPHERES_GLSL

const int kSpheres = 6;
const float kFar = 1e20, kOff = 1e-5;  // metres: kOff from a surface, a ray has left it

uniform vec4 spheres[kSpheres] = vec4[](vec4(-1.5, 0.8, -2.6, 0.8), vec4(0.3, 1.1, -3.6, 1.1), vec4(1.75, 0.6, -2.2, 0.6),
  vec4(-0.45, 0.35, -1.5, 0.35), vec4(0.75, 0.25, -1.2, 0.25), vec4(-2.6, 0.5, -4.2, 0.5));  // middle, radius, metres
uniform vec3 paints[kSpheres] = vec3[](vec3(0.9, 0.5, 0.3), vec3(0.92), vec3(0.45, 0.7, 0.9), vec3(0.7, 0.06, 0.05),
  vec3(0.9, 0.7, 0.2), vec3(0.15, 0.4, 0.2));
uniform float mirrors[kSpheres] = float[](0.75, 0.92, 0.7, 0.12, 0.5, 0.15);  // how much of it is a mirror
uniform int bounces = 6;                         // @slider 0 8
uniform float ground = 0.0;                      // metres: where the floor is
uniform float polish = 0.18;                     // of it @slider 0 1
uniform vec3 bright = vec3(0.75, 0.72, 0.66);    // squares of it @color
uniform vec3 dark = vec3(0.12, 0.13, 0.15);      // @color
uniform vec3 below = vec3(0.95, 0.93, 0.90);     // the sky's colour where it is lowest @color
uniform vec3 above = vec3(0.04, 0.16, 0.50);     // @color

struct Sun {
  vec3 direction, radiance, ambient;
};

// How far along a ray the nearest sphere is that is not farther than that; `which` it is, or as it was.
float nearestSphere(vec3 from, vec3 way, float far, inout int which) {
  for (int i = 0; i < kSpheres; ++i) {
    // Of the sphere's middle and of the ray's point beside it: exact where it grazes, too.
    vec3 toMiddle = spheres[i].xyz - from;
    float along = dot(toMiddle, way);
    vec3 beside = toMiddle - along * way;
    float half_ = spheres[i].w * spheres[i].w - dot(beside, beside);
    if (half_ <= 0.0) continue;
    float root = sqrt(half_), at = along - root > kOff ? along - root : along + root;
    if (at > kOff && at < far) {
      far = at;
      which = i;
    }
  }
  return far;
}

vec3 skyOf(vec3 way) { return mix(below, above, 0.5 + 0.5 * way.y); }

vec3 traced(vec3 from, vec3 way, Sun sun) {
  vec3 sum = vec3(0.0), weight = vec3(1.0);
  for (int k = 0; k <= bounces; ++k) {
    int which = -1;
    float toFloor = way.y < 0.0 ? (ground - from.y) / way.y : -1.0;
    float far = nearestSphere(from, way, toFloor > kOff ? toFloor : kFar, which);
    if (far == kFar) return sum + weight * skyOf(way);
    vec3 at = from + far * way, normal, paint;
    float mirror, power;
    if (which >= 0) {
      normal = (at - spheres[which].xyz) / spheres[which].w;
      paint = paints[which];
      mirror = mirrors[which];
      power = 200.0;
    } else {
      normal = vec3(0.0, 1.0, 0.0);
      vec2 square = floor(1.25 * at.xz);
      paint = mix(bright, dark, mod(square.x + square.y, 2.0));
      // The floor is lost in the sky before its squares are finer than pixels; and mirrors more at grazing angles.
      float lost = 1.0 - exp(-0.0012 * far * far);
      sum += weight * lost * skyOf(way);
      weight *= 1.0 - lost;
      mirror = polish + (1.0 - polish) * pow(1.0 + way.y, 5.0);
      power = 60.0;
    }
    int shade = -1;
    float up = dot(normal, sun.direction);
    vec3 lit = paint * sun.ambient;
    if (up > 0.0 && nearestSphere(at + kOff * normal, sun.direction, kFar, shade) == kFar)
      lit += sun.radiance * (paint * up + 0.5 * pow(max(dot(normal, normalize(sun.direction - way)), 0.0), power));
    sum += weight * (1.0 - mirror) * lit;
    weight *= mirror * (which >= 0 ? paint : vec3(1.0));
    way = reflect(way, normal);
    from = at + kOff * normal;
  }
  return sum;
}
#endif
