// SPDX-License-Identifier: Apache-2.0
// A checkerboard in u and v that is its own mean over each pixel: the integral of a square wave is a triangle wave, so the
// mean over a box is a difference of two of these. It goes over to grey where squares are smaller than pixels.

uniform vec2 squares = vec2(24.0, 12.0);   // over u and over v
uniform vec3 bright = vec3(0.85);          // @color
uniform vec3 dark = vec3(0.05, 0.06, 0.1); // @color
uniform float shine = 0.25;                // @slider 0 1

// Of a wave that is 1 and -1 in turn, from whole number to whole number.
vec2 triangle(vec2 x) { return abs(fract(0.5 * x) * 2.0 - 1.0); }

// Its mean over a box.
vec2 meanOfWave(vec2 middle, vec2 size) {
  return (triangle(middle - 0.5 * size) - triangle(middle + 0.5 * size)) / size;
}

vec4 material(Point p) {
  vec2 middle = squares * p.uv, size = squares * (abs(p.footprint[0]) + abs(p.footprint[1]));
  vec2 wave = meanOfWave(middle, max(size, vec2(1e-5)));
  float share = 0.5 + 0.5 * wave.x * wave.y;
  return vec4(blinnPhong(mix(dark, bright, share), vec3(shine), 60.0), 1.0);
}
