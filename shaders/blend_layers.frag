// SPDX-License-Identifier: Apache-2.0
// All that is seen through in a pixel, over what is not: nearest first, whatever the order in which it was found; or, in the
// given order of nodes, the last one first, and of each its points, nearest first.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/layers.glsl"
#include "lib/number.glsl"
#include "lib/one_point.glsl"
#include "lib/octahedral.glsl"

layout(constant_id = kConstantGivenOrder) const bool kGivenOrder = false;

// For the audit: of each pixel how many points were blended, and the sum of their depths.
layout(scalar, set = kSetLayers, binding = kBindingLayerSums) buffer LayerSums { vec2 layerSums[]; };

layout(location = 0, index = 0) out vec4 outLight;
layout(location = 0, index = 1) out vec4 outThrough;

bool isLess(vec3 a, vec3 b) { return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z; }

// A total order of what looks different, whatever the order of the nodes.
bool isBefore(uint first, uint second) {
  uint ofA = layerPoints[first].material & kLayerMaterial, ofB = layerPoints[second].material & kLayerMaterial;
  if (kGivenOrder && ofA != ofB) return ofA > ofB;
  float a = layerPoints[first].depth, b = layerPoints[second].depth;
  if (a != b) return a < b;
  vec3 lightA = layerPoints[first].light, lightB = layerPoints[second].light;
  return lightA != lightB ? isLess(lightA, lightB) : isLess(layerPoints[first].through, layerPoints[second].through);
}

// Runs of 1, 2, 4, ... points are merged, in the list's own links.
uint sorted(uint head) {
  for (uint run = 1;; run *= 2) {
    uint left = head, tail = 0, merges = 0;
    head = 0;
    while (left != 0) {
      ++merges;
      uint right = left, ofLeft = 0, ofRight = run;
      for (; ofLeft < run && right != 0; ++ofLeft) right = layerPoints[right].next;
      while (ofLeft > 0 || (ofRight > 0 && right != 0)) {
        bool takesLeft = ofLeft > 0 && (ofRight == 0 || right == 0 || !isBefore(right, left));
        uint taken = takesLeft ? left : right;
        if (takesLeft) {
          left = layerPoints[left].next;
          --ofLeft;
        } else {
          right = layerPoints[right].next;
          --ofRight;
        }
        if (tail != 0)
          layerPoints[tail].next = taken;
        else
          head = taken;
        tail = taken;
      }
      left = right;
    }
    if (tail != 0) layerPoints[tail].next = 0;
    if (merges <= 1) return head;
  }
}

void main() {
  // To fill squares of four devices run fragments beside the picture, too: there lists are others', which these sort meanwhile.
  if (any(greaterThanEqual(ivec2(gl_FragCoord.xy), textureSize(opaqueDepth, 0)))) return;
  uint head = layerHeads[layerPixel()];
  layerSums[layerPixel()] = vec2(0);
  if (head == 0) discard;
  head = sorted(head);
  layerHeads[layerPixel()] = head;
  float opaque = layerDepth(texelFetch(opaqueDepth, ivec2(gl_FragCoord.xy), 0).x, pixelPlace(), pixelRay());
  vec3 light = vec3(0), through = vec3(1);
  vec2 sums = vec2(0);
  LayerPoint last;
  last.depth = -3e38;  // there is none
  last.off = 0.0;
  last.material = 0;
  for (uint index = head; index != 0; index = layerPoints[index].next) {
    LayerPoint point = layerPoints[index];
    if ((point.material & kLayerOfMesh) != 0 && point.depth >= opaque) continue;
    // On a border between two cells both may have it, or one that is certain of it and the other, too.
    uint either = point.material | last.material, other = (point.material ^ last.material) & ~kLayerAtBorder;
    bool isBeside = point.depth - last.depth <= point.off + last.off && !(kGivenOrder && (other & kLayerMaterial) != 0),
         isTwice = isBeside && other == 0 && (either & kLayerAtBorder) != 0;
    // Which of two points is nearer than floats tell is left to rays, and how often a surface covers itself.
    if (isBeside && !isTwice && (either & (kLayerOfMesh | kLayerByRay)) == 0) doubtLayers();
    if (isTwice && !isOnePoint(point.parameters, fromOctahedral(point.normal), last.parameters, fromOctahedral(last.normal)))
      doubtLayers();
    last = point;
    if (isTwice) continue;
    sums += vec2(1, point.depth);
    if (isColor(point.light)) {
      light += through * point.light;
      through *= point.through;
    } else if (through != vec3(0)) {  // what a shader tells instead of a colour stays as it is
      light = point.light;
      through = vec3(0);
    }
  }
  layerSums[layerPixel()] = sums;
  outLight = vec4(light, 0);
  outThrough = vec4(through, 1);
}
