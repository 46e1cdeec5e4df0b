// SPDX-License-Identifier: Apache-2.0
// One value from each kind of descriptor; counts the pixels it runs for.
#version 460
#extension GL_EXT_scalar_block_layout : require
layout(early_fragment_tests) in;
layout(scalar, set = 0, binding = 0) readonly buffer First { vec3 first[]; };
layout(scalar, set = 0, binding = 1) readonly buffer Second { float second[]; };
layout(scalar, set = 0, binding = 2) uniform Third { float third; };
layout(set = 0, binding = 3) uniform sampler2D fourth;
layout(scalar, set = 0, binding = 4) buffer Count { uint count; };
layout(location = 0) out vec4 outColor;

void main() {
  outColor = vec4(first[1].z, second[2], third, texelFetch(fourth, ivec2(0), 0).g);
  atomicAdd(count, 1);
}
