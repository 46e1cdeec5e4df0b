// SPDX-License-Identifier: Apache-2.0
// Brushed steel: grooves along u, which spread a highlight across them (G. Ward, "Measuring and modeling anisotropic
// reflection", SIGGRAPH 1992, equation 5a). Its width along a direction is the roughness in that direction.
#include "noise.glsl"

const float kPi = 3.14159265;

uniform vec3 metal = vec3(0.62, 0.60, 0.58);   // @color
uniform vec2 roughness = vec2(0.06, 0.35);  // along the grooves, across them @slider 0.02 0.5
uniform float grooves = 400.0;              // over v @slider 20 800
uniform float depth = 0.25;                 // how much they vary

// Of the angle between the half vector and the normal; n, h, along, across: unit but h.
float ward(Point p, vec3 toLight) {
  float up = dot(p.normal, toLight), back = dot(p.normal, p.viewer);
  if (up <= 0.0 || back <= 0.0) return 0.0;
  vec3 h = toLight + p.viewer;
  float x = dot(h, p.tangent) / roughness.x, y = dot(h, p.bitangent) / roughness.y, z = dot(h, p.normal);
  return exp(-(x * x + y * y) / (z * z)) / (4.0 * kPi * roughness.x * roughness.y * sqrt(up * back)) * up;
}

// How bright the groove is, over what the pixel covers: it fades where grooves are thinner than that.
float groove(Point p) {
  float width = grooves * (abs(p.footprint[0].y) + abs(p.footprint[1].y));
  float line = noise(vec3(2.0 * p.uv.x, grooves * p.uv.y, 0.5));
  return 1.0 + depth * (2.0 * line - 1.0) * clamp(1.5 - width, 0.0, 1.0);
}

vec4 material(Point p) {
  vec3 sum = metal * ambientLight();
  float shade = groove(p);
  for (int i = 0; i < lightCount(); ++i) {
    Light l = light(i);
    sum += metal * shade * l.radiance * l.visible * (0.1 * max(dot(p.normal, l.direction), 0.0) + ward(p, l.direction));
  }
  return vec4(sum, 1.0);
}
