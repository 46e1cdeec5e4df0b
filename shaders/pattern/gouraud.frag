// SPDX-License-Identifier: Apache-2.0
// The interpolated light of the side that is seen, on a pattern.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/bindings.h"

layout(location = kLocationFront) sample in vec3 inFront;
layout(location = kLocationBack) sample in vec3 inBack;
layout(location = kLocationFrontRest) sample in vec4 inFrontRest;
layout(location = kLocationBackRest) sample in vec4 inBackRest;
layout(location = kLocationNumbers) flat in uvec3 inNumbers;
layout(location = kLocationDetail) sample in vec2 inParameters;

#include "lib/pattern_of_mesh.glsl"
#ifdef LUXO_TEXTURED
vec4 pixelFootprint() { return vec4(dFdx(inParameters), dFdy(inParameters)); }
#include "lib/maps.glsl"
#endif

layout(location = 0) out vec4 outColor;

void main() {
  vec4 rest = gl_FrontFacing ? inFrontRest : inBackRest;
#ifdef LUXO_SPECULAR_MAP
  MaterialData data = materials[inNumbers.y];
  vec3 ambient = (data.flags & kPatternAmbient) != 0 ? vec3(0) : data.ambient;
  rest.rgb = ambient + mappedSpecular(rest.rgb - ambient, inParameters);
#endif
  outColor = vec4(patternAt(inParameters) * (gl_FrontFacing ? inFront : inBack) + rest.rgb, rest.a);
#ifdef LUXO_GLOW_MAP
  outColor.rgb += glowAt(inParameters);
#endif
}
