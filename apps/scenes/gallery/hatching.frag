// SPDX-License-Identifier: Apache-2.0
// A drawing in ink: lines along u that are as wide as the light leaves the paper dark, and others across them where it is
// darker still, so that the mean of ink and paper is the tone (E. Praun et al., "Real-Time Hatching", SIGGRAPH 2001, has the
// tones; here each line's width is computed, and its mean over the pixel).

uniform vec2 lines = vec2(40.0, 20.0);          // over v and over u
uniform vec3 paper = vec3(0.93, 0.9, 0.82);     // @color
uniform vec3 ink = vec3(0.03, 0.03, 0.08);      // @color
uniform float bright = 1.0;                     // @slider 0.2 3

// The mean, over a box around x, of a wave that is 1 for a part of each unit, in its middle.
float meanOfLines(float x, float size, float part) {
  float half_ = 0.5 * max(size, 1e-5), low = x - half_, high = x + half_;
  // The integral of the wave from 0.
  float upTo = floor(high) * part + clamp(fract(high) - 0.5 + 0.5 * part, 0.0, part);
  float from = floor(low) * part + clamp(fract(low) - 0.5 + 0.5 * part, 0.0, part);
  return (upTo - from) / (2.0 * half_);
}

vec4 material(Point p) {
  vec3 light_ = blinnPhong(vec3(1.0), vec3(0.0), 1.0);
  float dark = clamp(1.0 - bright * dot(light_, vec3(0.2126, 0.7152, 0.0722)), 0.0, 1.0);
  // Up to a half by the first lines, so that the tone is 1 - (1 - first) (1 - second).
  float first = min(dark, 0.5), second = dark > 0.5 ? 1.0 - (1.0 - dark) / 0.5 : 0.0;
  vec2 size = abs(p.footprint[0]) + abs(p.footprint[1]);
  float along = meanOfLines(lines.x * p.uv.y, lines.x * size.y, first),
        across = meanOfLines(lines.y * p.uv.x, lines.y * size.x, second);
  float share = 1.0 - (1.0 - along) * (1.0 - across);
  return vec4(mix(paper, ink, share), 1.0);
}
