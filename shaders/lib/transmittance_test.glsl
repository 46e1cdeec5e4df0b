// SPDX-License-Identifier: Apache-2.0
// How much of its light a caster lets through to a point: the product over all points in which the light's ray meets it, each
// proven to be one (lib/meeting.glsl). One on a border between two cells may be met in both, and counts once.
#define LUXO_EVALUATIONS 4096
// What two cells have met is one; what none has would be lost.
#define LUXO_USUAL_ROUNDING 1.0
#include "lib/shadow_test.glsl"
#ifndef LUXO_TRIANGLES
#include "lib/meeting.glsl"
#endif
#include "lib/cutoff.glsl"
#include "lib/one_point.glsl"

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

struct Passage {
  float t, off;   // metres along the ray, and by how much that may be off
  bool atBorder;  // a neighbouring cell may have it, too
  vec2 parameters;
  vec3 normal;
  vec3 part;      // how much of the light gets through
};

const int kMostPassages = 24;  // of a ray; more are left to rays
Passage passages[kMostPassages];
int passageCount;

// In the order of their distance, so that what rounding leaves of the product does not depend on the order of cells. Whether
// the others matter no more, as this one is open.
bool isLastPassage(Passage passage) {
  isOpen = isOpen || passageCount == kMostPassages;
  if (isOpen) return true;
  int place = passageCount++;
  for (; place > 0 && passages[place - 1].t > passage.t; --place) passages[place] = passages[place - 1];
  passages[place] = passage;
  roundsLeft -= passageCount - place;
  return false;
}

#ifdef LUXO_TRIANGLES
#ifdef LUXO_PATTERN
vec2 parametersOfCorner(uint corner) { return vec2(casterParameterAt(9 + 2 * corner), casterParameterAt(10 + 2 * corner)); }

vec2 onTriangle(vec2 weights) {
  vec2 first = parametersOfCorner(0);
  return first + weights.x * (parametersOfCorner(1) - first) + weights.y * (parametersOfCorner(2) - first);
}
#else
vec2 onTriangle(vec2 weights) { return weights; }
#endif

// Of two triangles with a common edge one has what passes there, or both: in one place, which is open.
bool endsAt(CellRay ray, CasterCell cell, vec2 weights, bool atBorder) {
  vec3 part = partThrough(onTriangle(weights));
  return isLastPassage(Passage(metAt, metOff, false, weights, vec3(0), part));
}
#else
bool endsAt(CellRay ray, CasterCell cell, vec2 parameters, bool atBorder) {
  Meeting met = meetingNear(ray, cell, parameters);
  isOpen = !met.isProven;
  if (isOpen) return true;
  vec3 normal = cross(met.Su, met.Sv);
  normal *= cell.outward * inversesqrt(max(dot(normal, normal), 1e-37));
  vec2 inside = parametersInside(cell, met.parameters);
  vec3 part = partThrough(inside);
  return isLastPassage(Passage(met.t, met.off, atBorder, inside, normal, part));
}
#endif

vec3 productOfPassages() {
  vec3 product = vec3(1);
  int last = -1;
  roundsLeft -= passageCount;
  for (int i = 0; i < passageCount; ++i) {
    Passage passage = passages[i];
    bool isBeside = last >= 0 && passage.t - passages[last].t <= 4.0 * (passage.off + passages[last].off);
    bool isTwice = isBeside && (passage.atBorder || passages[last].atBorder) &&
                   isOnePoint(passage.parameters, passage.normal, passages[last].parameters, passages[last].normal);
    // A crease, two sheets that cross, or a surface that covers itself.
    if (isBeside && !isTwice) isOpen = true;
    last = i;
    if (!isTwice) product *= passage.part;
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
