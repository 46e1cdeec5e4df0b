// SPDX-License-Identifier: Apache-2.0
// Whether casters that are known as equations keep their light from the points of a pixel that are seen through.
#extension GL_GOOGLE_include_directive : require
#include "lib/closed_test.glsl"
#include "lib/layers.glsl"
#include "lib/octahedral.glsl"

void findLayerShadows() {
  vec3 place = pixelPlace(), ray = pixelRay();
  for (uint index = layerHeads[layerPixel()]; index != 0; index = layerPoints[index].next) {
    LayerPoint point = layerPoints[index];
    if ((point.material & kLayerByRay) != 0) continue;
    bool isOpen;
    vec3 position = place + point.depth * ray, normal = fromOctahedral(point.normal);
    uint shadows = closedShadowsAt(position, normal, litAt(position, normal), point.depth, point.material & kLayerMaterial,
                                   isOpen);
    if (isOpen) doubtLayers();
    if (shadows != 0) layerPoints[index].shadows |= shadows;
  }
}
