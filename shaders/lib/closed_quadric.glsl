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

// 1: the point at t, which may be off by `dt`, is one of the patch; -1: it is not; 0: floats do not tell.
int insideAt(ClosedCaster caster, ClosedRay ray, float t, float dt) {
  vec3 p = ray.from + t * ray.way, e = 2.0 * ray.e + abs(ray.way) * (dt + kUlps * abs(t));
  if ((caster.flags & kRadialCaster) != 0) {
    p = vec3(length(p.xz), p.y, 0);
    e = vec3(e.x + e.z, e.y, 0);
  }
  vec3 inside = min(p - caster.lowest, caster.highest - p), least = inside - e, most = inside + e;
  if (min(min(least.x, least.y), least.z) > 0.0) return 1;
  return min(min(most.x, most.y), most.z) < 0.0 ? -1 : 0;
}

int meets(ClosedCaster caster, ClosedRay ray) {
  vec3 q = ray.from, d = ray.way, e = ray.e, ed = ray.eOfWay, A = caster.squares;
  float l = caster.halfY, k = caster.constant, atLight = caster.atLight;
  vec3 half_ = A * q, Ad = A * d, size = abs(A);
  half_.y += l;
  float b = dot(half_, d), a = dot(Ad, d), c = dot(half_, q) + l * q.y + k;
  vec3 D_ = abs(d) + ed, AD = size * D_;
  float ec = 2.0 * dot(abs(half_) + size * e, e) + kUlps * (dot(size * q, q) + 2.0 * abs(l * q.y) + abs(k));
  float eb = dot(AD, e) + dot(size * abs(q), ed) + abs(l) * ed.y, ea = 2.0 * dot(AD, ed);
  float ebOfOwn = eb + dot(AD + size * abs(q), ray.off) + abs(l) * ray.off.y;

  vec3 light = caster.light.xyz, m = cross(q, light), AA = A.yzx * A.zxy;
  vec3 em = 2.0 * (abs(light.yzx) * e.zxy + abs(light.zxy) * e.yzx), M = abs(m) + em;
  float square = 2.0 * l * (Ad.x * m.z - Ad.z * m.x) + l * l * d.y * d.y - k * a - dot(AA * m, m);
  float eSquare = 2.0 * (dot(abs(AA) * M, em) + l * l * D_.y * ed.y + abs(k) * dot(AD, ed) +
                         abs(l) * (AD.x * em.z + AD.z * em.x + size.x * M.z * ed.x + size.z * M.x * ed.z));
  if (ray.isOwn) {
    square = b * b;
    eSquare = ec = 0.0;
  }
  float root = sqrt(max(square, 0.0)), sign_ = atLight > 0.0 ? 1.0 : -1.0;
  // The roots where F turns to the light's sign, and where it turns away from that. Of the two ways to write a root the one
  // that cancels nothing.
  float turned = sign_ * root;
  float to = b * turned > 0.0 && !ray.isOwn ? -c / (b + turned) : (turned - b) / a;
  float away = b * turned < 0.0 ? -c / (b - turned) : (-turned - b) / a;

  bool touches = !ray.isOwn && abs(c) <= ec;
  float start = ray.isOwn || touches ? b : c, eStart = ray.isOwn ? ebOfOwn : touches ? eb : ec;
  float perRoot = 1.0 / max(root, kTiny);
  float eTo = (ec + abs(to) * (2.0 * eb + abs(to) * ea)) * perRoot;
  bool isClear = ray.isOwn ? root > 0.0 : square > eSquare;
  // Of a point that lies on the surface within rounding, where that goes on beyond its edges, t = 0 is no meeting.
  if (touches && !(isClear && insideAt(caster, ray, 0.0, 2.0 * ec * perRoot) < 0)) return kOpen;
  if (!(abs(start) > eStart)) return kOpen;
  if (start * sign_ < 0.0) {  // one root
    int inside = isClear ? insideAt(caster, ray, to, eTo) : 0;
    return inside > 0 ? kMet : inside < 0 ? kPassed : kOpen;
  }
  if (ray.isOwn || touches || square < -eSquare || b * sign_ > eb) return kPassed;
  if (!isClear) {  // it grazes the surface, if anything, near the vertex of the parabola
    float perA = 1.0 / max(abs(a) - ea, kTiny), vertex = -b / a;
    float eVertex = (eb + abs(vertex) * ea + sqrt(2.0 * eSquare)) * perA;
    bool isBeyond = caster.light.w != 0.0 && vertex - eVertex > 1.0;
    return isBeyond || insideAt(caster, ray, vertex, eVertex) < 0 ? kPassed : kOpen;
  }
  float eAway = (ec + abs(away) * (2.0 * eb + abs(away) * ea)) * perRoot;
  if (away + eAway < 0.0 || (caster.light.w != 0.0 && away - eAway > 1.0)) return kPassed;
  if (!(away - eAway > 0.0 && (caster.light.w == 0.0 || away + eAway < 1.0))) return kOpen;
  int first = insideAt(caster, ray, away, eAway), second = insideAt(caster, ray, to, eTo);
  return first > 0 || second > 0 ? kMet : first < 0 && second < 0 ? kPassed : kOpen;
}
