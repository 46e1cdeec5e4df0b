// SPDX-License-Identifier: Apache-2.0
// A caster's cells, its formula, and its grid, which lists the cells that a ray from the grid's light may meet.
#include "lib/shadow_interface.glsl"
#include "lib/caster_formula.glsl"

layout(scalar, set = kSetShadow, binding = kBindingGridStarts) readonly buffer GridStarts { uint gridStarts[]; };
layout(scalar, set = kSetShadow, binding = kBindingGridEntries) readonly buffer GridEntries { GridEntry gridEntries[]; };
#include "lib/cell_ray.glsl"

bool has(uint flags) { return (varyingCaster.z & flags) != 0; }

// The texel that a point is in; none where the grid has no texel in its direction.
const uint kNone = 0xffffffffu;
uint texelOf(vec3 q, out float ahead) {
  vec3 size = abs(q);
  bool isParallel = has(kParallelLight), isZ = isParallel || (size.z >= size.x && size.z >= size.y),
       isX = !isZ && size.x >= size.y;
  bool isNegative = !isParallel && (isZ ? q.z : isX ? q.x : q.y) < 0.0;
  vec4 face = isZ ? (isNegative ? varyingFaces[5] : varyingFaces[4])
            : isX ? (isNegative ? varyingFaces[1] : varyingFaces[0]) : (isNegative ? varyingFaces[3] : varyingFaces[2]);
  uvec3 firsts = isNegative ? varyingFirstTexels[1] : varyingFirstTexels[0];
  uint first = isZ ? firsts.z : isX ? firsts.x : firsts.y;
  vec2 place = isZ ? q.xy : isX ? q.yz : q.zx;
  ahead = isParallel ? q.z : isZ ? size.z : isX ? size.x : size.y;
  if (!isParallel) place /= ahead;
  vec2 texel = (place - face.xy) * face.zw;
  float count = float(varyingCaster.w);
  // A point beside all texels is in none; floats may put one that is on the border half a texel off.
  if (face.z == 0.0 || !(min(texel.x, texel.y) >= -0.03 && max(texel.x, texel.y) <= count + 0.03)) return kNone;
  uvec2 whole = uvec2(clamp(texel, vec2(0), vec2(count - 1.0)));
  return first + whole.y * varyingCaster.w + whole.x;
}

// Of a vector or a point (w = 1): as the grid has its axes, and as the caster has them.
vec3 inGrid(vec4 p) { return vec3(dot(varyingGrid[0], p), dot(varyingGrid[1], p), dot(varyingGrid[2], p)); }
vec3 inObject(vec4 p) { return vec3(dot(varyingObject[0], p), dot(varyingObject[1], p), dot(varyingObject[2], p)); }
