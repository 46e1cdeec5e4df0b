// SPDX-License-Identifier: Apache-2.0
// What rays have found in a pixel replaces all that they find again; points of other triangles stay. Later, for other groups of
// lights, their shadows there.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/layers.glsl"

layout(scalar, set = kSetLayers, binding = kBindingRayLayers) readonly buffer RayLayers { LayerPoint rayLayers[]; };

layout(scalar, set = kSetLayers, binding = kBindingRayLayerLight) readonly buffer ReachingLights { ReachingLight reachingLights[]; };

layout(scalar, set = kSetLayers, binding = kBindingRayLayerDetails) readonly buffer RayLayerDetails {
  LayerDetail rayLayerDetails[];
};

layout(location = 0) flat in uvec4 inRange;

// The last of them is the first in the list. Of every point there is one for each group.
void setLight() {
  uint last = inRange.x + inRange.y - 1;
  for (uint index = layerHeads[layerPixel()]; index != 0; index = layerPoints[index].next) {
    if ((layerPoints[index].material & kLayerByRay) == 0) continue;
    ReachingLight light = reachingLights[last-- * inRange.z + inRange.w];
    layerPoints[index].shadows = light.shadows;
    layerPoints[index].transmittance = light.transmittance;
  }
}

void main() {
  if (inRange.w > 0) {
    setLight();
    return;
  }
  uint head = 0;
  for (uint index = layerHeads[layerPixel()]; index != 0;) {
    uint next = layerPoints[index].next;
    if (isBesideRays(layerPoints[index].material)) {
      layerPoints[index].next = head;
      head = index;
    }
    index = next;
  }
  layerHeads[layerPixel()] = head;
  for (uint i = inRange.x; i < inRange.x + inRange.y; ++i)
    if (kLayerDetails)
      addLayer(rayLayers[i], rayLayerDetails[i]);
    else
      addLayer(rayLayers[i]);
}
