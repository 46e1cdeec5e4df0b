// SPDX-License-Identifier: Apache-2.0
// Triangles that are seen through and whose light is known in the fragment: light between vertices, drawings.
#include "lib/layers.glsl"

void addLitLayer(uint material, vec3 color, float opacity, vec3 diffuse) {
  LayerPoint point = unlitPoint(layerDepth(gl_FragCoord.z, pixelPlace(), pixelRay()), 0.0,
                                material | kLayerOfMesh | kLayerLit, vec2(0), vec2(0));
  point.light = opacity * color;
  point.through = throughLayer(materials[material].blend, opacity, diffuse);
  addLayer(point);
}
