// SPDX-License-Identifier: Apache-2.0
// The numbers of an equation, and (u, v) of its points.

real number(uint k) { return surfaceParameterAt(k); }
real3 number3(uint k) { return real3(number(k), number(k + 1), number(k + 2)); }

// The part of the circle, 0 to 1: an eighth of it or less, and quarters. Only their sum is rounded to the last bit of 1.
real turnOf(real y, real x) {
  real wide = abs(x), high = abs(y);
  bool steep = high > wide;
  real eighth = formulaAtan(min(wide, high) / max(max(wide, high), kSmallest)) * real(0.15915494309189535);
  float quarters = steep ? (y < 0.0 ? 3.0 : 1.0) : x < 0.0 ? 2.0 : y < 0.0 ? 4.0 : 0.0;
  bool backward = steep == (x < 0.0 == y < 0.0);
  return 0.25 * quarters + (backward ? -eighth : eighth);
}

// u or v of a point, as Equation::Parameter has it: a linear function of what it goes along.
float parameterOf(real3 p, uint k) {
  real3 q = p / number3(kEquationScale);
  real radius = sqrt(q.x * q.x + q.z * q.z);
  uint along = uint(number(k));
  real of = along == kAlongX   ? q.x
            : along == kAlongY ? q.y
            : along == kAlongZ ? q.z
            : along == kAlongRadius ? radius
            : along == kAlongTurn ? turnOf(-q.z, q.x)
            : along == kAlongLatitude ? formulaAtan2(q.y, radius) * real(0.31830988618379067)
                         : turnOf(q.y, radius - 1.0);
  return float(number(k + 1) + number(k + 2) * of);
}

#ifdef LUXO_TEXTURED
// How that moves with the point: from its gradient.
vec3 gradientOf(real3 p, uint k) {
  vec3 scale = vec3(number3(kEquationScale)), q = vec3(p) / scale;
  float radius = sqrt(q.x * q.x + q.z * q.z), perRadius = 1.0 / max(radius, kSmallest);
  vec3 outward = vec3(q.x * perRadius, 0, q.z * perRadius);
  uint along = uint(number(k));
  float height = radius - (along == kAlongLatitude ? 0.0 : 1.0), square = max(height * height + q.y * q.y, kSmallest);
  vec3 upward = (vec3(0, height, 0) - q.y * outward) / square;  // of the angle above the plane, or around a ring
  vec3 of = along == kAlongX   ? vec3(1, 0, 0)
            : along == kAlongY ? vec3(0, 1, 0)
            : along == kAlongZ ? vec3(0, 0, 1)
            : along == kAlongRadius ? outward
            : along == kAlongTurn ? vec3(q.z, 0, -q.x) * (0.15915494309189535 * perRadius * perRadius)
            : along == kAlongLatitude ? upward * 0.31830988618379067
                         : upward * 0.15915494309189535;
  return float(number(k + 2)) * of / scale;
}

// From how the point moves from a pixel to the next.
void setFootprint(real3 p, vec3 right, vec3 below) {
  vec3 u = gradientOf(p, kEquationU), v = gradientOf(p, kEquationV);
  rootFootprint = vec4(dot(u, right), dot(v, right), dot(u, below), dot(v, below));
}
#endif

#if defined(LUXO_FRAMED) || defined(LUXO_FINDS_FRAME)
// Of a point with the normal n (object space, any length): along the tangent plane v does not change where u grows.
void setFrame(real3 p, vec3 n, vec3 outward) {
  vec3 u = unitOrZero(gradientOf(p, kEquationU)), v = unitOrZero(gradientOf(p, kEquationV));
  vec3 alongU = cross(n, v), alongV = cross(n, u);
  vec3 right = relative(dot(u, alongU) < 0.0 ? -alongU : alongU), up = relative(dot(v, alongV) < 0.0 ? -alongV : alongV);
  rootFrame = vec4(unitOrZero(right), dot(cross(right, up), outward) < 0.0 ? -1.0 : 1.0);
}
#endif

// Whether the object's transform turns right hands into left ones.
bool isMirrored() { return (has(kNegative) != has(kBackSide)) == has(kInward); }
