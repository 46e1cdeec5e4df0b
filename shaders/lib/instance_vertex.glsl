// SPDX-License-Identifier: Apache-2.0
// The instance of a vertex. Of meshes it comes as attributes, one set for an instance: a CPU device fetches these a vector at a
// time, and reads buffers word by word.
#include "lib/scene.glsl"

#ifdef LUXO_RAY_POINT
InstanceData instanceOfVertex() { return instances[gl_InstanceIndex]; }
#else
layout(location = kLocationInstance) in vec4 inRelativeFromObject0;
layout(location = kLocationInstance + 1) in vec4 inRelativeFromObject1;
layout(location = kLocationInstance + 2) in vec4 inRelativeFromObject2;
layout(location = kLocationInstance + 3) in vec3 inTranslation;
layout(location = kLocationInstance + 4) in vec3 inNormalFromObject0;
layout(location = kLocationInstance + 5) in vec3 inNormalFromObject1;
layout(location = kLocationInstance + 6) in vec3 inNormalFromObject2;
layout(location = kLocationInstance + 7) in uvec3 inInstanceNumbers;  // flags, material, id
layout(location = kLocationInstance + 8) in vec4 inDomain;

InstanceData instanceOfVertex() {
  return InstanceData(vec4[](inRelativeFromObject0, inRelativeFromObject1, inRelativeFromObject2), inTranslation,
                      mat3(inNormalFromObject0, inNormalFromObject1, inNormalFromObject2), inInstanceNumbers.x,
                      inInstanceNumbers.y, inInstanceNumbers.z, inDomain);
}
#endif
