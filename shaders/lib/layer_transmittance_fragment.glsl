// SPDX-License-Identifier: Apache-2.0
// How much of its light a caster lets through to the points of a pixel that are seen through.
#extension GL_GOOGLE_include_directive : require
#include "lib/transmittance_test.glsl"
#include "lib/layer_start.glsl"

void findLayerTransmittances() {
  vec3 place = pixelPlace(), ray = pixelRay();
  for (uint index = layerHeads[layerPixel()]; index != 0; index = layerPoints[index].next) {
    if (isOutOfRounds(1)) {
      doubtLayers();
      return;
    }
    LayerPoint point = layerPoints[index];
    vec3 before = layerReaches[index].transmittance;
    // Of no light nothing more is left, whatever lets it through.
    if ((point.material & kLayerByRay) != 0 || before == vec3(0)) continue;
    LayerStart start = startOf(point, place, ray);
    if (facesAway(start.drawn, start.drawnNormal)) continue;
    vec3 transmittance = transmittanceAt(start.position, start.normal, point.depth,
                                         (point.material & kLayerMaterial) == varyingMaterial.x);
    if (isOpen) doubtLayers();
    layerReaches[index].transmittance = before * transmittance;
  }
}
