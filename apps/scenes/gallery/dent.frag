// SPDX-License-Identifier: Apache-2.0
// Dents: six octaves of turbulence, sharpened, press the surface in (R. Cook, "Shade trees", SIGGRAPH 1984; as a RenderMan
// shader in S. Upstill, "The RenderMan Companion", 1989, chapter 16). The normal is bent by the exact derivatives of the depth
// (J. Blinn, "Simulation of wrinkled surfaces", SIGGRAPH 1978); the outline stays. Where they are deepest there are holes.
#pragma luxo opacity
#include "noise.glsl"

uniform vec3 metal = vec3(0.45, 0.22, 0.11);   // @color
uniform vec3 patina = vec3(0.10, 0.22, 0.19);  // @color
uniform float scale = 1.0;       // of the noise, per metre @slider 0.1 4
uniform float dent = 1.5;        // metres, where turbulence is 1 @slider 0 4
uniform int octaves = 6;         // @slider 1 8
uniform float sharp = 3.0;       // the power that turbulence is raised to @slider 1 4
uniform float old = 0.5;         // how deep dents are that have a patina @slider 0 1
uniform float hole = 0.42;       // and those that are holes @slider 0.3 2
uniform float shininess = 50.0;  // @slider 1 200

// The derivatives of turbulence by the place, and it: the sum of |noise(4 f place)| / 2 f, f = 1, 2, 4 ... An octave
// fades where pixels are wider than it.
vec4 dents(vec3 place, float pixel) {
  vec4 sum = vec4(0.0);
  float frequency = 4.0;
  for (int i = 0; i < octaves; ++i) {
    vec4 n = gradientNoise(frequency * place);
    float seen = clamp(1.5 - frequency * pixel, 0.0, 1.0);
    sum += seen * 2.0 * sign(n.w) * vec4(n.xyz, n.w / frequency);
    frequency *= 2.0;
  }
  return sum;
}

vec4 material(Point p) {
  float pixel = 0.5 * scale * (length(p.Su * p.footprint[0].x + p.Sv * p.footprint[0].y) +
                               length(p.Su * p.footprint[1].x + p.Sv * p.footprint[1].y));
  vec4 t = dents(scale * p.object, pixel);
  t.xyz = worldNormal(t.xyz);
  // The point moves by -dent t^sharp along the normal: what of its derivatives lies in the surface bends that.
  vec3 slope = scale * dent * sharp * pow(max(t.w, 1e-6), sharp - 1.0) * t.xyz;
  vec3 bent = normalize(p.normal + slope - dot(slope, p.normal) * p.normal);
  float worn = old > 0.0 ? smoothstep(0.6 * old, old, t.w) : 0.0;
  vec3 color = mix(metal, patina, worn);
  vec3 sum = color * ambientLight();
  for (int i = 0; i < lightCount(); ++i) {
    Light l = light(i);
    float up = dot(bent, l.direction);
    if (up <= 0.0 || dot(p.normal, l.direction) <= 0.0) continue;
    float across = max(dot(bent, normalize(l.direction + p.viewer)), 0.0);
    sum += l.radiance * l.visible * color * (up + 3.0 * (1.0 - worn) * pow(across, shininess));
  }
  // Of the pixel, how much is on the side of the metal: as if the edge were straight.
  vec3 slant = scale * t.xyz;
  vec2 perPixel = vec2(dot(slant, p.Su * p.footprint[0].x + p.Sv * p.footprint[0].y),
                       dot(slant, p.Su * p.footprint[1].x + p.Sv * p.footprint[1].y));
  return vec4(sum, clamp(0.5 + (hole - t.w) / max(length(perPixel), 1e-9), 0.0, 1.0));
}
