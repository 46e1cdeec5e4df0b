// SPDX-License-Identifier: Apache-2.0
// How much of a pixel lines of a field cover: engine/scene/isolines.h says how, and has the same in double.
#include "shared/truth.h"

// Those of the material, behind its other numbers.
float isolineParameterAt(uint k) { return patternParameterAt(LUXO_FIRST_OF_ISOLINES + k); }
#undef parameterAt
#define parameterAt isolineParameterAt

// The part of a square pixel in which a linear function is less than x, less a half, where it is 0 in the middle and moves by
// a and b, a >= b >= 0, along the sides.
float partBelow(float x, float a, float b) {
  float off = abs(x), beyond = 0.5 * (a + b) - off;
  float part = off <= 0.5 * (a - b) ? off / a : beyond > 0.0 ? 0.5 - beyond * beyond / (2.0 * a * b) : 0.5;
  return x < 0.0 ? -part : part;
}

float coveredByLine(float off, float width, float a, float b) {
  return partBelow(off + 0.5 * width, a, b) - partBelow(off - 0.5 * width, a, b);
}

// `field`: how far from a line it is, its derivatives by u and v, its size; all in steps, if it `repeats`.
float lineCoverage(vec4 field, float width, bool repeats) {
  vec4 footprint = pixelFootprint();
  vec2 perPixel = abs(vec2(dot(field.yz, footprint.xy), dot(field.yz, footprint.zw)));
  float a = max(perPixel.x, perPixel.y), b = min(perPixel.x, perPixel.y), slope = length(perPixel);
  if (!(slope > kFieldRounding * field.w) || !(width > 0.0)) return 0.0;
  if (!(slope < kEndlessSlope)) return repeats ? 1.0 : 0.0;
  float wide = width * slope;
  if (!repeats) return coveredByLine(field.x, wide, a, b);
  float mean = min(wide, 1.0), many = clamp(a + b - kFewLines, 0.0, kManyLines - kFewLines);
  if (mean == 1.0 || many == kManyLines - kFewLines) return mean;
  float off = field.x - floor(field.x), sum = 0.0;
  for (int k = -2; k <= 3; ++k) sum += coveredByLine(off - float(k), wide, a, b);
  return mix(sum, mean, many);
}

// Lines, times the part that they cover, which is last, where that much of another is over them: of a linear colour, with an
// opacity.
vec4 underLine(vec4 lines, vec4 line, float covered) {
  vec3 color = vec3(colorOrBlack(line.r), colorOrBlack(line.g), colorOrBlack(line.b));
  return mix(lines, vec4(color, 1), covered * (line.a > 0.0 ? min(line.a, 1.0) : 0.0));
}
