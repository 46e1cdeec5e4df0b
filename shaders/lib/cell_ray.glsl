// SPDX-License-Identifier: Apache-2.0
// What a ray meets of a cell of a surface: of light, which does not get through; or of sight, of what is seen through.
//
// Of a rectangle of parameters with its middle at S0, half as wide as (hu, hv), the tangents a = hu Su, b = hv Sv and
// |S - (S0 + x a + y b)| <= bend (Taylor; engine/shadow/caster_cells.h). With f the offset of S0 from the ray, across it,
// in two coordinates, a point of the ray is on the surface only if
//
//     f + x a + y b = r,   |x|, |y| <= 1,  |r| <= bend.
//
// So there is none if the parallelogram of a and b around f keeps farther than `bend` from 0; else x and y are within
// (bend |b|, bend |a|) / |a x b| of the solution for r = 0, which narrows the rectangle (D. Toth 1985, after Krawczyk
// 1969); and if all these are inside of it there is such a point (Brouwer). What is left
// is looked at once more, cut in two where it has not become smaller by half. All this holds for every rectangle, however
// the surface turns in it.
//
// Where the tangents turn by less than they span (`isPlain`) a rectangle has one meeting at most.
//
// A point that is off its own surface by `off` meets that surface near t = 0, by as much as that moves the solution. Such a
// meeting is no shadow; but where there are two of them, or one that cannot be the point's own, no float tells, and rays do
// (kOpen), as where the ray's other end, a light, may be on the surface. Rectangles smaller than `grain`, or than some
// roundings, are not cut. Of sight one that is plain is a meeting, or beside an edge none, and where a ray grazes the surface
// as near as that, rays decide. Of light nothing is taken for granted: where it falls aslant on a point a border that is off
// by so little across the ray is off by far more, so that rectangles are cut on, and rays decide what they leave to rounding.

#include "lib/ray_result.glsl"
#include "lib/rounds.glsl"

const int kCuts = 31;              // of a cell, each in half: a bit each
#ifndef LUXO_EVALUATIONS
#define LUXO_EVALUATIONS 256
#endif
const int kMaxEvaluations = LUXO_EVALUATIONS;  // of a ray; a few dozen where it grazes, 4 elsewhere

// Of half a rectangle: more than what floats lose of where a meeting is. A point's own meeting that is nearer to a border is
// counted by both rectangles; were this too little, rounding might leave it to neither. Both are open, for rays. Chosen.
const float kBorder = 1e-4;

const float kGrain = 3e-4;        // pixels: a surface ends as near to where it should
const float kMaxRounding = 4e-3;  // pixels

struct CellRay {
  vec3 from, along;       // unit
  vec3 across1, across2;  // unit, upright on it and on each other
  float first, last;      // metres from `from`: what is nearer or farther is not met
  float rounding, off;    // metres: how far floats leave the ray, and the point its surface
  vec2 grain;             // metres: at `from`; what it grows by in a metre
  float aslant;           // how many times as much what is off at `from` may be off in the picture
  bool isSight;           // and no light
};

// T. Duff et al., "Building an orthonormal basis, revisited", 2017.
CellRay cellRay(vec3 from, vec3 along) {
  float s = along.z >= 0.0 ? 1.0 : -1.0, a = -1.0 / (s + along.z), b = along.x * along.y * a;
  return CellRay(from, along, vec3(1.0 + s * along.x * along.x * a, s * b, -s * along.x),
                 vec3(b, s + along.y * along.y * a, -along.y), 0.0, 0.0, 0.0, 0.0, vec2(0), 1.0, false);
}

// Told of every meeting, with its parameters, less originOfU; `atBorder`, of sight: a neighbouring rectangle may have it, too.
// Whether the others matter no more.
bool endsAt(CellRay ray, CasterCell cell, vec2 parameters, bool atBorder);

float crossOf(vec2 a, vec2 b) { return a.x * b.y - a.y * b.x; }

int evaluationsLeft = kMaxEvaluations;
int ownMeetings = 0;     // so many that may be the point's own
int besideMeetings = 0;  // and so many that a neighbouring rectangle has, but for rounding
bool mayTurnBack = false;  // one of these may be two

#ifdef LUXO_TRIANGLES
#include "lib/triangle_ray.glsl"
#else

// Whether a second meeting may be as near to a point's own as that. Over the plane that touches the surface the ray rises by
// its sine times the way, and the surface by half its curvature times the way squared, at most: they meet again no nearer than
// 2 sines / curvature. Own meetings are within twice `own`; `least`: the part of the sine here that is left of it anywhere in
// the rectangle, which has the same sign all over. On the side that the surface bends away from, all over the cell, the ray's
// height over that is a convex function of the way: where it rises it goes on to do so, however little, and does not turn back.
bool turnsBack(CellRay ray, CasterCell cell, vec3 Su, vec3 Sv, float own, float least) {
  vec3 across = cross(Su, Sv);
  if (cell.bendsAway * dot(across, ray.along) > 0.0) return false;
  float perSquared = 1.0 / max(dot(across, across), 1e-37);
  // What u and v move by in a metre along the ray, flattened.
  vec2 way = vec2(dot(cross(ray.along, Sv), across), dot(cross(Su, ray.along), across)) * perSquared;
  float curvature = cell.bend.x * way.x * way.x + 2.0 * cell.bend.y * abs(way.x * way.y) + cell.bend.z * way.y * way.y;
  float sine = least * abs(dot(across, ray.along)) * sqrt(perSquared);
  return !(sine > 1.25 * curvature * own);
}

// Rectangles are visited in order of a tree of halves, whose way back takes no memory that a device would have to index:
// a bit for each cut tells which half this is, another whether u was cut.
int meetsCell(CellRay ray, CasterCell cell) {
  if (cell.bend.x < 0.0) return kOpen;
  vec4 half_ = vec4(cell.middle, cell.half_), rectangle = half_;  // of the tree; the part of it that is left
  uint second = 0, ofU = 0;
  int cuts = 0;
  for (;;) {
    if (--evaluationsLeft < 0 || isOutOfRounds(2)) return kOpen;  // two: with those of the way back
    vec3 S, Su, Sv;
    surfaceAt(rectangle.x, rectangle.y, S, Su, Sv);
    vec3 from = S - ray.from;
    vec2 h = rectangle.zw, f = vec2(dot(ray.across1, from), dot(ray.across2, from));
    vec2 a = h.x * vec2(dot(ray.across1, Su), dot(ray.across2, Su)), b = h.y * vec2(dot(ray.across1, Sv), dot(ray.across2, Sv));
    float t = dot(ray.along, from), ta = h.x * dot(ray.along, Su), tb = h.y * dot(ray.along, Sv);
    float turn = 0.5 * (cell.bend.x * h.x * h.x + cell.bend.z * h.y * h.y) + cell.bend.y * h.x * h.y;
    float bend = turn + ray.rounding, reach = abs(ta) + abs(tb) + bend;
    float area = crossOf(a, b), lengthA = length(a), lengthB = length(b), size = lengthA + lengthB;
    if (!(abs(f.x) + abs(f.y) + reach + size < 1e30)) return kOpen;  // the formula has no value there
    float perArea = 1.0 / max(abs(area), 1e-37);
    vec2 middle = vec2(-crossOf(f, b), crossOf(f, a)) * (area < 0.0 ? -perArea : perArea), off = bend * vec2(lengthB, lengthA) * perArea;
    vec2 low = max(middle - off, vec2(-1)), high = min(middle + off, vec2(1)), part = 0.5 * (high - low);
    float tMiddle = t + ta * middle.x + tb * middle.y, tOff = abs(ta) * off.x + abs(tb) * off.y + bend;
    // Twice as far as with these tangents, as they turn by half at most.
    float own = 2.0 * ray.off * (1.0 + (abs(ta) * lengthB + abs(tb) * lengthA) * perArea);
    bool isPlain = 4.0 * turn * size < abs(area);
    bool isInside = max(abs(middle.x) + off.x, abs(middle.y) + off.y) < 1.0;
    bool passes = t + reach <= ray.first - ray.off || t - reach >= ray.last || min(part.x, part.y) < 0.0 ||
                  tMiddle + tOff <= ray.first - own || tMiddle - tOff >= ray.last ||
                  abs(crossOf(f, a)) > abs(area) + bend * lengthA || abs(crossOf(f, b)) > abs(area) + bend * lengthB ||
                  dot(f, f) > abs(dot(f, a)) + abs(dot(f, b)) + bend * length(f);
    bool isOwn = ray.off > 0.0 && isPlain && abs(tMiddle) + tOff <= 2.0 * own;
    // The surface may end here: what is beyond an edge by more than rounding is not met.
    vec2 beyond = abs(middle) - off;
    bool isHere = max(beyond.x, beyond.y) <= 1.0;
    float grain = ray.grain.x + ray.grain.y * (ray.grain.y > 0.0 ? t - reach : t + reach);
    // Where floats are as coarse as that borders would be off.
    if (!passes && kGrain * ray.rounding * ray.aslant > kMaxRounding * (ray.grain.x + ray.grain.y * t)) return kOpen;
    bool isGrain = size + bend <= 4.0 * ray.rounding || (ray.isSight && size + bend <= grain);
    // The ray ends where the surface is, or before or behind it.
    if (!passes && isGrain && isHere && !isOwn && abs(tMiddle - ray.last) <= tOff) return kOpen;
    bool isProven = isInside && tMiddle - tOff > ray.first + own && tMiddle + tOff < ray.last;
    bool isSeeming = ray.isSight && isGrain && isHere && !isOwn && tMiddle > ray.first + own && tMiddle < ray.last;
    bool isMet = !passes && isPlain && (isProven || isSeeming);
    if (!passes && isPlain && isGrain && !isProven && !isOwn && !ray.isSight) return kOpen;
    if (isMet && endsAt(ray, cell, rectangle.xy + h * middle, !isInside)) return kMet;
    if (!passes && !isMet && isGrain && !isPlain) return kOpen;
    // Of a meeting on a border between two rectangles one counts, but for rounding.
    if (!passes && !isMet && isOwn) {
      if (max(abs(middle.x), abs(middle.y)) <= 1.0 + kBorder) ++ownMeetings;
      else ++besideMeetings;
      // Both tangents together turn by 2 turn.
      mayTurnBack = mayTurnBack || turnsBack(ray, cell, Su, Sv, own, 1.0 - 2.0 * turn * size * perArea);
    }
    if (passes || isMet || isOwn || isGrain) {
      for (; cuts > 0 && (second & 1) != 0; --cuts) {
        half_.xy -= (ofU & 1) != 0 ? vec2(half_.z, 0) : vec2(0, half_.w);
        half_.zw *= (ofU & 1) != 0 ? vec2(2, 1) : vec2(1, 2);
        second >>= 1;
        ofU >>= 1;
      }
      if (cuts == 0) return kPassed;
      second |= 1;
      half_.xy += (ofU & 1) != 0 ? vec2(2.0 * half_.z, 0) : vec2(0, 2.0 * half_.w);
      rectangle = half_;
    } else if (part.x * part.y <= 0.5) {
      rectangle = vec4(rectangle.xy + h * (0.5 * (low + high)), h * part);
    } else {
      if (cuts == kCuts) return kOpen;
      bool cutU = lengthA + h.x * (cell.bend.x * h.x + cell.bend.y * h.y) >= lengthB + h.y * (cell.bend.z * h.y + cell.bend.y * h.x);
      half_.zw *= cutU ? vec2(0.5, 1) : vec2(1, 0.5);
      half_.xy -= cutU ? vec2(half_.z, 0) : vec2(0, half_.w);
      second <<= 1;
      ofU = ofU << 1 | (cutU ? 1 : 0);
      ++cuts;
      rectangle = half_;
    }
  }
}
#endif
