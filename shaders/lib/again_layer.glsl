// SPDX-License-Identifier: Apache-2.0
// Points that are seen through, in the list of their pixel.
#include "lib/again.glsl"
#include "lib/cutoff.glsl"
#include "lib/layers.glsl"
#include "lib/number.glsl"
#include "lib/octahedral.glsl"

layout(constant_id = kConstantManyGroups) const bool kManyGroups = false;

// Of two draws of the same point, for some lights each; and whether there is another one for the same group of lights.
vec3 together(vec3 light, vec3 more);
bool isLastOfGroup();

uint ownPoint;

// Every fragment has put down one. A mesh of many vertices is several draws, each with triangles of the same numbers: of
// these the depths differ.
bool findPoint(uint material) {
  float depth = layerDepth(gl_FragCoord.z, pixelPlace(), pixelRay()), nearest = 3e38;
  ownPoint = 0;
  for (uint index = layerHeads[layerPixel()]; index != 0; index = layerPoints[index].next) {
    if ((layerPoints[index].material & (kLayerMaterial | kLayerOfMesh)) != (material | kLayerOfMesh)) continue;
    float off = abs(layerPoints[index].depth - depth);
    if (layerPoints[index].triangle != uint(gl_PrimitiveID) || off >= nearest) continue;
    nearest = off;
    ownPoint = index;
  }
  if (ownPoint == 0) return false;
  LayerPoint found = layerPoints[ownPoint];
  point = DrawnPoint(pixelPlace() + found.depth * pixelRay(), fromOctahedral(found.normal),
                     layerReaches[ownPoint].shadows, layerReaches[ownPoint].transmittance);
  return true;
}

void lightPoint(vec3 light, vec4 paint) {
  paint.a = cutOut(paint.a, materials[layerPoints[ownPoint].material & kLayerMaterial].leastOpaque);
  vec3 reflected_ = isColor(light) ? paint.a * light : light;  // what a shader tells instead of a colour stays
  layerPoints[ownPoint].light = kAddsLight ? together(layerPoints[ownPoint].light, reflected_) : reflected_;
  layerPoints[ownPoint].through = throughLayer(materials[layerPoints[ownPoint].material & kLayerMaterial].blend, paint.a, paint.rgb);
  // The next group's are in the same place.
  if (kManyGroups && isLastOfGroup()) layerReaches[ownPoint] = kAllReaches;
}
