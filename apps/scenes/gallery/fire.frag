// SPDX-License-Identifier: Apache-2.0
// Fire: what it gives off on the way from a point to the viewer is added to the light on that point, so that it stands in front
// of whatever has this material. Its body is torn by turbulence that rises (K. Perlin and E. Hoffert, "Hypertexture", SIGGRAPH
// 1989), its colours are those of a black body, which is what soot is, by Planck's law.
#include "noise.glsl"

const vec3 kWavelengths = vec3(611.0, 549.0, 464.0);  // nanometres: of sRGB's primaries, about

uniform float time;
uniform vec3 foot = vec3(0.0);     // metres, world
uniform float tall = 2.5;          // @slider 0.2 5
uniform float wide = 0.65;         // @slider 0.1 2
uniform float rise = 1.8;          // metres a second @slider 0 5
uniform float torn = 0.9;          // by turbulence @slider 0 2
uniform float scale = 1.7;         // of that, waves per metre @slider 0.2 6
uniform float hot = 1950.0;        // kelvin, inside @slider 1000 4000
uniform float cool = 1450.0;       // kelvin, outside @slider 1000 4000
uniform float strength = 5.0;      // of a metre of 1900 kelvin @slider 0 20
uniform vec3 paint = vec3(0.25);   // of the surface @color
uniform float shine = 0.05;        // @slider 0 1
uniform float rough = 0.5;         // how uneven the paint is @slider 0 1
uniform float embers = 0.0;        // how much of it glows @slider 0 1

// What a black body gives off, of red at 1900 kelvin (Planck's law).
vec3 blackBody(float kelvin) {
  const float kSecond = 1.438777e7;  // nanometre kelvins
  vec3 shorter = kWavelengths.r / kWavelengths;
  return shorter * shorter * shorter * shorter * shorter * (exp(kSecond / (kWavelengths.r * 1900.0)) - 1.0) /
         (exp(kSecond / (kWavelengths * kelvin)) - 1.0);
}

// Above 0 inside, 1 on the axis where nothing tears it. A place is from the foot.
float body(vec3 place) {
  float height = place.y / tall, width = 2.0 * wide * sqrt(max(height + 0.03, 0.0)) * (1.0 - height);
  float top = 1.0 - 0.5 * height * height, loose = torn * (0.4 + 0.4 * height), sway = 0.22 * torn * height * tall * wide;
  if (width <= 0.0 || length(place.xz) > width * (top + loose) + 1.5 * sway) return -1.0;  // about as far as noise tears it
  vec3 where = scale * vec3(place.x, 0.7 * (place.y - rise * time), place.z);
  vec4 coarse = gradientNoise(where);
  float fine = gradientNoise(2.3 * where + 0.4 * coarse.xyz).w;
  return top - length(place.xz + sway * coarse.xz) / width + loose * (0.7 * coarse.w + 0.6 * fine);
}

// From a point, from its foot, toward the viewer.
vec3 fire(vec3 point, vec3 way) {
  // A cylinder around it.
  float radius = 1.4 * wide, flat_ = dot(way.xz, way.xz), near = -dot(point.xz, way.xz) / max(flat_, 1e-6);
  vec2 off = point.xz + near * way.xz;
  float half_ = (radius * radius - dot(off, off)) / max(flat_, 1e-6);
  if (half_ <= 0.0) return vec3(0.0);
  vec2 heights = (vec2(0.0, tall) - point.y) / (abs(way.y) > 1e-6 ? way.y : 1e-6);
  float from = max(max(near - sqrt(half_), min(heights.x, heights.y)), 0.0), to = min(near + sqrt(half_), max(heights.x, heights.y));
  const int kSteps = 24;
  float step_ = max(to - from, 0.0) / float(kSteps);
  vec3 sum = vec3(0.0);
  for (int i = 0; i < kSteps && step_ > 0.0; ++i) {
    float b = body(point + (from + (float(i) + 0.5) * step_) * way);
    if (b > 0.0) sum += smoothstep(0.0, 0.5, b) * blackBody(mix(cool, hot, clamp(1.3 * b, 0.0, 1.0)));
  }
  return strength * step_ * sum;
}

vec4 material(Point p) {
  vec3 uneven = 7.0 * p.object;
  float grain = rough > 0.0 ? gradientNoise(uneven).w + 0.5 * gradientNoise(2.7 * uneven).w : 0.0;
  vec3 color = blinnPhong(paint * (1.0 + rough * grain), vec3(shine), 20.0);
  if (embers > 0.0) {
    // They breathe: they are hottest where the noise is high, and that moves on.
    float glow = embers + gradientNoise(2.0 * uneven + vec3(0.0, 0.5 * time, 0.0)).w + 0.4 * grain - 0.75;
    if (glow > 0.0) color += blackBody(1200.0 + 500.0 * min(glow, 1.0));
  }
  return vec4(color + fire(p.position - foot, p.viewer), 1.0);
}
