// SPDX-License-Identifier: Apache-2.0
// Whether a caster keeps its light from the points of a pixel that are seen through.
#extension GL_GOOGLE_include_directive : require
#include "lib/opaque_caster.glsl"
#include "lib/layer_start.glsl"

void findLayerShadows() {
  vec3 place = pixelPlace(), ray = pixelRay();
  for (uint index = layerHeads[layerPixel()]; index != 0; index = layerPoints[index].next) {
    if (isOutOfRounds(1)) {
      doubtLayers();
      return;
    }
    LayerPoint point = layerPoints[index];
    if ((point.material & kLayerByRay) != 0) continue;
    LayerStart start = startOf(point, place, ray);
    if (facesAway(start.drawn, start.drawnNormal)) continue;
    int result = shadowAt(start.position, start.normal, point.depth, (point.material & kLayerMaterial) == varyingMaterial.x);
    if (result == kOpen) doubtLayers();
    if (result == kMet) layerReaches[index].shadows |= 1u << varyingCaster.y;
  }
}
