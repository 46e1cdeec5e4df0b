// SPDX-License-Identifier: Apache-2.0
// Where exactly a ray meets a cell, from as near as a grain of a pixel, or, of light, in a rectangle that has one meeting; and
// whether that is proven to be one point.

struct Meeting {
  vec2 parameters;  // less originOfU
  vec3 Su, Sv;
  float t, off;     // metres along the ray, and by how much that may be off
  vec2 unsure;      // of the parameters: what rounding leaves of them
  bool isProven;
};

const float kAsFar = 8.0;
const int kSteps = 4;  // Newton's: from a grain of a pixel two are enough; what these do not find is open

Meeting meetingNear(CellRay ray, CasterCell cell, vec2 parameters) {
  Meeting meeting;
  vec3 S, Su, Sv;
  vec2 a, b, f;
  float area;
  for (int step = 0; step < kSteps; ++step) {
    surfaceAt(parameters.x, parameters.y, S, Su, Sv);
    vec3 from = S - ray.from;
    f = vec2(dot(ray.across1, from), dot(ray.across2, from));
    a = vec2(dot(ray.across1, Su), dot(ray.across2, Su));
    b = vec2(dot(ray.across1, Sv), dot(ray.across2, Sv));
    area = crossOf(a, b);
    if (dot(f, f) <= 0.0625 * ray.rounding * ray.rounding || step + 1 == kSteps) break;
    parameters += vec2(-crossOf(f, b), crossOf(f, a)) / area;
  }
  roundsLeft -= kSteps;
  float perArea = 1.0 / max(abs(area), 1e-37);
  meeting.t = dot(ray.along, S - ray.from);
  meeting.off = ray.rounding * (1.0 + (abs(dot(ray.along, Su)) * length(b) + abs(dot(ray.along, Sv)) * length(a)) * perArea);
  // Where the ray grazes the surface as near as floats tell there may be no point, or two: there the tangents turn by more
  // than they span in all that rounding leaves of the parameters.
  meeting.unsure = (ray.rounding + length(f)) * perArea * vec2(length(b), length(a));
  vec2 h = kAsFar * ray.rounding * perArea * vec2(length(b), length(a));
  float turn = 0.5 * (cell.bend.x * h.x * h.x + cell.bend.z * h.y * h.y) + cell.bend.y * h.x * h.y;
  bool isPlain = 4.0 * turn * (h.x * length(a) + h.y * length(b)) < h.x * h.y * abs(area);
  meeting.isProven = isPlain && dot(f, f) <= ray.rounding * ray.rounding && meeting.off < 1e30;
  meeting.parameters = parameters;
  meeting.Su = Su;
  meeting.Sv = Sv;
  return meeting;
}

// Its parameters as a pattern takes them: rounding must not lead across the end of the cell, where a pattern may jump.
vec2 parametersInside(CasterCell cell, vec2 parameters) {
  vec2 inside = (1.0 - 2e-6) * cell.half_;
  return clamp(parameters, cell.middle - inside, cell.middle + inside) + vec2(cell.originOfU, 0);
}
