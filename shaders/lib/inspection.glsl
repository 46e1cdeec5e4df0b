// SPDX-License-Identifier: Apache-2.0
// Geometry as numbers (auxiliary outputs) or as colours (debug views).
#include "lib/scene.glsl"

struct Inspected {
  vec3 position, normal;
  vec2 parameters;
  float depth;
  uint id;
  float residual;  // pixels; negative: not certified
  uint certificate;
};

// Colours of neighbouring numbers lie a golden angle apart on the hue circle: any few nodes are told apart.
vec3 colorOfId(uint id) {
  vec3 hue = fract(float(id) * 0.61803399 + vec3(0.0, 1.0 / 3.0, 2.0 / 3.0));
  return 0.15 + 0.75 * smoothstep(0.0, 1.0, abs(2.0 * hue - 1.0));
}

// From 1e-6 pixels (dark blue) over 1e-4 (green) to 1e-2 (red), by powers of ten; magenta where not certified.
vec3 colorOfResidual(float residual) {
  if (residual < 0.0) return vec3(0.9, 0.05, 0.9);
  float x = clamp((log2(max(residual, 1e-9)) * 0.30103 + 6.0) / 4.0, 0.0, 1.0);
  return vec3(smoothstep(0.5, 0.9, x), smoothstep(0.05, 0.5, x) * (1.0 - smoothstep(0.7, 1.0, x)),
              0.25 + 0.5 * smoothstep(0.0, 0.25, x) - 0.7 * smoothstep(0.3, 0.6, x));
}

// `domain`: lowest and highest u and v.
vec3 inspectedValue(Inspected point, uint quantity, bool asColor, vec4 domain) {
  if (quantity == kPosition) return point.position;
  if (quantity == kNormal) return asColor ? 0.5 + 0.5 * point.normal : point.normal;
  if (quantity == kParameters)
    return vec3(asColor ? (point.parameters - domain.xy) / (domain.zw - domain.xy) : point.parameters, 0);
  if (quantity == kDepth) {
    float nearness = (view.depthRange.y - point.depth) / max(view.depthRange.y - view.depthRange.x, 1e-30);
    return vec3(asColor ? 0.02 + 0.98 * clamp(nearness, 0.0, 1.0) : point.depth);
  }
  if (quantity == kId) return asColor ? colorOfId(point.id) : vec3(point.id);
  if (quantity == kCertificate) return vec3(point.certificate);
  return asColor ? colorOfResidual(point.residual) : vec3(abs(point.residual));
}
