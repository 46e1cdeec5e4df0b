// SPDX-License-Identifier: Apache-2.0
// The pattern of a material. The file "pattern" is made from its formulas when a scene is read.
#ifndef LUXO_LIB_PATTERN_GLSL
#define LUXO_LIB_PATTERN_GLSL
#include "lib/formula.glsl"
#include "lib/found_around.glsl"
#include "shared/scene_data.h"

#ifndef LUXO_PATTERN_BINDING
#define LUXO_PATTERN_BINDING kBindingPatternParameters
#endif
layout(scalar, set = kSetPattern, binding = LUXO_PATTERN_BINDING) readonly buffer PatternParameters { float patternParameters[]; };

// The including shader says where the material's parameters start, and what lib/found_around.glsl asks.
uint firstPatternParameter();

float patternParameterAt(uint k) { return patternParameters[firstPatternParameter() + k]; }

// A formula without a value is black. What is above the largest number of a scene (scene/ranges.h) is that, so that no
// product with a light leaves float's range.
float colorOrBlack(float c) { return c > 0.0 && c <= 3.40282347e38 ? min(c, 1e18) : 0.0; }

#define parameterAt patternParameterAt
#include "pattern"
#undef parameterAt

vec2 patternParametersAt(vec2 parameters) {
  vec4 bounds = patternBounds();
  return clamp(parameters, bounds.xy, bounds.zw);
}

// The colour, and how opaque it is; of a pattern that does not say 1.
vec4 paintAt(vec2 parameters) {
  parameters = patternParametersAt(parameters);
  vec4 paint;
  patternPaint(parameters.x, parameters.y, paint);
  paint = vec4(colorOrBlack(paint.r), colorOrBlack(paint.g), colorOrBlack(paint.b), paint.a > 0.0 ? min(paint.a, 1.0) : 0.0);
#ifdef LUXO_FIRST_OF_ISOLINES
  vec4 lines = isolinesOver(parameters.x, parameters.y);
  paint.rgb = (1.0 - lines.a) * paint.rgb + lines.rgb;
#endif
  return paint;
}

vec3 patternAt(vec2 parameters) { return paintAt(parameters).rgb; }
#endif
