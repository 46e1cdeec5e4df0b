// SPDX-License-Identifier: Apache-2.0
// Wood: rings around the axis of a trunk, from which the surface is cut (D. Peachey, "Solid texturing of complex surfaces",
// and K. Perlin, "An image synthesizer", both SIGGRAPH 1985). A ring darkens slowly from spring to autumn, and ends.
#include "noise.glsl"

uniform vec3 early = vec3(0.55, 0.33, 0.16);  // @color
uniform vec3 late = vec3(0.24, 0.11, 0.045);  // @color
uniform vec3 pith = vec3(0.0);                // a point of the trunk's axis, on the node's axes
uniform vec3 trunk = vec3(0.0, 1.0, 0.0);     // along it
uniform float rings = 14.0;                   // per metre @slider 1 60
uniform float autumn = 3.0;                   // how late in the year it darkens @slider 0.5 8
uniform float wobble = 0.06;                  // metres: how far from round rings are @slider 0 0.3
uniform float fibre = 0.35;                   // how much its fibres and pores show @slider 0 1
uniform float shine = 0.25;                   // of the varnish @slider 0 1

// The mean over a box of a wave that grows from 0 to 1 over each unit, as a power.
float meanOfYears(float year, float size) {
  vec2 at = year + 0.5 * max(size, 1e-3) * vec2(-1.0, 1.0);
  vec2 sums = (floor(at) + pow(fract(at), vec2(autumn + 1.0))) / (autumn + 1.0);
  return (sums.y - sums.x) / (at.y - at.x);
}

vec4 material(Point p) {
  vec3 along = dot(trunk, trunk) > 0.0 ? normalize(trunk) : vec3(0.0, 1.0, 0.0), place = p.object - pith;
  float height = dot(place, along);
  vec3 across = place - height * along;
  float pixel = length(p.Su * p.footprint[0].x + p.Sv * p.footprint[0].y) +
                length(p.Su * p.footprint[1].x + p.Sv * p.footprint[1].y);
  // Trunks grow straighter along than across.
  vec3 slow = 2.5 * across + 0.5 * height * along;
  float radius = length(across) + wobble * (noise(slow + 3.7) - 0.5) + 0.2 * wobble * (noise(4.0 * slow) - 0.5);
  float share = meanOfYears(rings * radius, 0.5 * rings * pixel);
  // Fibres are long, and fade where pixels are wider than they.
  vec3 thin = 60.0 * across + 2.0 * height * along;
  float fine = fibre * clamp(1.5 - 60.0 * pixel, 0.0, 1.0) * (noise(thin + 0.5) - 0.5);
  float pore = fibre * clamp(1.5 - 150.0 * pixel, 0.0, 1.0) * smoothstep(0.62, 0.9, noise(2.5 * thin));
  vec3 color = mix(early, late, clamp(share + 0.6 * fine, 0.0, 1.0)) * (1.0 + 0.4 * fine - 0.6 * pore);
  return vec4(blinnPhong(color, vec3(shine), 60.0), 1.0);
}
