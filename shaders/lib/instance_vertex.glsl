// SPDX-License-Identifier: Apache-2.0
// The instance of a vertex. Of meshes it comes as attributes, one set for an instance: a CPU device fetches these a vector at a
// time, and reads buffers word by word.
#include "lib/scene.glsl"

#ifdef LUXO_RAY_POINT
InstanceData instanceOfVertex() { return instances[gl_InstanceIndex]; }
#else
layout(location = kAttributeRelativeFromObject) in vec4 inRelativeFromObject0;
layout(location = kAttributeRelativeFromObject + 1) in vec4 inRelativeFromObject1;
layout(location = kAttributeRelativeFromObject + 2) in vec4 inRelativeFromObject2;
layout(location = kAttributeTranslation) in vec3 inTranslation;
layout(location = kAttributeNormalFromObject) in vec3 inNormalFromObject0;
layout(location = kAttributeNormalFromObject + 1) in vec3 inNormalFromObject1;
layout(location = kAttributeNormalFromObject + 2) in vec3 inNormalFromObject2;
layout(location = kAttributeInstanceNumbers) in uvec3 inInstanceNumbers;  // flags, material, id
layout(location = kAttributeDomain) in vec4 inDomain;

InstanceData instanceOfVertex() {
  return InstanceData(vec4[](inRelativeFromObject0, inRelativeFromObject1, inRelativeFromObject2), inTranslation,
                      mat3(inNormalFromObject0, inNormalFromObject1, inNormalFromObject2), inInstanceNumbers.x,
                      inInstanceNumbers.y, inInstanceNumbers.z, inDomain);
}
#endif
