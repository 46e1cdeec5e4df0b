// SPDX-License-Identifier: Apache-2.0
// A material's shader by itself: to find its errors, and which uniforms it has. It is never drawn. The file "material" is
// its own.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/material.glsl"

layout(location = 0) in vec4 inAny;
layout(location = 0) out vec4 outColor;

vec2 luxoPictureSize() { return inAny.xy; }
int lightCount() { return int(inAny.x); }
Light light(int i) { return Light(inAny.xyz, inAny.w, inAny.xyz, inAny.xyz); }
vec3 ambientLight() { return inAny.xyz; }
vec3 blinnPhong(vec3 diffuse, vec3 specular, float shininess) { return inAny.xyz * diffuse + specular * shininess; }
vec3 colorMap(vec2 uv) { return inAny.xyz * uv.x; }
vec3 specularMap(vec2 uv) { return inAny.xyz * uv.x; }
vec3 glowMap(vec2 uv) { return inAny.xyz * uv.x; }
vec3 worldVector(vec3 object) { return inAny.xyz * object.x; }
vec3 objectVector(vec3 world) { return inAny.xyz * world.x; }
vec3 worldNormal(vec3 object) { return inAny.xyz * object.x; }
vec4 texture(int map, vec2 uv) { return inAny * uv.x * float(map); }
vec4 textureGrad(int map, vec2 uv, vec2 right, vec2 below) { return inAny * uv.x * right.x * below.x * float(map); }
Hit trace(vec3 direction) { return Hit(inAny.x > 0.0, inAny.y > 0.0, inAny.z, direction, inAny.xyz, inAny.xy, inAny.xyz, 0); }
Hit trace(Hit from, vec3 direction) { return Hit(from.found, from.inside, inAny.z, direction, from.normal, inAny.xy, inAny.xyz, 0); }

#define sampler2D int
#include "material"
#undef sampler2D

void main() {
  outColor = material(Point(inAny.xyz, inAny.xyz, inAny.xyz, inAny.xyz, inAny.xyz, inAny.xyz, inAny.xyz, inAny.xyz, inAny.xy, inAny.x, inAny.y, inAny.z,
                            inAny.w, mat2(inAny)));
}
