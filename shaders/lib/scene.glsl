// SPDX-License-Identifier: Apache-2.0
// The scene's bindings, and the transform every vertex shader shares.
#include "shared/scene_data.h"

layout(scalar, set = 0, binding = kBindingView) uniform View { ViewData view; };
layout(scalar, set = 0, binding = kBindingInstances) readonly buffer Instances { InstanceData instances[]; };

vec3 relativeFromObject(InstanceData instance, vec3 position) {
  return instance.relativeFromObject * position + instance.translation;
}
