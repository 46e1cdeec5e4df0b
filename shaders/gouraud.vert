// SPDX-License-Identifier: Apache-2.0
// Light per vertex (Gouraud shading): the colour of each side is evaluated here and interpolated.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/illumination.glsl"
#include "lib/lights.glsl"
#include "lib/instance_vertex.glsl"

layout(location = kAttributePosition) in vec3 inPosition;
layout(location = kAttributeNormal) in vec3 inNormal;

layout(location = kLocationFront) sample out vec4 outFront;
layout(location = kLocationBack) sample out vec4 outBack;

invariant gl_Position;

LightData lightAt(uint i) { return lightSet.lights[i]; }
ShadeData shadeAt(uint i) { return lightSet.shades[i]; }

void main() {
  InstanceData instance = instanceOfVertex();
  vec3 position = relativeFromObject(instance, inPosition);
  vec3 n = unitOrZero(instance.normalFromObject * inNormal);
  vec3 v = towardViewer(view.viewer, position);
  MaterialData data = materials[instance.material];
  Material material = materialOf(data);
  bool twoSided = (instance.flags & kTwoSided) != 0;
  outFront = vec4(illuminated(material, position, n, v), data.opacity);
  outBack = vec4(illuminated(material, position, twoSided ? -n : n, v), data.opacity);
  gl_Position = view.clipFromRelative * vec4(position, 1);
}
