// SPDX-License-Identifier: Apache-2.0
// All points that the ray of a pixel meets of a surface that is seen through, in front of what is not.
//
// The eye is the light of the surface's grid, and a ray of sight one of light that goes on: of every cell that the grid lists
// in its direction every meeting is proven to be one, and the only one of its rectangle (lib/cell_ray.glsl). One on a border
// between two rectangles may be found by both; who blends the layers takes it once. What no float tells is left to rays.
#extension GL_GOOGLE_include_directive : require
#define LUXO_EVALUATIONS 4096
// What two cells have found is one; what none has would be lost.
#define LUXO_USUAL_ROUNDING 1.0
#include "lib/caster.glsl"
#include "lib/layers.glsl"
#include "lib/octahedral.glsl"

CellRay sight;
CasterCell found_;       // the cell
float metresOfDepth;     // along the ray, in a metre of depth
float opaque, nearest_;  // metres along the ray: what is not seen through, and the near plane
float besideOpaque;      // and by so much these may be off
vec3 rayInView;
bool isOpen = false;

const float kAsFar = 8.0;
const int kSteps = 4;  // Newton's: from a grain of a pixel two are enough

bool endsAt(vec2 parameters, bool atBorder) {
  vec3 S, Su, Sv;
  vec2 a, b, f;
  float area;
  for (int step = 0; step < kSteps; ++step) {
    surfaceAt(parameters.x, parameters.y, S, Su, Sv);
    vec3 from = S - sight.from;
    f = vec2(dot(sight.across1, from), dot(sight.across2, from));
    a = vec2(dot(sight.across1, Su), dot(sight.across2, Su));
    b = vec2(dot(sight.across1, Sv), dot(sight.across2, Sv));
    area = crossOf(a, b);
    if (dot(f, f) <= 0.0625 * sight.rounding * sight.rounding || step + 1 == kSteps) break;
    parameters += vec2(-crossOf(f, b), crossOf(f, a)) / area;
  }
  float t = dot(sight.along, S - sight.from), perArea = 1.0 / max(abs(area), 1e-37);
  float off = sight.rounding * (1.0 + (abs(dot(sight.along, Su)) * length(b) + abs(dot(sight.along, Sv)) * length(a)) * perArea);
  // Where the ray grazes the surface as near as floats tell there may be no point, or two: there the tangents turn by more
  // than they span in all that rounding leaves of the parameters.
  vec2 h = kAsFar * sight.rounding * perArea * vec2(length(b), length(a));
  float turn = 0.5 * (found_.bend.x * h.x * h.x + found_.bend.z * h.y * h.y) + found_.bend.y * h.x * h.y;
  bool isPlain = 4.0 * turn * (h.x * length(a) + h.y * length(b)) < h.x * h.y * abs(area);
  bool isFound = isPlain && dot(f, f) <= sight.rounding * sight.rounding && off < 1e30;
  if (!isFound || abs(t - opaque) <= off + besideOpaque || abs(t - nearest_) <= off + besideOpaque) {
    isOpen = true;
    return true;
  }
  if (t > opaque || t < nearest_) return false;

  // By the inverse transposed, as normals are; the determinant's sign is that of the side.
  vec3 n = found_.outward * cross(Su, Sv);
  n *= inversesqrt(max(dot(n, n), 1e-37));
  vec3 normal = n.x * varyingObject[0].xyz + n.y * varyingObject[1].xyz + n.z * varyingObject[2].xyz;
  normal = unitOrZero(normal);
  bool isFront = dot(normal, rayInView) < 0.0;
  if (has(kShowsFront) && !isFront) return false;
  if (has(kTurnsNormal) && !isFront) normal = -normal;
  vec2 inside = (1.0 - 2e-6) * found_.half_;
  parameters = clamp(parameters, found_.middle - inside, found_.middle + inside) + vec2(found_.originOfU, 0);
  addLayer(LayerPoint(0, t / metresOfDepth, 4.0 * off / metresOfDepth, varyingMaterial | (atBorder ? kLayerAtBorder : 0), 0,
                      octahedral(normal), parameters, vec3(0), vec3(0)));
  return false;
}

void findLayers() {
  vec3 place = layerPlace();
  rayInView = layerRay();
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
  sight = cellRay(inObject(vec4(place, 1)), along / metresOfDepth);
  float buffered = texelFetch(opaqueDepth, ivec2(gl_FragCoord.xy), 0).x, originDepth = view.forward.w;
  opaque = buffered > 0.0 ? layerDepth(buffered, place, rayInView) * metresOfDepth : 1e30;
  bool isPerspective = view.viewer.w != 0.0;
  nearest_ = (isPerspective ? view.clipFromRelative[3][2] - originDepth : layerDepth(1.0, place, rayInView)) * metresOfDepth;
  besideOpaque = rounding + (buffered > 0.0 ? 4.8e-7 * (abs(opaque) + abs(originDepth) * metresOfDepth) : 0.0);
  sight.first = nearest_ - 2.0 * besideOpaque;
  sight.last = opaque + 2.0 * besideOpaque;
  sight.rounding = rounding;
  sight.off = 0.0;
  sight.grain = kGrain * varyingRounding.w * (isPerspective ? vec2(originDepth, 1.0 / metresOfDepth) : vec2(1, 0));
  for (; entry < end; ++entry) {
    found_ = casterCells[varyingFirst.y + gridEntries[varyingFirst.x + entry].cell];
    holdPatch(found_.patch_);
    if (meetsCell(sight, found_) == kPassed && !isOpen) continue;
    doubtLayers();
    return;
  }
}
