// SPDX-License-Identifier: Apache-2.0
// A shadow that is flattened onto a plane: where the plane is seen, of what is between it and the light. Nothing fights for the
// depth there, and what is below the plane or beyond the light has no shadow.
#extension GL_GOOGLE_include_directive : require
#include "shared/flat_pattern.h"
#include "shared/scene_data.h"
#include "lib/material_of_texel.glsl"

layout(set = kSetFound, binding = kBindingFound) uniform sampler2D foundTexels;
layout(scalar, push_constant) uniform Draw {
  FlatShadow draw;
  FlatPattern caster;
};

layout(location = kLocationFlatHeight) in float inHeight;

bool isInFlatShadow() {
  vec4 texel = texelFetch(foundTexels, ivec2(gl_FragCoord.xy), 0);
  bool isPlane = texel.w != 0.0 && materialOfTexel(texel) == draw.receiver;
  return isPlane && inHeight > 0.0 && inHeight < draw.highest;
}
