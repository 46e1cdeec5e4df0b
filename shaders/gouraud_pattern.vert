// SPDX-License-Identifier: Apache-2.0
// Light per vertex for a pattern: of each side what the pattern will scale, and the rest.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/illumination.glsl"
#include "lib/lights.glsl"
#include "lib/instance_vertex.glsl"

layout(location = kAttributePosition) in vec3 inPosition;
layout(location = kAttributeNormal) in vec3 inNormal;
layout(location = kAttributeParameters) in vec2 inParameters;

layout(location = kLocationFront) sample out vec3 outFront;
layout(location = kLocationBack) sample out vec3 outBack;
layout(location = kLocationFrontRest) sample out vec4 outFrontRest;
layout(location = kLocationBackRest) sample out vec4 outBackRest;
layout(location = kLocationDetail) sample out vec2 outParameters;
layout(location = kLocationNumbers) flat out uvec3 outNumbers;  // of the material; where the pattern's parameters start
layout(location = kLocationParameterBounds) flat out vec4 outParameterBounds;

invariant gl_Position;

LightData lightAt(uint i) { return lightSet.lights[i]; }
ShadeData shadeAt(uint i) { return lightSet.shades[i]; }

void main() {
  InstanceData instance = instanceOfVertex();
  vec3 position = relativeFromObject(instance, inPosition);
  vec3 n = unitOrZero(instance.normalFromObject * inNormal);
  vec3 v = towardViewer(view.viewer, position);
  MaterialData data = materials[instance.material];
  bool follows = (data.flags & kPatternAmbient) != 0;
  Material scaled = Material(follows ? data.ambient : vec3(0), vec3(1), vec3(0), data.shininess, data.flags);
  Material rest = Material(follows ? vec3(0) : data.ambient, vec3(0), data.specular, data.shininess, data.flags);
  vec3 back = (instance.flags & kTwoSided) != 0 ? -n : n;
  outFront = illuminated(scaled, position, n, v);
  outBack = illuminated(scaled, position, back, v);
  outFrontRest = vec4(illuminated(rest, position, n, v), data.opacity);
  outBackRest = vec4(illuminated(rest, position, back, v), data.opacity);
  outParameters = inParameters;
  outNumbers = uvec3(0, instance.material, data.firstPatternParameter);
  outParameterBounds = parameterBounds(instance);
  gl_Position = view.clipFromRelative * vec4(position, 1);
}
