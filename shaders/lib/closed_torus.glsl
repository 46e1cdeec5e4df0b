// SPDX-License-Identifier: Apache-2.0
// Whether a ray from outside to outside meets a torus with a ring of radius 1: F(p) = (r - 1)^2 + y^2 - tube^2, with r the
// distance from the axis, is the square of the distance from the ring less that of the tube.
//
// Expanded F = |p|^2 + 1 - tube^2 - 2 r. As 2 r <= s + r^2 / s for every s > 0, with equality at r = s,
//
//     F >= |p|^2 + 1 - tube^2 - s - r^2 / s:
//
// the torus is inside of a quadric that touches F where r = s. Along a ray that is a parabola below F, with F's own value and
// slope where r = s is the ray's. Up to the parabola's next root the ray meets nothing; where it has none no more. From root
// to root this is Newton's iteration, but one that never steps too far (majorization: D. Hunter, K. Lange, "A tutorial on MM
// algorithms", 2004). And as r is convex along a ray, the parabola of that value and slope with |d|^2 for its square is
// above F: the ray meets the torus where that is negative.

const int kMaxRootSteps = 32;  // what they do not settle is open: fewer leave more to rays, and nothing wrong; chosen

// Whether a ray keeps, from t to `end`, more than `off` inside of the ring, as r is convex along it, or outside.
bool missesRing(vec3 q, vec3 d, float t, float end, float off) {
  float nearest = clamp(-dot(q.xz, d.xz) / max(dot(d.xz, d.xz), kTiny), t, end);
  float farthest = max(length(q.xz + t * d.xz), length(q.xz + end * d.xz));
  return farthest < 1.0 - off || length(q.xz + nearest * d.xz) > 1.0 + off;
}

int meetsTorus(ClosedCaster caster, ClosedRay ray) {
  vec3 q = ray.from, d = ray.way;
  float tube = caster.tube, e = length(ray.e), ed = length(ray.eOfWay);
  float dd = dot(d, d), dRound = dot(d.xz, d.xz), size = sqrt(dd);
  if (!(e < 1.0)) return kOpen;
  // Where the ray is in a slab and in a ball around it.
  float slab = 1.01 * tube + 4.0 * e, ball = 1.01 * (1.0 + tube) + 4.0 * e;
  float perY = 1.0 / (abs(d.y) > 1e-20 * size ? d.y : 1e-20 * size), middleY = -q.y * perY, halfY = slab * abs(perY);
  float middle = -dot(q, d) / dd;
  vec3 foot = q + middle * d;
  float square = (ball * ball - dot(foot, foot)) / dd, halfBall = sqrt(max(square, 0.0));
  float t = max(0.0, max(middleY - halfY, middle - halfBall)), end = min(middleY + halfY, middle + halfBall);
  if (caster.light.w != 0.0) end = min(end, 1.0);
  if (square < 0.0 || t >= end) return kPassed;
  if (!ray.isOwn && missesRing(q, d, t, end, 1.01 * tube + 8.0 * e)) return kPassed;
  if (!(e < 1e-2 * tube)) return kOpen;

  float least = 0.5 * (1.0 - tube);  // s, where r is less: near the axis parabolas are narrow
  bool isOwn = ray.isOwn;
  for (int i = 0; i < kMaxRootSteps; ++i) {
    vec3 p = q + t * d;
    float r = length(p.xz), perS = 1.0 / max(r, least), below = max(least - r, 0.0), off = r - 1.0;
    float c = off * off + (p.y - tube) * (p.y + tube), around = dot(p.xz, d.xz);
    float b = around * (1.0 - perS) + p.y * d.y, a = dd - dRound * perS;
    float far = abs(off) + abs(p.y) + e, bend = 1.0 + perS;
    float ec = 2.0 * far * e + kUlps * (off * off + p.y * p.y), eb = size * bend * e + far * ed;
    float ea = size * (2.0 * ed * bend + size * perS * perS * e);
    if (isOwn) {
      c = ec = 0.0;
      eb += size * bend * length(ray.off);
    }
    float above = clamp(-b / dd, 0.0, end - t);
    if (below == 0.0 && c + above * (2.0 * b + above * dd) < -(ec + 2.0 * above * eb)) return kMet;
    float leastC = c - ec - below * below * perS, leastB = b - eb, leastA = a - ea;
    if (!(leastC > 0.0 || (isOwn && leastB > 0.0))) return kOpen;
    float discriminant = leastB * leastB - leastA * leastC, root = sqrt(max(discriminant, 0.0));
    bool hasRoot = leastB > 0.0 ? leastA < 0.0 : discriminant >= 0.0;
    if (!hasRoot) return kPassed;
    t += leastB > 0.0 ? (leastB + root) / -leastA : leastC / (root - leastB);
    if (!(t < end)) return kPassed;
    isOwn = false;
  }
  return kOpen;
}
