// SPDX-License-Identifier: Apache-2.0
// What rays have found of the shadows in a pixel: a triangle around the place at which it is sampled (see
// lib/placed_vertex.glsl).
#version 460

layout(location = 0) in vec2 inPlace;
layout(location = 1) in uint inShadows;
layout(push_constant) uniform Target { vec2 size; float guard; } target;

layout(location = 0) flat out uint outShadows;

void main() {
  const vec2 kCorners[3] = vec2[](vec2(0, -0.25), vec2(-0.25, 0.25), vec2(0.25, 0.25));  // pixels
  vec2 part = 2.0 * (inPlace + kCorners[gl_VertexIndex % 3]) / target.size - 1.0;
  outShadows = inShadows;
  gl_Position = vec4(vec2(part.x, -part.y) / target.guard, 0, 1);
}
