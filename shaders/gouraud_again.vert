// SPDX-License-Identifier: Apache-2.0
// What vertices receive of some lights, each by itself.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/illumination.glsl"
#include "lib/lights.glsl"
#include "lib/instance_vertex.glsl"

layout(constant_id = kConstantFirstLight) const uint kFirstLight = 0;

layout(location = kAttributePosition) in vec3 inPosition;
layout(location = kAttributeNormal) in vec3 inNormal;
layout(location = kAttributeParameters) in vec2 inParameters;

layout(location = kLocationAgainReceived) sample out vec4 outReceived[kVertexLights];
layout(location = kLocationAgainNumbers) flat out uvec3 outNumbers;
layout(location = kLocationAgainAmbient) flat out vec3 outAmbient;
layout(location = kLocationAgainDiffuse) flat out vec3 outDiffuse;
layout(location = kLocationAgainSpecular) flat out vec3 outSpecular;
layout(location = kLocationAgainOpacity) flat out float outOpacity;
layout(location = kLocationDetail) sample out vec2 outParameters;
layout(location = kLocationParameterBounds) flat out vec4 outParameterBounds;

invariant gl_Position;

LightData lightAt(uint i) { return lightSet.lights[i]; }
ShadeData shadeAt(uint i) { return lightSet.shades[i]; }

// Of a white light by a white surface: as light, and as a highlight.
vec2 received(MaterialData data, LightData light, vec3 toLight, vec3 n, vec3 v) {
  light.radiance = vec3(1);
  return vec2(reflected(Material(vec3(0), vec3(1), vec3(0), data.shininess, data.flags), light, toLight, n, v).x,
              reflected(Material(vec3(0), vec3(0), vec3(1), data.shininess, data.flags), light, toLight, n, v).x);
}

void main() {
  InstanceData instance = instanceOfVertex();
  vec3 position = relativeFromObject(instance, inPosition);
  vec3 n = unitOrZero(instance.normalFromObject * inNormal);
  vec3 v = towardViewer(view.viewer, position);
  MaterialData data = materials[instance.material];
  vec3 back = (instance.flags & kTwoSided) != 0 ? -n : n;
  for (uint k = 0; k < kVertexLights; ++k) {
    uint i = kFirstLight + k;
    if (i >= kPlainLights + kShadedLights) break;
    LightData light = lightAt(i);
    vec3 toLight = light.position.xyz - position * light.position.w;
    outReceived[k] = vec4(received(data, light, toLight, n, v), received(data, light, toLight, back, v)) *
                     spotAttenuation(i, position, toLight);
  }
  outNumbers = uvec3(data.flags, instance.material, data.firstPatternParameter);
  outAmbient = data.ambient;
  outDiffuse = data.diffuse;
  outSpecular = data.specular;
  outOpacity = data.opacity;
  outParameters = inParameters;
  outParameterBounds = parameterBounds(instance);
  gl_Position = view.clipFromRelative * vec4(position, 1);
}
