// SPDX-License-Identifier: Apache-2.0
// Fragments of triangles: what they know of the surface's point, and the light on it.
//
// What is interpolated is so at each sample, as in every shader here: a pixel's centre may lie beside the triangle, where
// normals sparkle and positions leave the node whose bounds decided which lights reach it. (Centroids lie inside, but a
// driver may choose them among the samples that passed the depth test, so that the order of draws would show.)
#include "lib/found.glsl"
#include "lib/carried_lights.glsl"
#include "lib/pixel_ray.glsl"
#include "lib/scene.glsl"
#include "lib/show.glsl"

layout(constant_id = kConstantFacetNormal) const bool kFacetNormal = false;

layout(location = kLocationPosition) sample in vec3 inPosition;
layout(location = kLocationNormal) sample in vec3 inNormal;
layout(location = kLocationAmbient) flat in vec3 inAmbient;
layout(location = kLocationDiffuse) flat in vec3 inDiffuse;
layout(location = kLocationSpecular) flat in vec3 inSpecular;
layout(location = kLocationShininessOpacity) flat in vec2 inShininessOpacity;
layout(location = kLocationNumbers) flat in uvec3 inNumbers;
layout(location = kLocationViewer) flat in vec4 inViewer;

Material foundMaterial() {
  if (kCarries) return Material(inAmbient, inDiffuse, inSpecular, inShininessOpacity.x, inNumbers.x);
  MaterialData data = materials[inNumbers.y];
  return Material(data.ambient, data.diffuse, data.specular, data.shininess, inNumbers.x);
}
float foundOpacity() { return kCarries ? inShininessOpacity.y : materials[inNumbers.y].opacity; }
vec4 viewerOfDraw() { return kCarries ? inViewer : view.viewer; }

// The interpolated normal (Phong shading) or the facet's own (flat shading), on the side that is shown.
vec3 fragmentNormal(vec3 v) {
  // The facet is flat, so the derivatives of its position span it; which of its sides is seen, the rasteriser knows.
  if (kFacetNormal) {
    vec3 n = unitOrZero(cross(dFdx(inPosition), dFdy(inPosition)));
    return (dot(n, v) > 0.0) == (gl_FrontFacing || (inNumbers.x & kTwoSided) != 0) ? n : -n;
  }
  vec3 n = unitOrZero(inNormal);
  return (inNumbers.x & kTwoSided) != 0 && !seenFromFront(n, v, gl_FrontFacing) ? -n : n;
}

// Whoever includes this knows them, where there is a pattern.
vec2 foundParameters();

// What is lit later is on the pixel's ray, of which it keeps the depth.
#ifdef LUXO_FINDS_LAYER
#define LUXO_LIT_LATER true
#else
#define LUXO_LIT_LATER (kQuantity == kFoundTexel)
#endif

Found foundPoint() {
  vec3 v = towardViewer(viewerOfDraw(), inPosition), position = inPosition;
  if (LUXO_LIT_LATER) position = seenByPixel(inPosition);
  return Found(position, fragmentNormal(v), v, foundParameters(), 0.0, 0.0);
}

uint foundMaterialNumber() { return inNumbers.y; }
