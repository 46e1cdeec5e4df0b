// SPDX-License-Identifier: Apache-2.0
// Points of triangles that are seen through, to be lit later, with what maps and shaders ask for.
#extension GL_GOOGLE_include_directive : require
#define LUXO_FINDS_LAYER
#define LUXO_FRAMED
#include "lib/textured_surface.glsl"
#include "lib/layers.glsl"
#include "lib/lit_plain.glsl"
#include "lib/octahedral.glsl"

layout(location = kLocationParameterBounds) flat in vec4 inParameterBounds;

vec4 patternBounds() { return inParameterBounds; }

void addFramedLayer() {
  Found found = foundPoint();
  vec2 parameters = clamp(found.parameters, inParameterBounds.xy, inParameterBounds.zw);
  LayerPoint point = unlitPoint(dot(found.position, view.forward.xyz), 0.0, inNumbers.y | layerOfTriangles(inNumbers.x),
                                octahedral(found.normal), parameters);
  setTriangle(addLayer(point, LayerDetail(pixelFootprint(), normalFrame())));
}
