// SPDX-License-Identifier: Apache-2.0
// How much of a light reaches a point as its depth map tells: L. Williams, "Casting curved shadows on curved surfaces", 1978;
// the mean of comparisons by W. Reeves, D. Salesin, R. Cook, "Rendering antialiased shadows with depth maps", 1987; planes of
// receivers after J. Isidoro, "Shadow mapping: GPU-based tips and techniques", 2006; penumbrae by R. Fernando,
// "Percentage-closer soft shadows", 2005. None of it is exact.
#include "shared/scene_data.h"

layout(scalar, set = kSetShadow, binding = kBindingLightMaps) readonly buffer LightMaps { LightMap lightMaps[]; };
layout(set = kSetShadow, binding = kBindingLightDepths) uniform sampler2D lightDepths;
layout(scalar, push_constant) uniform Draw { LightMapDraw draw; };

const float kSteepest = 1e3;        // the tangent of N and L: beyond that slopes are no steeper
const float kGoldenAngle = 2.39996323;
const uint kSearchTaps = 24, kPenumbraTaps = 48;
const float kWidestPenumbra = 64.0; // texels, half

struct Receiver {
  vec3 position, normal, toLight;
  uint face;
  vec2 texel;      // of its face
  float depth;     // metres along the axis, less the bias
  float width;     // of a texel there, metres
};

bool isPoint(LightMap map) { return map.light.w != 0.0; }

vec3 inFace(LightMapFace face, vec3 position) {
  vec3 from = position - face.origin;
  return vec3(dot(face.right, from), dot(face.down, from), dot(face.forward, from));
}

vec2 texelOfFace(LightMap map, vec3 p) {
  return 0.5 * float(map.size) + p.xy / (map.texel * (isPoint(map) ? p.z : 1.0));
}

// Its depth as the plane of the surface has it where the light sees the middle of a texel.
float depthInPlane(LightMap map, Receiver receiver, vec2 texel) {
  LightMapFace face = map.faces[receiver.face];
  vec2 aside = (texel - 0.5 * float(map.size)) * map.texel;
  vec3 across = aside.x * face.right + aside.y * face.down;
  vec3 start = isPoint(map) ? face.origin : face.origin + across, way = isPoint(map) ? face.forward + across : face.forward;
  float slope = dot(receiver.normal, way);
  return abs(slope) * kSteepest > length(way) ? dot(receiver.normal, receiver.position - start) / slope : receiver.depth;
}

// Metres; what has no texel there is infinitely far.
float storedDepth(LightMap map, Receiver receiver, vec2 texel) {
  ivec2 place = ivec2(floor(texel));
  int size = int(map.size);
  if (min(place.x, place.y) < 0 || max(place.x, place.y) >= size) return 3e38;
  place += size * ivec2(receiver.face % kLightMapFacesInRow, receiver.face / kLightMapFacesInRow);
  float x = texelFetch(lightDepths, place, 0).x;
  if (x == 0.0) return 3e38;
  return isPoint(map) ? map.depthOfBuffer.x / x : map.depthOfBuffer.x + map.depthOfBuffer.y * x;
}

bool isLit(LightMap map, Receiver receiver, vec2 texel) {
  vec2 middle = floor(texel) + 0.5;
  float bias = receiver.depth - inFace(map.faces[receiver.face], receiver.position).z;
  float depth = map.receiverPlane != 0 ? depthInPlane(map, receiver, middle) + bias : receiver.depth;
  return depth <= storedDepth(map, receiver, middle);
}

// H. Vogel, "A better way to construct the sunflower head", 1979: in the unit disc.
vec2 sunflower(uint i, uint count) {
  float angle = float(i) * kGoldenAngle;
  return sqrt((float(i) + 0.5) / float(count)) * vec2(cos(angle), sin(angle));
}

float litInPenumbra(LightMap map, Receiver receiver) {
  float depth = receiver.depth;
  float search = min((isPoint(map) ? map.radius : tan(map.radius) * depth) / receiver.width, kWidestPenumbra);
  float blockers = 0.0, sum = 0.0;
  for (uint i = 0; i < kSearchTaps; ++i) {
    vec2 texel = receiver.texel + search * sunflower(i, kSearchTaps);
    if (isLit(map, receiver, texel)) continue;
    sum += storedDepth(map, receiver, texel);
    blockers += 1.0;
  }
  if (blockers == 0.0) return 1.0;
  float blocker = sum / blockers, behind = max(depth - blocker, 0.0);
  float penumbra = isPoint(map) ? map.radius * behind / max(blocker, 1e-30) : tan(map.radius) * behind;
  float half_ = clamp(penumbra / receiver.width, 0.5, kWidestPenumbra);
  float lit = 0.0;
  for (uint i = 0; i < kPenumbraTaps; ++i)
    lit += isLit(map, receiver, receiver.texel + half_ * sunflower(i, kPenumbraTaps)) ? 1.0 : 0.0;
  return lit / float(kPenumbraTaps);
}

// A part of 1. `normal`: of the side that is shown, unit.
float litByMap(vec3 position, vec3 normal) {
  LightMap map = lightMaps[draw.map];
  Receiver receiver;
  receiver.toLight = map.light.xyz - map.light.w * position;
  receiver.toLight *= inversesqrt(max(dot(receiver.toLight, receiver.toLight), 1e-37));
  receiver.normal = normal;
  float cosine = dot(normal, receiver.toLight), sine = sqrt(max(1.0 - cosine * cosine, 0.0));
  receiver.face = 0;
  vec3 p = inFace(map.faces[0], position);
  for (uint i = 1; i < map.faceCount; ++i) {
    vec3 other = inFace(map.faces[i], position);
    if (other.z <= p.z) continue;
    receiver.face = i;
    p = other;
  }
  if (isPoint(map) && p.z <= 0.0) return 1.0;
  receiver.width = map.texel * (isPoint(map) ? p.z : 1.0);
  receiver.position = position + map.normalOffset * receiver.width * sine * (cosine < 0.0 ? -normal : normal);
  p = inFace(map.faces[receiver.face], receiver.position);
  receiver.texel = texelOfFace(map, p);
  receiver.depth = p.z - map.bias - map.slopeBias * receiver.width * min(sine / max(abs(cosine), 1e-30), kSteepest);
  if (map.radius > 0.0) return litInPenumbra(map, receiver);
  float lit = 0.0;
  int half_ = int(map.pcf) / 2;
  for (int y = -half_; y <= half_; ++y)
    for (int x = -half_; x <= half_; ++x) lit += isLit(map, receiver, receiver.texel + vec2(x, y)) ? 1.0 : 0.0;
  return lit / float(map.pcf * map.pcf);
}
