// SPDX-License-Identifier: Apache-2.0
// The scene's bindings, and the transform every vertex shader shares.
#ifndef LUXO_LIB_SCENE_GLSL
#define LUXO_LIB_SCENE_GLSL
#include "shared/scene_data.h"
#include "shared/truth.h"

layout(scalar, set = kSetScene, binding = kBindingView) uniform View { ViewData view; };
layout(scalar, set = kSetScene, binding = kBindingInstances) readonly buffer Instances { InstanceData instances[]; };
layout(scalar, set = kSetScene, binding = kBindingMaterials) readonly buffer Materials { MaterialData materials[]; };

// From a point toward who sees it: unit.
vec3 towardViewer(vec4 viewer, vec3 position) {
  vec3 v = viewer.xyz - position * viewer.w;
  return v * inversesqrt(dot(v, v));
}

// Unit vector along v; 0 where a flattened surface has no normal, which is where it has no area.
vec3 unitOrZero(vec3 v) {
  // Scaled first: squares of floats beyond 1e19 and below 1e-19 are no floats.
  float longest = max(max(abs(v.x), abs(v.y)), abs(v.z));
  vec3 scaled = v / max(longest, 1.17549435e-38);
  return scaled * inversesqrt(max(dot(scaled, scaled), 0.5));
}

// The lowest and highest u and v inside a surface, a millionth of the domain from its ends.
vec4 parameterBounds(InstanceData instance) {
  vec2 margin = 1e-6 * instance.domain.zw;
  return vec4(instance.domain.xy + margin, instance.domain.xy + instance.domain.zw - margin);
}

mat3 linearOf(InstanceData instance) {
  return mat3(instance.relativeFromObject[0].xyz, instance.relativeFromObject[1].xyz, instance.relativeFromObject[2].xyz);
}

vec3 relativeFromObject(InstanceData instance, vec3 position) {
  vec3 middle = vec3(instance.relativeFromObject[0].w, instance.relativeFromObject[1].w, instance.relativeFromObject[2].w);
  return linearOf(instance) * (position - middle) + instance.translation;
}

// Which side of a surface is seen, given its outward normal, the direction toward the viewer (both unit) and whether the
// facet faces the viewer. The facet decides where the surface turns away: there the interpolated normal runs ahead of
// it. Elsewhere the normal does: the raster's grid turns facets over that are thinner than a pixel.
bool seenFromFront(vec3 n, vec3 v, bool facetFaces) {
  float cosine = dot(n, v);
  return abs(cosine) > kTurningAway ? cosine > 0.0 : facetFaces;
}
#endif
