// SPDX-License-Identifier: Apache-2.0
// How much of its light a caster lets through to a point: the product over all points in which the light's ray meets it, each
// proven to be one, of one cell alone (lib/cell_ray.glsl, lib/meeting.glsl).
#define LUXO_EVALUATIONS 4096
#include "lib/shadow_test.glsl"
#ifndef LUXO_TRIANGLES
#include "lib/meeting.glsl"
#endif
#include "lib/cutoff.glsl"
#include "shared/truth.h"

bool isOpen;

#ifdef LUXO_PATTERN
#define LUXO_PATTERN_BINDING kBindingCasterPatterns
#define LUXO_TEXELS_BINDING kBindingCasterTexels
#include "lib/pattern.glsl"
#ifdef LUXO_TEXTURED
vec4 pixelFootprint() { return vec4(0); }  // light has no pixels
#endif

uint firstPatternParameter() { return varyingMaterial.y; }
vec4 patternBounds() { return vec4(vec2(-3e38), vec2(3e38)); }  // parameters are within their cell

vec4 paintOf(vec2 parameters) {
  vec4 paint = paintAt(parameters);
  paint.a *= varyingPaint.a;
#ifdef LUXO_MAP_OPACITY
  float least = varyingOff.y;
  if (least > 0.0 && abs(paint.a - least) <= roundingOfAlpha(0, parameters)) isOpen = true;
  paint.a = cutOut(paint.a, least);
#endif
  return paint;
}
#else
vec4 paintOf(vec2 parameters) { return varyingPaint; }
#endif

// How much of the light gets through there.
vec3 partThrough(vec2 parameters) {
  vec4 paint = paintOf(parameters);
  return (1.0 - paint.a) * (has(kTintsLight) ? paint.rgb : vec3(1));
}

// What gets through at a meeting is looked at around it, too, as far as rounding leaves its place: where a pattern jumps there
// rays tell its side, as its border may fall on what is aslant.
#ifdef LUXO_PATTERN
const int kLooks = 5;
#else
const int kLooks = 1;
#endif
#ifdef LUXO_TEXTURED
const float kAlike = 1.0 / 255;  // devices filter with eight bits
#else
const float kAlike = kTransmittanceRounding;
#endif

vec2 lookAside(int i, vec2 unsure) { return i == 0 ? vec2(0) : unsure * vec2((i & 1) * 2 - 1, (i & 2) - 1); }

void look(int i, vec2 parameters, inout vec3 part) {
  vec3 here = partThrough(parameters);
  if (i == 0) part = here;
  else if (any(greaterThan(abs(here - part), vec3(kAlike)))) isOpen = true;
}

struct Passage {
  float t, off;  // metres along the ray, and by how much that may be off
  vec3 part;     // how much of the light gets through
};

const int kMaxPassages = 24;  // of a ray; more are left to rays
Passage passages[kMaxPassages];
int passageCount;

// In the order of their distance, so that what rounding leaves of the product does not depend on the order of cells. Whether
// the others matter no more, as this one is open.
bool isLastPassage(Passage passage) {
  isOpen = isOpen || passageCount == kMaxPassages;
  if (isOpen) return true;
  int place = passageCount++;
  for (; place > 0 && passages[place - 1].t > passage.t; --place) passages[place] = passages[place - 1];
  passages[place] = passage;
  roundsLeft -= passageCount - place;
  return false;
}

#ifdef LUXO_TRIANGLES
#ifdef LUXO_PATTERN
vec2 parametersOfCorner(uint corner) {
  return vec2(casterParameterAt(kTriangleNumbers + kCornerParameters * corner),
              casterParameterAt(kTriangleNumbers + 1 + kCornerParameters * corner));
}

vec2 onTriangle(vec2 weights) {
  vec2 first = parametersOfCorner(0);
  return first + weights.x * (parametersOfCorner(1) - first) + weights.y * (parametersOfCorner(2) - first);
}
#else
vec2 onTriangle(vec2 weights) { return weights; }
#endif

// Of two triangles with a common edge one has what passes there, or both: in one place, which is open.
bool endsAt(CellRay ray, CasterCell cell, vec2 weights, bool atBorder) {
  vec3 part = vec3(1);
  roundsLeft -= kLooks;
  for (int i = 0; i < kLooks; ++i) look(i, onTriangle(weights + lookAside(i, vec2(weightsOff))), part);
  return isLastPassage(Passage(metAt, metOff, part));
}
#else
bool endsAt(CellRay ray, CasterCell cell, vec2 parameters, bool atBorder) {
  Meeting met = meetingNear(ray, cell, parameters);
  isOpen = !met.isProven;
  if (isOpen) return true;
  vec3 part = vec3(1);
  roundsLeft -= kLooks;
  for (int i = 0; i < kLooks; ++i) look(i, parametersInside(cell, met.parameters + lookAside(i, met.unsure)), part);
  return isLastPassage(Passage(met.t, met.off, part));
}
#endif

// Two in one place are a crease, two sheets that cross, or a surface that covers itself: rays tell.
vec3 productOfPassages() {
  vec3 product = vec3(1);
  roundsLeft -= passageCount;
  for (int i = 0; i < passageCount; ++i) {
    Passage passage = passages[i];
    if (i > 0 && passage.t - passages[i - 1].t <= 4.0 * (passage.off + passages[i - 1].off)) isOpen = true;
    product *= passage.part;
  }
  return product;
}

// As of shadowAt().
vec3 transmittanceAt(vec3 position, vec3 normal, float depth, bool isOwn) {
  passageCount = 0;
  isOpen = false;
  int result = shadowAt(position, normal, depth, isOwn);
  isOpen = isOpen || result != kPassed;
  return productOfPassages();
}
