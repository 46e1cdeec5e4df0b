// SPDX-License-Identifier: Apache-2.0
// Whether a caster keeps its light from the point that a pixel sees: by the cells that the light's grid lists in the
// direction of the point, nearest to the light first.
#extension GL_GOOGLE_include_directive : require
#include "lib/formula.glsl"
#include "lib/shadow_interface.glsl"

layout(scalar, set = kSetShadow, binding = kBindingGridStarts) readonly buffer GridStarts { uint gridStarts[]; };
layout(scalar, set = kSetShadow, binding = kBindingGridEntries) readonly buffer GridEntries { GridEntry gridEntries[]; };
layout(scalar, set = kSetShadow, binding = kBindingCasterCells) readonly buffer CasterCells { CasterCell casterCells[]; };
layout(scalar, set = kSetShadow, binding = kBindingCasterParameters) readonly buffer CasterParameters { float casterParameters[]; };
layout(scalar, set = kSetShadow, binding = kBindingShadowDoubts) buffer Doubts { uint ofPixels[]; } doubts;
layout(set = kSetFound, binding = kBindingFound) uniform sampler2D foundTexels;

layout(location = 0) out uint outShadows;

// A CPU device reads a buffer slowly: parameters are read once for a patch, not whenever the formula is.
layout(constant_id = kConstantParameterCount) const uint kParameterCount = 0;
const uint kHeldParameters = 64;
const uint kHeld = kParameterCount < kHeldParameters ? kParameterCount : kHeldParameters;
float heldParameters[kHeld > 0 ? kHeld : 1];
uint heldPatch = 0xffffffffu;

float casterParameterFromBuffer(uint k) { return casterParameters[varyingFirst.z + heldPatch * varyingFirst.w + k]; }

void holdPatch(uint patch_) {
  if (patch_ == heldPatch) return;
  heldPatch = patch_;
  for (uint k = 0; k < kHeld; ++k) heldParameters[k] = casterParameterFromBuffer(k);
}

float casterParameterAt(uint k) { return k < kHeld ? heldParameters[k] : casterParameterFromBuffer(k); }

// The formula: void surfaceAt(float u, float v, out vec3 S, out vec3 Su, out vec3 Sv).
#define parameterAt casterParameterAt
#include "surface"
#undef parameterAt

#include "lib/shadow_ray.glsl"
#include "lib/material_of_texel.glsl"
#include "lib/octahedral.glsl"

const float kGrazing = 0.02;       // the sine of a ray's height over its own surface
const float kGrain = 3e-4;         // pixels: shadows end as near to where they should
const float kBesidePlane = 1e-6;   // of the distances involved: what floats leave of one
const float kMostRounding = 4e-3;  // pixels

void doubtPixel() {
  uint pixel = uint(gl_FragCoord.y) * uint(2.0 * varyingMiddle.x) + uint(gl_FragCoord.x);
  atomicOr(doubts.ofPixels[pixel / kDoubtsPerWord], kShadowOpenHere << kDoubtBits * (pixel % kDoubtsPerWord));
}

bool has(uint flags) { return (varyingCaster.z & flags) != 0; }

// The texel that a point is in; none where the grid has no texel in its direction.
const uint kNone = 0xffffffffu;
uint texelOf(vec3 q, out float ahead) {
  vec3 size = abs(q);
  bool isParallel = has(kParallelLight), isZ = isParallel || (size.z >= size.x && size.z >= size.y),
       isX = !isZ && size.x >= size.y;
  bool isNegative = !isParallel && (isZ ? q.z : isX ? q.x : q.y) < 0.0;
  vec4 face = isZ ? (isNegative ? varyingFaces[5] : varyingFaces[4])
            : isX ? (isNegative ? varyingFaces[1] : varyingFaces[0]) : (isNegative ? varyingFaces[3] : varyingFaces[2]);
  uvec3 firsts = isNegative ? varyingFirstTexels[1] : varyingFirstTexels[0];
  uint first = isZ ? firsts.z : isX ? firsts.x : firsts.y;
  vec2 place = isZ ? q.xy : isX ? q.yz : q.zx;
  ahead = isParallel ? q.z : isZ ? size.z : isX ? size.x : size.y;
  if (!isParallel) place /= ahead;
  vec2 texel = (place - face.xy) * face.zw;
  float count = float(varyingCaster.w);
  // A point beside all texels is in none; floats may put one that is on the border half a texel off.
  if (face.z == 0.0 || !(min(texel.x, texel.y) >= -0.03 && max(texel.x, texel.y) <= count + 0.03)) return kNone;
  uvec2 whole = uvec2(clamp(texel, vec2(0), vec2(count - 1.0)));
  return first + whole.y * varyingCaster.w + whole.x;
}

void findShadow() {
  vec4 texel = texelFetch(foundTexels, ivec2(gl_FragCoord.xy), 0);
  vec2 pixel = gl_FragCoord.xy - varyingMiddle.xy;
  vec3 place = varyingPlace[0] + pixel.x * varyingPlace[1] + pixel.y * varyingPlace[2],
       sight = varyingRay[0] + pixel.x * varyingRay[1] + pixel.y * varyingRay[2];
  vec3 position = place + texel.x * sight, toLight = varyingLightRelative.xyz - varyingLightRelative.w * position;
  float cosine = dot(fromOctahedral(texel.yz), toLight) * inversesqrt(max(dot(toLight, toLight), 1e-37));
  if (has(kGatedLight) && cosine <= 0.0) discard;
  bool isOwn = materialOfTexel(texel) == varyingMaterial;
  if (isOwn && (has(kFlatCaster) || (has(kConvexCaster) && cosine > 0.0))) discard;
  if (has(kFlatCaster) && dot(varyingPlane, vec4(position, 1)) > kBesidePlane * (length(position) + abs(varyingPlane.w))) discard;

  // Beyond its margin the grid may not list what is in the way.
  float rounding = varyingRounding.x + varyingRounding.y * length(position);
  if (rounding > varyingRounding.z) {
    doubtPixel();
    discard;
  }
  vec4 p = vec4(position, 1);
  float ahead;
  uint number = texelOf(vec3(dot(varyingGrid[0], p), dot(varyingGrid[1], p), dot(varyingGrid[2], p)), ahead);
  if (number == kNone) discard;
  uint entry = gridStarts[number], end = gridStarts[number + 1];
  if (entry == end) discard;

  vec3 from = vec3(dot(varyingObject[0], p), dot(varyingObject[1], p), dot(varyingObject[2], p));
  vec3 way = varyingLightObject.xyz - varyingLightObject.w * from;
  float distance_ = length(way), width = varyingRounding.w * (varyingMiddle.z != 0.0 ? texel.x + varyingMiddle.w : 1.0);
  // A point is off its surface by what rounding and the search for it leave.
  LightRay ray = lightRay(from, way / max(distance_, 1e-37), varyingLightObject.w != 0.0 ? distance_ : 1e30, rounding,
                          rounding + varyingOff * width);
  int result = kPassed;
  float behind = ahead * (1.0 + 1e-5) + 1e-30;
  for (; entry < end && result == kPassed; ++entry) {
    GridEntry listed = gridEntries[varyingFirst.x + entry];
    if (listed.nearest > behind) break;
    // What is off at the caster is off by more behind it, as the light spreads.
    float narrowed = width * (has(kParallelLight) ? 1.0 : clamp(listed.nearest / ahead, 0.0, 1.0));
    if (rounding > kMostRounding * narrowed) {
      result = kOpen;
      break;
    }
    ray.grain = max(kGrain * narrowed, 4.0 * rounding);
    CasterCell cell = casterCells[varyingFirst.y + listed.cell];
    holdPatch(cell.patch_);
    result = meetsCell(ray, cell);
  }
  // One is the point's own, if it is a point of the caster. None is left where the ray grazes it and floats part them: then
  // they may part others, too.
  bool isSettled = ownMeetings == (isOwn ? 1 : 0) ||
                   (isOwn && ownMeetings == 0 && !has(kWholeCaster) && abs(cosine) > kGrazing);
  bool mayHaveTwo = isOwn && besideMeetings > 0 && abs(cosine) <= kGrazing;
  if (result == kPassed && (!isSettled || mayHaveTwo)) result = kOpen;
  if (result == kOpen) doubtPixel();
  if (result != kMet) discard;
  outShadows = 1u << varyingCaster.y;
}
