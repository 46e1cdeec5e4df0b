// SPDX-License-Identifier: Apache-2.0
// The functions of formulas in double, which GLSL has in float only: the same names as in lib/formula.glsl, for other
// arguments, made the same way. Within a few units in the last place; tests/gpu/formula_double_test.cpp states and
// measures how many. Where C has an infinity or a NaN, so have they.
//
// Polynomials are the best ones of their degree in relative error (Remez), rounded to double; their error is below 2e-17.
// A CPU device runs both sides of every branch, and converts no vector of doubles to integers: the nearest integer is
// found by an addition, and read from the sum's last bits.
#ifndef LUXO_LIB_DOUBLE_MATH_GLSL
#define LUXO_LIB_DOUBLE_MATH_GLSL
#include "lib/formula.glsl"

const double kDoubleHalfPi = 1.5707963267948966lf;
const double kDoubleHalfPiRest = 6.123233995736766e-17lf;  // pi/2 - kDoubleHalfPi
const double kDoubleLn2High = 0.69314718055920821lf;       // 40 bits
const double kDoubleLn2Low = 7.3710025651677989e-13lf;
const double kDoubleLargest = 1.7976931348623157e308lf;
const double kDoubleSmallest = 2.2250738585072014e-308lf;  // with all its bits

double doubleNan() { return packDouble2x32(uvec2(0u, 0x7ff80000u)); }
double doubleInfinity() { return packDouble2x32(uvec2(0u, 0x7ff00000u)); }
int highBits(double x) { return int(unpackDouble2x32(x).y); }

// 2^n, for -1023 < n < 1024.
double doublePower2(int n) { return packDouble2x32(uvec2(0u, uint(n + 1023) << 20)); }

// The integer nearest to x, for |x| < 2^51; `n` has its last 32 bits.
double nearestInteger(double x, out int n) {
  const double kShift = 6755399441055744.0lf;  // 3 * 2^51: the unit of its last place is 1
  precise double sum = x + kShift;
  n = int(unpackDouble2x32(sum).x);
  precise double nearest = sum - kShift;
  return nearest;
}

double formulaMin(double x, double y) { return x == x && y == y ? (x < y ? x : y) : x + y; }
double formulaMax(double x, double y) { return x == x && y == y ? (x > y ? x : y) : x + y; }
double formulaSign(double x) { return x > 0.0lf ? 1.0lf : x < 0.0lf ? -1.0lf : x; }

// x * 2^n for results in range, in two steps, as 2^n alone may be out of it.
double formulaScale(double x, int n) {
  int half_ = n >> 1;
  return x * doublePower2(half_) * doublePower2(n - half_);
}

// e^x * 2^n.
double formulaExpScaled(double x, int n) {
  int whole;
  double multiple = nearestInteger(clamp(x, -800.0lf, 800.0lf) * 1.4426950408889634lf, whole);
  precise double r = (x - multiple * kDoubleLn2High) - multiple * kDoubleLn2Low;
  double p = 2.4801492900396793e-05lf +
             r * (2.7557578591739781e-06lf + r * (2.7630323637763444e-07lf + r * 2.5002896739253853e-08lf));
  p = 0.0083333333334916736lf + r * (0.0013888888943808496lf + r * (0.00019841269513961267lf + r * p));
  p = 0.50000000000000111lf + r * (0.16666666666666416lf + r * (0.041666666666529538lf + r * p));
  double y = formulaScale(1.0lf + (r + r * r * p), whole + n);
  return x > 720.0lf ? doubleInfinity() : x < -746.0lf ? 0.0lf : y;
}

double formulaExp(double x) {
  double y = formulaExpScaled(x, 0);
  return x > 709.78271289338397lf ? doubleInfinity() : y;
}

// x = m * 2^e with m from sqrt(1/2) to sqrt(2); x positive and finite.
double formulaExponent(double x, out double m) {
  bool small = x < kDoubleSmallest;
  uvec2 bits = unpackDouble2x32(small ? x * 18014398509481984.0lf : x);
  int e = (int(bits.y) - 0x3fe6a09e) >> 20;
  m = packDouble2x32(uvec2(bits.x, bits.y - (uint(e) << 20)));
  return double(e - (small ? 54 : 0));
}

// (log m - 2 s) / s^3, where z = s * s and log m = 2 atanh s with s = (m - 1) / (m + 1), |s| < 0.172.
double doubleLogRest(double z) {
  double p = 0.18181775725875973lf + z * (0.15387088290507439lf + z * (0.13250170418321552lf + z * 0.13250880099212789lf));
  p = 0.40000000000006225lf + z * (0.28571428569091739lf + z * (0.22222222645984271lf + z * p));
  return 0.66666666666666663lf + z * p;
}

double formulaLog(double x) {
  double m;
  double e = formulaExponent(x, m);
  double s = (m - 1.0lf) / (m + 1.0lf), z = s * s;
  precise double y = e * kDoubleLn2High + (2.0lf * s + (s * z * doubleLogRest(z) + e * kDoubleLn2Low));
  return x > 0.0lf ? (x <= kDoubleLargest ? y : doubleInfinity()) : x == 0.0lf ? -doubleInfinity() : doubleNan();
}

// |r| <= pi/4.
double formulaSinNearZero(const double r) {
  double z = r * r;
  double p = 2.7557313621655308e-06lf + z * (-2.5050747802229092e-08lf + z * 1.5896232277358292e-10lf);
  return r + r * z * (-0.1666666666666663lf + z * (0.00833333333332212lf + z * (-0.00019841269829590368lf + z * p)));
}

double formulaCosNearZero(const double r) {
  double z = r * r;
  double p = -2.7557314179475586e-07lf + z * (2.0875700862571598e-09lf - z * 1.1358537423957617e-11lf);
  p = 0.041666666666666595lf + z * (-0.0013888888888873058lf + z * (2.4801587288852439e-05lf + z * p));
  double half_ = 0.5lf * z;
  precise double w = 1.0lf - half_, rest = (1.0lf - w) - half_;
  return w + (rest + z * z * p);
}

// x = quadrant * pi/2 + r with |r| <= pi/4. Past 1e7 r is wrong by as much as x is by being a double.
int formulaQuadrant(const double x, out double r) {
  int quadrant;
  double multiple = nearestInteger(x * 0.63661977236758138lf, quadrant);
  precise double rest = (x - multiple * 1.570796325802803lf) - multiple * 9.9209357916352214e-10lf;
  rest -= multiple * 5.1701829817941051e-19lf;
  r = rest;
  return quadrant;
}

dvec2 formulaSinCos(const double x) {
  double r;
  int quadrant = formulaQuadrant(x, r);
  double s = formulaSinNearZero(r), c = formulaCosNearZero(r);
  bool even = (quadrant & 1) == 0;
  double sine = even ? s : c, cosine = even ? c : s, minusSine = -sine, minusCosine = -cosine;
  return dvec2((quadrant & 2) == 0 ? sine : minusSine, ((quadrant + 1) & 2) == 0 ? cosine : minusCosine);
}

double formulaTan(const double x) {
  double r;
  int quadrant = formulaQuadrant(x, r);
  double s = formulaSinNearZero(r), c = formulaCosNearZero(r), minusC = -c;
  bool even = (quadrant & 1) == 0;
  double above = even ? s : minusC, below = even ? c : s;
  return above / below;
}

// |x| <= 1/2.
double formulaAsinNearZero(double x) {
  double z = x * x;
  double p = 0.0065280373513446795lf +
             z * (0.019528092179763121lf + z * (-0.01622397687000534lf + z * 0.031912078063560063lf));
  p = 0.022371758064758912lf +
      z * (0.017359704550256115lf + z * (0.013885237579060374lf + z * (0.012169197554863398lf + z * p)));
  p = 0.075000000003369954lf + z * (0.044642856828343895lf + z * (0.03038195913634997lf + z * p));
  return x + x * z * (0.16666666666665408lf + z * p);
}

// Of the arc cosine near 1, asin sqrt((1 - x) / 2) is half.
double formulaAsin(double x) {
  double a = abs(x);
  bool small = a <= 0.5lf;
  double part = formulaAsinNearZero(small ? a : sqrt(max(0.5lf - 0.5lf * a, 0.0lf)));
  double y = small ? part : kDoubleHalfPi - (2.0lf * part - kDoubleHalfPiRest);
  return a <= 1.0lf ? (x < 0.0lf ? -y : y) : doubleNan();
}

double formulaAcos(double x) {
  double a = abs(x);
  bool small = a <= 0.5lf;
  double part = formulaAsinNearZero(small ? x : sqrt(max(0.5lf - 0.5lf * a, 0.0lf)));
  double y = small      ? kDoubleHalfPi - (part - kDoubleHalfPiRest)
             : x > 0.0lf ? 2.0lf * part
                         : 2.0lf * (kDoubleHalfPi - (part - kDoubleHalfPiRest));
  return a <= 1.0lf ? y : doubleNan();
}

// The angle of (x, y), for x, y >= 0, not both infinite or 0. Above tan(pi/8), atan t = pi/4 + atan((t - 1) / (t + 1)).
double formulaAtanPositive(double y, double x) {
  bool steep = y > x;
  double longer = steep ? y : x, shorter = steep ? x : y;
  bool large = shorter > 0.41421356237309503lf * longer;
  // Halved, or the sum might overflow.
  double r = (large ? 0.5lf * shorter - 0.5lf * longer : shorter) / (large ? 0.5lf * shorter + 0.5lf * longer : longer);
  double z = r * r;
  double p = 0.058478485041656224lf +
             z * (-0.050391407267709291lf + z * (0.038060848220919735lf - z * 0.017903594270168958lf));
  p = 0.11111110781926474lf + z * (-0.090908977184895073lf + z * (0.076920595937767539lf + z * (-0.066630977605441802lf + z * p)));
  p = -0.33333333333333198lf + z * (0.19999999999953205lf + z * (-0.14285714280162121lf + z * p));
  double angle = r + r * z * p;
  // One sum from the largest term on: pi/4, pi/2 or nothing, plus or minus the angle.
  double base = large ? 0.5lf : steep ? 1.0lf : 0.0lf;
  double signed_ = steep ? -angle : angle;
  return base * kDoubleHalfPi + (signed_ + base * kDoubleHalfPiRest);
}

double formulaAtan(double x) {
  double y = formulaAtanPositive(abs(x), 1.0lf);
  return x != x ? x : (x < 0.0lf ? -y : y);
}

// From -pi to pi; the signs of zeros count, as in C.
double formulaAtan2(double y, double x) {
  double ax = abs(x), ay = abs(y);
  bool infinite = ax > kDoubleLargest && ay > kDoubleLargest, zero = ax == 0.0lf && ay == 0.0lf;
  double angle = formulaAtanPositive(infinite ? 1.0lf : zero ? 0.0lf : ay, infinite || zero ? 1.0lf : ax);
  if (highBits(x) < 0) angle = 2.0lf * kDoubleHalfPi - (angle - 2.0lf * kDoubleHalfPiRest);
  return x != x || y != y ? doubleNan() : (highBits(y) < 0 ? -angle : angle);
}

// Half of e^|x| does not overflow before the hyperbolic functions do.
double formulaSinh(double x) {
  double z = x * x;
  double p = 2.7557319157076397e-06lf +
             z * (2.5052123136039729e-08lf + z * (1.6057259819551916e-10lf + z * 7.7587473233284708e-13lf));
  p = 0.16666666666666669lf + z * (0.0083333333333331476lf + z * (0.00019841269841431856lf + z * p));
  double h = formulaExpScaled(abs(x), -1), y = h - 0.25lf / h;
  return z < 1.0lf ? x + x * z * p : x < 0.0lf ? -y : y;
}

double formulaCosh(double x) {
  double h = formulaExpScaled(abs(x), -1);
  return h + 0.25lf / h;
}

double formulaTanh(double x) {
  double z = x * x;
  double p = -0.00023039673416603573lf + z * (7.9313858126807884e-05lf - z * 1.7178677343625555e-05lf);
  p = -0.0088632267772332431lf +
      z * (0.0035920373773645135lf + z * (-0.0014552153525660937lf + z * (0.00058718836962219872lf + z * p)));
  p = 0.13333333333299663lf + z * (-0.053968253949295213lf + z * (0.021869488002548263lf + z * p));
  double y = 1.0lf - 2.0lf / (formulaExp(2.0lf * abs(x)) + 1.0lf);
  return z < 0.36lf ? x + x * z * (-0.33333333333333126lf + z * p) : x < 0.0lf ? -y : y;
}

// As in lib/formula.glsl.
double formulaCardinal(double w, const int order) {
  double sum = 1.0lf, first = 1.0lf;
  for (int k = 32; k >= 1; --k) sum = 1.0lf - sum * w * (1.0lf / double(2 * k * (2 * order + 2 * k + 1)));
  for (int n = 1; n <= order; ++n) first *= 1.0lf / double(2 * n + 1);
  double x = sqrt(abs(w));
  dvec2 turning = formulaSinCos(x);
  double below = w > 0.0lf ? turning.y : formulaCosh(x), here = (w > 0.0lf ? turning.x : formulaSinh(x)) / x;
  for (int n = 0; n < order; ++n) {
    double above = (double(2 * n + 1) * here - below) / w;
    below = here;
    here = above;
  }
  return w > -100.0lf && w < double(9 + 4 * order) ? first * sum : here;
}

// The rounding error of the product `ab` of a and b (Dekker), for factors below 1e290.
double formulaProductError(double a, double b, double ab) {
  precise double ca = 134217729.0lf * a, cb = 134217729.0lf * b;
  precise double aHigh = ca - (ca - a), bHigh = cb - (cb - b);
  precise double aLow = a - aHigh, bLow = b - bHigh;
  precise double error = ((aHigh * bHigh - ab) + aHigh * bLow + aLow * bHigh) + aLow * bLow;
  return error;
}

// e^(y log x) for positive finite x. The exponent may be near 700 and its error becomes relative: the logarithm and the
// product are kept as sums of two doubles.
double formulaPowPositive(double x, double y) {
  double m;
  double e = formulaExponent(x, m);
  // s = (m - 1) / (m + 1) and what its rounding left over.
  precise double f = m - 1.0lf, g = m + 1.0lf, gRest = m - (g - 1.0lf);
  precise double s = f / g, sg = s * g;
  precise double sRest = (((f - sg) - formulaProductError(s, g, sg)) - s * gRest) / g;
  double z = s * s;
  precise double scaled = e * kDoubleLn2High, sum = scaled + 2.0lf * s;
  // |scaled| is 0 or the larger one.
  precise double sumRest = 2.0lf * s - (sum - scaled);
  precise double rest = (2.0lf * sRest + s * z * doubleLogRest(z)) + (e * kDoubleLn2Low + sumRest);
  precise double high = sum + rest, low = rest - (high - sum);
  precise double product = y * high;
  precise double productRest = formulaProductError(y, high, product) + y * low;
  double result = formulaExp(product) * (1.0lf + productRest);
  return abs(product) < 1500.0lf ? result : product > 0.0lf ? doubleInfinity() : 0.0lf;
}

// As std::pow: x^0 = 1^y = 1; a negative finite x only takes integers.
double formulaPow(double x, double y) {
  double a = abs(x);
  bool integer = floor(y) == y, odd = integer && abs(y) < 9007199254740992.0lf && floor(0.5lf * y) != 0.5lf * y;
  // Beyond 1e19 the power of the neighbours of 1 is already 0 or infinite.
  double result = formulaPowPositive(a, clamp(y, -1e19lf, 1e19lf));
  if (a == 0.0lf || a > kDoubleLargest) result = (a == 0.0lf) == (y > 0.0lf) ? 0.0lf : doubleInfinity();
  result = highBits(x) < 0 && odd ? -result : result;
  if (x != x || y != y || (x < 0.0lf && a <= kDoubleLargest && !integer)) result = doubleNan();
  return y == 0.0lf || x == 1.0lf ? 1.0lf : result;
}
#endif
