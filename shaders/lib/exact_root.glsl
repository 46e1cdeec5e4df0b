// SPDX-License-Identifier: Apache-2.0
// The point of a surface that a pixel sees: Newton's method on the pixel's ray, from where it enters the hull.
//
// With the ray's pixel (qx, qy) the offset f(u, v) = (X - qx w, Y - qy w)(S(u, v)) vanishes where S is on the ray;
// |f| / w is how far S is from the pixel's centre on the screen. Newton's method finds nearly every pixel in two steps.
// Where the ray grazes the surface the offset folds: two roots lie close to each other or have just vanished, and
// Newton's step, which knows only the slope, misses them. Steps after the first know the fold, too (foldStep).
#include "lib/exact_interface.glsl"

// The formula: void surfaceAt(float u, float v, out vec3 S, out vec3 Su, out vec3 Sv).
#include "lib/formula.glsl"
layout(scalar, set = 2, binding = kBindingExactParameters) readonly buffer ExactParameters { float exactParameters[]; };
float surfaceParameterAt(uint k) {
  return k < kCarriedParameters ? linkParameters[k / 4][k % 4]
                                : exactParameters[floatBitsToUint(linkSides.w) + k];
}
#define parameterAt surfaceParameterAt
#include "surface"
#undef parameterAt

// A search that has not ended after so many steps begins anew, from four other places and with cautious steps.
const int kBoldSteps = 9, kCautiousSteps = 12;
const int kMostSteps = kBoldSteps + 4 * kCautiousSteps;
const float kSettled = 0.05;       // cells: where the ray is nearest is known once steps are shorter
const float kNear = 0.5;           // pixels: a search that never came so near has missed
const float kBoldCells = 4.0, kCautiousCells = 0.4;  // how many cells a step may lead
const float kFarCells = 2.0;       // a root farther from the start is not certain to be the nearest
const float kSmallest = 1e-37;
const float kPi = 3.14159265;

// The pixel's ray: f = (dot(across1, S) + offset1, dot(across2, S) + offset2).
struct Ray {
  vec3 across1, across2;
  float offset1, offset2;
};

Ray rayOfPixel() {
  vec2 q = gl_FragCoord.xy - linkCellHalf.zw;
  vec4 w = linkClip.w != 0.0 ? linkDepth : vec4(0, 0, 0, 1);
  vec4 a = linkX - q.x * w, b = linkY - q.y * w;
  return Ray(a.xyz, b.xyz, a.w, b.w);
}

// The surface at some (u, v), and where that is from the ray.
struct Probe {
  vec3 S, Su, Sv;
  vec2 f, fu, fv;
  float depth;
  float residual;  // pixels
};

Probe probeAt(Ray ray, vec2 p) {
  Probe at;
  surfaceAt(p.x, p.y, at.S, at.Su, at.Sv);
  at.f = vec2(dot(ray.across1, at.S) + ray.offset1, dot(ray.across2, at.S) + ray.offset2);
  at.fu = vec2(dot(ray.across1, at.Su), dot(ray.across2, at.Su));
  at.fv = vec2(dot(ray.across1, at.Sv), dot(ray.across2, at.Sv));
  at.depth = dot(linkDepth.xyz, at.S) + linkDepth.w;
  float w = linkClip.w != 0.0 ? at.depth : 1.0;
  // Behind the eye there is no screen. A formula without a value has an infinite residual, too.
  at.residual = w > 0.0 ? max(abs(at.f.x), abs(at.f.y)) / w : 1e30;
  if (!(at.residual < 1e30)) at.residual = 1e30;
  return at;
}

// The area that a unit of u and v takes on the screen, signed.
float area(Probe at) { return at.fu.x * at.fv.y - at.fu.y * at.fv.x; }

// The sign of that area on the side of the surface searched for: the one that the hull is seen from.
float wantedSide() { return gl_FrontFacing ? linkSides.x : -linkSides.x; }

bool polesOfU() { return abs(linkSides.y) > 1.5; }

layout(constant_id = 6) const bool kPoles = true;  // whether an edge of a patch is one point

// The angle of a direction, to half a hundredth: small ones far better.
float angleOf(vec2 q) {
  vec2 a = abs(q);
  float z = min(a.x, a.y) / max(max(a.x, a.y), kSmallest);
  float angle = z / (1.0 + 0.28 * z * z);
  angle = a.y > a.x ? 0.5 * kPi - angle : angle;
  angle = q.x < 0.0 ? kPi - angle : angle;
  return q.y < 0.0 ? -angle : angle;
}

// p moved by delta, at most that many cells. Beside an edge (of v, say) that is one point u is an angle around it: there the step is
// straight in the tangent plane, or it would run around the point.
vec2 moved(vec2 p, vec2 delta, Probe at, float most) {
  vec2 cell = linkCellHalf.xy;
  float size = max(abs(delta.x) / cell.x, abs(delta.y) / cell.y);
  vec2 straight = p + delta * min(1.0, most / max(size, kSmallest));
  if (!kPoles) return straight;
  bool ofU = polesOfU();
  float at_ = ofU ? p.x : p.y, size_ = ofU ? cell.x : cell.y;
  float low = at_ - linkPolesWraps.x, high = linkPolesWraps.y - at_;
  float height = max(min(low, high), 0.0);
  if (height < 3.0 * size_) {
    bool up = low < high;
    // |Su| / |Sv| = height * angle per unit of u.
    vec3 around = ofU ? at.Sv : at.Su, outward = ofU ? at.Su : at.Sv;
    float ratio = sqrt(dot(around, around) / max(dot(outward, outward), kSmallest));
    float rise = ofU ? delta.x : delta.y;
    vec2 step_ = vec2(up ? rise : -rise, ratio * (ofU ? delta.y : delta.x));
    step_ *= min(1.0, most * size_ / max(length(step_), kSmallest));
    vec2 q = vec2(height + step_.x, step_.y);
    float newHeight = length(q);
    float anglePer = ratio / max(height, 1e-6 * size_);
    float turned = anglePer > 0.0 ? angleOf(q) / anglePer : 0.0;
    float moved_ = up ? linkPolesWraps.x + newHeight : linkPolesWraps.y - newHeight;
    return ofU ? vec2(moved_, p.y + turned) : vec2(p.x + turned, moved_);
  }
  return straight;
}

// A cell beyond the domain and no farther: formulas need not exist there.
vec2 nearDomain(vec2 p, float cells) {
  vec2 margin = linkCellHalf.xy * cells;
  vec2 low = linkDomain.xy - margin, high = linkDomain.zw + margin;
  return vec2(linkPolesWraps.z > 0.0 ? p.x : clamp(p.x, low.x, high.x),
              linkPolesWraps.w > 0.0 ? p.y : clamp(p.y, low.y, high.y));
}

bool inDomain(vec2 p) {
  vec2 margin = 1e-6 * (linkDomain.zw - linkDomain.xy);
  bool insideU = linkPolesWraps.z > 0.0 || (p.x >= linkDomain.x - margin.x && p.x <= linkDomain.z + margin.x);
  bool insideV = linkPolesWraps.w > 0.0 || (p.y >= linkDomain.y - margin.y && p.y <= linkDomain.w + margin.y);
  return insideU && insideV;
}

bool converged(Probe at) {
  return at.residual <= linkSpecularTolerance.w + (linkClip.w != 0.0 ? linkClip.y / at.depth : 0.0);
}

const int kFound = 0, kMissed = 1, kLost = 2;

// A Newton step from p that knows the fold. Near one the step leads along it, and what changes on the way is the area
// `det` that a unit of u and v takes in the picture, which vanishes at the fold: linearly, at the rate seen from `last`,
// so that the offset along the step is a quadratic. The root taken is the one on the side searched for, where det has
// its sign. `missed`: there is none, the ray passes by; the step then leads to where it is nearest.
vec2 foldStep(vec2 p, Probe at, float det, float most, vec2 gradient, out bool missed) {
  vec2 delta = vec2(at.fv.x * at.f.y - at.fv.y * at.f.x, at.fu.y * at.f.x - at.fu.x * at.f.y) / det;
  float k = dot(gradient, delta) / det;  // det at the end of the step is (1 + k) det
  float square = 1.0 + 2.0 * k;
  missed = square < 0.0;
  float root = sqrt(max(square, 0.0));
  bool rightSide = det * wantedSide() > 0.0;
  float part = missed ? -1.0 / k : rightSide ? 2.0 / (1.0 + root) : k != 0.0 ? (-1.0 - root) / k : -0.5;
  delta *= part;
  // A vanishing area gives no direction.
  if (!(abs(delta.x) + abs(delta.y) < 1e30)) delta = 0.25 * linkCellHalf.xy;
  return moved(p, delta, at, most);
}

// Finds the point; p and at are its own when found.
int findRoot(Ray ray, out vec2 p, out Probe at) {
  p = linkStart;
  at = probeAt(ray, p);
  float det = area(at);
  vec2 gradient = vec2(0);  // of det, per unit of u and v, along the last step that was long enough to tell
  int start = 0, steps = 0, misses = 0, outside = 0, verdicts = 0;
  float nearest = 1e30;
  int result = kLost;
  // A CPU device runs the whole body of a loop for all pixels at least once and skips no branch: so the step for folds
  // is one for all.
  for (int i = 0; i < kMostSteps; ++i) {
    bool missed;
    vec2 last = p;
    p = nearDomain(foldStep(p, at, det, start > 0 ? kCautiousCells : kBoldCells, gradient, missed), 1.0);
    // A verdict that the ray passes by counts when two searches agree: where folds meet in a cusp one may err.
    bool anew = misses == 2 || steps == (start > 0 ? kCautiousSteps : kBoldSteps);
    start += anew ? 1 : 0;
    steps = anew ? 0 : steps + 1;
    vec2 corner = vec2((start & 2) == 0 ? 0.4 : -0.4, (start & 1) == (start >> 1 & 1) ? 0.4 : -0.4);
    p = anew ? nearDomain(linkStart + corner * linkCellHalf.xy, 0.0) : p;
    at = probeAt(ray, p);
    float before = det;
    det = area(at);
    vec2 way = (p - last) / linkCellHalf.xy;
    float length2 = dot(way, way);
    gradient = anew ? vec2(0) : length2 > 1e-6 ? (det - before) / length2 * way / linkCellHalf.xy : gradient;
    bool inside = inDomain(p), close = converged(at);
    nearest = min(nearest, at.residual);
    misses = missed && !anew && length2 < kSettled * kSettled ? misses + 1 : 0;
    verdicts += misses == 2 ? 1 : 0;
    outside = inside ? 0 : outside + 1;
    if (i > 0 && close && det * wantedSide() > 0.0) result = inside ? kFound : kMissed;
    else if (verdicts == 2 || outside == 4) result = kMissed;
    else if (i + 1 == kMostSteps && close) result = inside && linkClip.z != 0.0 ? kFound : kMissed;
    else if (i + 1 == kMostSteps && nearest > kNear) result = kMissed;
    if (result != kLost) break;
  }
  return result;
}
