// SPDX-License-Identifier: Apache-2.0
// The points of a pixel that are seen through, nearest first, each once; or, in the given order of nodes, the last one first,
// and of each its points, nearest first.
#include "lib/layers.glsl"
#include "lib/octahedral.glsl"
#include "lib/one_point.glsl"
#include "lib/quantity.glsl"

layout(constant_id = kConstantGivenOrder) const bool kGivenOrder = false;

bool isLess(vec3 a, vec3 b) { return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z; }

// What points are mostly sorted by. A CPU device reads a buffer slowly: it is read once for each step of a merge.
struct LayerKey {
  uint index, next, node;
  float depth;
};

LayerKey keyOf(uint index) {
  return LayerKey(index, layerPoints[index].next, kGivenOrder ? layerPoints[index].material & kLayerMaterial : 0,
                  layerPoints[index].depth);
}

// A total order. Of points that look different it does not depend on that of the nodes.
bool isBefore(LayerKey a, LayerKey b) {
  if (a.node != b.node) return a.node > b.node;
  if (a.depth != b.depth) return a.depth < b.depth;
  if (kQuantity != kCertificate) {  // for that they are not lit
    vec3 lightA = layerPoints[a.index].light, lightB = layerPoints[b.index].light;
    if (lightA != lightB) return isLess(lightA, lightB);
    vec3 throughA = layerPoints[a.index].through, throughB = layerPoints[b.index].through;
    if (throughA != throughB) return isLess(throughA, throughB);
  }
  return (layerPoints[a.index].material & kLayerMaterial) < (layerPoints[b.index].material & kLayerMaterial);
}

// Runs of 1, 2, 4, ... points are merged, in the list's own links.
uint sorted(uint head) {
  for (uint run = 1;; run *= 2) {
    LayerKey left = keyOf(head);
    uint tail = 0, merges = 0;
    while (left.index != 0) {
      ++merges;
      uint atRight = left.index, ofLeft = 0, ofRight = run;
      for (; ofLeft < run && atRight != 0; ++ofLeft) atRight = layerPoints[atRight].next;
      LayerKey right = keyOf(atRight);
      while (ofLeft > 0 || (ofRight > 0 && right.index != 0)) {
        bool takesLeft = ofLeft > 0 && (ofRight == 0 || right.index == 0 || !isBefore(right, left));
        uint taken = takesLeft ? left.index : right.index;
        LayerKey after = keyOf(takesLeft ? left.next : right.next);
        if (takesLeft) {
          left = after;
          --ofLeft;
        } else {
          right = after;
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

// For the audit: of each pixel how many points there are, and the sum of their depths.
layout(scalar, set = kSetLayers, binding = kBindingLayerSums) buffer LayerSums { vec2 layerSums[]; };

LayerPoint lastLayer;
vec2 sumsHere = vec2(0);
float opaqueLayer;  // the depth of what is not seen through

// To fill squares of four devices run fragments beside the picture, too: there lists are others', which these sort meanwhile.
// They return: one that is discarded may go on.
bool isInPicture() { return all(lessThan(ivec2(gl_FragCoord.xy), textureSize(opaqueDepth, 0))); }

// Begins with the first of the list; 0: there is none. In the picture only.
uint firstLayer() {
  layerSums[layerPixel()] = vec2(0);  // rays may have emptied the list
  uint head = layerHeads[layerPixel()];
  if (head != 0 && layerPoints[head].next != 0) {
    head = sorted(head);
    layerHeads[layerPixel()] = head;
  }
  opaqueLayer = layerDepth(texelFetch(opaqueDepth, ivec2(gl_FragCoord.xy), 0).x, pixelPlace(), pixelRay());
  lastLayer.depth = -3e38;  // there is none
  lastLayer.off = 0.0;
  lastLayer.material = 0;
  return head;
}

// Of one point after the other whether it is in front of what is not seen through, and not the last one once more.
bool isAnother(LayerPoint point) {
  if ((point.material & kLayerOfMesh) != 0 && point.depth >= opaqueLayer) return false;
  // On a border between two cells both may have it, or one that is certain of it and the other, too.
  uint either = point.material | lastLayer.material, other = (point.material ^ lastLayer.material) & ~kLayerAtBorder;
  bool isBeside = point.depth - lastLayer.depth <= point.off + lastLayer.off && !(kGivenOrder && (other & kLayerMaterial) != 0),
       isTwice = isBeside && other == 0 && (either & kLayerAtBorder) != 0;
  // Which of two points is nearer than floats tell is left to rays, and how often a surface covers itself.
  if (isBeside && !isTwice && (either & (kLayerOfMesh | kLayerByRay)) == 0) doubtLayers();
  if (isTwice && !isOnePoint(point.parameters, fromOctahedral(point.normal), lastLayer.parameters, fromOctahedral(lastLayer.normal)))
    doubtLayers();
  lastLayer = point;
  if (!isTwice) sumsHere += vec2(1, point.depth);
  return !isTwice;
}

// After all of them.
void endLayers() {
  layerSums[layerPixel()] = sumsHere;
  countEndedLoops();
}
