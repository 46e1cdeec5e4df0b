// SPDX-License-Identifier: Apache-2.0
// The light of more lights on meshes that were drawn again, once for each pixel, however many triangles are there.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/scene_data.h"

layout(set = kSetFound, binding = kBindingMoreLight) uniform sampler2D moreLight;

layout(location = 0) out vec4 outColor;

void main() {
  outColor = vec4(texelFetch(moreLight, ivec2(gl_FragCoord.xy), 0).rgb, 0);
  if (outColor.rgb == vec3(0)) discard;  // what is no mesh's stays as it is
}
