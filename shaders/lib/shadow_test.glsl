// SPDX-License-Identifier: Apache-2.0
// Whether a caster keeps its light from a point: by the cells that the light's grid lists in its direction, nearest to the
// light first.
#include "lib/caster.glsl"

const float kBesidePlane = 1e-6;   // of the distances involved: what floats leave of one

// Whether a point of that normal gets nothing of the light, shadow or not.
bool facesAway(vec3 position, vec3 normal) {
  return has(kGatedLight) && dot(normal, varyingLightRelative.xyz - varyingLightRelative.w * position) <= 0.0;
}

// Of a point that the picture shows at a depth (metres beyond that of what positions are relative to); `isOwn`: of the
// caster itself. kMet: it does.
int shadowAt(vec3 position, vec3 normal, float depth, bool isOwn) {
  vec3 toLight = varyingLightRelative.xyz - varyingLightRelative.w * position;
  float cosine = dot(normal, toLight) * inversesqrt(max(dot(toLight, toLight), 1e-37));
  if (isOwn && (has(kFlatCaster) || (has(kConvexCaster) && cosine > kLeastCosine))) return kPassed;
  if (has(kFlatCaster) && dot(varyingPlane, vec4(position, 1)) > kBesidePlane * (length(position) + abs(varyingPlane.w)))
    return kPassed;

  // Beyond its margin the grid may not list what is in the way.
  float rounding = varyingRounding.x + varyingRounding.y * length(position);
  if (rounding > varyingRounding.z) return kOpen;
  vec4 p = vec4(position, 1);
  float ahead;
  uint number = texelOf(inGrid(p), ahead);
  if (number == kNone) return kPassed;
  uint entry = gridStarts[number], end = gridStarts[number + 1];
  if (entry == end) return kPassed;

  vec3 from = inObject(p);
  vec3 way = varyingLightObject.xyz - varyingLightObject.w * from;
  float distance_ = length(way), width = varyingRounding.w * (varyingMiddle.z != 0.0 ? depth + varyingMiddle.w : 1.0);
  // A point is off its surface by what rounding and the search for it leave.
  CellRay ray = cellRay(from, way / max(distance_, 1e-37));
  ray.last = varyingLightObject.w != 0.0 ? distance_ : 1e30;
  ray.rounding = rounding;
  ray.off = rounding + varyingOff.x * width;
  // What is off at the caster is off by more behind it, as the light spreads.
  ray.grain = kGrain * vec2(width, has(kParallelLight) ? 0.0 : -width / max(distance_, 1e-37));
  ray.aslant = length(sightOfPixel());
  evaluationsLeft = kMaxEvaluations;
  ownMeetings = besideMeetings = 0;
  mayTurnBack = false;
#ifdef LUXO_TRIANGLES
  metBesideEdge = passedBesideEdge = false;
  ownSlant = 0.0;
  widthBesideEdge = 1e30;
#endif
  // What one cell leaves open another may settle.
  int result = kPassed;
  // Of parallel light `ahead` has either sign, and what rounding leaves of it is within the grid's margin.
  float behind = ahead + 1e-5 * abs(ahead) + 1e-30;
  for (; entry < end && result != kMet && evaluationsLeft >= 0; ++entry) {
    GridEntry listed = gridEntries[varyingFirst.x + entry];
    if (listed.nearest > behind) break;
    CasterCell cell = casterCells[varyingFirst.y + listed.cell];
    if (isOutOfRounds(1 + roundsToHold(cell.patch_))) {
      result = kOpen;
      break;
    }
    holdPatch(cell.patch_);
    int met = meetsCell(ray, cell);
    if (met != kPassed) result = met;
  }
  // One is the point's own, if it is a point of the caster. None is left where the ray grazes it and floats part them: then
  // they may part others, too.
  bool isSettled = ownMeetings == (isOwn ? 1 : 0);
#ifdef LUXO_TRIANGLES
  if (result != kMet && isAsNearAsBordersMove(ray)) return kOpen;
  if (metBesideEdge && result == kPassed) return isSettled ? kMet : kOpen;
#endif
  bool mayHaveTwo = isOwn && besideMeetings > 0 && mayTurnBack;
  return result == kPassed && (!isSettled || mayHaveTwo) ? kOpen : result;
}
