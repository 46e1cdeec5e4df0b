// SPDX-License-Identifier: Apache-2.0
// The point of a surface that a pixel sees, where the surface is known as an equation, too (engine/surface/equation.h).
//
// Along the pixel's ray F(p + t way) is a function of one variable, c + 2 b t + a t^2 of a quadric and nearly that of a
// torus near p. F rises at one of its two roots and falls at the other: only one is on the side of the surface searched
// for. One step finds a quadric, whatever the start, and steps that triple the digits a torus, with neither a sine nor a
// derivative.

#include "lib/equation_numbers.glsl"

const float kSettledPart = 0.02;  // of the tube: where the ray is nearest is known once steps are shorter
const float kStride = 0.25;       // of the tube: the first step of following a ray; each next is twice as long
const float kMaxStride = 0.35;   // of the ring
const int kMaxSteps = 24;
const int kWalkSteps = 32;        // from where the ray enters the shell to a torus's root

struct Expansion {
  real c, b, a;
  real3 half_;  // of the gradient
};

real squareOf(Expansion e) { return e.b * e.b - e.a * e.c; }

// Where the parabola is zero and its slope has that sign; where it is nearest to zero if it never is, `square` being
// negative. Of the two ways to write a root that one which cancels nothing.
real rootOf(Expansion e, real square, real rising) {
  real root = rising * sqrt(max(square, 0.0));
  bool alike = e.b * root > 0.0;
  return (alike ? -e.c : root - e.b) / (alike ? e.b + root : e.a);
}

#ifdef LUXO_QUADRIC

// Read once: a driver reads memory as often as it is asked to.
real3 quadricSquares, quadricLinear, quadricCenter, quadricLowest, quadricHighest;
real quadricConstant;

void readEquation() {
  quadricSquares = number3(kQuadricSquares);
  quadricLinear = real3(0, number(kQuadricHalfY), 0);
  quadricConstant = number(kQuadricConstant);
  quadricCenter = real3(0, number(kQuadricCenter), 0);
  quadricLowest = number3(kEquationLowest);
  quadricHighest = number3(kEquationHighest);
}

real3 center() { return quadricCenter; }

// Of a point from the centre on.
Expansion expansionAt(real3 p, real3 way) {
  real3 half_ = quadricSquares * p + quadricLinear;
  return Expansion(dot(p, half_ + quadricLinear) + quadricConstant, dot(half_, way), dot(quadricSquares * way, way), half_);
}

// Cylinders and the like end at heights, others at distances from the axis or, like rectangles, at places. What is
// beyond an edge by less on the screen than the tolerance is the patch's: both straight to there, and along the surface, where dF
// is 0, so that what ends at heights goes on sideways, and the others up or down. (Either may be along the ray, and show nothing
// on the screen. What ends at distances has heights only to tell its sheet, which is the right one but for rounding.) A plane's other root is infinitely far away.
bool isSeen(Ray ray, real3 p) {
  real depth = depthOf(p + center()), radius = sqrt(p.x * p.x + p.z * p.z);
  real3 q = has(kRadial) ? real3(radius, p.y, 0.0) : p;
  real3 beyond = max(max(quadricLowest - q, q - quadricHighest), real3(0));
  if (has(kRadial)) beyond = real3(p.x * beyond.x, radius * beyond.y, p.z * beyond.x) / max(radius, kSmallest);
  real3 gradient = quadricSquares * p + quadricLinear;
  real sideways = has(kRadial) ? 0.0 : gradient.y * beyond.y / max(dot(gradient.xz, gradient.xz), kSmallest);
  real up = dot(gradient.xz, beyond.xz) / (abs(gradient.y) > kSmallest ? gradient.y : kSmallest);
  real3 on = real3(sideways * gradient.x, up, sideways * gradient.z);
  real2 straight = real2(dot(ray.across1, beyond), dot(ray.across2, beyond));
  real2 along = straight - real2(dot(ray.across1, on), dot(ray.across2, on)), most = max(abs(straight), abs(along));
  real onScreen = max(most.x, most.y);
  bool isOnSheet = !has(kRadial) || beyond.y <= 2.4e-7 * (radius + abs(p.y));
  return isOnSheet && onScreen <= toleranceAt(depth) && depth < 1e30 && inDepthRange(depth);
}

// A ray may run around an edge inside the slab: whatever it comes in by, the nearer of both roots is seen.
int findOnRay(Ray ray, real3 way, real metre, real outer, inout real rising, inout real3 p, inout Expansion e) {
  real square = squareOf(e), outerWay = rootOf(e, square, outer), innerWay = rootOf(e, square, -outer);
  real3 outerPoint = p + outerWay * way, innerPoint = p + innerWay * way;
  bool outerSeen = isSeen(ray, outerPoint), innerSeen = has(kShowsBack) && isSeen(ray, innerPoint);
  bool isOuter = outerSeen && !(innerSeen && innerWay < outerWay);
  rising = isOuter ? outer : -outer;
  p = isOuter ? outerPoint : innerPoint;
  e = expansionAt(p, way);
  // What the first step's differences of large numbers have lost. Where the ray grazes there is nothing to gain.
  real root = rising * sqrt(max(squareOf(e), 0.0));
  if (e.b * root > 0.0) p -= e.c / (e.b + root) * way;
  e = expansionAt(p, way);
  return square >= 0.0 && (outerSeen || innerSeen) ? kFound : kMissed;
}

real3 startOfSearch() { return real3(0); }

// Both are known.
bool leavesBehind(real3 p, Expansion e, real metre) { return true; }

// No other root is on that side.
bool isFirst(real3 entry, real3 p, real3 way, Expansion e) { return true; }
real mostBend(Expansion e, real3 p) { return abs(e.a); }

#else

real3 center() { return real3(0); }

real torusRing, torusTube;

void readEquation() {
  torusRing = number(kTorusRing);
  torusTube = number(kTorusTube);
}

// F = (distance from the axis - ring)^2 + y^2 - tube^2: unlike the quartic it loses no digits.
Expansion expansionAt(real3 p, real3 way) {
  real radius2 = max(dot(p.xz, p.xz), kSmallest), perRadius = inversesqrt(radius2);
  real2 outward = p.xz * perRadius;
  real off = radius2 * perRadius - torusRing, rate = dot(outward, way.xz);
  real3 half_ = real3(off * outward.x, p.y, off * outward.y);
  real turning = dot(way.xz, way.xz) - rate * rate;  // squared
  return Expansion(off * off + (p.y - torusTube) * (p.y + torusTube), dot(half_, way),
                   rate * rate + off * turning * perRadius + way.y * way.y, half_);
}

// A ray that leaves, or passes by, may meet the surface farther on as long as it is in the slab: it is followed.
int findOnRay(Ray ray, real3 way, real metre, real outer, inout real rising, inout real3 p, inout Expansion e) {
  real most = sqrt(torusTube * torusRing), stride = kStride * torusTube;
  real slab = varyingClip.z * metre;
  real outsideSlab = slab * (2.0 * torusTube + (rising < 0.0 ? slab : -min(slab, torusTube)));  // from |F| on
  real far = 2.0 * toleranceAt(depthOf(p)) * metre * torusTube, last = 0.0;
  bool wasGood = false, follows = false;
  // Entering, and dipping deeper than the slab, the ray leaves that before it comes out: another fragment's.
  real depth = min(slab, torusTube), bottom = depth * (2.0 * torusTube - depth);
  if (rising > 0.0 && e.c > 0.0 && e.b < 0.0 && squareOf(e) > e.a * bottom) return kMissed;
  for (int i = 0; i < kMaxSteps; ++i) {
    if (ends(abs(e.c) <= far && e.b * rising > 0.0, abs(e.c) <= kFine * far, wasGood)) return kFound;
    real square = squareOf(e), t = rootOf(e, square, rising);
    bool leaves = e.c * rising < 0.0 && e.b * rising <= 0.0;
    bool passes = square < 0.0 && abs(t) < kSettledPart * torusTube;
    follows = passes || (leaves && (follows || i == 0));
    if ((follows && leaves && abs(e.c) > outsideSlab) || (passes && e.c * rising > 0.0)) return kMissed;
    if (t * last < 0.0 && abs(t) > most) most *= 0.5;  // or it might go to and fro for ever
    last = follows ? stride : clamp(t, -most, most);
    if (follows) stride = min(2.0 * stride, kMaxStride * torusRing);
    p += last * way;
    e = expansionAt(p, way);
  }
  return kLost;
}

real3 startOfSearch() { return real3(startAtEntry()); }

// A bound of `a` around a point, as far as half its distance from the axis: |way| is 1, and there the distance is at least
// half of what it is, the ring no farther off than it is and half of it.
real mostBend(Expansion e, real3 p) {
  real radius = sqrt(p.x * p.x + p.z * p.z);
  return 2.0 + 2.0 * abs(radius - torusRing) / max(radius, kSmallest);
}

// Whether the ray leaves the slab behind a root before it can meet the torus again: t behind it |F| is at least
// 2 b t - B t^2, as at isFirst().
bool leavesBehind(real3 p, Expansion e, real metre) {
  real slab = varyingClip.z * metre, inside = min(slab, torusTube);
  real height = e.b > 0.0 ? slab * (2.0 * torusTube + slab) : inside * (2.0 * torusTube - inside), most = height / max(abs(e.b), kSmallest);
  real radius = length(p.xz), least = max(radius - most, kSmallest);
  real bend = e.b > 0.0 ? max(torusRing - least, 0.0) / least : 1.0 + (abs(radius - torusRing) + most) / least;
  return bend * height < e.b * e.b;
}

// Whether the ray has met the torus nowhere between `entry`, where it has come into the shell, and its root p. A root that
// is nearer to the eye than the entry hides what is farther. Else the way is walked from the entry.
//
// Theorem: where F has the value c, and c > 0, and the slope 2 b along a way, it has no zero nearer than
// c / (sqrt(b^2 + B c) - b), if half its second derivative is at least -B; and before a zero p at which it falls with the
// slope -2 b there is none nearer to p than 2 b / B. Of -F the same is true, if half its second derivative is at most B.
// Proof: F >= c + 2 b t - B t^2; and, s before p, F >= 2 b s - B s^2. Half its second derivative, the `a` of an expansion, is
// at least -(ring - r) / r, or 0, and at most 1 + |r - ring| / r, r being the distance from the axis; on the way that is no
// less than the lesser of both ends but half the way, and no farther from the ring than the farther of both and half.
bool isFirst(real3 entry, real3 p, real3 way, Expansion e) {
  real far = dot(p - entry, way), left = abs(far);
  real3 onward = far < 0.0 ? -way : way;
  Expansion at = expansionAt(entry, onward);
  real side = at.c < 0.0 ? -1.0 : 1.0, radiusHere = length(entry.xz), radiusThere = length(p.xz);
  real least = max(min(radiusHere, radiusThere) - 0.5 * left, kSmallest);
  real farthest = max(abs(radiusHere - torusRing), abs(radiusThere - torusRing)) + 0.5 * left;
  real bend = side < 0.0 ? 1.0 + farthest / least : max(torusRing - least, 0.0) / least;
  left -= 2.0 * max(-side * dot(e.half_, onward), 0.0) / max(bend, kSmallest);
  bool first = gl_FrontFacing && far <= 0.0;
  real3 q = entry;
  for (int i = 0; i < kWalkSteps && !first; ++i) {
    real c = side * at.c, b = side * at.b, step_ = max(c, 0.0) / max(sqrt(max(b * b + bend * c, 0.0)) - b, kSmallest);
    left -= step_;
    first = left <= 0.0 && dot(e.half_, onward) * side < 0.0;
    q += step_ * onward;
    at = expansionAt(q, onward);
  }
  return first;
}

#endif

// Where the outer side faces, from the gradient: by the cofactors of the matrix, which mirrors what the matrix mirrors.
vec3 outwardOf(vec3 gradient) {
  gradient /= max(max(max(abs(gradient.x), abs(gradient.y)), abs(gradient.z)), kSmallest);
  vec3 x = varyingRelative[0].xyz, y = varyingRelative[1].xyz, z = varyingRelative[2].xyz;
  vec3 n = cross(y, z) * gradient.x + cross(z, x) * gradient.y + cross(x, y) * gradient.z;
  return isMirrored() ? -n : n;
}

int rootOfPixel(out Root root) {
  readSurface();
  if (isLeftOut()) return kMissed;
  readEquation();
  Ray ray = rayOfPixel();
  // Begins where the ray is nearest to a point: of a torus the shell's, of a quadric the centre, so that it is found to
  // the same bits whatever the ray comes in by. In metres: a pixel is `metre` wide, times the depth.
  real metre = inversesqrt(max(dot(ray.across1, ray.across1), dot(ray.across2, ray.across2)));
  real3 across1 = ray.across1 * metre, across2 = ray.across2 * metre, along = cross(across1, across2);
  real perLength = inversesqrt(dot(along, along));
  real3 near = startOfSearch();
  real2 f = offsetOf(ray, center() + near) * metre;
  real3 start = near + cross(along, f.x * across2 - f.y * across1) * (perLength * perLength), p = start;
  // Away from the viewer; of what is flattened, too, where depths do not tell.
  real3 way = along * (isMirrored() ? -perLength : perLength);

  // The sign of F's slope where the ray meets the outer side, and where it meets the side searched for.
  real outer = has(kRisesOutward) ? -1.0 : 1.0, rising = gl_FrontFacing != has(kBackSide) ? outer : -outer;
  Expansion e = expansionAt(start, way);
  int result = findOnRay(ray, way, metre, outer, rising, p, e);
  root.S = center() + p;
  root.parameters = vec2(parameterOf(root.S, kEquationU), parameterOf(root.S, kEquationV));
  root.outward = outwardOf(vec3(has(kRisesOutward) ? e.half_ : -e.half_));
  root.front = rising == outer;
  root.depth = depthOf(root.S);
  // Of the nearest point of the surface.
  f = offsetOf(ray, root.S - e.half_ * (0.5 * e.c / max(dot(e.half_, e.half_), kSmallest)));
  real off = max(abs(f.x), abs(f.y));
  root.residual = float(off / widthAt(root.depth));
#ifdef LUXO_TEXTURED
  // Along the tangent plane.
  vec3 n = vec3(e.half_), a = vec3(ray.across1), b = vec3(ray.across2), right = cross(b, n), below = cross(n, a);
  float perDeterminant = float(widthAt(root.depth)) / dot(a, right);
  setFootprint(root.S, right * perDeterminant, below * perDeterminant);
#endif
#if defined(LUXO_FRAMED) || defined(LUXO_FINDS_FRAME)
  setFrame(root.S, vec3(e.half_), root.outward);
#endif
  // Newton-Kantorovich, of one variable. A quadric's one step need not come within the tolerance.
  root.certified = mostBend(e, p) * abs(e.c) <= 0.5 * e.b * e.b && isFirst(start, p, way, e) && off <= toleranceAt(root.depth);
  // The back of what shows only its front: the ray goes on through it.
  if (kFrontOnly && result == kFound && !root.front) return root.certified && leavesBehind(p, e, metre) ? kMissed : kLost;
  return result;
}
