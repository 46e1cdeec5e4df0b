// SPDX-License-Identifier: Apache-2.0
// The point of a surface that a pixel sees: Newton's method on the pixel's ray, from where it enters the hull.
//
// With the ray's pixel (qx, qy) the offset f(u, v) = (X - qx w, Y - qy w)(S(u, v)) vanishes where S is on the ray;
// |f| / w is how far S is from the pixel's centre on the screen. Two plain steps find nearly every pixel. Where they do
// not, the ray grazes the surface: the offset folds there, two roots lie close to each other or have just vanished, and
// Newton's step, which knows only the slope, misses them. There the search goes on with steps that solve a quadratic
// along the direction in which the fold lies, and that know which of its two roots is on the side that is seen.
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

const int kMostSteps = 10;
const float kMostCells = 4.0;      // a step is no longer
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

// p moved by delta, at most a few cells. Beside an edge (of v, say) that is one point u is an angle around it: there the step is
// straight in the tangent plane, or it would run around the point.
vec2 moved(vec2 p, vec2 delta, Probe at) {
  vec2 cell = linkCellHalf.xy;
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
    step_ *= min(1.0, kMostCells * size_ / max(length(step_), kSmallest));
    vec2 q = vec2(height + step_.x, step_.y);
    float newHeight = length(q);
    float anglePer = ratio / max(height, 1e-6 * size_);
    float turned = anglePer > 0.0 ? atan(q.y, q.x) / anglePer : 0.0;
    float moved_ = up ? linkPolesWraps.x + newHeight : linkPolesWraps.y - newHeight;
    return ofU ? vec2(moved_, p.y + turned) : vec2(p.x + turned, moved_);
  }
  float size = max(abs(delta.x) / cell.x, abs(delta.y) / cell.y);
  return p + delta * min(1.0, kMostCells / max(size, kSmallest));
}

vec2 newtonStep(vec2 p, Probe at) {
  float det = at.fu.x * at.fv.y - at.fu.y * at.fv.x;
  vec2 delta = vec2(at.fv.x * at.f.y - at.fv.y * at.f.x, at.fu.y * at.f.x - at.fu.x * at.f.y) / det;
  // A vanishing area gives no direction.
  if (!(abs(delta.x) + abs(delta.y) < 1e30)) delta = vec2(0);
  return moved(p, delta, at);
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

// A step that knows the fold: see above. `missed`: the ray passes by, as far as the quadratic knows.
vec2 foldStep(Ray ray, vec2 p, Probe at, float reach, out bool missed) {
  // Lengths on the surface instead of parameters, so that no scale of theirs looks like a fold.
  vec2 perLength = vec2(inversesqrt(max(dot(at.Su, at.Su), kSmallest)), inversesqrt(max(dot(at.Sv, at.Sv), kSmallest)));
  vec2 ju = at.fu * perLength.x, jv = at.fv * perLength.y;
  // Right singular vectors: `steep`, along which the offset changes most, and `fold`, along which it changes least.
  float half_ = 0.5 * (dot(ju, ju) - dot(jv, jv)), mixed = dot(ju, jv);
  float root = sqrt(half_ * half_ + mixed * mixed);
  vec2 steep = half_ > 0.0 ? vec2(half_ + root, mixed) : vec2(mixed, root - half_);
  steep *= inversesqrt(max(dot(steep, steep), kSmallest));
  vec2 fold = vec2(-steep.y, steep.x);
  vec2 image = ju * steep.x + jv * steep.y;
  float size = max(length(image), kSmallest);
  vec2 along = image / size, across = vec2(-along.y, along.x);
  vec2 foldImage = ju * fold.x + jv * fold.y;
  float slope = dot(across, foldImage), value = dot(across, at.f);
  // The second derivative along the fold, by a look at a point on it.
  vec2 look = fold * perLength;
  float far = reach / max(max(abs(look.x) / linkCellHalf.x, abs(look.y) / linkCellHalf.y), kSmallest);
  vec2 there = nearDomain(p + far * look, 0.0);
  far = dot(there - p, look) / dot(look, look);
  if (abs(far) < 1e-3 * reach) {  // at the end of the domain: the other way
    there = nearDomain(p - reach * look, 0.0);
    far = dot(there - p, look) / dot(look, look);
  }
  vec2 h = 2.0 * (probeAt(ray, there).f - at.f - far * foldImage) / (far * far);
  float bend = dot(across, h);
  float square = slope * slope - 2.0 * bend * value;
  missed = square < 0.0;
  float wanted = sign(linkSides.x) * sqrt(max(square, 0.0));  // the slope at the root on the side searched for
  float s = slope * wanted > 0.0 ? -2.0 * value / (slope + wanted) : (wanted - slope) / bend;
  float most = 2.0 * far / reach;
  s = abs(s) < 1e30 ? clamp(s, -abs(most), abs(most)) : 0.0;
  float t = -dot(along, at.f + 0.5 * s * s * h) / size;
  return nearDomain(moved(p, (s * fold + t * steep) * perLength, at), 1.0);
}

// Finds the point; p and at are its own when found.
int findRoot(Ray ray, out vec2 p, out Probe at) {
  p = linkStart;
  at = probeAt(ray, p);
  p = nearDomain(newtonStep(p, at), 1.0);
  at = probeAt(ray, p);
  p = nearDomain(newtonStep(p, at), 1.0);
  at = probeAt(ray, p);
  if (converged(at) && side(at) > 0.0) return inDomain(p) ? kFound : kMissed;

  p = nearDomain(linkStart, 0.0);
  at = probeAt(ray, p);
  int misses = 0, outside = 0;
  float reach = 0.25;
  for (int i = 0; i < kMostSteps; ++i) {
    bool missed;
    p = foldStep(ray, p, at, reach, missed);
    at = probeAt(ray, p);
    if (converged(at) && side(at) > 0.0) return inDomain(p) ? kFound : kMissed;
    misses = missed ? misses + 1 : 0;
    outside = inDomain(p) ? 0 : outside + 1;
    if (misses == 3 || outside == 3) return kMissed;
    reach = max(0.5 * reach, 0.02);
  }
  if (converged(at)) return inDomain(p) && linkClip.z != 0.0 ? kFound : kMissed;
  return kLost;
}
