// SPDX-License-Identifier: Apache-2.0
// A triangle around the place at which a pixel is sampled, so small that no other pixel is.
#include "shared/scene_data.h"

layout(push_constant, scalar) uniform Target { RayTarget target; };

// `place`: in the target, pixels; `depth`: as in the depth buffer.
vec4 aroundPlace(vec2 place, float depth) {
  const vec2 kCorners[3] = vec2[](vec2(0, -0.25), vec2(-0.25, 0.25), vec2(0.25, 0.25));  // pixels, seen from the front
  vec2 part = 2.0 * (place + kCorners[gl_VertexIndex % 3]) / target.size - 1.0;
  return vec4(vec2(part.x, -part.y) / target.guard, depth, 1);
}
