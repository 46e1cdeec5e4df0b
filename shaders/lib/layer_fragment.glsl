// SPDX-License-Identifier: Apache-2.0
// All points that the ray of a pixel meets of a surface that is seen through, in front of what is not.
//
// The eye is the light of the surface's grid, and a ray of sight one of light that goes on: of every cell that the grid lists
// in its direction every meeting is proven to be one, and the only one of its rectangle (lib/cell_ray.glsl). One on a border
// between two rectangles may be found by both; who blends the layers takes it once. What no float tells is left to rays.
#extension GL_GOOGLE_include_directive : require
#define LUXO_EVALUATIONS 4096
#include "lib/caster.glsl"
#include "lib/layers.glsl"
#include "lib/meeting.glsl"
#include "lib/octahedral.glsl"

float metresOfDepth;     // along the ray, in a metre of depth
float opaque, nearest_;  // metres along the ray: what is not seen through, and the near plane
float besideOpaque;      // and by so much these may be off
vec3 rayInView;
bool isOpen = false;

// Of a point that is met. Along the tangent plane it moves to the next pixel as the rays do; what of that is along Su and
// along Sv is how u and v move.
LayerDetail detailOf(Meeting met, float depth, vec3 normal, float outward, bool isTurned) {
  mat3 objectFromRelative = transpose(mat3(varyingObject[0].xyz, varyingObject[1].xyz, varyingObject[2].xyz));
  vec3 across = cross(met.Su, met.Sv);
  float perSquared = 1.0 / max(dot(across, across), 1e-37);
  vec4 footprint;
  for (int i = 0; i < 2; ++i) {
    vec3 moved = i == 0 ? view.placeRight + depth * view.rayRight : view.placeDown + depth * view.rayDown;
    vec3 onPlane = objectFromRelative * (moved - rayInView * (dot(normal, moved) / dot(normal, rayInView)));
    footprint[2 * i] = dot(cross(onPlane, met.Sv), across) * perSquared;
    footprint[2 * i + 1] = dot(cross(met.Su, onPlane), across) * perSquared;
  }
  vec4 frame = vec4(unitOrZero(inverse(objectFromRelative) * met.Su), outward * sign(determinant(objectFromRelative)));
  return LayerDetail(footprint, isTurned ? -frame : frame);
}

bool endsAt(CellRay ray, CasterCell cell, vec2 parameters, bool atBorder) {
  Meeting met = meetingNear(ray, cell, parameters);
  float t = met.t, off = met.off;
  if (!met.isProven || abs(t - opaque) <= off + besideOpaque || abs(t - nearest_) <= off + besideOpaque) {
    isOpen = true;
    return true;
  }
  if (t > opaque || t < nearest_) return false;

  // By the inverse transposed, as normals are; the determinant's sign is that of the side.
  vec3 n = cell.outward * cross(met.Su, met.Sv);
  n *= inversesqrt(max(dot(n, n), 1e-37));
  vec3 normal = n.x * varyingObject[0].xyz + n.y * varyingObject[1].xyz + n.z * varyingObject[2].xyz;
  normal = unitOrZero(normal);
  bool isFront = dot(normal, rayInView) < 0.0;
  if (has(kShowsFront) && !isFront) return false;
  bool isTurned = has(kTurnsNormal) && !isFront;
  if (isTurned) normal = -normal;
  LayerPoint point = unlitPoint(t / metresOfDepth, 4.0 * off / metresOfDepth, varyingMaterial.x | (atBorder ? kLayerAtBorder : 0),
                                octahedral(normal), parametersInside(cell, met.parameters));
  if (kLayerDetails)
    addLayer(point, detailOf(met, point.depth, normal, cell.outward, isTurned));
  else
    addLayer(point);
  return false;
}

void findLayers() {
  vec3 place = pixelPlace();
  rayInView = pixelRay();
  float rounding = varyingRounding.x + varyingRounding.y * length(place);
  // Beyond its margin the grid may not list what is seen.
  if (rounding > varyingRounding.z) {
    doubtLayers();
    return;
  }
  float ahead;
  uint number = texelOf(inGrid(has(kParallelLight) ? vec4(place, 1) : vec4(rayInView, 0)), ahead);
  if (number == kNone) return;
  uint entry = gridStarts[number], end = gridStarts[number + 1];
  if (entry == end) return;

  vec3 along = inObject(vec4(rayInView, 0));
  metresOfDepth = length(along);
  CellRay sight = cellRay(inObject(vec4(place, 1)), along / metresOfDepth);
  sight.isSight = true;
  float buffered = texelFetch(opaqueDepth, ivec2(gl_FragCoord.xy), 0).x, originDepth = view.forward.w;
  opaque = buffered > 0.0 ? layerDepth(buffered, place, rayInView) * metresOfDepth : 1e30;
  nearest_ = layerDepth(1.0, place, rayInView) * metresOfDepth;
  besideOpaque = rounding + (buffered > 0.0 ? 4.8e-7 * (abs(opaque) + abs(originDepth) * metresOfDepth) : 0.0);
  sight.first = nearest_ - 2.0 * besideOpaque;
  sight.last = opaque + 2.0 * besideOpaque;
  sight.rounding = rounding;
  sight.off = 0.0;
  sight.grain = kGrain * varyingRounding.w * (varyingMiddle.z != 0.0 ? vec2(originDepth, 1.0 / metresOfDepth) : vec2(1, 0));
  for (; entry < end; ++entry) {
    CasterCell cell = casterCells[varyingFirst.y + gridEntries[varyingFirst.x + entry].cell];
    holdPatch(cell.patch_);
    if (meetsCell(sight, cell) == kPassed && !isOpen) continue;
    doubtLayers();
    return;
  }
}
