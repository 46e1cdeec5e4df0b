// SPDX-License-Identifier: Apache-2.0
// Cool and warm: the side of a light is warm, the other cool, and no side is dark (A. Gooch et al., "A non-photorealistic
// lighting model for automatic technical illustration", SIGGRAPH 1998).
uniform vec3 paint = vec3(0.55, 0.25, 0.2);  // @color
uniform float blue = 0.4, yellow = 0.4;        // of the cool and the warm tone
uniform float cool = 0.2, warm = 0.6;          // how much of the paint they take
uniform float lines = 0.25;                    // the cosine below which the outline is drawn

vec4 material(Point p) {
  vec3 shadow = vec3(0, 0, blue) + cool * paint, sun = vec3(yellow, yellow, 0) + warm * paint;
  vec3 color = shadow;
  if (lightCount() > 0) {
    Light l = light(0);
    color = mix(shadow, sun, 0.5 + 0.5 * dot(p.normal, l.direction));
    vec3 mirrored = reflect(-l.direction, p.normal);
    color += l.visible * 0.6 * pow(max(dot(mirrored, p.viewer), 0.0), 40.0);
  }
  float edge = smoothstep(lines - 0.06, lines + 0.06, dot(p.normal, p.viewer));
  return vec4(mix(vec3(0.03), color, edge), 1.0);
}
