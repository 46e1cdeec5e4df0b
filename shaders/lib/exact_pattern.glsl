// SPDX-License-Identifier: Apache-2.0
// A surface with a pattern found in every pixel. The files "surface" and "pattern" are made from formulas.
#include "lib/exact_fragment.glsl"
#include "lib/pattern.glsl"

uint firstPatternParameter() { return varyingFlags.z; }
vec4 patternBounds() {
  vec4 domain = domainOfNames();
  vec2 margin = 1e-6 * (domain.zw - domain.xy);
  return vec4(domain.xy + margin, domain.zw - margin);
}

void main() {
  Seen seen = seenPoint();
  vec3 color = patternAt(seen.parameters);
  show(seen, has(kPatternAmbient) ? color * varyingAmbientShininess.rgb : varyingAmbientShininess.rgb, color);
}
