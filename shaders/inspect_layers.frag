// SPDX-License-Identifier: Apache-2.0
// Geometry instead of light of what is seen through: of the nearest point that is in no hole; its light is its opacity then.
// The certificate is that of the worst point, whatever its opacity; where all are certain, of what is behind them, if there is
// something.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/inspection.glsl"
#include "lib/layer_order.glsl"

layout(location = 0) out vec4 outValue;

uint certificateOf(uint material) {
  if ((material & (kLayerOfMesh | kLayerOfSurface)) == kLayerOfMesh) return kUncertified;
  return (material & kLayerByRay) != 0 ? kByRay : kBySearch;
}

// Whether the list is not all that is there, or not proven to be.
bool isListOpen() {
  bool isUndecided = (layerDoubts[layerPixel() / kDoubtsPerWord] >> doubtShift() & kLayersUndecidedHere) != 0;
  return isUndecided || loopsWereEnded() || layerCount.points >= layerPoints.length();
}

// Pixels: what is left of the way along the ray is more than that across it.
float residualOf(LayerPoint point) {
  return point.off / max(length(view.placeDown + point.depth * view.rayDown), 1e-37);
}

void main() {
  if (!isInPicture()) return;
  LayerPoint nearest;
  uint worst = 0;
  for (uint index = firstLayer(); index != 0; index = layerPoints[index].next) {
    LayerPoint point = layerPoints[index];
    if (!isAnother(point) || (kQuantity != kCertificate && !(point.light.x >= kLeastShown))) continue;
    if (worst == 0) nearest = point;
    worst = max(worst, certificateOf(point.material));
  }
  endLayers();
  if (kQuantity == kCertificate) {
    if (isListOpen()) worst = kUncertified;
    if (worst == 0 || (worst != kUncertified && opaqueLayer < kNothingOpaque)) discard;
    outValue = vec4(worst, worst, worst, 1);
    return;
  }
  if (worst == 0) discard;
  vec3 position = pixelPlace() + nearest.depth * pixelRay();
  uint id = materials[nearest.material & kLayerMaterial].blend >> kIdShift;
  Inspected inspected = Inspected(position, fromOctahedral(nearest.normal), nearest.parameters,
                                  nearest.depth + view.forward.w, id, residualOf(nearest), worst);
  outValue = vec4(inspectedValue(inspected, kQuantity, false, vec4(0, 0, 1, 1)), 1);
}
