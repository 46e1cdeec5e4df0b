// SPDX-License-Identifier: Apache-2.0
// Triangles that are seen through and whose light is known in the fragment: light between vertices, drawings.
#include "lib/layers.glsl"

void addLitLayer(uint material, vec3 color, float opacity, vec3 diffuse) {
  addLayer(LayerPoint(0, layerDepth(gl_FragCoord.z, layerPlace(), layerRay()), 0.0, material | kLayerOfMesh | kLayerLit, 0,
                      vec2(0), vec2(0), opacity * color, throughLayer(materials[material].blend, opacity, diffuse)));
}
