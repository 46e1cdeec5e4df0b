// SPDX-License-Identifier: Apache-2.0
// Where vertices are: those of meshes in object space; or, with LUXO_RAY_POINT, of points that rays have found, each a
// triangle around the place at which its pixel is sampled and so small that no other pixel is.
#include "lib/instance_vertex.glsl"

layout(location = kAttributePosition) in vec3 inPosition;
layout(location = kAttributeNormal) in vec3 inNormal;

#ifdef LUXO_RAY_POINT
#include "lib/around_place.glsl"

layout(location = kAttributePointPlace) in vec4 inPlace;  // of the sample, in the target; its depth in the depth buffer, and in metres
layout(location = kAttributePointFlags) in uint inPointFlags;
vec3 positionOfVertex(InstanceData instance) { return inPosition; }  // relative already
vec3 normalOfVertex(InstanceData instance) { return inNormal; }
float depthOfVertex(vec3 relative) { return inPlace.w; }

uint flagsOfVertex(InstanceData instance) { return instance.flags | inPointFlags; }

vec4 clipOfVertex(vec3 relative) { return aroundPlace(inPlace.xy, inPlace.z); }

#else

vec3 positionOfVertex(InstanceData instance) { return relativeFromObject(instance, inPosition); }
vec3 normalOfVertex(InstanceData instance) { return unitOrZero(instance.normalFromObject * inNormal); }
float depthOfVertex(vec3 relative) { return dot(vec4(relative, 1), view.forward); }
uint flagsOfVertex(InstanceData instance) { return instance.flags; }
vec4 clipOfVertex(vec3 relative) { return view.clipFromRelative * vec4(relative, 1); }

#endif
