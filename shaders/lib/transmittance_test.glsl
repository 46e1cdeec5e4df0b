// SPDX-License-Identifier: Apache-2.0
// How much of its light a caster lets through to a point: the product over all points in which the light's ray meets it, each
// proven to be one (lib/meeting.glsl). One on a border between two cells may be met in both, and counts once.
#define LUXO_EVALUATIONS 4096
// What two cells have met is one; what none has would be lost.
#define LUXO_USUAL_ROUNDING 1.0
#include "lib/shadow_test.glsl"
#include "lib/meeting.glsl"
#include "lib/one_point.glsl"
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
  return vec4(paint.rgb, varyingPaint.a * paint.a);
}
#else
vec4 paintOf(vec2 parameters) { return varyingPaint; }
#endif

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
bool isOpen;

// In the order of their distance, so that what rounding leaves of the product does not depend on the order of cells.
bool endsAt(CellRay ray, CasterCell cell, vec2 parameters, bool atBorder) {
  Meeting met = meetingNear(ray, cell, parameters);
  isOpen = !met.isProven || passageCount == kMostPassages;
  if (isOpen) return true;
  vec3 normal = cross(met.Su, met.Sv);
  normal *= cell.outward * inversesqrt(max(dot(normal, normal), 1e-37));
  vec2 inside = parametersInside(cell, met.parameters);
  vec4 paint = paintOf(inside);
  vec3 part = (1.0 - paint.a) * (has(kTintsLight) ? paint.rgb : vec3(1));
  int place = passageCount++;
  for (; place > 0 && passages[place - 1].t > met.t; --place) passages[place] = passages[place - 1];
  passages[place] = Passage(met.t, met.off, atBorder, inside, normal, part);
  return false;
}

vec3 productOfPassages() {
  vec3 product = vec3(1);
  int last = -1;
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
