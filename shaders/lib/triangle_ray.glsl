// SPDX-License-Identifier: Apache-2.0
// What a ray meets of a cell that is a triangle, in place of what lib/cell_ray.glsl says of curved ones.
//
// Seen along the ray the edges are signs of cross products of the corners' offsets from it. Those of an edge that two
// triangles share are the same numbers turned round, so that no ray passes between them (S. Woop, C. Benthin, I. Wald,
// "Watertight Ray/Triangle Intersection", 2013); borders are off by what rounding leaves, a small part of a pixel. How far
// along the ray the meeting is floats tell worse the more the ray grazes the triangle: the triangle's own point, and what may
// be nearer than that, is told from others as in lib/cell_ray.glsl.
//
// Where light grazes what a point is on, what rounding leaves of the ray moves the borders of shadows there by as
// much more as that is aslant, which normals that are smoothed do not tell: a ray that is as near to an edge is open, if
// the point is not on a triangle that is known to be steep (isAsNearAsBordersMove()).

vec3 cornerOf(CellRay ray, uint first) {
  vec3 from = vec3(casterParameterAt(first), casterParameterAt(first + 1), casterParameterAt(first + 2)) - ray.from;
  return vec3(dot(ray.across1, from), dot(ray.across2, from), dot(ray.along, from));
}

// Turned round where a and b are: no product is fused with a sum.
float spanned(vec3 a, vec3 b) {
  precise float one = a.x * b.y, other = a.y * b.x;
  precise float difference = one - other;
  return difference;
}

// Of the one that endsAt() is told of: metres along the ray, and by how much that may be off; and the weights of its corners.
float metAt, metOff, weightsOff;

// The ray has met, or passed, a triangle so near to an edge that floats do not tell which.
bool metBesideEdge = false, passedBesideEdge = false;
float ownSlant = 0.0;  // of the triangle that the point is on: 1 / the sine of the ray's height over it
float widthBesideEdge = 1e30;  // the least of a pixel, there: where light spreads, narrower than at the point

bool isAsNearAsBordersMove(CellRay ray) {
  bool isSteep = ownMeetings > 0 && ray.rounding * ownSlant * ray.aslant <= kMaxRounding * widthBesideEdge;
  return (metBesideEdge || passedBesideEdge) && !isSteep;
}

void noteEdge(CellRay ray, float t) { widthBesideEdge = min(widthBesideEdge, (ray.grain.x + ray.grain.y * t) / kGrain); }

int meetsCell(CellRay ray, CasterCell cell) {
  precise vec3 a = cornerOf(ray, 0), b = cornerOf(ray, kCornerNumbers), c = cornerOf(ray, 2 * kCornerNumbers);
  float ofA = spanned(b, c), ofB = spanned(c, a), ofC = spanned(a, b);
  float most = max(max(ofA, ofB), ofC), least = min(min(ofA, ofB), ofC);
  // An edge's length, or more, times how far from it the ray may be.
  vec2 long_ = max(max(abs(b.xy - a.xy), abs(c.xy - b.xy)), abs(a.xy - c.xy));
  float unsure = ray.rounding * (long_.x + long_.y);
  if (most > unsure && least < -unsure) return kPassed;
  bool passes = most > 0.0 && least < 0.0, isBeside = min(min(abs(ofA), abs(ofB)), abs(ofC)) <= unsure;
  float area = ofA + ofB + ofC;
  if (area == 0.0) return kPassed;  // edge-on: its neighbours have what the ray meets
  float t = (ofA * a.z + ofB * b.z + ofC * c.z) / area;
  if (!(abs(t) < 1e30)) return kOpen;
  // By so much more the triangle is long along the ray than it is wide across it.
  vec3 normal = cross(b - a, c - a);
  float aslant = length(normal) / max(abs(area), 1e-37);
  float nearest = min(min(a.z, b.z), c.z), farthest = max(max(a.z, b.z), c.z);
  float off = min(ray.rounding * aslant, farthest - nearest + ray.rounding), own = 2.0 * ray.off * aslant;
  if (t + off <= ray.first - own || t - off >= ray.last) return kPassed;
  if (passes) {
    passedBesideEdge = true;
    noteEdge(ray, t);
    return kPassed;
  }
  // Where floats are as coarse as that borders would be off.
  if (kGrain * ray.rounding * ray.aslant > kMaxRounding * (ray.grain.x + ray.grain.y * t)) return kOpen;
  metAt = t;
  metOff = off;
  weightsOff = unsure / abs(area);
  if (t - off > ray.first + own && t + off < ray.last) {
    bool isMet = endsAt(ray, cell, vec2(ofB, ofC) / area, false);
    // Whether that matters the triangle that the point is on tells.
    metBesideEdge = metBesideEdge || isBeside;
    if (isBeside) noteEdge(ray, t);
    if (!isMet) return kPassed;
    // Devices draw triangles a little beyond their edges, there behind the one that goes on: what is in the way so near is none.
    if (t - off <= kMovedPx / kGrain * ray.grain.x * aslant) return kOpen;
    return isBeside ? kPassed : kMet;
  }
  if (abs(t) + off > 2.0 * own) return kOpen;  // beside the light
  ++ownMeetings;
  ownSlant = max(ownSlant, aslant);
  return kPassed;
}
