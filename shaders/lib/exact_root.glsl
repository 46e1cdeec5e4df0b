// SPDX-License-Identifier: Apache-2.0
// The point of a surface that a pixel sees: Newton's method on the pixel's ray, from where it enters the shell.
//
// Newton's method on the offset f(u, v) of S(u, v) finds nearly every pixel in two steps. Where the ray grazes the
// surface the offset folds: two roots lie close to each other or have just vanished, and Newton's step, which knows only
// the slope, misses them. Steps after the first know the fold, too (foldStep).

const int kPlainSteps = 9, kNearSteps = 9;
const float kSettled = 0.05;    // cells: where the ray is nearest is known once steps are shorter
const float kBoldCells = 4.0;   // how many cells a step may lead
const float kTraceStep = 0.35;   // cells: a step of a trace,
const float kTraceGrowth = 1.6;  // how many times as long the next one is where the surface bends steadily,
const float kTraceMax = 4.0;    // the longest,
const float kTraceMin = 0.02;   // and the shortest
const float kBothEnds = 1.7;    // of what is clear ahead of a step: some is clear before its end, too
const float kSteady = 0.1;      // of the offset: what the slopes at both ends of a step say of it may be wrong by that
const float kFollows = 0.8;      // of what the trace moves along the ray: so much the point that it is nearest to does, too,
const float kFollowsShort = 0.3; // and in a step that is no longer than half of kTraceStep so much
const int kTraceSteps = 42;     // of a trace, both ways
const float kBehind = 0.7;      // cells: so far it looks against the ray, if at all
const float kBeyond = 1.0;      // cells beyond the domain that a trace looks at
const float kAlike = 0.5;       // of two areas: between places that differ by no more there is no fold
const float kBesideEdge = 2e-4;  // cells: a trace begins no nearer to an edge; some 0.005 pixels
const int kAttempts = 3;        // to find a root, all but the first by a trace; one more takes what is held
const int kPolishSteps = 14;    // near double roots they converge slowly
const float kNearPixels = 0.5;  // what is farther from the ray after these steps is no root
const float kNearCells = 0.25;  // nor what is farther outside of the patch
const float kAtBorder = 0.02;   // cells: what begins no farther inside has come in past the border
const int kWalkSteps = 32;      // from where a search began to its root: half of them leave 20 pixels more of the teapot to rays
// Cells: nearer to an edge that is one point no search goes, as there is no normal there. Less than its tolerance.
#ifdef LUXO_DOUBLE
const real kBesidePole = 1e-8;
#else
const real kBesidePole = 1e-6;
#endif

// The surface at some (u, v), and where that is from the ray.
struct Probe {
  real3 S, Su, Sv;
  real2 f, fu, fv;
  real depth;
};

Probe probeAt(Ray ray, real2 p) {
  Probe at;
  surfaceAt(p.x, p.y, at.S, at.Su, at.Sv);
  at.f = offsetOf(ray, at.S);
  at.fu = real2(dot(ray.across1, at.Su), dot(ray.across2, at.Su));
  at.fv = real2(dot(ray.across1, at.Sv), dot(ray.across2, at.Sv));
  at.depth = depthOf(at.S);
  return at;
}

// In units of f, as all that follows: a division by the width is what a search would wait for most of its time.
real offset(Probe at) { return max(abs(at.f.x), abs(at.f.y)); }

real tolerance(Probe at) { return toleranceAt(at.depth); }

// Never, where the formula has no value.
bool converged(Probe at) { return widthAt(at.depth) > 0.0 && offset(at) <= tolerance(at); }

// The area that a unit of u and v takes on the screen, signed.
real area(Probe at) { return at.fu.x * at.fv.y - at.fu.y * at.fv.x; }

// The sign of that area on the side of the surface that the shell is seen from; and on the side searched for: that one, or,
// past a border, the other.
real shellSide() { return gl_FrontFacing != has(kNegative) ? 1.0 : -1.0; }
real wantedSide;

// Whether a ray that runs past a border of the surface may see its other side, or, through that, what is farther on.
bool seesPastBorder() { return (has(kShowsBack) || kFrontOnly) && has(kBordered); }

layout(constant_id = kConstantPoles) const bool kPoles = true;  // whether an edge of a patch is one point
// Whether a root that is not the first for certain is walked to: all of grazing triangles are, and some transversal ones.
layout(constant_id = kConstantWalks) const bool kWalks = true;

// Whether a root is on the back of what shows only its front: the ray goes on through it.
bool isPassed(Probe at) { return kFrontOnly && (area(at) < 0.0) != (has(kNegative) != has(kBackSide)); }

// The angle of a direction, to half a hundredth: small ones far better.
real angleOf(real2 q) {
  real2 a = abs(q);
  real z = min(a.x, a.y) / max(max(a.x, a.y), kSmallest);
  real angle = z / (1.0 + 0.28 * z * z);
  angle = a.y > a.x ? 0.5 * kPi - angle : angle;
  angle = q.x < 0.0 ? kPi - angle : angle;
  return q.y < 0.0 ? -angle : angle;
}

// p moved by delta, at most that many cells. Beside an edge (of v, say) that is one point u is an angle around it: there
// the step is straight in the tangent plane, or it would run around the point.
real2 moved(real2 p, real2 delta, Probe at, real most) {
  real2 cell = varyingCellHalf.xy;
  real size = max(abs(delta.x) / cell.x, abs(delta.y) / cell.y);
  real2 straight = p + delta * min(1.0, most / max(size, kSmallest));
  if (!kPoles) return straight;
  bool ofU = has(kPolesOfU);
  real at_ = ofU ? p.x : p.y, size_ = ofU ? cell.x : cell.y;
  real lowest = ofU ? patchDomain.x : patchDomain.y, highest = ofU ? patchDomain.z : patchDomain.w;
  real low = has(kPoleLow) ? at_ - lowest : 1e30, high = has(kPoleHigh) ? highest - at_ : 1e30;
  real height = max(min(low, high), 0.0);
  if (height < 3.0 * size_) {
    bool up = low < high;
    // |Su| / |Sv| = height * angle per unit of u.
    real3 around = ofU ? at.Sv : at.Su, outward = ofU ? at.Su : at.Sv;
    real ratio = sqrt(dot(around, around) / max(dot(outward, outward), kSmallest));
    real rise = ofU ? delta.x : delta.y;
    real2 step_ = real2(up ? rise : -rise, ratio * (ofU ? delta.y : delta.x));
    step_ *= min(1.0, most * size_ / max(length(step_), kSmallest));
    real2 q = real2(height + step_.x, step_.y);
    real newHeight = max(length(q), kBesidePole * size_);  // at the point itself there is no normal
    real anglePer = ratio / max(height, kBesidePole * size_);
    real turned = anglePer > 0.0 ? angleOf(q) / anglePer : 0.0;
    real moved_ = up ? lowest + newHeight : highest - newHeight;
    return ofU ? real2(moved_, p.y + turned) : real2(p.x + turned, moved_);
  }
  return straight;
}

// A cell beyond the domain and no farther: formulas need not exist there.
real2 nearDomain(real2 p, real cells) {
  real2 margin = varyingCellHalf.xy * cells;
  real2 low = patchDomain.xy - margin, high = patchDomain.zw + margin;
  return real2(has(kWrapsU) ? p.x : clamp(p.x, low.x, high.x),
              has(kWrapsV) ? p.y : clamp(p.y, low.y, high.y));
}

// An edge may be a cusp: there the surface has no normal, beside it one.
real2 besideEdges(real2 p) {
  real2 margin = varyingCellHalf.xy * kBesideEdge, inside = clamp(p, patchDomain.xy + margin, patchDomain.zw - margin);
  return real2(has(kWrapsU) ? p.x : inside.x, has(kWrapsV) ? p.y : inside.y);
}

// How much the offset's derivatives, each per cell, change over a cell, at most.
real changeOfOffset(Ray ray) {
  return varyingViewerSecond.w * sqrt(dot(ray.across1, ray.across1) + dot(ray.across2, ray.across2));
}

// How many cells p is beyond the domain; below 0 inside.
real cellsBeyond(real2 p) {
  real2 beyond = max(patchDomain.xy - p, p - patchDomain.zw) / varyingCellHalf.xy;
  return max(has(kWrapsU) ? -1.0 : beyond.x, has(kWrapsV) ? -1.0 : beyond.y);
}

// Whether the point is the patch's. What is beyond an edge by less on the screen than the search's tolerance is on it.
bool inDomain(real2 p, Probe at) {
  real2 beyond = max(max(patchDomain.xy - p, p - patchDomain.zw), real2(0));
  beyond = real2(has(kWrapsU) ? 0.0 : beyond.x, has(kWrapsV) ? 0.0 : beyond.y);
  real2 onScreen = beyond.x * at.fu + beyond.y * at.fv;
  return max(abs(onScreen.x), abs(onScreen.y)) <= tolerance(at);
}

real cellsFromStart(real2 p) {
  real2 way = abs(p - startAtEntry().xy) / varyingCellHalf.xy;
  return max(way.x, way.y);
}

// To where the offset would vanish if it were linear; `det` is area(at).
real2 newtonStep(Probe at, real det) {
  return real2(at.fv.x * at.f.y - at.fv.y * at.f.x, at.fu.y * at.f.x - at.fu.x * at.f.y) * (1.0 / det);
}

// A Newton step from p that knows the fold. Near one the step leads along it, and what changes on the way is the area
// `det` that a unit of u and v takes in the picture, which vanishes at the fold: linearly, at the rate seen from `last`,
// so that the offset along the step is a quadratic. The root taken is the one on the side searched for, where det has
// its sign. `missed`: there is none, the ray passes by; the step then leads to where it is nearest.
real2 foldStep(real2 p, Probe at, real det, real most, real2 gradient, out bool missed) {
  real2 delta = newtonStep(at, det);
  real k = dot(gradient, delta) / det;  // det at the end of the step is (1 + k) det
  real square = 1.0 + 2.0 * k;
  missed = square < 0.0;
  real root = sqrt(max(square, 0.0));
  bool rightSide = det * wantedSide > 0.0;
  real part = missed ? -1.0 / k : rightSide ? 2.0 / (1.0 + root) : k != 0.0 ? (-1.0 - root) / k : -0.5;
  delta *= part;
  // A vanishing area gives no direction.
  if (!(abs(delta.x) + abs(delta.y) < 1e30)) delta = 0.25 * varyingCellHalf.xy;
  return moved(p, delta, at, most);
}

// The point where no ray grazes the surface, so that only one is near.
int findPlainRoot(Ray ray, out real2 p, out Probe at) {
  p = startAtEntry().xy;
  bool wasGood = false;
  for (int i = 0;; ++i) {
    at = probeAt(ray, p);
    if (i > 0 && ends(converged(at), offset(at) <= kFine * tolerance(at), wasGood) || i == kPlainSteps) break;
    p += newtonStep(at, area(at));
  }
  bool root = cellsFromStart(p) <= kFarCells && converged(at) && area(at) * shellSide() > 0.0;
  return root ? (inDomain(p, at) ? kFound : kMissed) : kLost;
}

// A place on the curve along which a trace looks for roots: the points of the surface to which those of the ray are
// nearest.
struct Sample {
  real2 p;
  real g, slope;  // how far behind the surface the ray is, as the shell's side sees it, and how that grows along the curve,
                  // per cell
  real depth, reached;  // of the place, and of the ray's own point, whose nearest it is
  real2 way;      // unit, along the curve, cells
  real across, tilt;  // how fast, per cell across the curve, the offset along the fold grows; and by what part of that g does
  real slack;     // what g may be off by, as the curve is a Newton step away that knows the slopes alone
};

// Which way along the curve leads away from the viewer.
real senseOf(Ray ray) { return dot(rowDepth.xyz, cross(ray.across1, ray.across2)) < 0.0 ? 1.0 : -1.0; }

// The sample next to p, a Newton step away: there the offset along the fold, across the normal on the screen, vanishes.
Sample sampleAt(Ray ray, real2 p, Probe at, real sense, real k) {
  real3 n = cross(at.Su, at.Sv);
  real2 normal = real2(dot(ray.across1, n), dot(ray.across2, n));
  real largest = max(abs(normal.x), abs(normal.y));
  real onScreen = largest * length(normal / max(largest, kSmallest));
  normal = largest > 0.0 ? normalize(normal / largest) : real2(0, 1);
  real2 along = real2(normal.y, -normal.x), across = normal * (shellSide() * sense);
  real2 a = at.fu * varyingCellHalf.x, b = at.fv * varyingCellHalf.y;
  real2 rate = real2(dot(along, a), dot(along, b));
  real perRate = inversesqrt(max(dot(rate, rate), kSmallest));
  real2 correction = rate * (-dot(along, at.f) * perRate * perRate);
  real size = length(correction);
  correction *= min(1.0, 0.5 / max(size, kSmallest));
  Sample s;
  s.way = real2(-rate.y, rate.x) * (perRate * sense);
  s.p = p + correction * varyingCellHalf.xy;
  s.g = dot(across, at.f + a * correction.x + b * correction.y);
  s.slope = dot(across, a * s.way.x + b * s.way.y);
  s.depth = at.depth;
  s.reached = at.depth - s.g * shellSide() * sense * dot(rowDepth.xyz, n) / max(onScreen, kSmallest);
  s.across = 1.0 / perRate;
  s.tilt = abs(dot(across, a * rate.x + b * rate.y)) * perRate * perRate;
  // A step of c cells is off by K c^2 / 2, and the curve that far beside it: by that over 3/4 a, in which g grows by tilt a.
  s.slack = size > 0.5 ? 1e30 : 1.2 * k * size * size * (1.0 + s.tilt);
  return s;
}

// How many cells along the curve, ahead of a sample (`sense` 1) or before it (-1), the ray certainly does not meet the
// surface: until a parabola with the height and the slope there and the theorem's second derivative (at `certified`) is 0.
real clearance(Sample s, real sense, real k) {
  real height = max(abs(s.g) - s.slack, 0.0), rise = s.g > 0.0 ? sense * s.slope : -sense * s.slope, bend = 1.5 * k * (1.0 + s.tilt);
  real root = sqrt(rise * rise + 2.0 * bend * height);
  real way = rise > 0.0 ? (rise + root) / max(bend, kSmallest) : 2.0 * height / max(root - rise, kSmallest);
  return min(way, 0.25 * s.across / max(k, kSmallest));
}

// Where between two samples g changes its sign, 0 to 1: by the parabola through both with the slope of the first.
real crossing(Sample low, Sample high, real way) {
  real b = low.slope * way, c = high.g - low.g - b;
  real root = sqrt(max(b * b - 4.0 * c * low.g, 0.0));
  return clamp(2.0 * abs(low.g) / max(low.g > 0.0 ? root - b : root + b, kSmallest), 0.0, 1.0);
}

// Where ahead of a sample g is 0 by what is known there: 0 to 1, or -1.
real ahead(Sample s, real way) {
  real part = -s.g / max(s.slope * way, kSmallest);
  return s.g <= 0.0 && s.slope > 0.0 && part <= 1.0 ? part : -1.0;
}

// Steps of Newton's method that know the fold, from p: to the root, or to where the ray is nearest. What begins at a
// root that a trace has found is `polished`: it stays near, and what it does not find is not there. But where the ray has
// `crossed` the surface between two places of the trace a root is there, if not the patch's: one that is not found is lost.
int approach(Ray ray, bool polished, bool crossed, inout real2 p, out Probe at) {
  // The gradient is that of det, per unit of u and v, along the last step that was long enough to tell.
  real2 way = real2(0), gradient = real2(0);
  real det = 0.0, first = 0.0;
  bool missed = false, wasGood = false;
  int misses = 0, outside = 0, result = kLost;
  for (int i = 0;; ++i) {
    at = probeAt(ray, p);
    real before = det, length2 = dot(way, way);
    det = area(at);
    if (i == 0) first = det;
    if (length2 > 1e-6) gradient = (det - before) / length2 * way / varyingCellHalf.xy;
    bool inside = inDomain(p, at), root = converged(at) && det * wantedSide > 0.0;
    misses = missed && length2 < kSettled * kSettled ? misses + 1 : 0;
    outside = inside || i == 0 ? 0 : outside + 1;
    bool last = i == (polished ? kPolishSteps : kNearSteps), good = root && inside;
    if (ends(good, offset(at) <= kFine * tolerance(at), wasGood) || (good && last)) result = kFound;
    else if (polished && !good && (root || misses == 2 && !crossed)) result = kMissed;
    else if (root && !inside && det / first > kAlike && first / det > kAlike) result = kMissed;
    if (result != kLost || last || !polished && (misses == 2 || outside == 3)) break;
    real2 next = nearDomain(foldStep(p, at, det, polished ? kTraceStep : kBoldCells, gradient, missed), 1.0);
    way = (next - p) / varyingCellHalf.xy;
    p = next;
  }
  // What had seemed to be a root and is not even near the ray, or the patch, is none.
  bool isFar = !(offset(at) <= kNearPixels * widthAt(at.depth)) || cellsBeyond(p) > kNearCells;
  return polished && !crossed && result == kLost && isFar ? kMissed : result;
}

// Where the ray enters the shell, as floats tell it: not before that (`sense` 1), not behind it (-1).
real entryInDepthBuffer(real sense) {
  return gl_FragCoord.z + sense * kDepthRounding * (has(kPerspective) ? gl_FragCoord.z : 1.0);
}
real entryDepth() {
  real z = entryInDepthBuffer(-1.0);
  return has(kPerspective) ? varyingClip.x / z : varyingClip.x + (z - 1.0) / varyingClip.y;
}

// Walks along the points of the surface to which the ray's are nearest, first against the ray, then along it, and ends
// at the nearest place, farther away than `after`, where the ray meets the surface: `best`, at depth `after`, on
// `wantedSide`. That is the side that the shell is seen from, or, where the ray has run past a border before, the other.
// Found, or missed, or lost. A miss has to be explained: the ray was outside of the surface from the first place to the last,
// or it came in beyond a border, or through a root that is known to be none. And it has to be proven: of every step, what is
// clear ahead of its start and what is clear before its end are all of it. Else it is lost, as is what has not left the shell,
// or the patch, when the trace is over.
//
// A miss is one of all that the ray does from where it enters the shell to where it leaves it. The places of the trace are
// those p at which S + h n, h the height of the ray above S(p), is on the ray, and p has `reached` a depth of the ray: it has to
// begin no farther than the entry, and what is beyond the slab leaves it only behind the entry. As the ray goes on so does p,
// and never back, while h is less than the radius of curvature there: the derivative of p along the ray is (1 - h k)^-1 times
// the part of the ray's direction along the surface. Where the slab is thicker than the surface is curved the ray goes on beside
// another part of the surface, and a miss is lost: as on corrugated sheets that are seen along their flanks. There the trace
// turns back, or, with a whole wave within a step, its point moves on while the ray's nearest one hardly does: the ratio of the
// two ways is the mean of 1 - h k over the step.
//
// Where a ray runs along a valley, the offset hardly changes over many cells: steps grow as long as they tell the next
// offset well and are proven to pass nothing.
int traceCurve(Ray ray, inout real after, out real2 best, out bool crossed) {
  real2 p = besideEdges(startAtEntry().xy);
  real nearest = 1e30, length_ = kTraceStep, behind = 0.0;
  real sense = senseOf(ray), k = changeOfOffset(ray);
  Sample first, last;
  bool hasLeft = false, fromEntry = !gl_FrontFacing, passedBorder = false, back = true, explained = true, blind = false;
  best = p;
  crossed = false;
  for (int steps = 0; steps <= kTraceSteps; ++steps) {
    Probe at = probeAt(ray, p);
    Sample now = sampleAt(ray, p, at, sense, k);
    bool again = false, turned = false;
    bool beforeEntry = gl_FrontFacing && inDepthBuffer(now.reached) > entryInDepthBuffer(1.0);
    bool counts = !back || !fromEntry;  // what is before the entry is another fragment's
    fromEntry = fromEntry || inDepthBuffer(now.reached) >= entryInDepthBuffer(-1.0);
    bool leavesSlab = steps > 0 && !beforeEntry && abs(now.g) - now.slack > max(abs(last.g), varyingClip.z);
    real shorter = 0.0;
    if (steps == 0) {
      first = now;
      // Behind the surface it begins where it has come in past a border, or where the root is behind the start.
      explained = now.g <= 0.0 || cellsBeyond(p) > -kAtBorder;
      passedBorder = now.g > 0.0 && seesPastBorder();
      // Where the trace begins beside the edge it sees nothing between, s cells wide: there f is at least |f| - |J| s - K s^2,
      // and f + J x is 0 within |1/J| K s^2 of a root. If there may be one on this side of the edge, a miss is lost.
      if (any(notEqual(p, startAtEntry().xy))) {
        real2 ju = at.fu * varyingCellHalf.x, jv = at.fv * varyingCellHalf.y;
        real strip = 1.5 * kBesideEdge, bend = changeOfOffset(ray) * strip * strip, size = sqrt(dot(ju, ju) + dot(jv, jv));
        real perArea = 1.0 / (ju.x * jv.y - ju.y * jv.x);
        real2 root = p + varyingCellHalf.xy * real2(jv.x * at.f.y - jv.y * at.f.x, ju.y * at.f.x - ju.x * at.f.y) * perArea;
        blind = !(length(at.f) > size * strip + bend) && !(cellsBeyond(root) > size * abs(perArea) * bend);
      }
      // What is clear before a start that is a little behind the entry reaches to it.
      real perCell = dot(rowDepth.xyz, at.Su * (now.way.x * varyingCellHalf.x) + at.Sv * (now.way.y * varyingCellHalf.y));
      fromEntry = fromEntry || 2.0 * (now.reached - entryDepth()) <= clearance(now, -1.0, k) * perCell;
      // Where the ray begins outside and nears the surface, nothing is behind.
      back = !fromEntry || !(now.g < 0.0 && now.slope > 0.0);
    } else {
      turned = dot(now.way, last.way) < 0.0;
      blind = blind || (counts && turned && !(leavesSlab && now.g * last.g > 0.0));
      turned = turned && !back;
      Sample from = back ? now : last, to = back ? last : now;
      bool rises = !turned && from.g <= 0.0 && to.g > 0.0, falls = !turned && !back && passedBorder && from.g > 0.0 && to.g <= 0.0;
      // Where both ends leave some of the step open it may touch 0 there.
      real clear = clearance(from, 1.0, k), clearBefore = clearance(to, -1.0, k);
      bool unsure = !rises && !falls && !(clear + clearBefore >= length_);
      bool touches = unsure && from.g * from.slope < 0.0 && to.g * to.slope > 0.0;
      real nears = turned ? ahead(from, length_) : -1.0;
      bool isRoot = rises || falls || touches || nears >= 0.0;
      real part = rises || falls ? crossing(from, to, length_) : touches ? (from.g > 0.0 ? 1.0 : 0.0) : max(nears, 0.0);
      // The mean over a long step tells less.
      bool isShort = length_ <= 0.5 * kTraceStep;
      bool follows = to.reached - from.reached >= (isShort ? kFollowsShort : kFollows) * (to.depth - from.depth);
      // What a long step has passed, or may have, is walked again.
      again = unsure ? length_ > kTraceMin : (rises || falls) && length_ > kTraceStep || !follows && !isShort;
      shorter = unsure ? max(back ? clearBefore : clear, kTraceMin) : 0.5 * length_;
      real2 candidate = mix(from.p, turned ? p : to.p, part);
      real depth = mix(from.depth, to.depth, part);
      // Where the candidate is, is an estimate: whether it is the patch's is for the steps to decide that begin there.
      if (isRoot && !again && cellsBeyond(candidate) < kNearCells && depth < nearest && depth > after) {
        nearest = depth;
        best = candidate;
        crossed = rises || falls;
        wantedSide = falls ? -shellSide() : shellSide();
      } else if (isRoot && !again) {
        passedBorder = kFrontOnly || seesPastBorder();
        explained = true;
      }
      blind = blind || (counts && !again && (unsure || !follows));
      explained = explained || (back && !again && now.g > 0.0 && cellsBeyond(now.p) > -kAtBorder);
    }
    // Beyond the shell and beyond the domain nothing is left to find: what the ray meets farther on, another fragment does.
    bool leaves = !back && !again && steps > 0 && (leavesSlab || turned || (!beforeEntry && cellsBeyond(now.p) > kBeyond));
    hasLeft = leaves;
    bool steady = !back && steps > 0 && abs(now.g - last.g - 0.5 * length_ * (now.slope + last.slope)) < kSteady * abs(now.g);
    if (back && !again && steps > 0) behind += length_;
    bool atStart = back && behind >= kBehind;
    back = back && !atStart;
    if (blind || !back && (nearest < 1e30 || leaves)) break;
    if (!again) last = atStart ? first : now;
    real longest = min(steady ? kTraceGrowth * length_ : kTraceStep, kTraceMax);
    length_ = again ? shorter : max(min(longest, kBothEnds * clearance(last, back ? -1.0 : 1.0, k)), kTraceMin);
    // A formula need not exist far beyond the domain.
    if (cellsBeyond(last.p + length_ * last.way * varyingCellHalf.xy) > kBeyond) length_ = min(length_, 2.0 * kTraceStep);
    p = last.p + (back ? -length_ : length_) * last.way * varyingCellHalf.xy;
  }
  after = nearest;
  return nearest < 1e30 ? kFound : hasLeft && fromEntry && explained && !blind ? kMissed : kLost;
}

// The point where rays may graze the surface.
//
// Newton's method from where the ray enters the shell finds most. Where folds lie close to each other or to an edge, it
// may find the wrong root or none. There a trace begins: along a fold the surface is flat on the screen, so one direction
// is settled by a step, and what remains is a function of one variable on a curve through the cells around the start.
// The trace takes the nearest of its roots, and Newton's method goes on from there. Where that one turns out to be none, or
// none of the patch, there is another attempt farther away. A root far from the start may have others before it: it is
// held until a trace has found none. What shows only its front is met from behind, too: whether the front follows there
// before the ray has left the slab is for rays to tell.
int findGrazedRoot(Ray ray, out real2 p, out Probe at) {
  p = startAtEntry().xy;
  int result = kLost;
  // A CPU device skips no branch, but leaves a loop when no pixel is left in it; and it runs the body of each at least
  // once. So each formula stands once in a loop of its own, and a trace costs those that need none a single step.
  wantedSide = shellSide();
  real after = -1e30, heldDepth = 1e30;
  real2 held = p;
  bool passed = false, takesHeld = false, crossed = false;
  for (int attempt = 0; attempt <= kAttempts; ++attempt) {
    result = approach(ray, attempt > 0, crossed, p, at);
    if (result == kFound && isPassed(at)) return kLost;
    bool holds = attempt == 0 && result == kFound && cellsFromStart(p) > kFarCells;
    if (holds) held = p, heldDepth = at.depth;
    // What is past a border, or farther away than a root that is none, is mostly another fragment's.
    passed = passed || result == kMissed;
    if (result == kLost && passed && !crossed) result = kMissed;
    bool ended = result == kFound ? !holds : attempt > 0 ? result == kLost : result == kMissed && !seesPastBorder();
    if (ended || takesHeld) break;
    if (attempt > 0) after = max(after, at.depth);
    result = attempt + 1 < kAttempts ? traceCurve(ray, after, p, crossed) : kLost;
    takesHeld = heldDepth < 1e30 && (result != kFound || after >= heldDepth);
    if (takesHeld) p = held, wantedSide = shellSide(), crossed = false;
    else if (result != kFound) break;
  }
  return result;
}

// Finds the point; p and at are its own when found.
int findRoot(Ray ray, out real2 p, out Probe at) {
  if (isLeftOut()) return kMissed;
  return kGrazing ? findGrazedRoot(ray, p, at) : findPlainRoot(ray, p, at);
}

// Whether the root is certainly the one that the search was for (Newton-Kantorovich): with J the Jacobian per cell, K a
// proven bound of how much it changes over a cell, |1/J|^2 |f| K <= 1/2 proves that a single root is near.
//
// And the ray has not met the surface before, between where it entered the shell and the root. That is so of a root nearer
// to the eye than that place, which hides whatever is farther on, and where that place is too near to the root for another
// one: a root d cells from this one has J d = f(root + d) - f(root) - (what J changes by on the way), so |J d| <= K d^2 / 2,
// and d >= 2 / |1/J| K. The entry is r cells off along u and along v at most, so at sqrt(2) r or less; |1/J| is |J| / det at
// most; and a tenth is for what the root itself is off by. Elsewhere the way there is walked, along the curve of points to
// which the ray's are nearest, but for triangles of which nearly all rays are steep enough. One lane in a hundred, and a loop
// that no pixel of a group is in costs nothing.
//
// Theorem: let the offset at a place of the curve be h, along the normal n on the screen, and let it grow across the curve,
// per cell, by a along the fold t and by `tilt` a along n. On the curve n.f has no zero within d cells, 0 < d <= a / 4 K, if
// at the end it is h' > 0 and sqrt(h) + sqrt(h') >= d sqrt(3 K (1 + tilt) / 4). Proof: x along the curve's tangent and y
// across it, t.f = 0 is y(x), as t.f grows by 3/4 a at least with y; y' <= (K d) / (3/4 a) <= 1/3, and |y''| <=
// K (1 + y'^2) / (3/4 a). n.f has with them the second derivative n.D2f + (n.f)_y y'', that is at most
// K (1 + 1/9) (1 + (tilt a + a / 4) / (3/4 a)) <= 3/2 K (1 + tilt) = B; and a function of which it is at most B, and that
// touches 0 between, is at most B x^2 / 2 on either side. So a step of sqrt(h / (3/4 K (1 + tilt))) or less passes nothing,
// if the ray is above the surface where it ends, or that is the root.
bool certified(Ray ray, real2 p, Probe at) {
  real2 ju = at.fu * varyingCellHalf.x, jv = at.fv * varyingCellHalf.y;
  real det = ju.x * jv.y - ju.y * jv.x, squares = dot(ju, ju) + dot(jv, jv), r = cellsFromStart(p);
  real k = changeOfOffset(ray);
  bool proven = squares * length(at.f) * k <= 0.5 * det * det && r <= kFarCells;
  bool nearer = gl_FrontFacing && inDepthBuffer(at.depth) >= gl_FragCoord.z;
  bool first = nearer || squares * k * k * r * r <= 1.8 * det * det;
  if (kWalks) {
    real side = det * shellSide() > 0.0 ? 1.0 : -1.0, left = r;
    for (int i = 0; i < kWalkSteps && proven && !first; ++i) {
      real2 q = mix(p, startAtEntry().xy, left / r);
      Sample place = sampleAt(ray, q, probeAt(ray, q), senseOf(ray), k);
      real height = -side * place.g - place.slack;
      proven = height > 0.0;
      real step_ = min(sqrt(max(height, 0.0) / (k * 0.75 * (1.0 + place.tilt))), 0.25 * place.across / k);
      first = step_ >= left;
      left -= step_;
    }
  }
  return proven && first;
}

// The parameters as the surface names them.
vec2 inPeriod(real2 p) {
  real2 period = patchDomain.zw - patchDomain.xy;
  real2 turns = floor((p - patchDomain.xy) / period);
  return vec2((has(kWrapsU) ? p.x - turns.x * period.x : p.x) + originOfU(),
              has(kWrapsV) ? p.y - turns.y * period.y : p.y);
}

int rootOfPixel(out Root root) {
  readSurface();
  Ray ray = rayOfPixel();
  real2 p;
  Probe at;
  int result = findRoot(ray, p, at);
  root.S = at.S;
  root.parameters = inPeriod(p);
  vec3 n = cross(relative(vec3(at.Su)), relative(vec3(at.Sv)));
  // The sign of the area tells the side exactly; at outlines n.V is what rounding makes of 0.
  bool flipped = has(kNegative) != has(kBackSide);
  root.outward = flipped ? n : -n;
  root.front = (area(at) < 0.0) == flipped;
  root.depth = at.depth;
  root.residual = float(offset(at) / widthAt(at.depth));
#ifdef LUXO_TEXTURED
  setFootprint(at.fu, at.fv, widthAt(at.depth));
#endif
#if defined(LUXO_FRAMED) || defined(LUXO_FINDS_FRAME)
  rootFrame = vec4(unitOrZero(relative(vec3(at.Su))), flipped ? 1.0 : -1.0);
#endif
  root.certified = certified(ray, p, at);
  // A root beyond a border is all that there is to find if no other can be on the way to it.
  return !kGrazing && result == kMissed && !root.certified && !isLeftOut() ? kLost : result;
}
