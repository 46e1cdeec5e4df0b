// SPDX-License-Identifier: Apache-2.0
// Where light rays of what is seen through start: at its points, but of a mesh at those of its surface
// (lib/layer_place_fragment.glsl).
#include "lib/layers.glsl"
#include "lib/octahedral.glsl"

struct LayerStart {
  vec3 position, normal;
  vec3 drawn, drawnNormal;  // where and on what light falls: of a mesh its own
};

// `place`, `ray`: of the pixel.
LayerStart startOf(LayerPoint point, vec3 place, vec3 ray) {
  vec3 drawn = place + point.depth * ray, normal = fromOctahedral(point.normal);
  if ((point.material & kLayerPlaced) == 0) return LayerStart(drawn, normal, drawn, normal);
  return LayerStart(point.place, fromOctahedral(unpackedOctahedral(point.placeNormal)), drawn, normal);
}
