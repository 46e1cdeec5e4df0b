// SPDX-License-Identifier: Apache-2.0
// How much of a light reaches a point as its depth map tells: L. Williams, "Casting curved shadows on curved surfaces", 1978;
// the mean of comparisons by W. Reeves, D. Salesin, R. Cook, "Rendering antialiased shadows with depth maps", 1987; planes of
// receivers after J. Isidoro, "Shadow mapping: GPU-based tips and techniques", 2006; penumbrae by R. Fernando,
// "Percentage-closer soft shadows", 2005. None of it is exact.
#include "lib/light_map_interface.glsl"

layout(set = kSetShadow, binding = kBindingLightDepths) uniform sampler2D lightDepths;

const float kSteepest = 1e3;        // the tangent of N and L: beyond that slopes are no steeper
const float kGoldenAngle = 2.39996323;
const uint kSearchTaps = 24, kPenumbraTaps = 48;
const float kWidestPenumbra = 64.0; // texels, half

bool isPoint = varyingLight.w != 0.0;
LightMapFace face = LightMapFace(varyingFace[0], varyingFace[1], varyingFace[2], varyingFace[3]);
ivec2 corner = ivec2(0);  // of the face among them all

struct Receiver {
  vec3 position, normal;
  vec2 texel;   // of its face
  float depth;  // metres along the axis
  float bias;   // less that
  float width;  // of a texel there, metres
};

vec3 inFace(LightMapFace of, vec3 position) {
  vec3 from = position - of.origin;
  return vec3(dot(of.right, from), dot(of.down, from), dot(of.forward, from));
}

// Its depth as the plane of the surface has it where the light sees the middle of a texel.
float depthInPlane(Receiver receiver, vec2 texel) {
  vec2 aside = (texel - varyingTexel.y) * varyingTexel.x;
  vec3 across = aside.x * face.right + aside.y * face.down;
  vec3 start = isPoint ? face.origin : face.origin + across, way = isPoint ? face.forward + across : face.forward;
  float slope = dot(receiver.normal, way);
  return abs(slope) * kSteepest > length(way) ? dot(receiver.normal, receiver.position - start) / slope : receiver.depth;
}

// Metres; what has no texel there is infinitely far.
float storedDepth(ivec2 texel) {
  int size = int(2.0 * varyingTexel.y);
  if (min(texel.x, texel.y) < 0 || max(texel.x, texel.y) >= size) return 3e38;
  float x = texelFetch(lightDepths, corner + texel, 0).x;
  return x == 0.0 ? 3e38 : isPoint ? varyingTexel.z / x : varyingTexel.z + varyingTexel.w * x;
}

bool isLit(Receiver receiver, vec2 at) {
  vec2 texel = floor(at);
  float depth = varyingMap.z != 0 ? depthInPlane(receiver, texel + 0.5) : receiver.depth;
  return depth - receiver.bias <= storedDepth(ivec2(texel));
}

// H. Vogel, "A better way to construct the sunflower head", 1979: in the unit disc.
vec2 sunflower(uint i, uint count) {
  float angle = float(i) * kGoldenAngle;
  return sqrt((float(i) + 0.5) / float(count)) * vec2(cos(angle), sin(angle));
}

float litInPenumbra(Receiver receiver) {
  float radius = varyingBias.w, depth = receiver.depth;
  float search = min((isPoint ? radius : tan(radius) * depth) / receiver.width, kWidestPenumbra);
  float blockers = 0.0, sum = 0.0;
  for (uint i = 0; i < kSearchTaps; ++i) {
    vec2 texel = receiver.texel + search * sunflower(i, kSearchTaps);
    if (isLit(receiver, texel)) continue;
    sum += storedDepth(ivec2(floor(texel)));
    blockers += 1.0;
  }
  if (blockers == 0.0) return 1.0;
  float blocker = sum / blockers, behind = max(depth - blocker, 0.0);
  float penumbra = isPoint ? radius * behind / max(blocker, 1e-30) : tan(radius) * behind;
  float half_ = clamp(penumbra / receiver.width, 0.5, kWidestPenumbra);
  float lit = 0.0;
  for (uint i = 0; i < kPenumbraTaps; ++i)
    lit += isLit(receiver, receiver.texel + half_ * sunflower(i, kPenumbraTaps)) ? 1.0 : 0.0;
  return lit / float(kPenumbraTaps);
}

// A part of 1. `normal`: of the side that is shown, unit.
float litByMap(vec3 position, vec3 normal) {
  vec3 toLight = varyingLight.xyz - varyingLight.w * position;
  toLight *= inversesqrt(max(dot(toLight, toLight), 1e-37));
  float cosine = dot(normal, toLight), sine = sqrt(max(1.0 - cosine * cosine, 0.0));
  vec3 p = inFace(face, position);
  for (uint i = 1; i < varyingMap.x; ++i) {
    LightMapFace other = lightMaps[varyingMap.w].faces[i];
    vec3 inOther = inFace(other, position);
    if (inOther.z <= p.z) continue;
    face = other;
    corner = int(2.0 * varyingTexel.y) * ivec2(i % kLightMapFacesInRow, i / kLightMapFacesInRow);
    p = inOther;
  }
  if (isPoint && p.z <= 0.0) return 1.0;
  Receiver receiver;
  receiver.width = varyingTexel.x * (isPoint ? p.z : 1.0);
  receiver.position = position + varyingBias.z * receiver.width * sine * (cosine < 0.0 ? -normal : normal);
  receiver.normal = normal;
  p = inFace(face, receiver.position);
  receiver.texel = varyingTexel.y + p.xy / (varyingTexel.x * (isPoint ? p.z : 1.0));
  receiver.depth = p.z;
  receiver.bias = varyingBias.x + varyingBias.y * receiver.width * min(sine / max(abs(cosine), 1e-30), kSteepest);
  if (varyingBias.w > 0.0) return litInPenumbra(receiver);
  float lit = 0.0;
  int half_ = int(varyingMap.y) / 2;
  for (int y = -half_; y <= half_; ++y)
    for (int x = -half_; x <= half_; ++x) lit += isLit(receiver, receiver.texel + vec2(x, y)) ? 1.0 : 0.0;
  return lit / float(varyingMap.y * varyingMap.y);
}
