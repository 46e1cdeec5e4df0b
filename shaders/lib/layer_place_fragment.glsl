// SPDX-License-Identifier: Apache-2.0
// The points that a pixel shows of a mesh that is seen through, on the mesh's surface, from where their light rays start.
#extension GL_GOOGLE_include_directive : require
#include "lib/surface_place.glsl"
#include "lib/layers.glsl"
#include "lib/rounds.glsl"

void findPlaces() {
  vec3 place = pixelPlace(), ray = pixelRay();
  for (uint index = layerHeads[layerPixel()]; index != 0; index = layerPoints[index].next) {
    if (isOutOfRounds(1 + 2 * int(varyingNode.x))) {
      doubtLayers();
      return;
    }
    LayerPoint point = layerPoints[index];
    if ((point.material & (kLayerMaterial | kLayerOfMesh)) != (varyingNode.y | kLayerOfMesh)) continue;
    SurfacePlace found = surfacePlace(point.parameters, place + point.depth * ray, fromOctahedral(point.normal));
    if (!found.exists) {
      doubtLayers();
      continue;
    }
    layerPoints[index].place = found.position;
    layerPoints[index].placeNormal = packedOctahedral(octahedral(found.normal));
    layerPoints[index].material = point.material | kLayerPlaced;
  }
}
