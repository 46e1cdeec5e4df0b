// SPDX-License-Identifier: Apache-2.0
// Whether casters that are known as equations, all of one kind, keep their light from a point.
//
// F(p + t d) is a polynomial of t, with the point at t = 0 and the light at t = 1, or at infinity. Of a point of the caster
// itself t = 0 is a root: it is divided out before anything is rounded.
//
// Every number comes with a bound of what floats leave of it, from `e` on, that of the point itself, by axis. kUlps times
// what has the size of a sum bounds what a few additions round away. What these bounds do not decide is kOpen.
#include "lib/closed_interface.glsl"
#include "lib/ray_result.glsl"

const float kUlps = 2.4e-7;  // 2^-22
const float kTiny = 1e-37;

struct ClosedRay {
  vec3 from, way;   // to the light, or toward it
  vec3 e, eOfWay;   // bounds of what is rounded away of these
  vec3 off;         // and how far the point may be off its own surface; 0 of another one
  bool isOwn;
};

#include "lib/closed_quadric.glsl"
#include "lib/closed_torus.glsl"

int meets(ClosedCaster caster, ClosedRay ray) {
  if (kClosedKind == kClosedTorus) return meetsTorus(caster, ray);
  return kClosedKind == kClosedPlane ? meetsPlane(caster, ray) : meetsQuadric(caster, ray);
}

// Of a point that the picture shows at a depth (metres beyond that of what positions are relative to), whose pixels are
// `width` times as wide as one metre away; `cosine`: of its surface with the light; `lit`: below.
int closedShadowAt(ClosedCaster caster, vec3 position, float cosine, float lit, float width, uint material) {
  bool isOwn = material == caster.material;
  if ((caster.flags & kGatedLight) != 0 && lit <= 0.0) return kPassed;
  if (isOwn && (kClosedKind == kClosedPlane || ((caster.flags & kConvexCaster) != 0 && cosine > kLeastCosine))) return kPassed;
  ClosedRay ray;
  for (int i = 0; i < 3; ++i)
    ray.from[i] = dot(caster.unitFromRelative[i].xyz, position) + caster.unitFromRelative[i].w;
  ray.way = caster.light.xyz - caster.light.w * ray.from;
  ray.e = caster.rounding + caster.roundingPerMetre * length(position);
  ray.eOfWay = 2.0 * caster.light.w * ray.e + kUlps * abs(caster.light.xyz);
  ray.off = isOwn ? caster.roundingPerMetre * (caster.offPerPixel * width) : vec3(0);
  if (isOwn && (caster.flags & kRoundedPoints) != 0) ray.off += ray.e;
  ray.isOwn = isOwn;
  return meets(caster, ray);
}

// How much a light shines on a point of that normal: above 0 it does.
float litAt(vec3 position, vec3 normal) {
  return dot(normal, varyingLightRelative.xyz - varyingLightRelative.w * position);
}

// The lights that do not reach a point; `lit`: litAt() where and on what they fall; `isOpen`: floats leave some of it open.
uint closedShadowsAt(vec3 position, vec3 normal, float lit, float depth, uint material, out bool isOpen) {
  vec3 toLight = varyingLightRelative.xyz - varyingLightRelative.w * position;
  float cosine = dot(normal, toLight) * inversesqrt(max(dot(toLight, toLight), kTiny));
  float width = varyingMiddle.z != 0.0 ? depth + varyingMiddle.w : 1.0;
  uint shadows = 0;
  isOpen = false;
  for (int i = 0; i < int(kClosedCasters); ++i) {
    ClosedCaster caster = toldCaster(i);
    int result = closedShadowAt(caster, position, cosine, lit, width, material);
    isOpen = isOpen || result == kOpen;
    if (result == kMet) shadows |= 1u << caster.light_;
  }
  // What is in one's shadow is in shadow whatever another does.
  isOpen = isOpen && shadows == 0;
  return shadows;
}
