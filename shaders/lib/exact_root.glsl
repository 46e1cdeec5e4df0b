// SPDX-License-Identifier: Apache-2.0
// The point of a surface that a pixel sees: Newton's method on the pixel's ray, from where it enters the hull.
//
// With the ray's pixel (qx, qy) the offset f(u, v) = (X - qx w, Y - qy w)(S(u, v)) vanishes where S is on the ray;
// |f| / w is how far S is from the pixel's centre on the screen. Newton's method finds nearly every pixel in two steps.
// Where the ray grazes the surface the offset folds: two roots lie close to each other or have just vanished, and
// Newton's step, which knows only the slope, misses them. Steps after the first know the fold, too.
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

// Twice the area that a unit of u and v takes on the screen, signed: positive on the side that is searched for.
float side(Probe at) { return (at.fu.x * at.fv.y - at.fu.y * at.fv.x) * linkSides.x; }

bool polesOfU() { return abs(linkSides.y) > 1.5; }

layout(constant_id = 6) const bool kPoles = true;  // whether an edge of a patch is one point

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
    float turned = anglePer > 0.0 ? atan(q.y, q.x) / anglePer : 0.0;
    float moved_ = up ? linkPolesWraps.x + newHeight : linkPolesWraps.y - newHeight;
    return ofU ? vec2(moved_, p.y + turned) : vec2(p.x + turned, moved_);
  }
  return straight;
}

vec2 newtonStep(vec2 p, Probe at) {
  float det = at.fu.x * at.fv.y - at.fu.y * at.fv.x;
  vec2 delta = vec2(at.fv.x * at.f.y - at.fv.y * at.f.x, at.fu.y * at.f.x - at.fu.x * at.f.y) / det;
  // A vanishing area gives no direction.
  if (!(abs(delta.x) + abs(delta.y) < 1e30)) delta = vec2(0);
  return moved(p, delta, at, kBoldCells);
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

// A Newton step from p that knows the fold: along the direction in which the offset changes least it solves a quadratic,
// whose curvature `bend` it has from the change of the Jacobian since `before`, at `last`, and takes the root on the side
// searched for. `missed`: there is none, the ray passes by; the step then leads to where it is nearest.
vec2 foldStep(vec2 last, Probe before, vec2 p, Probe at, float most, inout vec2 bend, out bool missed) {
  // Lengths on the surface instead of parameters, so that no scale of theirs looks like a fold.
  vec2 lengths = sqrt(max(vec2(dot(at.Su, at.Su), dot(at.Sv, at.Sv)), kSmallest)), perLength = 1.0 / lengths;
  vec2 ju = at.fu * perLength.x, jv = at.fv * perLength.y;
  // Right singular vectors: `steep`, along which the offset changes most, and `fold`, along which it changes least.
  float half_ = 0.5 * (dot(ju, ju) - dot(jv, jv)), mixed = dot(ju, jv);
  float root = sqrt(half_ * half_ + mixed * mixed);
  vec2 steep = half_ > 0.0 ? vec2(half_ + root, mixed) : vec2(mixed, root - half_);
  steep *= inversesqrt(max(dot(steep, steep), kSmallest));
  vec2 fold = vec2(-steep.y, steep.x);
  vec2 image = ju * steep.x + jv * steep.y;
  float steepness = inversesqrt(max(dot(image, image), kSmallest));  // its reciprocal
  vec2 along = image * steepness, across = vec2(-along.y, along.x);
  float slope = dot(across, ju * fold.x + jv * fold.y), value = dot(across, at.f);

  // How the image of the fold changes per length along it, if the last step went along it and was not too short to tell;
  // else as it was.
  vec2 look = fold * perLength, way = (p - last) * lengths;
  float far = dot(way, fold);
  vec2 change = (at.fu - before.fu) * look.x + (at.fv - before.fv) * look.y;
  float cell = 1.0 / max(max(abs(look.x) / linkCellHalf.x, abs(look.y) / linkCellHalf.y), kSmallest);
  bool known = abs(far) > 1e-3 * cell && far * far > 0.05 * dot(way, way);
  bend = known ? change / far : bend;
  float bendAcross = dot(across, bend);
  float square = slope * slope - 2.0 * bendAcross * value;
  missed = square < 0.0;
  float wanted = sign(linkSides.x) * sqrt(max(square, 0.0));  // the slope at the root on the side searched for
  bool rightSide = slope * wanted > 0.0;
  // On the wrong side without an idea where the other one is: a look along the fold.
  float s = rightSide ? -2.0 * value / (slope + wanted) : bendAcross != 0.0 ? (wanted - slope) / bendAcross : 0.25 * cell;
  s = abs(s) < 1e30 ? clamp(s, -0.5 * most * cell, 0.5 * most * cell) : 0.0;
  float t = -dot(along, at.f + 0.5 * s * s * bend) * steepness;
  return moved(p, (s * fold + t * steep) * perLength, at, most);
}

// Finds the point; p and at are its own when found.
int findRoot(Ray ray, out vec2 p, out Probe at) {
  vec2 last = linkStart;
  Probe before = probeAt(ray, last);
  p = nearDomain(newtonStep(last, before), 1.0);
  at = probeAt(ray, p);
  vec2 bend = vec2(0);
  int misses = 0, outside = 0;
  float nearest = at.residual;
  int result = kLost;
  // A CPU device runs every loop at least once and skips no branch, so that the second step is the loop's first.
  for (int i = 0; i < kMostSteps; ++i) {
    bool missed;
    int turn = i - kBoldSteps;
    bool anew = turn >= 0 && turn % kCautiousSteps == 0;
    vec2 corner = vec2(turn < 2 * kCautiousSteps ? 0.4 : -0.4, turn / kCautiousSteps % 2 == 0 ? 0.4 : -0.4);
    vec2 next = nearDomain(foldStep(last, before, p, at, turn >= 0 ? kCautiousCells : kBoldCells, bend, missed), 1.0);
    last = p;
    before = at;
    p = anew ? nearDomain(linkStart + corner * linkCellHalf.xy, 0.0) : next;
    bend = anew ? vec2(0) : bend;
    at = probeAt(ray, p);
    bool inside = inDomain(p), close = converged(at);
    nearest = min(nearest, at.residual);
    vec2 way = abs(p - last) / linkCellHalf.xy;
    misses = missed && !anew && max(way.x, way.y) < kSettled ? misses + 1 : 0;
    outside = inside ? 0 : outside + 1;
    if (close && side(at) > 0.0) result = inside ? kFound : kMissed;
    else if (misses == 2 || outside == 4) result = kMissed;
    else if (i + 1 == kMostSteps && close) result = inside && linkClip.z != 0.0 ? kFound : kMissed;
    else if (i + 1 == kMostSteps && nearest > kNear) result = kMissed;
    if (result != kLost) break;
  }
  return result;
}
