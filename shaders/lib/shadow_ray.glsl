// SPDX-License-Identifier: Apache-2.0
// Whether a surface keeps the light from a point: what a ray of light meets of a cell of it.
//
// Of a rectangle of parameters with its middle at S0, half as wide as (hu, hv), the tangents a = hu Su, b = hv Sv and
// |S - (S0 + x a + y b)| <= bend (Taylor; engine/shadow/caster_cells.h). With f the offset of S0 from the ray, across it,
// in two coordinates, a point of the ray is on the surface only if
//
//     f + x a + y b = r,   |x|, |y| <= 1,  |r| <= bend.
//
// So there is none if the parallelogram of a and b around f keeps farther than `bend` from 0; else x and y are within
// (bend |b|, bend |a|) / |a x b| of the solution for r = 0, which narrows the rectangle (D. Toth 1985, after Krawczyk
// 1969); and if all these are inside of it there is such a point (Brouwer): the light does not get through. What is left
// is looked at once more, cut in two where it has not become smaller by half. All this holds for every rectangle, however
// the surface turns in it. Where rays graze, rectangles end that are smaller than `grain`: then the border of the shadow
// is as near.

const int kMet = 1, kPassed = 0, kOpen = 2;
const int kRectangles = 24;        // that wait: each half as large as the one before
const int kMaxEvaluations = 256;   // of a pixel; a few dozen where rays graze, 4 elsewhere

struct LightRay {
  vec3 from, along;      // unit
  vec3 across1, across2; // unit, upright on it and on each other
  float first, last;     // metres: what is nearer is the point itself, what is farther is behind the light
  float rounding, grain; // metres
};

// T. Duff et al., "Building an orthonormal basis, revisited", 2017.
LightRay lightRay(vec3 from, vec3 along, float first, float last, float rounding, float grain) {
  float s = along.z >= 0.0 ? 1.0 : -1.0, a = -1.0 / (s + along.z), b = along.x * along.y * a;
  return LightRay(from, along, vec3(1.0 + s * along.x * along.x * a, s * b, -s * along.x),
                  vec3(b, s + along.y * along.y * a, -along.y), first, last, rounding, grain);
}

float crossOf(vec2 a, vec2 b) { return a.x * b.y - a.y * b.x; }

int evaluationsLeft = kMaxEvaluations;

int meetsCell(LightRay ray, CasterCell cell) {
  if (cell.bend.x < 0.0) return kOpen;
  vec4 waiting[kRectangles];
  int count = 0;
  vec4 rectangle = vec4(cell.middle, cell.half_);
  for (;;) {
    if (--evaluationsLeft < 0) return kOpen;
    vec3 S, Su, Sv;
    surfaceAt(rectangle.x, rectangle.y, S, Su, Sv);
    vec3 from = S - ray.from;
    vec2 h = rectangle.zw, f = vec2(dot(ray.across1, from), dot(ray.across2, from));
    vec2 a = h.x * vec2(dot(ray.across1, Su), dot(ray.across2, Su)), b = h.y * vec2(dot(ray.across1, Sv), dot(ray.across2, Sv));
    float t = dot(ray.along, from), ta = h.x * dot(ray.along, Su), tb = h.y * dot(ray.along, Sv);
    float turn = 0.5 * (cell.bend.x * h.x * h.x + cell.bend.z * h.y * h.y) + cell.bend.y * h.x * h.y;
    float bend = turn + ray.rounding, reach = abs(ta) + abs(tb) + bend;
    float area = crossOf(a, b), lengthA = length(a), lengthB = length(b);
    if (!(abs(f.x) + abs(f.y) + reach + lengthA + lengthB < 1e30)) return kOpen;  // the formula has no value there
    bool passes = t + reach <= ray.first || t - reach >= ray.last ||
                  abs(crossOf(f, a)) > abs(area) + bend * lengthA || abs(crossOf(f, b)) > abs(area) + bend * lengthB ||
                  dot(f, f) > abs(dot(f, a)) + abs(dot(f, b)) + bend * length(f);
    if (!passes) {
      float perArea = 1.0 / max(abs(area), 1e-37);
      vec2 middle = vec2(-crossOf(f, b), crossOf(f, a)) * (area < 0.0 ? -perArea : perArea), off = bend * vec2(lengthB, lengthA) * perArea;
      vec2 low = middle - off, high = middle + off;
      float tMiddle = t + ta * middle.x + tb * middle.y, tOff = abs(ta) * off.x + abs(tb) * off.y + bend;
      bool isInside = max(abs(middle.x) + off.x, abs(middle.y) + off.y) < 1.0;
      if (isInside && tMiddle - tOff > ray.first && tMiddle + tOff < ray.last) return kMet;
      low = max(low, vec2(-1));
      high = min(high, vec2(1));
      passes = low.x > high.x || low.y > high.y || tMiddle + tOff <= ray.first || tMiddle - tOff >= ray.last;
      if (!passes) {
        if (lengthA + lengthB + bend <= ray.grain) {
          // A point as small as that: on the ray, unless this runs along a fold.
          bool isPlain = turn * (lengthA + lengthB) < 0.5 * abs(area);
          if (isPlain && tMiddle > ray.first && tMiddle < ray.last) return kMet;
          passes = true;
        } else {
          vec2 part = 0.5 * (high - low);
          if (part.x * part.y <= 0.5) {
            rectangle = vec4(rectangle.xy + h * (0.5 * (low + high)), h * part);
          } else {
            if (count == kRectangles) return kOpen;
            bool ofU = lengthA + h.x * (cell.bend.x * h.x + cell.bend.y * h.y) >= lengthB + h.y * (cell.bend.z * h.y + cell.bend.y * h.x);
            vec2 half_ = ofU ? vec2(0.5 * h.x, 0) : vec2(0, 0.5 * h.y);
            waiting[count++] = vec4(rectangle.xy + half_, h - half_);
            rectangle = vec4(rectangle.xy - half_, h - half_);
          }
        }
      }
    }
    if (passes) {
      if (count == 0) return kPassed;
      rectangle = waiting[--count];
    }
  }
}
