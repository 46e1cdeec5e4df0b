// SPDX-License-Identifier: Apache-2.0
// Whether casters that are known as equations keep their light from the points of a pixel that are seen through.
#extension GL_GOOGLE_include_directive : require
#include "lib/closed_test.glsl"
#include "lib/layer_start.glsl"
#include "lib/rounds.glsl"

const int kRoundsOfCaster = kClosedKind == kClosedTorus ? 1 + kMaxRootSteps : 1;

void findLayerShadows() {
  vec3 place = pixelPlace(), ray = pixelRay();
  for (uint index = layerHeads[layerPixel()]; index != 0; index = layerPoints[index].next) {
    if (isOutOfRounds(1 + int(kClosedCasters) * kRoundsOfCaster)) {
      doubtLayers();
      return;
    }
    LayerPoint point = layerPoints[index];
    if ((point.material & kLayerByRay) != 0) continue;
    bool isOpen;
    LayerStart start = startOf(point, place, ray);
    uint shadows = closedShadowsAt(start.position, start.normal, litAt(start.drawn, start.drawnNormal), point.depth,
                                   point.material & kLayerMaterial, isOpen);
    if (isOpen) doubtLayers();
    if (shadows != 0) layerReaches[index].shadows |= shadows;
  }
}
