// SPDX-License-Identifier: Apache-2.0
// A leaf: both sides scatter light, and what comes from behind goes through it, yellower than what it reflects, for it went
// through the green once more (P. Hanrahan and W. Krueger, "Reflection from layered surfaces due to subsurface scattering",
// SIGGRAPH 1993, which has leaves). u runs across it from -1 to 1, v along it from 0 to 1. Shadows of other leaves fall
// through it, too.
#include "noise.glsl"

uniform vec3 reflectance = vec3(0.07, 0.19, 0.03);    // @color
uniform vec3 transmittance = vec3(0.24, 0.40, 0.03); // @color
uniform float veins = 9.0;     // on each side @slider 0 20
uniform float slant = 0.35;    // how far a vein gets along the leaf on its way out @slider 0 1
uniform float relief = 1.0;    // how much veins and cells show @slider 0 1
uniform float shine = 0.03;    // of the wax @slider 0 0.3

// 1 in the middle of a line of that half width at 0, smooth over what a pixel covers.
float line(float x, float width, float pixel) {
  float soft = max(pixel, 0.3 * width);
  return (1.0 - smoothstep(width - 0.5 * soft, width + 0.5 * soft, abs(x))) * clamp(2.0 * width / max(pixel, 1e-6), 0.0, 1.0);
}

vec4 material(Point p) {
  vec2 size = abs(p.footprint[0]) + abs(p.footprint[1]);
  float out_ = abs(p.uv.x), wave = veins * (p.uv.y - slant * out_ * (1.15 - 0.3 * out_));
  float middle = line(p.uv.x, 0.05 * (1.1 - p.uv.y), size.x);
  float side = line(fract(wave) - 0.5, 0.09 * (1.1 - out_), veins * (size.y + slant * size.x)) * (veins > 0.0 ? 1.0 : 0.0);
  float vein = relief * max(middle, 0.7 * side);
  vec2 cells = vec2(40.0 * p.uv.x, 70.0 * p.uv.y);
  float fine = clamp(1.5 - 70.0 * max(size.x, size.y), 0.0, 1.0);
  float mottle = 1.0 + relief * (0.5 * fine * (noise(vec3(cells, 0.5)) - 0.5) + 0.5 * (noise(vec3(0.1 * cells, 7.5)) - 0.5));

  vec3 front = reflectance * mix(1.0, 2.2, vein) * mottle;
  vec3 through = pow(transmittance, vec3(mix(1.0, 1.9, vein) * mottle));  // thicker there
  vec3 sum = front * ambientLight() + 0.5 * through * ambientLight();
  for (int i = 0; i < lightCount(); ++i) {
    Light l = light(i);
    float up = dot(p.normal, l.direction);
    vec3 color = up > 0.0 ? front : through;
    float mirrored = up > 0.0 ? shine * pow(max(dot(p.normal, normalize(l.direction + p.viewer)), 0.0), 25.0) * 6.0 : 0.0;
    sum += (color * abs(up) + mirrored * (1.0 - 0.5 * vein)) * l.radiance * l.visible;
  }
  return vec4(sum, 1.0);
}
