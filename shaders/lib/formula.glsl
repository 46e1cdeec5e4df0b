// SPDX-License-Identifier: Apache-2.0
// The functions of formulas in float, where a device's own promise less: sin and cos of Vulkan may be wrong by 2^-11,
// asin by 4096 units in the last place, pow(0, 0) and pow of negative numbers by anything. These are within a few units
// on every device; tests/gpu/formula_glsl_test.cpp states and measures how many. Where C has an infinity or a NaN, so
// have they.
//
// Each is reduced to a short interval and evaluated there by a polynomial: the best one of its degree in relative error
// (Remez), rounded to float; its error is below 7e-9, a tenth of a unit. Cody-Waite reduction: constants are split into
// parts of few bits, so that multiples of the first parts are exact.
#ifndef LUXO_LIB_FORMULA_GLSL
#define LUXO_LIB_FORMULA_GLSL

const float kHalfPi = 1.57079633;
const float kHalfPiRest = -4.37113883e-8;  // pi/2 - kHalfPi
const float kLn2High = 0.693359375;        // 10 bits
const float kLn2Low = -2.12194440e-4;

float formulaNan() { return uintBitsToFloat(0x7fc00000u); }
float formulaInfinity() { return uintBitsToFloat(0x7f800000u); }

// These pass on a NaN, as all formulas do. Both operands are asked: devices have instructions for x < y ? x : y that leave out
// a NaN wherever it stands.
float formulaMin(float x, float y) { return x == x && y == y ? (x < y ? x : y) : x + y; }
float formulaMax(float x, float y) { return x == x && y == y ? (x > y ? x : y) : x + y; }
float formulaSign(float x) { return x > 0.0 ? 1.0 : x < 0.0 ? -1.0 : x; }

// x * 2^n for results in range, in two steps, as 2^n alone may be out of it.
float formulaScale(float x, int n) {
  int half_ = n >> 1;
  return x * intBitsToFloat((half_ + 127) << 23) * intBitsToFloat((n - half_ + 127) << 23);
}

// e^x * 2^n.
float formulaExpScaled(float x, int n) {
  float multiple = round(clamp(x, -150.0, 150.0) * 1.44269504);
  float r = (x - multiple * kLn2High) - multiple * kLn2Low;
  float p = 0.49999994 + r * (0.166665196 + r * (0.0416684002 + r * (0.00836886372 + r * 0.00138144102)));
  float y = formulaScale(1.0 + (r + r * r * p), int(multiple) + n);
  return x > 90.0 ? formulaInfinity() : x < -104.0 ? 0.0 : y;
}

float formulaExp(float x) {
  float y = formulaExpScaled(x, 0);
  return x > 88.7228394 ? formulaInfinity() : y;
}

// x = m * 2^e with m from sqrt(1/2) to sqrt(2); x positive and finite.
int formulaExponent(float x, out float m) {
  int bits = floatBitsToInt(x);
  int e = (bits - 0x3f3504f3) >> 23;
  m = intBitsToFloat(bits - (e << 23));
  return e;
}

// log m = 2 atanh s with s = (m - 1) / (m + 1), |s| < 0.172.
float formulaLog(float x) {
  bool small = x < 1.17549435e-38;
  float m;
  float e = float(formulaExponent(small ? x * 8388608.0 : x, m) - (small ? 23 : 0));
  float s = (m - 1.0) / (m + 1.0), z = s * s;
  float p = 0.666667759 + z * (0.399775714 + z * 0.298710495);
  float y = e * kLn2High + (2.0 * s + (s * z * p + e * kLn2Low));
  return x > 0.0 ? (x <= 3.40282347e38 ? y : formulaInfinity()) : x == 0.0 ? -formulaInfinity() : formulaNan();
}

// |r| <= pi/4.
float formulaSinNearZero(const float r) {
  float z = r * r;
  return r + r * z * (-0.166666538 + z * (0.00833213702 - z * 0.000195120287));
}

float formulaCosNearZero(const float r) {
  float z = r * r;
  return 1.0 - (0.5 * z - z * z * (0.0416666456 + z * (-0.00138872839 + z * 2.44294388e-5)));
}

// Sine and cosine of quadrant * pi/2 + r: both are made of the same two numbers. Operands of ?: are names, so that nothing
// branches.
vec2 formulaSinCosIn(const int quadrant, const float r) {
  float s = formulaSinNearZero(r), c = formulaCosNearZero(r);
  bool even = (quadrant & 1) == 0;
  float sine = even ? s : c, cosine = even ? c : s, minusSine = -sine, minusCosine = -cosine;
  return vec2((quadrant & 2) == 0 ? sine : minusSine, ((quadrant + 1) & 2) == 0 ? cosine : minusCosine);
}

// x = quadrants * pi/2 + r with |r| <= pi/4. Past 1e5 r is wrong by as much as x is by being a float.
float formulaQuadrants(const float x) { return round(x * 0.636619772); }
float formulaInQuadrant(const float x, const float quadrants) {
  float r = ((x - quadrants * 1.5) - quadrants * 0.0703125) - quadrants * 4.83751297e-4;
  return (r - quadrants * 7.54953362e-8) - quadrants * 2.56334407e-12;
}

vec2 formulaSinCos(const float x) {
  float quadrants = formulaQuadrants(x);
  return formulaSinCosIn(int(quadrants), formulaInQuadrant(x, quadrants));
}

// times * x without its whole part. `times` has 12 bits at most, and so have both parts of x: products are exact.
float formulaTurns(float x, float times) {
  float high = uintBitsToFloat(floatBitsToUint(x) & 0xfffff000u);
  float turns = high * times;
  return turns - round(turns) + (x - high) * times;
}

// Of angles in turns, of which a float has as many as of radians, and whole ones to take away without rounding.
vec2 formulaSinCosTurns(const float turns) {
  float quarters = 4.0 * (turns - round(turns));
  float whole = round(quarters), part = quarters - whole;
  return formulaSinCosIn(int(whole), part * kHalfPi + part * kHalfPiRest);
}

float formulaTan(const float x) {
  float quadrants = formulaQuadrants(x), r = formulaInQuadrant(x, quadrants);
  float s = formulaSinNearZero(r), c = formulaCosNearZero(r);
  bool even = (int(quadrants) & 1) == 0;
  float minusC = -c, above = even ? s : minusC, below = even ? c : s;
  return above / below;
}

// |x| <= 1/2.
float formulaAsinNearZero(float x) {
  float z = x * x;
  float p = 0.0241795145 + z * 0.0421663076;
  return x + x * z * (0.166667521 + z * (0.0749529749 + z * (0.0454703756 + z * p)));
}

// asin sqrt((1 - x) / 2), which is half the arc cosine: accurate where x is near 1.
float formulaHalfAcos(float x) { return formulaAsinNearZero(sqrt(max(0.5 - 0.5 * x, 0.0))); }

float formulaAsin(float x) {
  float a = abs(x);
  float y = a <= 0.5 ? formulaAsinNearZero(a) : kHalfPi - (2.0 * formulaHalfAcos(a) - kHalfPiRest);
  return a <= 1.0 ? (x < 0.0 ? -y : y) : formulaNan();
}

float formulaAcos(float x) {
  float a = abs(x);
  float end = 2.0 * formulaHalfAcos(a);
  float y = a <= 0.5 ? kHalfPi - (formulaAsinNearZero(x) - kHalfPiRest)
            : x > 0.0 ? end
                      : 2.0 * kHalfPi - (end - 2.0 * kHalfPiRest);
  return a <= 1.0 ? y : formulaNan();
}

// 0 <= t <= 1. Above tan(pi/8), atan t = pi/4 + atan((t - 1) / (t + 1)).
float formulaAtanUnit(float t) {
  bool large = t > 0.414213562;
  float r = large ? (t - 1.0) / (t + 1.0) : t, z = r * r;
  float p = -0.142434776 + z * (0.1059338 - z * 0.0607706904);
  float y = r + r * z * (-0.333333164 + z * (0.199984685 + z * p));
  return large ? 0.5 * kHalfPi + (y + 0.5 * kHalfPiRest) : y;
}

float formulaAtan(float x) {
  float a = abs(x);
  float y = a <= 1.0 ? formulaAtanUnit(a) : kHalfPi - (formulaAtanUnit(1.0 / a) - kHalfPiRest);
  return x != x ? x : (x < 0.0 ? -y : y);
}

// From -pi to pi; the signs of zeros count, as in C.
float formulaAtan2(float y, float x) {
  float ax = abs(x), ay = abs(y);
  float longer = ax < ay ? ay : ax, shorter = ax < ay ? ax : ay;
  float t = shorter == longer ? (longer == 0.0 ? 0.0 : 1.0) : shorter / longer;
  float angle = formulaAtanUnit(t);
  if (ay > ax) angle = kHalfPi - (angle - kHalfPiRest);
  if (floatBitsToInt(x) < 0) angle = 2.0 * kHalfPi - (angle - 2.0 * kHalfPiRest);
  return x != x || y != y ? formulaNan() : (floatBitsToInt(y) < 0 ? -angle : angle);
}

// Half of e^|x| does not overflow before the hyperbolic functions do.
float formulaSinh(float x) {
  float z = x * x;
  if (z < 1.0)
    return x + x * z * (0.166666672 + z * (0.0083333496 + z * (0.000198361595 + z * 2.81695111e-6)));
  float h = formulaExpScaled(abs(x), -1), y = h - 0.25 / h;
  return x < 0.0 ? -y : y;
}

float formulaCosh(float x) {
  float h = formulaExpScaled(abs(x), -1);
  return h + 0.25 / h;
}

float formulaTanh(float x) {
  float z = x * x;
  if (z < 0.36) {
    float p = -0.0537838303 + z * (0.0207959712 - z * 0.00589515688);
    return x + x * z * (-0.333332986 + z * (0.133319244 + z * p));
  }
  float y = 1.0 - 2.0 / (formulaExp(2.0 * abs(x)) + 1.0);
  return x < 0.0 ? -y : y;
}

// engine/math/cardinal.h: its series where |w| is small, upwards from sine and cosine elsewhere; the order is a constant.
float formulaCardinal(float w, const int order) {
  float sum = 1.0, first = 1.0;
  for (int k = 12; k >= 1; --k) sum = 1.0 - sum * w * (1.0 / float(2 * k * (2 * order + 2 * k + 1)));
  for (int n = 1; n <= order; ++n) first *= 1.0 / float(2 * n + 1);
  float x = sqrt(abs(w));
  vec2 turning = formulaSinCos(x);
  float below = w > 0.0 ? turning.y : formulaCosh(x), here = (w > 0.0 ? turning.x : formulaSinh(x)) / x;
  for (int n = 0; n < order; ++n) {
    float above = (float(2 * n + 1) * here - below) / w;
    below = here;
    here = above;
  }
  return w > -40.0 && w < float(9 + 4 * order) ? first * sum : here;
}

// The rounding error of the product `ab` of a and b (Dekker), for factors below 1e34.
float formulaProductError(float a, float b, float ab) {
  precise float ca = 4097.0 * a, cb = 4097.0 * b;
  precise float aHigh = ca - (ca - a), bHigh = cb - (cb - b);
  precise float aLow = a - aHigh, bLow = b - bHigh;
  precise float error = ((aHigh * bHigh - ab) + aHigh * bLow + aLow * bHigh) + aLow * bLow;
  return error;
}

// e^(y log x) for positive finite x. The exponent may be near 100 and its error becomes relative: the logarithm and the
// product are kept as sums of two floats.
float formulaPowPositive(float x, float y) {
  bool small = x < 1.17549435e-38;
  float m;
  float e = float(formulaExponent(small ? x * 8388608.0 : x, m) - (small ? 23 : 0));
  // s = (m - 1) / (m + 1) and what its rounding left over.
  precise float f = m - 1.0, g = m + 1.0, gRest = m - (g - 1.0);
  precise float s = f / g, sg = s * g;
  precise float sRest = (((f - sg) - formulaProductError(s, g, sg)) - s * gRest) / g;
  float z = s * s;
  float p = 0.666666627 + z * (0.400003344 + z * (0.28537342 + z * 0.235815912));
  precise float scaled = e * kLn2High, sum = scaled + 2.0 * s;
  // |scaled| is 0 or the larger one.
  precise float sumRest = 2.0 * s - (sum - scaled);
  precise float rest = (2.0 * sRest + s * z * p) + (e * kLn2Low + sumRest);
  precise float high = sum + rest, low = rest - (high - sum);
  precise float product = y * high;
  precise float productRest = formulaProductError(y, high, product) + y * low;
  if (!(abs(product) < 200.0)) return product > 0.0 ? formulaInfinity() : 0.0;
  return formulaExp(product) * (1.0 + productRest);
}

// As std::pow: x^0 = 1^y = 1; a negative finite x only takes integers.
float formulaPow(float x, float y) {
  if (y == 0.0 || x == 1.0) return 1.0;
  if (x != x || y != y) return formulaNan();
  float a = abs(x);
  bool integer = floor(y) == y, odd = integer && abs(y) < 16777216.0 && floor(0.5 * y) != 0.5 * y;
  if (x < 0.0 && a <= 3.40282347e38 && !integer) return formulaNan();
  float result;
  if (a == 0.0 || a > 3.40282347e38)
    result = (a == 0.0) == (y > 0.0) ? 0.0 : formulaInfinity();
  else
    // Beyond 4e10 the power of the neighbours of 1 is already 0 or infinite.
    result = formulaPowPositive(a, clamp(y, -4e10, 4e10));
  return floatBitsToInt(x) < 0 && odd ? -result : result;
}
#endif
