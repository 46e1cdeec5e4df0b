// SPDX-License-Identifier: Apache-2.0
// Whether a caster keeps its light from the points of a pixel that are seen through.
#extension GL_GOOGLE_include_directive : require
#include "lib/opaque_caster.glsl"
#include "lib/layers.glsl"
#include "lib/octahedral.glsl"

void findLayerShadows() {
  vec3 place = pixelPlace(), ray = pixelRay();
  for (uint index = layerHeads[layerPixel()]; index != 0; index = layerPoints[index].next) {
    LayerPoint point = layerPoints[index];
    if ((point.material & kLayerByRay) != 0) continue;
    vec3 position = place + point.depth * ray, normal = fromOctahedral(point.normal);
    if (facesAway(position, normal)) continue;
    int result = shadowAt(position, normal, point.depth, (point.material & kLayerMaterial) == varyingMaterial.x);
    if (result == kOpen) doubtLayers();
    if (result == kMet) layerPoints[index].shadows |= 1u << varyingCaster.y;
  }
}
