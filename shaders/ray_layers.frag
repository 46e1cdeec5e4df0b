// SPDX-License-Identifier: Apache-2.0
// What rays have found in a pixel replaces all that they find again; points of other triangles stay, lit as rays tell. Later,
// for other groups of lights, their shadows there.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/layers.glsl"

layout(scalar, set = kSetLayers, binding = kBindingRayLayers) readonly buffer RayLayers { LayerPoint rayLayers[]; };

layout(scalar, set = kSetLayers, binding = kBindingRayLayerLight) readonly buffer ReachingLights { ReachingLight reachingLights[]; };

layout(scalar, set = kSetLayers, binding = kBindingRayLayerDetails) readonly buffer RayLayerDetails {
  LayerDetail rayLayerDetails[];
};

layout(location = kLocationLayerRange) flat in uvec4 inRange;
layout(location = kLocationLayerGroup) flat in uint inGroup;

ReachingLight lightOf(uint rayLayer) { return reachingLights[rayLayer * (inRange.w & ~kUndecidedLayers) + inGroup]; }

void setLight(uint index, uint rayLayer) {
  layerReaches[index] = lightOf(rayLayer);
}

// A point of a mesh stays where it is. Rays know what reaches it by what it shows, however often it is drawn.
void lightMeshPoint(uint index) {
  LayerPoint point = layerPoints[index];
  uint first = inRange.x + inRange.y;
  for (uint i = first; i < first + inRange.z; ++i) {
    if (((rayLayers[i].material ^ point.material) & kLayerMaterial) != 0 || rayLayers[i].depth != point.depth ||
        rayLayers[i].parameters != point.parameters)
      continue;
    layerPoints[index].material = point.material | kLayerByRay;
    setLight(index, i);
    return;
  }
}

// The last of them is the first in the list.
void setLights() {
  uint last = inRange.x + inRange.y - 1;
  for (uint index = layerHeads[layerPixel()]; index != 0; index = layerPoints[index].next) {
    if (isBesideRays(layerPoints[index].material))
      lightMeshPoint(index);
    else
      setLight(index, last--);
  }
}

void main() {
  if (inGroup > 0) {
    setLights();
    countEndedLoops();
    return;
  }
  if ((inRange.w & kUndecidedLayers) != 0)
    atomicOr(layerDoubts[layerPixel() / kDoubtsPerWord], kLayersUndecidedHere << doubtShift());
  uint head = 0;
  for (uint index = layerHeads[layerPixel()]; index != 0;) {
    uint next = layerPoints[index].next;
    if (isBesideRays(layerPoints[index].material)) {
      lightMeshPoint(index);
      layerPoints[index].next = head;
      head = index;
    }
    index = next;
  }
  layerHeads[layerPixel()] = head;
  for (uint i = inRange.x; i < inRange.x + inRange.y; ++i) {
    uint index = kLayerDetails ? addLayer(rayLayers[i], rayLayerDetails[i]) : addLayer(rayLayers[i]);
    if (index != 0) setLight(index, i);
  }
  countEndedLoops();
}
