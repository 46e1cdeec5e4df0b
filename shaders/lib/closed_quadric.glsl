// SPDX-License-Identifier: Apache-2.0
// Where a ray meets a patch of a quadric, F(p) = p A p + 2 l y + k with a diagonal A: F = c + 2 b t + a t^2 along it.
//
// F at the light is a number of the light's alone, from double precision. So the signs of both ends tell the number of roots
// between them but for 0 or 2, with nothing rounded but c; and of a point of the surface itself, where F / t = 2 b + a t, with
// nothing but b.
//
// The discriminant b^2 - a c cancels all that is large where the point is far away. In Pluecker's coordinates of the ray, m =
// p x d, which are the light's, too (p x light), it is
//
//     D = - (Ay Az mx^2 + Az Ax my^2 + Ax Ay mz^2) + 2 l (Ax dx mz - Az dz mx) + l^2 dy^2 - k d A d     (Lagrange's identity),
//
// which cancels nothing but at the outline itself: of a sphere it compares the ray's distance from the middle with the radius.
//
// Roots are looked for from whichever end of the ray F is a sum of smaller numbers at: what floats leave of a, b and c is a part
// of these. From a light's end, t counts from the light, where F is known best, on toward the point.
//
// A CPU device computes both sides of every branch: what a kind of quadric does not have is known when the pipeline is made.

const bool kIsBall = kClosedKind == kClosedBall;            // A = 1, k = -1, and no edges
const bool kHasLinear = kClosedKind == kClosedQuadric;      // l is not 0

// A ray from one of its ends on: its point at t is known to 2 (e + |t| eOfWay).
struct RayEnd {
  vec3 from, way, e, eOfWay;
};

// 1: the point at t, which may be off by `dt`, is one of the patch; -1: it is not; 0: floats do not tell.
int insideAt(ClosedCaster caster, RayEnd end, float t, float dt) {
  if (!(dt < 1e30)) return 0;
  if (kIsBall) return 1;
  vec3 p = end.from + t * end.way, e = 2.0 * (end.e + abs(t) * end.eOfWay) + abs(end.way) * (dt + kUlps * abs(t));
  if ((caster.flags & kRadialCaster) != 0) {
    p = vec3(length(p.xz), p.y, 0);
    e = vec3(e.x + e.z, e.y, 0);
  }
  vec3 inside = min(p - caster.lowest, caster.highest - p), least = inside - e, most = inside + e;
  if (min(min(least.x, least.y), least.z) > 0.0) return 1;
  return min(min(most.x, most.y), most.z) < 0.0 ? -1 : 0;
}

// y = 0: one division.
int meetsPlane(ClosedCaster caster, ClosedRay ray) {
  float y = ray.from.y, way = ray.way.y, perWay = 1.0 / way;
  RayEnd end = RayEnd(ray.from, ray.way, ray.e, vec3(0));
  if (!(abs(y) > ray.e.y)) {
    float t = abs(ray.e.y * perWay);
    return insideAt(caster, end, 0.0, 2.0 * t) < 0 ? kPassed : kOpen;
  }
  if (y > 0.0 == caster.atLight > 0.0) return kPassed;
  float t = -y * perWay;
  int inside = abs(way) > 2.0 * ray.eOfWay.y ? insideAt(caster, end, t, 2.0 * (ray.e.y + abs(t) * ray.eOfWay.y) * abs(perWay)) : 0;
  return inside > 0 ? kMet : inside < 0 ? kPassed : kOpen;
}

int meetsQuadric(ClosedCaster caster, ClosedRay ray) {
  vec3 q = ray.from, d = ray.way, e = ray.e, ed = ray.eOfWay, A = kIsBall ? vec3(1) : caster.squares, size = abs(A);
  float l = kHasLinear ? caster.halfY : 0.0, k = kIsBall ? -1.0 : caster.constant;
  vec3 half_ = A * q, Ad = A * d;
  half_.y += l;
  float b = dot(half_, d), a = dot(Ad, d), c = dot(half_, q) + l * q.y + k;
  vec3 D_ = abs(d) + ed, AD = size * D_, AQ = size * abs(q);
  float ec = 2.0 * dot(abs(half_) + size * e, e) + kUlps * (dot(AQ, abs(q)) + 2.0 * abs(l * q.y) + abs(k));
  float eb = dot(AD, e) + dot(AQ, ed) + abs(l) * ed.y, ea = 2.0 * dot(AD, ed);
  float ebOfOwn = eb + dot(AD + AQ, ray.off) + abs(l) * ray.off.y;

  vec3 light = caster.light.xyz, m = cross(q, light), AA = A.yzx * A.zxy;
  // Where a number of the light is next to 0, what doubles leave of it is still a part of the distances involved.
  vec3 nearLight = abs(light) + caster.light.w * e;
  vec3 em = 2.0 * (nearLight.yzx * e.zxy + nearLight.zxy * e.yzx), M = abs(m) + em;
  float square = -k * a - dot(AA * m, m), eSquare = dot(abs(AA) * M, em) + abs(k) * dot(AD, ed);
  if (kHasLinear) {
    square += l * (2.0 * (Ad.x * m.z - Ad.z * m.x) + l * d.y * d.y);
    eSquare += abs(l) * (AD.x * em.z + AD.z * em.x + size.x * M.z * ed.x + size.z * M.x * ed.z + abs(l) * D_.y * ed.y);
  }
  eSquare *= 2.0;
  if (ray.isOwn) {
    square = b * b;
    eSquare = ec = 0.0;
  }
  bool touches = !ray.isOwn && !(abs(c) > ec);
  float start = ray.isOwn || touches ? b : c, eStart = ray.isOwn ? ebOfOwn : touches ? eb : ec;
  float sign_ = caster.atLight > 0.0 ? 1.0 : -1.0;
  bool isClear = square > eSquare, turns = start * sign_ < 0.0;
  bool isSurelyPast = !turns && (ray.isOwn || touches || square < -eSquare || b * sign_ > eb);

  // From the light's end on: rounding leaves of the light no more than of a number.
  RayEnd end = RayEnd(q, d, e, vec3(0));
  bool fromLight = caster.light.w != 0.0 && !ray.isOwn && !touches &&
                   dot(size * light, light) + abs(l * light.y) < dot(AQ, abs(q)) + abs(l * q.y);
  if (fromLight) {
    end = RayEnd(light, -d, 2.0 * kUlps * nearLight, e);
    b = -dot(Ad, light) - l * d.y;
    c = caster.atLight;
    eb = dot(AD, end.e) + dot(size * abs(light), ed) + abs(l) * ed.y;
    ec = kUlps * (dot(size * light, light) + 2.0 * abs(l * light.y) + abs(k));  // its coefficients are floats
  }
  float root = sqrt(max(square, 0.0)), perRoot = 1.0 / max(root, kTiny), perA = 1.0 / a;
  // The roots where F turns to the light's sign, and where it turns away from that. Of the two ways to write a root the one
  // that cancels nothing; of a point of the surface itself the root that is not 0.
  float turned = fromLight ? -sign_ * root : sign_ * root, large = b > 0.0 ? b + root : b - root;
  float first = -large * perA, second = ray.isOwn ? first : -c / large;
  bool isSecond = b > 0.0 == turned > 0.0;  // as `large` does, where b is 0
  float to = isSecond ? second : first, away = isSecond ? first : second;

  // What of a meeting at `to` there is; and at another one: where the point lies on the surface within rounding, that is no
  // meeting where this goes on beyond its edges; where the ray grazes it, if anything, it is near the vertex of the parabola.
  // Both, to first order, times 2: what is off of F at a root, by its slope, and of the root of D.
  float eLarge = eSquare / max(abs(large), kTiny);
  float eTo = (ec + abs(to) * (2.0 * eb + abs(to) * ea + eLarge)) * perRoot;
  float other = touches ? 0.0 : isClear ? away : -b * perA;
  float eOther = touches ? 2.0 * ec * perRoot
                 : isClear ? (ec + abs(away) * (2.0 * eb + abs(away) * ea + eLarge)) * perRoot
                           : (eb + abs(other) * ea + sqrt(2.0 * eSquare)) / max(abs(a) - ea, kTiny);
  int insideTo = isClear ? insideAt(caster, end, to, eTo) : 0, insideOther = insideAt(caster, end, other, eOther);
  if (touches && !(isClear && insideOther < 0)) return kOpen;
  if (!(abs(start) > eStart)) return kOpen;
  if (isSurelyPast) return kPassed;
  if (turns) return insideTo > 0 ? kMet : insideTo < 0 ? kPassed : kOpen;
  // How far the other one is beyond the light, and behind the point.
  float beyond = caster.light.w == 0.0 ? -1e30 : fromLight ? -other : other - 1.0, behind = fromLight ? other - 1.0 : -other;
  if (beyond > eOther || (isClear && behind > eOther)) return kPassed;
  if (!isClear) return insideOther < 0 ? kPassed : kOpen;
  if (!(max(beyond, behind) < -eOther)) return kOpen;
  return insideOther > 0 || insideTo > 0 ? kMet : insideOther < 0 && insideTo < 0 ? kPassed : kOpen;
}
